# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C ends a program without a traceback, also in its first second, while it imports.

Run by its path, ``quiet_interrupt.py MODULE [WORD …]`` runs a module so. The caller has to block
SIGINT before it starts Python, as ``env --block-signal=INT`` does: it is let in here.
"""

from __future__ import annotations

import runpy
import signal
import sys
from types import TracebackType

BLOCKED_PYTHON = ("/usr/bin/env", "--block-signal=INT", "/usr/bin/python3")


def let_interrupts_in() -> None:
    """From now on SIGINT raises KeyboardInterrupt, and nobody who does not catch it sees that."""
    sys.excepthook = _excepthook
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _excepthook(
    kind: type[BaseException], error: BaseException, trace: TracebackType | None
) -> None:
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


def main() -> None:
    """Runs the module that the command line names, with the words behind it."""
    let_interrupts_in()
    del sys.argv[0]
    sys.path[0] = ""  # as ``python3 -m`` has it, not the folder of this file
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
