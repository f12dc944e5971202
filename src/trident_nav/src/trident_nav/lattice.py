# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""``./trident lattice``: makes control sets for the State Lattice planner."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence

from trident_nav.core.errors import NavError
from trident_nav.core.programs import find_program


def main(words: Sequence[str] | None = None) -> int:
    """Runs ``nav_lattice`` with these words; returns its exit code."""
    try:
        program = find_program("nav_lattice")
    except NavError as error:
        print(f"lattice: {error}", file=sys.stderr)
        return 2
    given = sys.argv[1:] if words is None else list(words)
    return subprocess.run([str(program), *given], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
