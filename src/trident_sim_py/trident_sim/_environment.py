# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where packages, worlds and models are, for a Python whose shell has not sourced a workspace."""

from __future__ import annotations

import json
import os
from pathlib import Path

_PATHS = Path(__file__).with_name("workspace.json")


def complete_environment(paths: Path = _PATHS) -> None:
    """Set ROS_PACKAGE_PATH, GAZEBO_MODEL_PATH and GAZEBO_RESOURCE_PATH where they are not set.

    The variables are the interface: xacro's `$(find package)` reads them too. What a sourced
    workspace or the caller has set stays.

    Args:
        paths: JSON object of variable and value; made by the build next to this file. Nothing
            happens without it, e.g. in an installed package.
    """
    if not paths.is_file():
        return
    for name, value in json.loads(paths.read_text(encoding="utf-8")).items():
        os.environ.setdefault(name, value)
