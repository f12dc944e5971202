# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math

import pytest
from trident_fleet.core.network import Channel
from trident_fleet.core.tasks.book import Holder, Record
from trident_fleet.core.tasks.messages import State, TaskAnnounce, TaskBid, TaskMessage
from trident_fleet.core.tasks.methods import METHODS
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.methods.improved import Improved
from trident_fleet.core.tasks.protocol import Guards, Team, Times
from trident_fleet.core.tasks.rehearsal import Rehearsal
from trident_fleet.core.tasks.trading.resale import Resale, hold_s
from trident_fleet.core.tasks.trials.instances import random_instance
from trident_fleet.core.tasks.trials.scenes import PERFECT, STEP_S

TIMES = Times()
TASK = TaskAnnounce(0.0, "a", "m", 7, "visit", "", (1.0, 2.0, 0.0))
OFFER = TaskBid(10.0, "a", 7, "r1", 20.0, bundle=("a",))


class Kept(Improved):
    """What was won stays."""

    resells = False


@pytest.fixture
def records() -> dict[str, Record]:
    return {"a": Record(TASK, 7, holders={"r1": Holder(State.AWARDED, 20.0)})}


@pytest.fixture
def resale(records: dict[str, Record]) -> Resale:
    made = Resale("m", TIMES, Guards())
    assert made.offer(OFFER, records["a"])
    (task,) = made.open(records, 0, 10.2)
    assert (task.round, task.bids_until_s) == (8, 10.0 + TIMES.bids_s)
    return made


def bid(cost: float, robot: str = "r2", version: int = 1) -> TaskBid:
    return TaskBid(11.0, "a", 8, robot, cost, version=version)


def test_the_lowest_bid_below_the_price_gets_the_task(
    resale: Resale, records: dict[str, Record]
) -> None:
    for one in (bid(12.0), bid(11.0, "r3"), bid(30.0, version=2), bid(1.0, version=1)):
        assert resale.bid(one, 11.0)
    assert resale.decide(records, 11.5) == []
    ((job, offer),) = resale.decide(records, 12.2)
    assert (job.task.round, offer.robot, offer.cost) == (8, "r3", 11.0)


@pytest.mark.parametrize("cost", [19.9, 25.0])
def test_who_saves_too_little_does_not_get_it(
    resale: Resale, records: dict[str, Record], cost: float
) -> None:
    resale.bid(bid(cost), 11.0)
    assert resale.decide(records, 12.2) == []


def test_a_task_that_is_begun_or_gone_or_offered_too_long_ago_stays(
    records: dict[str, Record],
) -> None:
    changes = [
        {"holders": {"r1": Holder(State.ACTIVE, 20.0)}},
        {"holders": {"r4": Holder(State.AWARDED, 20.0)}},
        {"round": 9},
        {"given_up": True},
        {"done_by": ("r1",)},
    ]
    for changed in changes:
        made = Resale("m", TIMES, Guards())
        made.offer(OFFER, records["a"])
        made.open(records, 0, 10.2)
        made.bid(bid(1.0), 11.0)
        assert made.decide({"a": dataclasses.replace(records["a"], **changed)}, 12.2) == []
    made = Resale("m", TIMES, Guards())
    made.offer(OFFER, records["a"])
    made.open(records, 0, 10.2)
    made.bid(bid(1.0), 11.0)
    assert made.decide(records, 10.0 + hold_s(TIMES)) == []


def test_the_bid_by_which_it_was_won_and_that_of_a_stranger_are_no_offers(
    records: dict[str, Record],
) -> None:
    made = Resale("m", TIMES, Guards())
    for no_offer in (
        dataclasses.replace(OFFER, bundle=()),
        dataclasses.replace(OFFER, robot_id="r2"),
        dataclasses.replace(OFFER, round=6),
    ):
        assert not made.offer(no_offer, records["a"])
    assert made.open(records, 0, 10.2) == []


def test_sales_end_when_their_messages_are_spent(records: dict[str, Record]) -> None:
    made = Resale("m", TIMES, Guards())
    opened = 0
    for now_s in range(10, 400, 4):
        made.offer(dataclasses.replace(OFFER, stamp_s=float(now_s)), records["a"])
        opened += len(made.open(records, 0, float(now_s)))
        made.decide(records, now_s + 3.0)
    assert 1 < opened < 10


def traveled_m(method: Method, seed: int) -> float:
    """Paths of all robots together over a perfect network."""
    made = random_instance(4, 16, seed)
    team = Team({name: can for name, (can, _) in made.robots.items()}, tuple(made.robots))
    channel: Channel[TaskMessage] = Channel(list(made.robots), PERFECT, seed)
    places = {name: place for name, (_, place) in made.robots.items()}
    rehearsal = Rehearsal(team, places, method, channel)
    rehearsal.add(made.tasks)
    length_m = 0.0
    while rehearsal.open_tasks():
        before = dict(rehearsal.places)
        rehearsal.step(STEP_S)
        length_m += sum(math.dist(before[name], rehearsal.places[name]) for name in before)
    assert len(rehearsal.happened.done) == len(made.tasks)
    return length_m


def test_tasks_that_change_hands_on_the_road_make_paths_shorter() -> None:
    resold, kept = (
        sum(traveled_m(method, seed) for seed in range(3))
        for method in (METHODS["improved"], Kept())
    )
    assert resold < 0.97 * kept
