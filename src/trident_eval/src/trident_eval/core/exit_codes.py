# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What ends a command from outside: its reader, the user, a full disk."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable

_READER_GONE = 141  # as a shell reports a program that SIGPIPE ended
_INTERRUPTED = 130
_UNUSABLE = 2


def exit_code_of(main: Callable[[], int]) -> int:
    """Run a command whose output may be cut off, as by `| head`.

    Args:
        main: the command.

    Returns:
        Its exit code, or 141 where the reader has gone, 130 where the user has interrupted it, 2
        where a file cannot be written.
    """
    try:
        code = main()
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return _READER_GONE
    except KeyboardInterrupt:
        return _INTERRUPTED
    except OSError as error:
        problem = _disk_problem(error)
        if problem is None:
            raise
        print(f"trident: {problem}", file=sys.stderr)
        return _UNUSABLE
    return code


def _disk_problem(error: OSError) -> str | None:
    """What is wrong with a file or the disk (full, may not be written); None: it is neither."""
    if error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return error.strerror if error.errno in (errno.ENOSPC, errno.EDQUOT) else None
