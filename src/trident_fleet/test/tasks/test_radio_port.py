# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import math
import zlib
from collections import defaultdict, deque
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_fleet.core.tasks.codec import decode, encode
from trident_fleet.core.tasks.fields import Capabilities, TaskError
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import (
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskConfirm,
    TaskMessage,
    TaskProgress,
    TaskState,
    TaskTable,
)
from trident_fleet.core.tasks.methods import METHODS
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.protocol import Team
from trident_fleet.core.tasks.radio_port import LONGEST, RadioPort
from trident_fleet.core.tasks.worker import Worker

TASK = TaskAnnounce(0.5, "a", "m", 3, "visit", "", (1.0, 2.0, 0.0), after=("b",))
MESSAGES: list[TaskMessage] = [
    TASK,
    TaskBid(1.0, "a", 3, "r", 2.5, bundle=("x", "y")),
    TaskAward(1.0, "a", 3, "m", "r", 2.5, ("x",), 7, 9.0),
    TaskConfirm(1.0, "a", 3, "r", False, "does not fit"),
    TaskProgress(1.0, "a", 3, "r", 0.5, 2.0, State.ACTIVE),
    TaskTable(1.0, "m", 7, (TaskState(TASK, State.AWARDED, "r", 3, 7, 9.0),)),
]


@pytest.mark.parametrize("message", MESSAGES)
def test_messages_come_back_from_bytes(message: TaskMessage) -> None:
    assert decode(encode(message)) == message


@given(st.binary(max_size=60))
def test_bytes_that_are_no_message(data: bytes) -> None:
    with pytest.raises(TaskError, match=r"message: .*legal: compressed JSON"):
        decode(data)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"type": "TaskPlan"}, "message: type is 'TaskPlan', legal: TaskAnnounce, TaskBid"),
        ({"place": [1.0, 2.0]}, r"TaskAnnounce: place is \[1.0, 2.0\], legal: Point"),
        ({"round": 1.5}, r"TaskAnnounce: round is 1.5, legal: int"),
        ({"value": True}, "TaskAnnounce: value is True, legal: float"),
        ({"after": "b"}, r"TaskAnnounce: after is 'b', legal: tuple\[str, ...\]"),
        ({"requirements": "{"}, "task 'a': requirements are no JSON"),
        ({"kind": 5}, "TaskAnnounce: kind is 5, legal: str"),
    ],
)
def test_fields_of_another_type(changed: dict[str, object], message: str) -> None:
    found = json.loads(zlib.decompress(encode(TASK))) | changed
    with pytest.raises(TaskError, match=message):
        decode(zlib.compress(json.dumps(found).encode()))


class Heard(NamedTuple):
    source: str
    data: bytes
    sent: float


class Radios:
    """Radios that lose nothing, with the interface of `world.radio`."""

    def __init__(self, names: list[str]) -> None:
        self.names, self.now_s = names, 0.0
        self.inbox: defaultdict[str, deque[Heard]] = defaultdict(deque)

    def send(self, source: str, destination: str, data: bytes) -> bool:
        assert len(data) <= LONGEST
        for name in self.names:
            if name != source and destination in (name, "all"):
                self.inbox[name].append(Heard(source, data, self.now_s))
        return True

    def receive(self, name: str) -> list[Heard]:
        heard = list(self.inbox[name])
        self.inbox[name].clear()
        return heard


def test_a_team_shares_out_tasks_by_radio() -> None:
    can = Capabilities("ground", speed_m_s=5.0)
    team = Team({"uav1": can, "ugv1": can}, ("uav1", "ugv1"))
    air = Radios(["uav1", "ugv1"])
    places = {"uav1": (0.0, 0.0, 0.0), "ugv1": (50.0, 0.0, 0.0)}
    members = {
        name: Member(
            RadioPort(air, name, lambda: air.now_s),
            team,
            METHODS["improved"],
            Plan(name, can, place),
        )
        for name, place in places.items()
    }
    workers = {name: Worker(member.robot) for name, member in members.items() if member.robot}
    for index, x in enumerate((5.0, 45.0)):
        task = TaskAnnounce(0.0, f"t{index}", "", 0, "visit", "", (x, 0.0, 0.0), 1.0)
        members["uav1"].follower.request(task)
        members["ugv1"].follower.request(task)
    done = {}
    while air.now_s < 30.0 and len(done) < 2:
        air.now_s += 0.2
        for name, member in members.items():
            member.spin()
            goal = workers[name].goal(air.now_s)
            came = workers[name].at(goal or places[name], air.now_s)
            member.send(list(came.sent))
            done |= {came.done: name} if came.done else {}
    assert done == {"t0": "uav1", "t1": "ugv1"}


def test_what_a_radio_cannot_carry_or_understand_is_counted() -> None:
    air = Radios(["a", "b"])
    port = RadioPort(air, "a", lambda: 0.0)
    words = [f"{math.sin(seed)}" for seed in range(2000)]
    port.send(TaskConfirm(0.0, "a", 1, "a", False, "".join(words)))
    air.send("b", "a", b"\x00")
    assert port.receive() == []
    first, second = port.problems
    assert first == "TaskConfirm to send: length is above the legal 11000 bytes"
    assert second.startswith("from b: message: ")
    assert not air.inbox["b"]
