# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The nodes, as processes, against a world that speaks the lockstep protocol."""

from __future__ import annotations

import json
import os
import socket
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("trident.testing", reason="the workspace is not built or sourced")

from trident.testing.waiting import eventually, output_of
from trident_base.ports import free_port

REPO = Path(__file__).resolve().parents[3]
FLEET = REPO / "src" / "trident_fleet"
TUTORIAL_NODE = REPO / "src" / "compat" / "rotors_teleop" / "scripts" / "rotors_formation_son.py"
PYTHON = "/usr/bin/python3"
LIMIT_S = 120.0

for module in ("rospy", "trident_msgs.srv", "gazebo_msgs.msg"):
    pytest.importorskip(module, reason=f"{module} is not built or sourced")


@dataclass
class RosSession:
    """A master of our own, and what runs under it."""

    env: dict[str, str]
    folder: Path
    processes: list[subprocess.Popen[str]]

    def start(self, *command: object) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [str(word) for word in command],
            env=self.env,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.processes.append(process)
        return process

    def world(self, vehicles: int, sources: int, kind: str = "lockstep") -> subprocess.Popen[str]:
        script = FLEET / "test" / "ros" / "fake_world.py"
        return self.start(PYTHON, script, self.folder / "world.json", vehicles, sources, kind)

    def vehicle(
        self, index: int, *params: str, script: Path = FLEET / "scripts" / "formation_node.py"
    ) -> subprocess.Popen[str]:
        name = f"UAV{index + 1}"
        own = [f"__ns:={name}", f"_UAV:=/{name}/", f"_seq:={index}"]
        return self.start(PYTHON, script, *own, *self.common(), *params)

    def common(self) -> list[str]:
        # Nobody controls these vehicles: nobody has to be waited for.
        return [f"_out_dir:={self.folder}", "_connect_wait:=1"]

    def result(self, world: subprocess.Popen[str]) -> dict[str, Any]:
        output = output_of(world, LIMIT_S)
        assert world.returncode == 0, output
        return dict(json.loads((self.folder / "world.json").read_text()))

    def records(self) -> list[dict[str, Any]]:
        files = sorted(self.folder.glob("formation_*.json"))
        return [json.loads(file.read_text()) for file in files]

    def stop(self) -> None:
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.communicate(timeout=10.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()


def wait_for_port(port: int) -> None:
    def listens() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", port)) == 0

    eventually(listens, f"a rosmaster on port {port}")


def new_session(folder: Path) -> RosSession:
    port = free_port()
    source = [str(FLEET / "src"), os.environ.get("PYTHONPATH", "")]
    env = os.environ | {
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(folder / "ros_home"),
        "PYTHONPATH": os.pathsep.join(source),
    }
    env.pop("TRIDENT_OUT", None)
    session = RosSession(env, folder, [])
    session.start("/usr/bin/rosmaster", "--core", "-p", port)
    wait_for_port(port)
    return session


@pytest.fixture
def session(tmp_path: Path) -> Iterator[RosSession]:
    session = new_session(tmp_path)
    yield session
    session.stop()


@pytest.fixture
def formation(tmp_path: Path) -> Path:
    """Three vehicles, eight rows ahead."""
    path = tmp_path / "three.txt"
    lines = [
        f"{3 * row + i + 1} {0.15 * row} {4.0 - 1.6 * i} 1.0" for row in range(8) for i in range(3)
    ]
    path.write_text("\n".join(lines) + "\n")
    return path


def params(formation: Path, mode: str) -> list[str]:
    return [f"_formation_file:={formation}", "_vehicles_in_file:=3", f"_mode:={mode}"]


def fly(folder: Path, formation: Path, mode: str, single_process: bool) -> RosSession:
    folder.mkdir()
    session = new_session(folder)
    try:
        world = session.world(3, 1 if single_process else 3)
        if single_process:
            script = FLEET / "scripts" / "formation_all.py"
            session.start(PYTHON, script, *session.common(), *params(formation, mode))
        else:
            for index in range(3):
                session.vehicle(index, *params(formation, mode))
        session.result(world)
    finally:
        session.stop()
    return session


@pytest.mark.parametrize("mode", ["time", "gate"])
def test_runs_repeat_to_the_bit_in_one_process_or_in_one_for_each(
    tmp_path: Path, formation: Path, mode: str
) -> None:
    runs = [
        fly(tmp_path / name, formation, mode, single_process=name == "single")
        for name in ("first", "second", "single")
    ]
    worlds = [json.loads((run.folder / "world.json").read_text()) for run in runs]
    assert worlds[0]["digest"] == worlds[1]["digest"] == worlds[2]["digest"]
    assert len(set(worlds[0]["digest"])) == 3
    goal = [[1.05, 4.0 - 1.6 * i, 1.0] for i in range(3)]
    np.testing.assert_allclose(worlds[0]["position"], goal, atol=0.01)
    records = runs[0].records()
    assert [record["vehicle"] for record in records] == ["UAV1", "UAV2", "UAV3"]
    assert records == runs[2].records()
    if mode == "gate":
        assert all(record["finished"] for record in records)
        assert len(records[0]["arrival_time_s"]) == 8
    else:
        assert worlds[0]["sim_s"] >= records[0]["row_time_s"][-1] + 3.0


def test_a_bad_file_is_reported_once_and_the_world_continues(
    session: RosSession, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.txt"
    bad.write_text("1 0 0 1\n2 0 1\n")
    world = session.world(3, 3)
    nodes = [session.vehicle(index, *params(bad, "time")) for index in range(3)]
    assert session.result(world)["sim_s"] == 0.0
    output = ""
    for node in nodes:
        text = output_of(node, LIMIT_S)
        output += text
        assert node.returncode == 1
    assert output.count("FATAL") == 1
    assert f"{bad}:2: 3 columns in '2 0 1'; legal: 4" in output
    assert "Traceback" not in output
    assert all("3 columns" in record["error"] for record in session.records())


def test_a_parameter_that_is_not_known_is_reported_once_with_the_nearest_one(
    session: RosSession, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.txt"
    bad.write_text("1 0 0 1\n2 0 1\n")
    world = session.world(1, 1)
    node = session.vehicle(0, *params(bad, "time"), "_look_ahead:=3")
    session.result(world)
    output = output_of(node, LIMIT_S)
    assert output.count("are not used") == 1
    assert "look_ahead: unknown; did you mean 'lookahead'?" in output


def test_the_tutorial_node_flies_in_a_world_without_lockstep(
    session: RosSession, formation: Path
) -> None:
    world = session.world(3, 0, "plain")
    for index in range(3):
        session.vehicle(
            index, *params(formation, "time"), "_enroll_wait:=0.2", script=TUTORIAL_NODE
        )
    result = session.result(world)
    goal = [[1.05, 4.0 - 1.6 * i, 1.0] for i in range(3)]
    np.testing.assert_allclose(result["position"], goal, atol=0.05)
    assert result["early"] == 0


def follow(folder: Path, formation: Path, *topic: str) -> RosSession:
    """UAV1 flies what is its own in the formation, UAV2 and UAV3 follow it."""
    folder.mkdir()
    session = new_session(folder)
    try:
        world = session.world(3, 2)
        session.vehicle(0, *params(formation, "time"), "_uavs:=1")
        script = FLEET / "scripts" / "leader_follower.py"
        own = ["_followers:=UAV2 UAV3", "_pattern:=line", "_end_when_still:=2.0", *topic]
        session.start(PYTHON, script, *own, *session.common())
        session.result(world)
    finally:
        session.stop()
    return session


@pytest.fixture
def long_path(tmp_path: Path) -> Path:
    """Three vehicles, a hundred rows ahead and up."""
    path = tmp_path / "long.txt"
    rows = [
        f"{3 * row + i + 1} {0.25 * row} {4.0 - 1.6 * i} {1.0 + 0.02 * row}"
        for row in range(100)
        for i in range(3)
    ]
    path.write_text("\n".join(rows) + "\n")
    return path


def test_followers_hold_their_places_and_runs_repeat_to_the_bit(
    tmp_path: Path, long_path: Path
) -> None:
    runs = [follow(tmp_path / name, long_path) for name in ("first", "second")]
    worlds = [json.loads((run.folder / "world.json").read_text()) for run in runs]
    assert worlds[0]["digest"] == worlds[1]["digest"]
    position = np.array(worlds[0]["position"])
    leader, followers = position[0], position[1:]
    np.testing.assert_allclose(leader, [24.75, 4.0, 2.98], atol=0.01)
    # The leader has the middle of the line.
    np.testing.assert_allclose(followers - leader, [[0, 2, 0], [0, -2, 0]], atol=0.02)
    following = [record for record in runs[0].records() if record["mode"] == "follow"]
    records = {record["vehicle"]: record for record in following}
    assert list(records) == ["UAV1", "UAV2", "UAV3"]
    record = records["UAV2"]
    assert (record["mode"], record["leader"], record["error"]) == ("follow", "UAV1", "")
    assert len(record["rows"]) > 5
    np.testing.assert_allclose(record["rows"][-1] - leader, [0, 2, 0], atol=0.02)


def test_without_a_leader_the_followers_hover_until_they_give_up(
    session: RosSession, long_path: Path
) -> None:
    world = session.world(3, 2)
    session.vehicle(0, *params(long_path, "time"), "_uavs:=1")
    script = FLEET / "scripts" / "leader_follower.py"
    own = ["_followers:=UAV2 UAV3", "_leader:=nobody", "_end_when_still:=1.0", "_give_up:=3.0"]
    session.start(PYTHON, script, *own, *session.common())
    position = session.result(world)["position"]
    np.testing.assert_allclose(position[1:], [[0.0, 2.4, 0.6], [0.0, 0.8, 0.6]], atol=0.01)
    errors = {r["vehicle"]: r["error"] for r in session.records() if r["mode"] == "follow"}
    assert set(errors) == {"nobody", "UAV2", "UAV3"}
    assert set(errors.values()) == {"the leader has not been seen"}


def test_a_topic_of_another_type_is_refused(session: RosSession, long_path: Path) -> None:
    world = session.world(3, 2)
    session.vehicle(0, *params(long_path, "time"), "_uavs:=1")
    script = FLEET / "scripts" / "leader_follower.py"
    own = ["_followers:=UAV2 UAV3", "_leader_topic:=/clock"]
    node = session.start(PYTHON, script, *own, *session.common())
    session.result(world)
    output = output_of(node, LIMIT_S)
    assert node.returncode == 1
    assert "leader_topic: /clock is a rosgraph_msgs/Clock; legal: trident_msgs/FleetState" in output
    assert "Traceback" not in output
