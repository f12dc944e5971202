# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Goals in a building with a map and amcl, and how they are judged."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.nav import office, tour_rows, tours, trials
from trident_benchmarks.nav.goals import Places
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import GoalOutcome, KnownMap, Outcome, Trials

ROBOTS = package_folder("trident_bringup") / "config" / "nav" / "robots"
LIMITS = RobotLimits(ROBOTS / "my_nav_robot.yaml")


def goal(end: str = "reached", off_m: float = 0.0, touched: str = "") -> GoalOutcome:
    return GoalOutcome((1.0, 2.0, 0.0), end, "", 10.0, off_m, 0.0, touched, 1)


def test_a_goal_counts_only_if_the_truth_is_within_the_tolerance() -> None:
    assert tour_rows.is_reached(goal(off_m=0.9 * LIMITS.tolerance_m), LIMITS)
    assert not tour_rows.is_reached(goal(off_m=1.1 * LIMITS.tolerance_m), LIMITS)
    assert not tour_rows.is_reached(goal(end="aborted"), LIMITS)


def test_a_row_counts_goals_contacts_and_recoveries() -> None:
    goals = (goal(), goal(end="timeout", off_m=3.0, touched="wall"))
    run = Outcome(1, "timeout", 20.0, "", (), (), 2.0, goals)
    tour = tour_rows.Tour((0.0, 0.0, 0.0), ((1.0, 2.0, 0.0),) * 2, (8.0, 8.0))
    row = tour_rows.row_of("office", office.driver(*office.ROBOTS[0]), [tour], [run])
    assert (row["goals"], row["reached"], row["contacts"], row["recoveries"]) == (2, 1, 1, 2)
    assert row["time_over_bound"] == pytest.approx(1.25)
    assert row["cpu_s_per_s"] == pytest.approx(0.1)
    assert "| my_nav_robot | 1 of 2 | 1 | 1 | 2 | 1.25 | 0.100 s |" in tour_rows.table([row])


def test_a_goal_that_only_move_base_takes_for_reached_is_in_the_log(
    capsys: pytest.CaptureFixture[str],
) -> None:
    run = Outcome(1, "reached", 20.0, "", (), (), 2.0, (goal(), goal(off_m=0.5)))
    tour = tour_rows.Tour((0.0, 0.0, 0.0), ((1.0, 2.0, 0.0),) * 2, (8.0, 8.0))
    building = tours.Building(Path("/dev/null"), KnownMap(Path("map.yaml"), (0.0, 0.0, 0.0)))
    task = tours.task_of(trials.MY_NAV_ROBOT, building, tour, 1, LIMITS)
    tour_rows.report(LIMITS, task, [run])
    said = "".join(capsys.readouterr())
    assert "my_nav_robot_1: 1 of 2 reached" in said
    assert "goal 1:" not in said
    assert "goal 2: (1.00, 2.00, 0.00): reached" in said
    assert "off by 0.500 m" in said


def test_a_robot_that_nobody_knows_is_refused_with_those_known() -> None:
    with pytest.raises(EvalError, match="--robot tractor: not known, legal: ackermann_car"):
        tours.chosen_robots(["tractor"], office.ROBOTS)


@pytest.mark.parametrize("robot", [robot for robot, _ in office.ROBOTS], ids=lambda r: r.name)
def test_every_robot_has_limits_and_a_lidar_of_that_name(robot: trials.Robot) -> None:
    limits = RobotLimits(ROBOTS / f"{robot.name}.yaml")
    assert 0.0 < limits.inscribed_m <= limits.circumscribed_m
    assert f'name="{robot.lidar}"' in robot.urdf()


def test_tours_are_the_seeds_and_bounded_from_below() -> None:
    from trident_sim.occupancy import FREE, OccupancyMap

    grid = OccupancyMap(np.full((200, 200), FREE, dtype=np.int8), 0.05, (-5.0, -7.0))
    places = Places(grid, LIMITS.inscribed_m, LIMITS.circumscribed_m)
    tour = tours.make_tour(places, LIMITS, (0.0, -4.5), 3, 4)
    assert tour == tours.make_tour(places, LIMITS, (0.0, -4.5), 3, 4)
    assert tour != tours.make_tour(places, LIMITS, (0.0, -4.5), 4, 4)
    assert len(tour.goals) == len(tour.bounds_s) == 4
    assert min(tour.bounds_s) >= 1.0 / LIMITS.speed - 1e-9


def test_a_tour_from_a_goal_on_begins_at_the_goal_before_it() -> None:
    places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 1.0), (3.0, 0.0, 2.0))
    tour = tour_rows.Tour(places[0], places[1:], (1.0, 2.0, 3.0))
    assert tour.since(1) == tour
    assert tour.since(3) == tour_rows.Tour(places[2], places[3:], (3.0,))


def test_a_robot_reaches_five_goals_in_the_office_by_map_and_amcl(tmp_path: Path) -> None:
    world = package_folder("trident_bringup") / "worlds" / "office.world"
    tours.true_map(world, (0.115,)).save(tmp_path / "map.pgm")
    building = tours.Building(world, KnownMap(tmp_path / "map.yaml", (0.0, 0.0, 0.0)))
    goals = (
        (1.5, -4.5, 0.5),
        (1.0, -4.0, 2.5),
        (0.0, -4.5, -2.0),
        (-1.0, -4.2, 0.0),
        (0.0, -4.5, 0.0),
    )
    tour = tour_rows.Tour((0.0, -4.5, 0.0), goals, (1.0,) * len(goals))
    task = tours.task_of(trials.MY_NAV_ROBOT, building, tour, 1, LIMITS)
    parameters = trials.default_parameters(trials.MY_NAV_ROBOT, has_map=True)
    run = Trials(trials.MY_NAV_ROBOT, parameters, 1).run([task], [1], lambda *_: None)[0][0]
    assert [tour_rows.is_reached(one, LIMITS) for one in run.goals] == [True] * 5, run.goals
    assert not any(one.touched for one in run.goals)
    assert run.recoveries == ()
    assert run.localization_error_m < 0.1
