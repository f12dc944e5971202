# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Starts the Trident command line whatever PYTHONPATH and working directory are."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from trident_tool.quiet_interrupt import let_interrupts_in

let_interrupts_in()

from trident_tool.cli import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
