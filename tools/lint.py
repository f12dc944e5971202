# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs static checks without provisioning first; this is what ctest calls."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from trident_tool.lint import run_checks
from trident_tool.workspace import Runner, TridentError, Workspace

if __name__ == "__main__":
    try:
        sys.exit(run_checks(Workspace.of_this_file(), Runner(), sys.argv[1:]))
    except TridentError as error:
        sys.exit(f"lint: {error}")
