# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Launch files under the fixtures that users get: good ones, and such that must fail a test."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trident.testing import Gazebo, Launch, Ros, box_sdf, eventually, pose, recorder

from trident_msgs.msg import FleetState

PAGE = Path(__file__).resolve().parents[3] / "docs" / "howto" / "python.md"
FORMATION = ("trident_bringup", "multi_uav_simulation.launch")
Start = Callable[..., Launch]


def block(label: str) -> str:
    """The piece of code in docs/howto/python.md that has this label."""
    text = PAGE.read_text(encoding="utf-8")
    (found,) = re.findall(rf"^```python {label}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return str(found)


def test_the_launch_test_of_the_page_passes(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text(block("launch-conftest"), encoding="utf-8")
    (tmp_path / "test_formation.py").write_text(block("launch-test"), encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout
    assert "1 passed" in result.stdout


def test_the_same_steps_give_the_same_hash(ros: Ros) -> None:
    hashes = []
    for _ in range(2):
        with Launch(ros, *FORMATION, uavs=1, paused=True, seed=3) as run:
            run.ready()
            assert run.time() == 0.0
            assert run.step_to(2.505) == pytest.approx(2.51)
            assert run.step_to(2.0) == pytest.approx(2.51), "time does not go back"
            assert run.step(4) == pytest.approx(2.55)
        results = run.results()
        assert (results["steps"], results["seed"]) == (255, 3)
        hashes.append(results["state_hash"])
        ros.clean()
    assert hashes[0] == hashes[1]


def test_conditions_are_waited_for_in_simulated_time(launch: Start) -> None:
    run = launch(*FORMATION, uavs=1, paused=True).ready()
    reached = run.step_until(lambda: run.position("UAV1")[2] > 0.8, "UAV1 above 0.8 m")
    assert run.position("UAV1")[2] > 0.8
    before = run.time()
    assert before == pytest.approx(reached)
    with pytest.raises(AssertionError, match=r"UAV1 above 9 m did not happen in 0\.5 s simulated"):
        run.step_until(lambda: run.position("UAV1")[2] > 9.0, "UAV1 above 9 m", limit_s=0.5)
    assert run.time() == pytest.approx(before + 0.5)


def test_a_running_launch_is_paused_where_it_is(launch: Start) -> None:
    run = launch("gazebo_ros", "empty_world.launch", gui=False).spawned("ground_plane")
    run.until(0.5)
    stands_at = run.pause()
    assert [run.time() for _ in range(20)] == [stands_at] * 20
    run.unpause()
    run.until(stands_at + 0.5)


def test_states_are_in_the_world_frame(gazebo: Gazebo) -> None:
    gazebo.spawn("crate", box_sdf("crate"), pose(1.0, 2.0, 10.0, yaw_rad=np.pi / 2.0))
    with recorder("/gazebo/fleet_state", FleetState) as fleet:
        gazebo.step_to(0.5)
        message = fleet.received()[-1]
    state = gazebo.state("crate")
    assert state.position == pytest.approx([1.0, 2.0, 10.0 - 9.81 / 8.0], abs=0.03)
    assert state.linear_velocity == pytest.approx([0.0, 0.0, -9.81 / 2.0], abs=1e-2)
    assert state.orientation == pytest.approx([0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)])
    assert state.angular_velocity == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert message.name == ["crate"]


def test_results_are_there_only_after_the_end(launch: Start) -> None:
    run = launch(*FORMATION, uavs=1, paused=True).ready()
    run.step(1)
    with pytest.raises(AssertionError, match=r"run\.json is not there: has it ended"):
        run.results()
    assert run.end() == []
    assert run.end() == [], "nothing is left to be ended"
    assert run.results()["steps"] == 1


def test_a_launch_file_that_is_not_there_is_reported_at_once(ros: Ros) -> None:
    run = Launch(ros, "trident_bringup", "no_such.launch")
    with pytest.raises(AssertionError, match=r"(?s)has ended.*no_such\.launch"):
        run.ready()


def launch_file(folder: Path, command: str) -> Path:
    """A launch file with the simulator and a node that is this shell command instead."""
    script = folder / "node.sh"
    script.write_text(f"#!/bin/sh\n{command}\n", encoding="utf-8")
    script.chmod(0o755)
    text = f"""<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/>
    <arg name="paused" value="true"/></include>
  <node name="odd" pkg="gazebo_ros" type="spawn_model" launch-prefix="{script}"/>
</launch>"""
    path = folder / "odd.launch"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("command", "reported"),
    [
        ("exit 3", ["odd has died (exit code 3)"]),
        ("trap '' INT; touch READY; while :; do sleep 0.1; done", ["odd ignored the interrupt"]),
        ("setsid sleep 600 & touch READY; wait", ["1 processes were left behind"]),
        ("touch READY; exec sleep 600", []),
    ],
    ids=["dies", "ignores the interrupt", "leaves a process", "is well"],
)
def test_what_is_not_a_clean_end_is_reported(
    ros: Ros, tmp_path: Path, command: str, reported: list[str]
) -> None:
    ready = tmp_path / "ready"
    run = Launch(ros, launch_file(tmp_path, command.replace("READY", str(ready))))
    run.ready()
    until(lambda: bool(run.died()) if "exit" in command else ready.exists())
    assert run.end() == reported
    until(lambda: not run.process.family())


def until(condition: Callable[[], bool]) -> None:
    eventually(condition, "the node does what it is for")


def test_an_unclean_end_fails_the_test_unless_it_fails_anyway(ros: Ros, tmp_path: Path) -> None:
    path = launch_file(tmp_path, "exit 3")

    def fly(error: Exception | None) -> None:
        with Launch(ros, path) as run:
            run.ready()
            until(lambda: bool(run.died()))
            if error:
                raise error

    with pytest.raises(AssertionError, match=r"odd has died \(exit code 3\)"):
        fly(None)
    with pytest.raises(ValueError, match="mine"):
        fly(ValueError("mine"))


def test_logs_of_all_nodes_can_be_read(launch: Start) -> None:
    run = launch(*FORMATION, uavs=1, paused=True).ready()
    run.step(1)
    run.end()
    logs: dict[str, Any] = dict(run.logs())
    assert "roslaunch" in logs
    assert any("formation_node" in name for name in logs), logs.keys()
