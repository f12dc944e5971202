# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Who reads what a command prints may stop at any line."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

_READER_GONE = 141  # as a shell tells of a program that SIGPIPE ended


def until_unread(main: Callable[[], int]) -> int:
    """Run a command whose output may be cut off, as by `| head`.

    Args:
        main: the command.

    Returns:
        Its exit code, or 141 where the reader has gone.
    """
    try:
        code = main()
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return _READER_GONE
    return code
