# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ends of `./trident run`, and what is left then: no process, and every result."""

from __future__ import annotations

import json
import os
import re
import signal
from pathlib import Path

import pytest
import rosbag
from harness import REPO, eventually
from trident.testing.programs import Process
from trident_runs import Outcome, Trident

# A robot that stands, and a recorder: little to start.
LAUNCH = """\
<launch>
  <arg name="factor" default="1.0"/>
  <param name="/gazebo/real_time_factor" type="double" value="$(arg factor)"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/>
  </include>
  <include file="$(find trident_bringup)/launch/robot/ground_robot.launch"/>
  <node name="record" pkg="rosbag" type="record"
        args="-O $(optenv TRIDENT_OUT)/run.bag --chunksize=4 /clock /gazebo/model_states"/>
</launch>
"""


def commands_of(process: Process) -> list[str]:
    """Command lines of it and of all that it started."""
    found = []
    for pid in process.family():
        try:
            found.append(Path(f"/proc/{pid}/cmdline").read_text("utf-8"))
        except OSError:
            continue
    return found


class Started:
    """A running `./trident run`."""

    def __init__(self, folder: Path, trident: Trident, *words: str) -> None:
        self.process = Process([str(REPO / "trident"), "run", *words], os.environ, folder / "log")
        eventually(self._has_folder, "the run's folder")
        trident.folders.append(self.folder)

    def _has_folder(self) -> bool:
        assert self.process.running, self.process.log
        found = re.search(r"-> (out/\S+)$", self.process.log, re.MULTILINE)
        if found:
            self.folder = REPO / found[1]
        return found is not None

    @property
    def said(self) -> str:
        log = self.folder / "roslaunch.log"
        return self.process.log + (log.read_text("utf-8", "replace") if log.is_file() else "")

    def spawned(self) -> Started:
        eventually(lambda: self.sim_s() > 0.0, f"simulated time in {self.folder}")
        return self

    def sim_s(self) -> float:
        path = self.folder / "progress.jsonl"
        assert self.process.running, self.said
        lines = path.read_text("utf-8").splitlines(keepends=True) if path.is_file() else []
        whole = [line for line in lines if line.endswith("\n")]
        return float(json.loads(whole[-1])["sim_s"]) if whole else 0.0

    def pid_of(self, text: str) -> int:
        """Process id of the one whose command line has this in it."""
        for pid in self.process.family():
            words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
            if any(word.endswith(text) for word in words[:2]):
                return pid
        raise AssertionError(f"no {text} in {self.said}")

    def ended(self) -> Outcome:
        eventually(lambda: not self.process.running, "the end of ./trident run")
        eventually(lambda: not self.process.family(), "the end of all that it started")
        return Outcome(self.process.popen.returncode, self.said, self.folder)


@pytest.fixture
def launch_file(tmp_path: Path) -> Path:
    path = tmp_path / "stand.launch"
    path.write_text(LAUNCH, "utf-8")
    return path


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_no_process_outlives_a_run_that_is_ended_by(
    tmp_path: Path, trident: Trident, launch_file: Path, number: signal.Signals
) -> None:
    run = Started(tmp_path, trident, str(launch_file)).spawned()
    assert len(run.process.family()) > 5
    run.process.send(number)
    outcome = run.ended()
    assert outcome.code == (-signal.SIGKILL if number == signal.SIGKILL else 130)
    with rosbag.Bag(str(run.folder / "run.bag")) as bag:
        assert bag.get_message_count("/clock") > 0, "nothing that was recorded is lost"


def test_a_run_in_its_first_second_leaves_nothing(
    tmp_path: Path, trident: Trident, launch_file: Path
) -> None:
    run = Started(tmp_path, trident, str(launch_file))
    run.process.send(signal.SIGKILL)
    run.ended()


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("real_time_factor:=-1",), "real_time_factor is '-1'"),
        (("uavs:=1000000000",), "/gazebo/wait_for is 1000000000"),
        (("uavs:=7",), "the launch file spawns 6 models"),
        (("uavs:=six",), "invalid literal"),
        (("world_name:=nowhere",), "nowhere.world' not found"),
        (("seed:=-1",), "/gazebo/seed"),
    ],
)
def test_arguments_are_refused_before_anything_starts(
    tmp_path: Path, words: tuple[str, ...], reported: str
) -> None:
    command = [str(REPO / "trident"), "run", "multi_uav_simulation.launch", *words]
    process = Process(command, os.environ, tmp_path / "log")
    assert process.wait() == 1
    (line,) = process.log.splitlines()
    assert line.startswith("trident: ")
    assert reported in line
    assert not process.family()


def test_a_launch_that_the_simulator_ends_leaves_nothing(
    tmp_path: Path, trident: Trident, launch_file: Path
) -> None:
    # What only the simulator itself finds out: a folder that is taken away from it.
    broken = launch_file.read_text("utf-8").replace(
        "<arg name=", '<param name="/gazebo/out_dir" value="/nowhere/at/all"/><arg name=', 1
    )
    launch_file.write_text(broken, "utf-8")
    outcome = Started(tmp_path, trident, str(launch_file)).ended()
    assert outcome.code == 1
    assert "/gazebo has died with exit code 1" in outcome.output
    assert "/nowhere/at/all" in outcome.output


def test_a_killed_simulator_is_named_and_its_torn_states_are_read(
    tmp_path: Path, trident: Trident, launch_file: Path
) -> None:
    run = Started(tmp_path, trident, str(launch_file), "factor:=0").spawned()
    eventually(lambda: (run.folder / "states.csv").stat().st_size > 20000, "states")
    os.kill(run.pid_of("gzserver"), signal.SIGKILL)
    outcome = run.ended()
    assert outcome.code == 1
    assert outcome.verdict["pass"] is False
    assert outcome.verdict["reasons"][0] == "/gazebo was killed by SIGKILL"
    assert outcome.verdict["vehicles"], "what was there is judged"


def test_a_killed_recorder_is_reported_and_what_it_wrote_is_kept(
    tmp_path: Path, trident: Trident, launch_file: Path
) -> None:
    end = {"TRIDENT_END_TIME": "12"}
    os.environ.update(end)
    try:
        run = Started(tmp_path, trident, str(launch_file), "factor:=2").spawned()
    finally:
        for name in end:
            del os.environ[name]
    eventually((run.folder / "run.bag.active").is_file, "the recording")
    eventually(lambda: (run.folder / "run.bag.active").stat().st_size > 20000, "some of it")
    os.kill(run.pid_of("record"), signal.SIGKILL)
    outcome = run.ended()
    assert outcome.passed["notes"][0] == "/record was killed by SIGKILL"
    assert "run.bag was not closed" in outcome.verdict["notes"][1]
    with rosbag.Bag(str(run.folder / "run.bag")) as bag:
        assert bag.get_message_count("/clock") > 10


def test_a_run_without_its_slam_node_fails_at_once_with_its_name(
    tmp_path: Path, trident: Trident
) -> None:
    run = Started(tmp_path, trident, "slam_room.launch")
    eventually(lambda: "sync_slam_toolbox_node" in str(commands_of(run.process)), "the SLAM node")
    os.kill(run.pid_of("sync_slam_toolbox_node"), signal.SIGKILL)
    outcome = run.ended()
    assert outcome.code == 1
    assert "slam_room.launch failed: /slam_toolbox was killed by SIGKILL" in outcome.output
    if (run.folder / "verdict.json").is_file():
        assert outcome.verdict["pass"] is False
        assert outcome.verdict["reasons"][0] == "/slam_toolbox was killed by SIGKILL"


@pytest.mark.parametrize("command", ["view", "shell"])
def test_no_process_outlives_a_look_or_a_shell(tmp_path: Path, command: str) -> None:
    world = REPO / "worlds" / "room.world"
    film = str(tmp_path / "a.mp4")
    words = {
        "view": ["view", str(world), "--film", film, "--seconds", "1000"],
        "shell": ["shell", "-c", "roslaunch gazebo_ros empty_world.launch gui:=false"],
    }[command]
    process = Process([str(REPO / "trident"), *words], os.environ, tmp_path / "log")
    eventually(lambda: "gzserver" in str(commands_of(process)), "the simulator")
    process.send(signal.SIGKILL)
    eventually(lambda: not process.family(), "the end of all that it started")
