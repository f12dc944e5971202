# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A TurtleBot3 by the files of turtlebot3_navigation."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.nav import tour_rows, tours, turtlebot3
from trident_benchmarks.nav.launch_files import launch_parameters, nested, node_parameters
from trident_benchmarks.nav.trials import KnownMap, Trials

_WORLD = package_folder("turtlebot3_gazebo") / "worlds" / "turtlebot3_world.world"


def test_full_names_become_maps_of_maps() -> None:
    flat = {"/move_base/DWAPlannerROS/max_vel_x": 0.2, "/move_base/rate": 5, "/amcl/kld_err": 0.1}
    assert nested(flat) == {
        "move_base": {"DWAPlannerROS": {"max_vel_x": 0.2}, "rate": 5},
        "amcl": {"kld_err": 0.1},
    }


def test_a_launch_file_that_does_not_load_is_named(tmp_path: Path) -> None:
    file = tmp_path / "broken.launch"
    file.write_text("<launch><node/></launch>", encoding="utf-8")
    with pytest.raises(EvalError, match=r"broken\.launch"):
        launch_parameters([str(file)])
    with pytest.raises(EvalError, match="no parameters of move_base"):
        node_parameters({"amcl": {}}, "move_base", tmp_path / "move_base.yaml")


@pytest.mark.parametrize(("robot", "heights"), turtlebot3.ROBOTS, ids=("burger", "waffle"))
def test_a_robot_has_what_the_launch_file_sets(
    robot: turtlebot3.Robot, heights: tuple[float, ...], tmp_path: Path
) -> None:
    driver, amcl = turtlebot3.driver(robot, heights, tmp_path)
    move_base = yaml.safe_load(driver.parameters[0].read_text(encoding="utf-8"))
    assert move_base["base_local_planner"] == "dwa_local_planner/DWAPlannerROS"
    assert driver.limits.speed == move_base["DWAPlannerROS"]["max_vel_x"]
    assert driver.limits.tolerance_m == move_base["DWAPlannerROS"]["xy_goal_tolerance"]
    assert move_base["local_costmap"]["rolling_window"] is True
    assert "max_particles" in yaml.safe_load(amcl.read_text(encoding="utf-8"))


def test_a_burger_reaches_two_goals_among_the_pillars(tmp_path: Path) -> None:
    driver, amcl = turtlebot3.driver(*turtlebot3.ROBOTS[0], tmp_path)
    tours.true_map(_WORLD, (0.18,), (-2.0, -0.5)).save(tmp_path / "map.pgm")
    known = KnownMap(tmp_path / "map.yaml", (0.0, 0.0, 0.0), amcl=amcl)
    goals = ((-0.5, -0.5, 1.0), (-1.7, 0.5, 3.0))
    tour = tour_rows.Tour((-2.0, -0.5, 0.0), goals, (1.0, 1.0))
    task = tours.task_of(driver.robot, tours.Building(_WORLD, known), tour, 1, driver.limits)
    run = Trials(driver.robot, driver.parameters, 1).run([task], [1], lambda *_: None)[0][0]
    assert [one.end for one in run.goals] == ["reached", "reached"], run.goals
    assert not any(one.touched for one in run.goals)
