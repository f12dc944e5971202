# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters with the keys of known robots' navigation packages load, with known warnings."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
import rospy
from harness import Process, Ros, eventually

LIMIT_S = 60.0
TRAJECTORY_PLANNER = """
TrajectoryPlannerROS: {acc_lim_x: 3.0, acc_lim_theta: 6.0, max_vel_x: 0.6, min_vel_x: 0.1,
  max_vel_theta: 1.2, min_vel_theta: -1.2, min_in_place_vel_theta: 0.3, holonomic_robot: false,
  escape_vel: -0.2, yaw_goal_tolerance: 0.15, xy_goal_tolerance: 0.2,
  latch_xy_goal_tolerance: false, sim_time: 1.8, sim_granularity: 0.025,
  angular_sim_granularity: 0.025, vx_samples: 5, vtheta_samples: 18, controller_frequency: 20.0,
  meter_scoring: true, occdist_scale: 0.1, pdist_scale: 0.7, gdist_scale: 0.9,
  heading_lookahead: 0.3, heading_scoring: false, heading_scoring_timestep: 0.7, dwa: true,
  simple_attractor: false, publish_cost_grid_pc: true, oscillation_reset_dist: 0.05,
  escape_reset_dist: 0.1, escape_reset_theta: 0.1}
"""
JACKAL_COSTMAP = """{map_type: costmap, origin_z: 0.0, z_resolution: 1, z_voxels: 2,
  obstacle_range: 2.5, raytrace_range: 3.0, publish_voxel_map: false, transform_tolerance: 0.5,
  meter_scoring: true, footprint: [[-0.2, -0.15], [-0.2, 0.15], [0.2, 0.15], [0.2, -0.15]],
  footprint_padding: 0.1, robot_base_frame: base_link, update_frequency: 20, publish_frequency: 5,
  width: %s, height: %s, resolution: 0.05, origin_x: -20.0, origin_y: -20.0, static_map: %s,
  rolling_window: %s, global_frame: map, plugins: [%s
  {name: obstacles_layer, type: "costmap_2d::ObstacleLayer"},
  {name: inflater_layer, type: "costmap_2d::InflationLayer"}],
  obstacles_layer: {observation_sources: scan, scan: {sensor_frame: front_laser,
    data_type: LaserScan, topic: front/scan, marking: true, clearing: true,
    min_obstacle_height: -2.0, max_obstacle_height: 2.0, obstacle_range: 2.5,
    raytrace_range: 3.0}},
  inflater_layer: {inflation_radius: 0.3}}"""
STATIC = '{name: static_layer, type: "costmap_2d::StaticLayer"},'
JACKAL = (
    TRAJECTORY_PLANNER
    + f"""
global_costmap: {JACKAL_COSTMAP % (40.0, 40.0, "true", "false", STATIC)}
local_costmap: {JACKAL_COSTMAP % (10.0, 10.0, "false", "true", "")}
shutdown_costmaps: false
controller_frequency: 20.0
controller_patience: 15.0
planner_frequency: 20.0
planner_patience: 5.0
oscillation_timeout: 0.0
oscillation_distance: 0.5
recovery_behavior_enabled: true
clearing_rotation_allowed: true
base_global_planner: navfn/NavfnROS
base_local_planner: base_local_planner/TrajectoryPlannerROS
"""
)
HUSKY_COSTMAP = """{footprint: [[-0.5, -0.3], [-0.5, 0.3], [0.5, 0.3], [0.5, -0.3]],
  footprint_padding: 0.01, robot_base_frame: base_link, update_frequency: 4.0,
  publish_frequency: 3.0, transform_tolerance: 0.5, resolution: 0.05, obstacle_range: 5.5,
  raytrace_range: 6.0, static: {map_topic: /map, subscribe_to_updates: true},
  obstacles_laser: {observation_sources: laser, laser: {data_type: LaserScan, clearing: true,
    marking: true, topic: front/scan, inf_is_valid: true}},
  inflation: {inflation_radius: 1.0}, global_frame: %s, rolling_window: %s, %s
  {name: inflation, type: "costmap_2d::InflationLayer"}]}"""
HUSKY_LASER = """width: 10.0, height: 10.0,
  plugins: [{name: obstacles_laser, type: "costmap_2d::ObstacleLayer"},"""
HUSKY_MAP = """track_unknown_space: true,
  plugins: [{name: static, type: "costmap_2d::StaticLayer"},"""
HUSKY = (
    TRAJECTORY_PLANNER
    + f"""
controller_frequency: 5.0
recovery_behaviour_enabled: true
NavfnROS: {{allow_unknown: true, default_tolerance: 0.1}}
DWAPlannerROS: {{acc_lim_x: 2.5, acc_lim_y: 0, acc_lim_th: 3.2, max_vel_x: 0.5, min_vel_x: 0.0,
  max_vel_y: 0, min_vel_y: 0, max_vel_trans: 0.5, min_vel_trans: 0.1, max_vel_rot: 1.0,
  min_vel_rot: 0.2, yaw_goal_tolerance: 0.1, xy_goal_tolerance: 0.2,
  latch_xy_goal_tolerance: false}}
global_costmap: {HUSKY_COSTMAP % ("map", "false", HUSKY_MAP)}
local_costmap: {HUSKY_COSTMAP % ("odom", "true", HUSKY_LASER)}
base_global_planner: navfn/NavfnROS
base_local_planner: dwa_local_planner/DWAPlannerROS
"""
)
IDLE_IN_COSTMAPS = (
    *("map_type", "meter_scoring", "origin_z", "publish_voxel_map", "static_map"),
    *("z_resolution", "z_voxels"),
)
WARNINGS = {
    "jackal": [
        *(f"global_costmap/{key}" for key in IDLE_IN_COSTMAPS),
        *(f"local_costmap/{key}" for key in IDLE_IN_COSTMAPS),
        "TrajectoryPlannerROS/pdist_scale",
        "TrajectoryPlannerROS/gdist_scale",
    ],
    "husky": [
        "DWAPlannerROS/acc_lim_th",
        "DWAPlannerROS/latch_xy_goal_tolerance",
        "DWAPlannerROS/max_vel_rot",
        "DWAPlannerROS/min_vel_rot",
        "TrajectoryPlannerROS",
        "global_costmap/obstacles_laser",
        "local_costmap/static",
        "recovery_behaviour_enabled",
    ],
}
FILES = {"jackal": JACKAL, "husky": HUSKY}


def started(ros: Ros, folder: Path, parameters: str) -> Process:
    file = folder / "parameters.yaml"
    file.write_text(parameters, encoding="utf-8")
    if rospy.has_param("/move_base"):
        rospy.delete_param("/move_base")
    subprocess.run(["rosparam", "load", str(file), "/move_base"], check=True)
    node = ros.launch(["rosrun", "move_base", "move_base"])
    eventually(lambda: node.running is False or "/move_base/make_plan" in services(), "move_base")
    return node


def services() -> list[str]:
    _code, _text, state = rospy.get_master().getSystemState()
    return [name for name, _nodes in state[2]]


def warned_of(log: str) -> list[str]:
    """The parameters that warnings are about."""
    return sorted(re.findall(r"WARN.*?\]: (?:parameter )?/move_base/(\S+)", log))


@pytest.mark.parametrize("robot", FILES)
def test_files_of_a_robot_load_with_known_warnings(ros: Ros, tmp_path: Path, robot: str) -> None:
    node = started(ros, tmp_path, FILES[robot])
    assert node.running, node.log
    assert "ERROR" not in node.log, node.log
    assert warned_of(node.log) == sorted(WARNINGS[robot]), node.log
