# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A world of two robots with radios that follow rules."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from harness import Gazebo, Ros, eventually, pose

WORLD = '<sdf version="1.6"><world name="meadow"><gravity>0 0 0</gravity></world></sdf>'
RADIO = '<plugin name="radio" filename="libtrident_radio.so"/>'
ROBOT = f"""<robot name="robot"><link name="base_link"><inertial><mass value="1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<gazebo>{RADIO}</gazebo></robot>"""


class Meadow:
    """Robots "rover" and "boat", 60 m apart, in a world that stands.

    Attributes:
        gazebo: the server; its results are in the folder.
    """

    def __init__(
        self, ros: Ros, folder: Path, rules: str, rover: str = ROBOT, **params: Any
    ) -> None:
        """Start it.

        Args:
            ros: the master it is under.
            folder: for the files and the results.
            rules: a file of config/links.
            rover: description of that robot.
            params: of the server.
        """
        (folder / "team.yaml").write_text(rules, encoding="utf-8")
        (folder / "meadow.world").write_text(WORLD, encoding="utf-8")
        self.gazebo = Gazebo(
            ros,
            folder / "meadow.world",
            radio_rules=str(folder / "team.yaml"),
            out_dir=str(folder),
            **params,
        ).ready()
        self.gazebo.spawn("rover", rover, pose(z=1.0))
        self.gazebo.spawn("boat", ROBOT, pose(x=60.0, z=1.0))

    def step_until(self, is_so: Callable[[], bool], what: str, steps: int = 10) -> None:
        """Step until something is so; at least once."""
        eventually(lambda: self.gazebo.step(steps) > 0.0 and is_so(), what)
