# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The pieces of code in docs/howto/python.md, and processes that have not sourced anything."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

REPO = Path(__file__).resolve().parents[3]
PAGE = REPO / "docs" / "howto" / "python.md"
EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
_BLOCK = re.compile(r"^```python ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SOURCED = re.compile(r"^(ROS_|GAZEBO_|CMAKE_|TRIDENT_|PYTHONPATH$|LD_LIBRARY_PATH$)")


def code(label: str = "") -> str:
    """The one block with this label behind its ```python."""
    (found,) = [text for name, text in _BLOCK.findall(PAGE.read_text("utf-8")) if name == label]
    return str(found)


def run_unsourced(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Runs this Python as a shell does that has sourced nothing."""
    env = {name: value for name, value in os.environ.items() if not _SOURCED.match(name)}
    command = [sys.executable, *words]
    return subprocess.run(command, env=env, cwd=cwd, capture_output=True, text=True, check=False)
