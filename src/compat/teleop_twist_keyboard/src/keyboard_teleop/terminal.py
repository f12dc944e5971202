# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Single keys from a terminal."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from types import TracebackType


class Keys:
    """Reads keys one at a time; the terminal is as before afterwards."""

    def __init__(self) -> None:
        """Take standard input.

        Raises:
            OSError: it is not a terminal.
        """
        self._input = sys.stdin.fileno()
        if not os.isatty(self._input):
            raise OSError(
                "standard input is not a terminal: start this with rosrun in a terminal of its own"
            )
        self._settings = termios.tcgetattr(self._input)

    def __enter__(self) -> Keys:
        """Keys come at once, without echo and Enter."""
        tty.setraw(self._input, termios.TCSADRAIN)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the terminal back."""
        termios.tcsetattr(self._input, termios.TCSADRAIN, self._settings)

    def read(self, timeout_s: float | None) -> str | None:
        """The next key; "" when none comes in time; None at the end of the input.

        Args:
            timeout_s: wall time [s]; None: for ever.
        """
        ready, _, _ = select.select([self._input], [], [], timeout_s)
        if not ready:
            return ""
        byte = os.read(self._input, 1)
        return byte.decode("latin-1") if byte else None
