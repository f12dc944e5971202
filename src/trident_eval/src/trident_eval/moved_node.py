# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that are in another package now, and still start by their old names."""

from __future__ import annotations

import os
import sys


def start_moved_node(package: str) -> None:
    """Becomes the node of the same name in a package, with the same words; says what to write.

    Args:
        package: that has the node now.
    """
    path, *words = sys.argv
    name = os.path.basename(path)
    print(f"{name}: a node of {package} now: rosrun {package} {name}", file=sys.stderr, flush=True)
    os.execvp("rosrun", ["rosrun", package, name, *words])
