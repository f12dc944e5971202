# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from typing import Any

import pytest
from trident_fleet.core.errors import FormationError
from trident_fleet.core.network import Channel, LinkModel
from trident_fleet.core.tasks.fields import Capabilities, Requirements, TaskError
from trident_fleet.core.tasks.intake import check_tasks
from trident_fleet.core.tasks.messages import TaskAnnounce, TaskAward, TaskBid, TaskTable
from trident_fleet.core.tasks.methods import method_named
from trident_fleet.core.tasks.protocol import Times
from trident_fleet.core.tasks.trials.scenes import Scene, scene

TASK = TaskAnnounce(0.0, "a", "", 0, "visit", "", (1.0, 2.0, 0.0))
ROBOTS = {
    "rover": Capabilities("ground", ("dig",), payload_kg=2.0),
    "boat": Capabilities("water"),
}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"task_id": ""}, "task: task_id is empty, legal: a name"),
        ({"place": (0.0, math.nan, 0.0)}, r"task 'a': place is \(0.0, nan, 0.0\), legal: three"),
        ({"duration_s": -1.0}, "task 'a': duration_s is -1.0, legal: finite, from 0"),
        ({"value": math.nan}, "task 'a': value is nan, legal: finite, from 0"),
        ({"deadline_s": 0.0}, "task 'a': deadline_s is 0.0, legal: above 0"),
        ({"robots_needed": 3}, "task 'a': robots_needed is 3, legal: 1 ... 2"),
        ({"after": ("z",)}, "task 'a': after is 'z', an unknown task, legal: b"),
        ({"after": ("b",)}, "after is circular: (a after b after a|b after a after b), legal"),
        ({"requirements": "{"}, "task 'a': requirements are no JSON"),
        ({"requirements": "[]"}, r"task 'a': requirements are '\[\]', legal: a JSON object"),
        ({"requirements": '{"color": 1}'}, "task 'a': requirements.color is unknown, legal: dom"),
        ({"requirements": '{"speed_m_s": -2}'}, "requirements.speed_m_s is -2, legal: finite"),
        ({"requirements": '{"domains": ["moon"]}'}, "requirements.domains is .* legal: some of"),
        ({"requirements": '{"skills": "dig"}'}, "requirements.skills is 'dig', legal: a list"),
    ],
)
def test_tasks_that_are_not_legal(changed: dict[str, Any], message: str) -> None:
    task = dataclasses.replace(TASK, **changed)
    other = dataclasses.replace(TASK, task_id="b", after=("a",) if task.task_id == "a" else ())
    with pytest.raises(TaskError, match=message):
        check_tasks([task, other], {}, ROBOTS)


def test_a_task_that_is_there_already() -> None:
    with pytest.raises(TaskError, match=r"task 'a': task_id is there already, legal: a new one"):
        check_tasks([TASK], {"a": TASK}, ROBOTS)


def test_requirements_that_nobody_has_are_reported_with_the_nearest_robot() -> None:
    asked = Requirements(("ground",), ("dig",), payload_kg=5.0).to_json()
    said = check_tasks([dataclasses.replace(TASK, requirements=asked)], {}, ROBOTS)
    assert said == [
        f"task 'a': no robot has requirements {asked}; nearest: rover, lacks payload_kg 2 of 5"
    ]


def test_requirements_come_back_from_json() -> None:
    asked = Requirements(("air", "water"), ("see",), 1.5, 2.0, 3.0)
    assert Requirements.from_json(asked.to_json(), "x") == asked
    assert Requirements.from_json("", "x") == Requirements()


@pytest.fixture
def started() -> Scene:
    made = scene(1)
    made.run(until_s=0.6)
    return made


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"cost": -1.0}, "bid of r1 for task 't0': cost is -1.0, legal: finite, from 0"),
        ({"cost": math.nan}, "bid of r1 for task 't0': cost is nan, legal: finite, from 0"),
        ({"robot_id": "r2"}, "bid of r1 for task 't0': robot_id is 'r2', legal: r1"),
        ({"task_id": "x"}, "bid of r1: task_id is 'x', legal: t0, t1, t2, t3, t4, t5"),
        ({"energy": math.inf}, "bid of r1 for task 't0': energy is inf, legal: finite, from 0"),
    ],
)
def test_bids_that_are_not_legal(started: Scene, changed: dict[str, Any], message: str) -> None:
    member = started.rehearsal.members["r0"]
    bid = dataclasses.replace(TaskBid(0.6, "t0", 327681, "r1", 1.0), **changed)
    assert member.manager is not None
    member.manager.on_message("r1", bid, 0.6)
    assert dict(member.follower.problems) == {message: 1}


def test_a_bid_after_the_deadline(started: Scene) -> None:
    member = started.rehearsal.members["r0"]
    assert member.manager is not None
    member.manager.on_time(1.0)
    (running,) = member.manager._auctions.running.values()
    task = running.job.task
    bid = TaskBid(9.0, task.task_id, task.round, "r1", 1.0)
    member.manager.on_message("r1", bid, 9.0)
    (problem,) = member.follower.problems
    assert problem == (
        f"bid of r1 for task 't0': came at 9.000 s, legal: until {task.bids_until_s:.3f} s"
    )


def test_two_managers_of_one_epoch(started: Scene) -> None:
    member = started.rehearsal.members["r1"]
    epoch = member.follower.epoch
    assert not member.follower.hear("r2", TaskTable(0.6, "r2", epoch, ()), 0.6)
    assert dict(member.follower.problems) == {
        f"table of r2: epoch is {epoch}, which is that of r0; legal: one manager an epoch": 1
    }


def test_an_award_to_another_robot_is_not_taken(started: Scene) -> None:
    robot = started.rehearsal.members["r1"].robot
    assert robot is not None
    award = TaskAward(0.6, "t0", 327681, "r0", "r2", 1.0, (), robot.follower.epoch, 9.0)
    assert robot.on_message("r0", award, 0.6) == []
    assert not robot.holdings


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"loss": 1.5}, "link model: loss is 1.5, legal: 0 ... 1"),
        ({"double": math.nan}, "link model: double is nan, legal: 0 ... 1"),
        ({"min_delay_s": 1.0}, "link model: delay from 1.0 to 0.2 s, legal: 0 <= min_delay_s"),
    ],
)
def test_links_that_cannot_be(changed: dict[str, float], message: str) -> None:
    with pytest.raises(FormationError, match=message):
        LinkModel(**changed)  # type: ignore[arg-type]


def test_names_and_times_that_cannot_be() -> None:
    channel: Channel[str] = Channel(["a", "b"], LinkModel(), 1)
    with pytest.raises(FormationError, match=r"member 'c' is unknown, legal: a, b"):
        channel.port("c")
    channel.advance(1.0)
    with pytest.raises(FormationError, match=r"time 0.5 s, legal: from 1.0 s"):
        channel.advance(0.5)
    with pytest.raises(TaskError, match=r"method is 'best', legal: "):
        method_named("best")
    with pytest.raises(TaskError, match=r"lease_s is 0.1, legal: above 2 digest_s"):
        Times(lease_s=0.1)
    with pytest.raises(TaskError, match=r"speed_m_s is 0.0, legal: finite, above 0"):
        Capabilities("air", speed_m_s=0.0)
