# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import json
from pathlib import Path

import pytest
from trident_tool.faults import Fault, FaultWatch, describe_exit, save_faults
from trident_tool.launch.launch_plan import LaunchNode, LaunchPlan

PLAN = LaunchPlan(
    (
        LaunchNode("/gazebo", "/", "gazebo_ros", "gzserver", required=True),
        LaunchNode("/a/pilot", "/a/", "rotors_control", "lee_position_controller_node"),
        LaunchNode("/a/spawn", "/a/", "gazebo_ros", "spawn_model", ("-model", "craft")),
        LaunchNode("/record", "/", "rosbag", "record"),
        LaunchNode("/again", "/", "my_package", "node", respawn=True),
    ),
    {},
)
DIED = "\x1b[31m[{}] process has died [pid 17, exit code {}, cmd x].\x1b[0m\nlog file: x*.log\n"
REQUIRED = (
    "\x1b[31m================REQUIRED process [gazebo-2] has died!\n{}\nInitiating shutdown!\n"
    "================\x1b[0m\n"
)


def _faults(folder: Path, text: str) -> list[Fault]:
    log = folder / "roslaunch.log"
    log.write_text(text, encoding="utf-8")
    watch = FaultWatch(log, PLAN)
    watch.look()
    return watch.faults


def test_a_controller_that_is_killed_is_named_with_the_signal(tmp_path: Path) -> None:
    (fault,) = _faults(tmp_path, "started\n" + DIED.format("a/pilot-3", -9))
    assert fault == Fault("/a/pilot", "was killed by SIGKILL", True)


def test_the_first_cause_comes_first_and_what_follows_the_end_is_none(tmp_path: Path) -> None:
    text = DIED.format("a/pilot-3", -11)
    text += REQUIRED.format("process has died [pid 18, exit code -6, cmd x].")
    text += DIED.format("slam-1", 1)
    found = _faults(tmp_path, text)
    assert [fault.node for fault in found] == ["/a/pilot", "/gazebo"]
    assert found[1].cause == "was killed by SIGABRT"


def test_a_required_node_that_ends_well_is_no_fault(tmp_path: Path) -> None:
    text = REQUIRED.format("process has finished cleanly")
    assert _faults(tmp_path, text + DIED.format("a/pilot-3", 1)) == []


def test_a_recorder_is_missed_and_the_run_continues(tmp_path: Path) -> None:
    (fault,) = _faults(tmp_path, DIED.format("record-9", -9))
    assert not fault.is_fatal
    assert fault.text == "/record was killed by SIGKILL"


def test_who_is_started_again_is_no_fault(tmp_path: Path) -> None:
    assert _faults(tmp_path, DIED.format("again-4", -9)) == []


def test_a_failed_spawn_names_the_model(tmp_path: Path) -> None:
    (fault,) = _faults(tmp_path, DIED.format("a/spawn-4", 1))
    assert fault.is_fatal
    assert fault.text == "/a/spawn has died with exit code 1: model craft is not in the world"


def test_a_node_of_a_launch_within_the_launch_counts(tmp_path: Path) -> None:
    (fault,) = _faults(tmp_path, DIED.format("slam_toolbox-1", -9))
    assert fault == Fault("/slam_toolbox", "was killed by SIGKILL", True)


@pytest.mark.parametrize(
    ("code", "text"),
    [
        (1, "has died with exit code 1"),
        (-11, "was killed by SIGSEGV"),
        (137, "was killed by SIGKILL"),
        (255, "has died with exit code 255"),
    ],
)
def test_exit_codes_in_words(code: int, text: str) -> None:
    assert describe_exit(code) == text


def test_a_lack_of_memory_is_reported() -> None:
    assert describe_exit(-9, out_of_memory=True).endswith("(the machine was out of memory)")
    assert describe_exit(-11, out_of_memory=True) == "was killed by SIGSEGV"


def test_faults_are_kept_next_to_the_results(tmp_path: Path) -> None:
    save_faults(tmp_path, [])
    assert not list(tmp_path.iterdir())
    save_faults(tmp_path, [Fault("/a", "was killed by SIGKILL", True)])
    kept = json.loads((tmp_path / "faults.json").read_text(encoding="utf-8"))
    assert kept == [{"node": "/a", "cause": "was killed by SIGKILL", "is_fatal": True}]
