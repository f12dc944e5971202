# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every launch file of the workspace can be read, and every node in it can be started."""

from pathlib import Path
from typing import Any

import pytest
import roslaunch.config
import roslaunch.xmlloader
import roslib.packages

BRINGUP = Path(__file__).resolve().parents[1]
FILES = sorted((BRINGUP / "launch").resolve().rglob("*.launch"))

# Required arguments of files that are only included by others.
_PLATFORM = [f"{name}:=0" for name in ("x", "y", "z", "yaw")] + [
    f"{name}:=true" for name in ("lidar", "camera", "gnss")
]
REQUIRED_ARGS = {
    "uav.launch": ["namespace:=UAV1"],
    "localization.launch": ["map_file:=map.yaml"],
    "navigation.launch": ["map_file:=map.yaml"],
    "sitl_vehicle.launch": ["autopilot:=px4", "instance:=0"],
    "sitl.launch": [
        *("autopilot:=px4", "vehicles:=1", "stand_in:=false", "world:=px4", "duration:=1"),
        *("real_time_factor:=0", "lockstep_policy:=wait", "seed:=0", "gui:=false"),
    ],
    **{
        f"coast_{kind}.launch": [
            f"ns:={kind}1",
            f"mission:={BRINGUP.parents[1]}/config/missions/coast_{kind}.yaml",
            *_PLATFORM,
        ]
        for kind in ("uav", "ugv", "usv")
    },
}


def _load(path: Path) -> Any:
    loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
    config = roslaunch.config.ROSLaunchConfig()
    loader.load(str(path), config, argv=REQUIRED_ARGS.get(path.name, []), verbose=False)
    return config


def test_there_are_launch_files() -> None:
    assert "multi_uav_simulation.launch" in {path.name for path in FILES}


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_every_node_of_a_launch_file_exists(path: Path) -> None:
    config = _load(path)
    nodes = {(node.package, node.type) for node in config.nodes}
    assert nodes
    missing = [node for node in sorted(nodes) if not roslib.packages.find_node(*node)]
    assert missing == []


@pytest.mark.parametrize("name", ["launch", "config", "worlds"])
def test_links_lead_to_the_folders_at_the_top(name: str) -> None:
    assert (BRINGUP / name).resolve() == BRINGUP.parents[1] / name
