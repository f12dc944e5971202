# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from trident_fleet.core.assignment import cheapest_pairs
from trident_fleet.core.quintic import Array
from trident_fleet.core.tasks.allocate import Allocation, allocate
from trident_fleet.core.tasks.currents import InCurrent
from trident_fleet.core.tasks.fields import Capabilities, Requirements, TaskError
from trident_fleet.core.tasks.grid_path import GridPath
from trident_fleet.core.tasks.messages import Point, TaskAnnounce
from trident_fleet.core.tasks.methods import METHODS
from trident_fleet.core.tasks.methods.auction import auction_pairs
from trident_fleet.core.tasks.plan import Job, Objective, Plan
from trident_fleet.core.tasks.trading.trades import Trades
from trident_fleet.core.tasks.trials.exact import exact
from trident_fleet.core.tasks.trials.instances import random_instance
from trident_fleet.core.tasks.trials.scenes import LOSSY, PERFECT, scene

Robots = dict[str, tuple[Capabilities, Point]]

ONE_EACH = [name for name, method in METHODS.items() if method.one_each]
MANY_EACH = [name for name, method in METHODS.items() if not method.one_each]


def instance(robots: int, tasks: int, seed: int) -> tuple[Robots, list[TaskAnnounce]]:
    """Points anywhere on 100 x 100 m, robots of speeds 1 ... 3 m/s."""
    made = random_instance(robots, tasks, seed)
    return made.robots, made.tasks


def test_few_tasks_are_within_a_hundredth_of_the_optimum() -> None:
    sums, spans = [], []
    for seed in range(12):
        team, tasks = instance(2 + seed % 3, 4 + seed % 3, seed)
        found = allocate(team, tasks, METHODS["improved"])
        sums.append(found.length_m / exact(team, tasks, makespan=False))
        found = allocate(team, tasks, METHODS["improved"], Objective.MAKESPAN)
        spans.append(found.finish_s / exact(team, tasks, makespan=True))
    assert min(sums) > 1.0 - 1e-9
    assert np.mean(sums) <= 1.01
    assert min(spans) > 1.0 - 1e-9
    assert np.mean(spans) <= 1.1


def test_methods_are_better_in_the_order_in_which_they_are_meant_to_be() -> None:
    length_m = {
        name: sum(allocate(*instance(5, 25, seed), METHODS[name]).length_m for seed in range(6))
        for name in MANY_EACH
    }
    assert length_m["improved"] < length_m["sequential"] < length_m["nearest"]
    assert length_m["improved"] < 0.97 * length_m["plain"]
    assert length_m["plain"] < length_m["nearest"]


def test_a_large_team_needs_at_most_forty_messages_a_task() -> None:
    found = allocate(*instance(12, 70, 1), METHODS["improved"])
    assert not found.left
    assert found.messages <= 40 * 70


@given(
    arrays(
        np.float64,
        st.tuples(st.integers(1, 8), st.integers(1, 8)),
        elements=st.floats(0.0, 100.0, allow_subnormal=False),
    )
)
def test_prices_pair_as_the_hungarian_method_does(cost: Array) -> None:
    pairs = auction_pairs(cost)
    rows, columns = cheapest_pairs(cost)
    assert len(pairs) == len(rows)
    total = sum(cost[pair] for pair in pairs)
    resolution = 1e-6 * len(rows) * float(cost.max()) + 1e-12
    assert total == pytest.approx(cost[rows, columns].sum(), abs=resolution)


@pytest.mark.parametrize("count", [3, 10, 30])
def test_one_task_each_at_the_least_cost(count: int) -> None:
    for seed in range(3):
        team, tasks = instance(count, count, seed)
        found = [allocate(team, tasks, METHODS[name]).length_m for name in ONE_EACH]
        cost = np.array(
            [[math.dist(place, task.place) for task in tasks] for _, place in team.values()]
        )
        assert found == pytest.approx([cost[cheapest_pairs(cost)].sum()] * len(found), rel=1e-3)


class TestEveryMethod:
    """What any method keeps to."""

    @pytest.fixture(params=METHODS)
    def name(self, request: pytest.FixtureRequest) -> str:
        return str(request.param)

    @staticmethod
    def check(found: Allocation, tasks: list[TaskAnnounce]) -> None:
        given_away = [task_id for route in found.routes.values() for task_id in route]
        assert sorted(given_away + found.left) == sorted(task.task_id for task in tasks)

    def test_every_task_is_given_away_once_or_left(self, name: str) -> None:
        for robots, count in [(1, 1), (4, 3), (3, 12), (2, 0)]:
            team, tasks = instance(robots, count, robots)
            found = allocate(team, tasks, METHODS[name])
            self.check(found, tasks)
            assert len(found.left) == (max(count - robots, 0) if name in ONE_EACH else 0)

    def test_same_instance_same_routes(self, name: str) -> None:
        one, other = (allocate(*instance(3, 9, 5), METHODS[name]) for _ in range(2))
        assert one == other

    def test_robots_get_only_what_they_can_do(self, name: str) -> None:
        team, tasks = instance(3, 9, 2)
        team["r1"] = (replace(team["r1"][0], skills=("dig",)), team["r1"][1])
        asked = Requirements(skills=("dig",)).to_json()
        tasks = [
            replace(task, requirements=asked) if index % 3 else task
            for index, task in enumerate(tasks)
        ]
        found = allocate(team, tasks, METHODS[name])
        self.check(found, tasks)
        digs = {task.task_id for task in tasks if task.requirements}
        assert not digs & {*found.routes["r0"], *found.routes["r2"]}

    def test_energy_and_deadlines_are_kept(self, name: str) -> None:
        team, tasks = instance(3, 9, 3)
        team = {
            robot: (replace(can, energy_j=120.0, travel_power_w=1.0), place)
            for robot, (can, place) in team.items()
        }
        tasks = [replace(task, deadline_s=80.0) for task in tasks]
        found = allocate(team, tasks, METHODS[name])
        self.check(found, tasks)
        assert found.finish_s <= 80.0
        for robot, route in found.routes.items():
            can, place = team[robot]
            places = [task.place for name in route for task in tasks if task.task_id == name]
            length_m = sum(map(math.dist, [place, *places], places))
            assert length_m / can.speed_m_s <= 120.0

    def test_bound_tasks_wait_for_others_and_for_all_their_robots(self, name: str) -> None:
        team, tasks = instance(6, 5, 7)
        tasks[0] = replace(tasks[0], after=("t1", "t2"), robots_needed=2)
        tasks[3] = replace(tasks[3], after=("t0",))
        tasks[4] = replace(tasks[4], robots_needed=2, deadline_s=1.0)
        found = allocate(team, tasks, METHODS[name])
        assert found.left == ["t4"]
        assert sum("t0" in route for route in found.routes.values()) == 2
        assert found.value == 4.0
        assert found.finish_s >= 15.0
        alone = allocate(team, tasks[1:3], METHODS[name])
        assert found.finish_s > alone.finish_s + 5.0
        missing = [replace(tasks[1], deadline_s=0.1), *tasks[:1], *tasks[2:4]]
        assert set(allocate(team, missing, METHODS[name]).left) == {"t0", "t1", "t3"}

    def test_value_leaves_what_cannot_be_done_in_time(self, name: str) -> None:
        team, tasks = instance(2, 10, 4)
        tasks = [replace(task, deadline_s=40.0) for task in tasks]
        found = allocate(team, tasks, METHODS[name], Objective.VALUE)
        self.check(found, tasks)
        assert found.value == len(tasks) - len(found.left)

    def test_over_the_network_every_task_is_done_once(self, name: str) -> None:
        for model in (PERFECT, LOSSY):
            made = scene(4, model, name)
            made.run()
            done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
            assert done == set(made.watch.tasks)


def test_paths_on_a_grid_go_around_walls() -> None:
    blocked = np.zeros((20, 20), dtype=np.bool_)
    blocked[10, :15] = True
    travel = GridPath(blocked, 1.0, (0.0, 0.0))
    assert travel((1.5, 1.5, 0.0), (5.5, 1.5, 0.0)) == pytest.approx(4.0)
    around = travel((8.5, 1.5, 0.0), (12.5, 1.5, 0.0))
    legs = math.dist((8.5, 1.5), (9.5, 15.5)) + math.dist((11.5, 15.5), (12.5, 1.5))
    assert legs + 2.0 <= around <= 1.1 * (legs + 2.0)
    blocked[10, :] = True
    apart = GridPath(blocked, 1.0, (0.0, 0.0))
    assert apart((8.5, 1.5, 0.0), (12.5, 1.5, 0.0)) == math.inf
    assert apart((8.5, 1.5, 0.0), (99.0, 1.5, 0.0)) == math.inf


def test_tasks_behind_a_wall_go_to_the_robot_on_that_side() -> None:
    blocked = np.zeros((20, 20), dtype=np.bool_)
    blocked[10, :] = True
    team: Robots = {
        "near": (Capabilities("ground"), (9.5, 5.5, 0.0)),
        "there": (Capabilities("ground"), (19.5, 19.5, 0.0)),
    }
    task = TaskAnnounce(0.0, "t", "", 0, "visit", "", (11.5, 5.5, 0.0))
    found = allocate(team, [task], METHODS["improved"], travel=GridPath(blocked, 1.0, (0.0, 0.0)))
    assert found.routes == {"near": [], "there": ["t"]}


def test_against_the_current_the_path_through_the_water_is_longer() -> None:
    travel = InCurrent(lambda _: (1.0, 0.0), 2.0)
    start, goal = (0.0, 0.0, 0.0), (30.0, 0.0, 0.0)
    assert travel(start, goal) == pytest.approx(20.0)
    assert travel(goal, start) == pytest.approx(60.0)
    assert travel(start, (0.0, 30.0, 0.0)) == pytest.approx(2.0 * 30.0 / math.sqrt(3.0))
    assert travel(start, start) == 0.0
    assert InCurrent(lambda _: (0.0, 3.0), 2.0)(start, goal) == math.inf
    assert InCurrent(lambda _: (3.0, 0.0), 2.0)(goal, start) == math.inf
    with pytest.raises(TaskError, match=r"current: speed_m_s is 0.0, legal: finite, above 0"):
        InCurrent(lambda _: (0.0, 0.0), 0.0)


def test_vessels_in_a_current_begin_upstream() -> None:
    boats: Robots = {"boat": (Capabilities("water", speed_m_s=2.0), (50.0, 0.0, 0.0))}
    tasks = [
        TaskAnnounce(0.0, f"t{x}", "", 0, "visit", "", (float(x), 0.0, 0.0)) for x in (10, 30, 80)
    ]
    still = allocate(boats, tasks, METHODS["improved"])
    assert still.routes == {"boat": ["t80", "t30", "t10"]}
    travel = {"boat": InCurrent(lambda _: (1.5, 0.0), 2.0)}
    moved = allocate(boats, tasks, METHODS["improved"], travel=travel)
    assert moved.routes == {"boat": ["t30", "t10", "t80"]}


@given(st.integers(0, 10_000))
@settings(max_examples=10, deadline=None)
def test_a_trade_is_worth_what_its_price_says_where_paths_are_not_symmetric(seed: int) -> None:
    random = Random(seed)
    team, tasks = instance(4, 12, seed)
    travels = [
        InCurrent(lambda _: (0.4, -0.2), 1.0),
        InCurrent(lambda _: (0.0, 0.5), 2.0),
        math.dist,
    ]
    plans = [
        Plan(name, can, place, travels[index % 3])
        for index, (name, (can, place)) in enumerate(team.items())
    ]
    for task in tasks:
        plan = random.choice(plans)
        plan.insert(Job.of(task), len(plan.jobs))
    trades = Trades(plans, 1000)
    tours = trades._tours
    for sweep in (trades._segments, trades._tails, trades._swaps, trades._turns):
        prices: list[float] = []

        def best(loss: Array, prices: list[float] = prices) -> Iterator[tuple[int, int]]:
            for place in Trades._best(loss):
                prices.append(float(loss[place]))
                yield place

        trades._best = best  # type: ignore[method-assign]
        routes, score = list(tours.routes), tours.score()
        for change in sweep(tours.edges()):
            for route, nodes in change.items():
                tours.routes[route] = nodes
            assert tours.score() - score == pytest.approx(prices[-1], abs=1e-6)
            tours.routes = list(routes)
