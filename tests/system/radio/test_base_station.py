# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV that connects others by radio, as a node in lockstep."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from harness import (
    Gazebo,
    Process,
    Ros,
    eventually,
    logged_problems,
    pose,
    program,
    recorder,
    vehicle_urdf,
)

WORLD = """<sdf version="1.6"><world name="meadow">
<include><uri>model://ground_plane</uri></include></world></sdf>"""
RADIO = '<plugin name="radio" filename="libtrident_radio.so"><height>0</height></plugin>'
MAST = f"""<sdf version="1.6"><model name="mast"><static>true</static><link name="link"/>
{RADIO}</model></sdf>"""
BOAT = f"""<robot name="boat"><link name="base_link"><inertial><mass value="1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<gazebo reference="base_link"><gravity>0</gravity></gazebo>
<gazebo><plugin name="truth" filename="libgazebo_ros_p3d.so"><topicName>odom</topicName>
<bodyName>base_link</bodyName><updateRate>50</updateRate></plugin></gazebo>
<gazebo>{RADIO}</gazebo></robot>"""
RULES = """
routing: true
radio: {tx_power: 10.0}
model: {path: free_space, shadowing_sigma: 2.0}
rules:
  - {topic: odom, from: [boat], to: [UAV1], depth: 1, deadline: 0.5, max_rate: 5.0}
"""
STATION = {
    "vehicle": "UAV1",
    "links": "[boat, mast]",
    "places": "{mast: [-45.0, 0.0, 3.0]}",
    "fence": "[[-40, -20], [40, -20], [40, 20], [-40, 20]]",
    "lowest": 8.0,
    "highest": 14.0,
    "survey_time": 8.0,
    "refine_time": 4.0,
}


def start(ros: Ros, **changes: Any) -> Process:
    params = [f"_{key}:={value}" for key, value in (STATION | changes).items()]
    node = [program("trident_fleet", "base_station.py"), "__name:=base_station", *params]
    return ros.launch(node, "base_station")


def populate(gazebo: Gazebo) -> Process:
    """The robots; the controller of the UAV."""
    urdf = vehicle_urdf("UAV1").replace("</robot>", f"<gazebo>{RADIO}</gazebo></robot>")
    gazebo.spawn("mast", MAST, pose(x=-45.0, z=3.0))
    gazebo.spawn("boat", BOAT, pose(x=45.0, z=2.0))
    gazebo.spawn("UAV1", urdf, pose(x=-30.0, z=0.1))
    return gazebo.controller("UAV1")


def flown(
    ros: Ros, start_gazebo: Callable[..., Gazebo], folder: Path, seconds: float
) -> tuple[dict[str, Any], dict[str, Any], list[Any]]:
    """Results and record of a flight, and its diagnostics."""
    folder.mkdir()
    (folder / "meadow.world").write_text(WORLD, encoding="utf-8")
    (folder / "rules.yaml").write_text(RULES, encoding="utf-8")
    gazebo = start_gazebo(
        folder / "meadow.world",
        radio_rules=str(folder / "rules.yaml"),
        out_dir=str(folder),
        wait_for=1,
        wait_for_sources=1,
    ).ready()
    controller = populate(gazebo)
    node = start(ros)
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        gazebo.step_to(seconds)

        def own() -> list[Any]:
            states = [s for array in diagnostics.messages for s in array.status]
            return [state for state in states if state.name == "base_station: UAV1"]

        eventually(lambda: any("hold" in state.message for state in own()), "it holds a place")
        states = own()
    assert node.running, node.log
    assert logged_problems(node.log) == []
    results = gazebo.finish()
    node.stop()
    controller.stop()
    record = json.loads((folder / "base_station_UAV1.json").read_text(encoding="utf-8"))
    return results, record, states


def test_a_base_station_flies_between_its_robots_and_its_runs_repeat(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    results, record, states = flown(ros, start_gazebo, tmp_path / "first", 24.0)
    assert results["repeatable"], results["not_repeatable"]
    assert [phase["phase"] for phase in record["phases"]] == [
        "on the ground",
        "take-off",
        "survey",
        "refine",
        "hold",
    ]
    x, y, z = record["phases"][-1]["goal"]
    assert abs(x) < 30.0  # nearer to the middle than its home
    assert abs(y) <= 19.0
    assert 9.0 <= z <= 13.0
    values = {pair.key: pair.value for pair in states[-1].values}
    worst_db = min(float(values[f"snr {name} [dB]"]) for name in ("boat", "mast"))
    start_db = 61.0 - 20.0 * math.log10(75.0)
    assert worst_db > start_db + 3.0
    again, _, _ = flown(ros, start_gazebo, tmp_path / "second", 24.0)
    assert again["state_hash"] == results["state_hash"]


def test_a_uav_without_a_radio_is_refused(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    gazebo = start_gazebo("basic", wait_for=1, wait_for_sources=1).ready()
    gazebo.spawn("UAV1", at=pose(x=-30.0, z=0.1))
    gazebo.controller("UAV1")
    node = start(ros, connect_wait=0.5)
    assert node.wait() == 1
    assert "link_status: nobody publishes /UAV1/link_status; legal: a UAV with a radio" in node.log
    assert "Traceback" not in node.log
    gazebo.step_to(1.0)


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"lowest": 20.0}, "highest: 14 m; legal: above lowest, 20 m"),
        ({"fence": "[[0, 0], [9, 0], [9, 9]]"}, r"fence: the UAV starts at \(-30, 0\); legal"),
    ],
)
def test_bad_parameters_are_refused_and_the_world_continues(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path, change: dict[str, Any], what: str
) -> None:
    (tmp_path / "rules.yaml").write_text(RULES, encoding="utf-8")
    gazebo = start_gazebo(
        "basic", radio_rules=str(tmp_path / "rules.yaml"), wait_for=1, wait_for_sources=1
    ).ready()
    populate(gazebo)
    node = start(ros, **change)
    assert node.wait() == 1
    assert re.search(what, node.log), node.log
    assert "Traceback" not in node.log
    gazebo.step_to(1.0)
