# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the cores' unit tests under sanitizers; this is what ctest calls."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from trident_tool.sanitizing import run_sanitized
from trident_tool.workspace import Runner, TridentError, Workspace

if __name__ == "__main__":
    try:
        sys.exit(run_sanitized(Workspace.of_this_file(), Runner()))
    except TridentError as error:
        sys.exit(f"sanitize: {error}")
