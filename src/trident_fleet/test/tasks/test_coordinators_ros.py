# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coordinators as processes: tasks over common topics, and over those that a relay carries."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

pytest.importorskip("trident.testing", reason="the workspace is not built or sourced")
pytest.importorskip("trident_msgs.msg", reason="trident_msgs is not built or sourced")

from test_nodes_ros import FLEET, LIMIT_S, PYTHON, RosSession, session
from test_radio_port import MESSAGES
from trident.testing.waiting import eventually, output_of
from trident_fleet.cli import tasks as cli
from trident_fleet.core.tasks.book import Holder, Record
from trident_fleet.core.tasks.fields import Capabilities, TaskError
from trident_fleet.core.tasks.messages import State, TaskMessage
from trident_fleet.nodes.tasks.conversion import from_ros, to_ros
from trident_fleet.nodes.tasks.settings import read_settings

import trident_msgs.msg as ros

__all__ = ["session"]

SCRIPT = FLEET / "scripts" / "cnp_coordinator.py"
POINTS = FLEET / "test" / "ros" / "points.py"
ROBOTS = {"uav1": {"role": "uav", "skills": ["see"], "speed_m_s": 4.0}, "usv1": {"role": "usv"}}


@pytest.mark.parametrize("kind", ["topics", "relay"])
def test_a_team_does_what_a_user_asks_for(session: RosSession, kind: str) -> None:
    world = session.start(PYTHON, POINTS, session.folder / "points.json", kind)
    eventually((session.folder / "points.ready").exists, "the team's parameters")
    for name, role in (("rover", "ugv"), ("boat", "usv")):
        session.start(PYTHON, SCRIPT, f"__ns:={name}", f"_role:={role}", f"_network:={kind}")
    command = [PYTHON, "-m", "trident_fleet.cli.tasks", f"--wait={LIMIT_S}"]
    added = output_of(session.start(*command, "add", "e", "55", "1", "0"), LIMIT_S)
    assert "\ne  " in "\n" + added, added
    output = output_of(world, 5.0 * LIMIT_S)
    assert world.returncode == 0, output
    found = json.loads((session.folder / "points.json").read_text())
    # Both can do b and e, and on a busy machine the nearer one's bid may come too late.
    sure = {name: robot for name, robot in found["done"].items() if name not in ("b", "e")}
    assert sure == {"a": "rover", "c": "rover", "d": "boat"}
    assert found["pending"] == []
    if kind == "topics":
        text = "/bid_submit refused: header.frame_id is '', legal: boat, rover, who sent it"
        assert text in found["refused"].values()


@pytest.mark.parametrize("message", MESSAGES)
def test_messages_come_back_from_ros(message: TaskMessage) -> None:
    made = to_ros(message, "uav1", "map")
    assert made.header.frame_id == "uav1"
    assert from_ros(made, "map") == message


def test_a_task_of_the_command_line_and_the_line_of_what_became_of_it() -> None:
    words = ["add", "dig1", "4", "5.5", "0", "--requirements", '{"skills": ["dig"]}', "--robots"]
    task = cli.task_of(cli.parser().parse_args([*words, "2", "--after", "a", "--after", "b"]))
    assert task.place == (4.0, 5.5, 0.0)
    assert (task.after, task.robots_needed, task.deadline_s) == (("a", "b"), 2, math.inf)
    record = Record(task)
    assert cli.line(record).split() == ["dig1", "waits", "-", "visit", "(4,", "5.5,", "0)"]
    record.holders = {"r1": Holder(State.ACTIVE), "r2": Holder(State.AWARDED)}
    assert cli.line(record).split()[1:4] == ["awarded", "r1,", "r2"]
    record.done_by = ("r1", "r2")
    assert cli.line(record).split()[1] == "done"


def announced() -> Any:
    return to_ros(MESSAGES[0], "uav1", "map")


def test_bad_messages_name_field_value_and_range() -> None:
    bad = announced()
    bad.place.pose.position.y = math.nan
    with pytest.raises(TaskError, match=r"task 'a': place is \(1.0, nan, 0.0\), legal: three"):
        from_ros(bad, "map")
    with pytest.raises(TaskError, match=r"place.header.frame_id is 'map', legal: world"):
        from_ros(announced(), "world")
    bad = announced()
    bad.header.stamp.secs = 4_000_000_000
    with pytest.raises(TaskError, match=r"header.stamp: stamp is 4000000000 s, legal: below"):
        from_ros(bad, "map")
    with pytest.raises(TaskError, match=r"epoch is 50001, legal: 0 ... 50000"):
        from_ros(ros.TaskTable(epoch=50_001), "map")
    bad = announced()
    bad.requirements = "{"
    with pytest.raises(TaskError, match="task 'a': requirements are no JSON"):
        from_ros(bad, "map")
    with pytest.raises(TaskError, match=r"state is 9, legal: 0 ... 4"):
        from_ros(ros.TaskProgress(state=9), "map")
    with pytest.raises(TaskError, match=r"done is nan, legal: 0 ... 1"):
        from_ros(ros.TaskProgress(done=math.nan), "map")


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"robots": None}, "robots: None; legal: a map of names"),
        ({"robots": {"uav1": {"role": "sub"}}}, "robots/uav1/role: 'sub'; legal: uav, ugv, usv"),
        ({"robots": {"uav1": {"rolle": "uav"}}}, "robots/uav1/rolle: unknown; did you mean 'role'"),
        ({"robots": {"uav1": {"role": "uav", "speed_m_s": 0.0}}}, "speed_m_s is 0.0, legal: fini"),
        ({"robots": {"uav1": {"role": "uav", "skills": "see"}}}, "robots/uav1/skills: 'see'; leg"),
        ({"managers": ["a", "a"]}, r"managers: \['a', 'a'\]; legal: each name once"),
        ({"member": "x"}, "member: 'x'; legal: uav1, usv1, the names in robots and managers"),
        ({"role": "ugv"}, "role: 'ugv'; legal: uav, as robots has it for uav1"),
        ({"method": "best"}, "method is 'best', legal: nearest"),
        ({"objective": "fun"}, "objective: 'fun'; legal: sum, makespan, value"),
        ({"network": "wire"}, "network: 'wire'; legal: topics, relay"),
        ({"step": 0.0}, "step: 0; legal: above 0"),
        ({"attempts": 0}, "attempts: 0; legal: 1 or more"),
        ({"lease_s": 0.1}, "lease_s is 0.1, legal: above 2 digest_s"),
    ],
)
def test_bad_parameters(changed: dict[str, Any], message: str) -> None:
    given = {"robots": ROBOTS} | changed
    with pytest.raises(TaskError, match=message):
        read_settings(given.get, "uav1")


def test_settings_of_a_robot_and_of_a_manager() -> None:
    given = {"robots": ROBOTS, "managers": ["gcs", "uav1"], "role": "uav", "lease_s": 8.0}
    robot = read_settings(given.get, "uav1")
    assert robot.is_robot
    assert robot.team.robots["uav1"] == Capabilities("air", ("see",), speed_m_s=4.0)
    assert robot.team.times.lease_s == 8.0
    assert robot.wiring.heard == (("/", None),)
    manager = read_settings((given | {"role": "manager", "network": "relay"}).get, "gcs")
    assert not manager.is_robot
    assert manager.wiring.out == "/gcs/"
    assert manager.wiring.heard == (("/gcs/from/uav1/", "uav1"), ("/gcs/from/usv1/", "usv1"))
