# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Warnings and errors in the output of a launch."""

from __future__ import annotations

import re
from pathlib import Path

_ANSI = re.compile(r"\x1b(\[[0-9;?]*[A-Za-z]|\][^\x07]*\x07)")
# roslaunch says "REQUIRED process has died" also of a node that ended well, so that is left out.
_WARNING = re.compile(
    r"\[\s*(WARN|ERROR|FATAL)\s*\]|process has died \[pid|Traceback|RLException|^ERROR"
)
_NUMBER = re.compile(r"\d+(\.\d+)?")


def log_warnings(log: Path) -> list[str]:
    """Every warning and error of a log once, in their order; none if the file does not exist.

    What differs in numbers only (times, process ids) counts as the same.
    """
    if not log.is_file():
        return []
    text = _ANSI.sub("", log.read_text(encoding="utf-8", errors="replace"))
    found = (line.strip() for line in text.splitlines() if _WARNING.search(line))
    return list({_NUMBER.sub("#", line): line for line in found}.values())
