// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <costmap_converter/ObstacleArrayMsg.h>
#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <teb_local_planner/FeedbackMsg.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "trident_nav/control/control_details.h"
#include "trident_nav/control/reported_obstacle.h"
#include "trident_nav/control/robot_state.h"

// What controllers have weighed as messages of upstream's types; pure functions. Poses are in the
// frame of `header`, that of the local costmap.

namespace trident::nav {

/// `local_plan`.
nav_msgs::Path local_plan_message(const ConsideredTrajectory& trajectory,
                                  const std_msgs::Header& header);
/// TEB's `teb_poses`.
geometry_msgs::PoseArray poses_message(const ConsideredTrajectory& trajectory,
                                       const std_msgs::Header& header);
/// TEB's `teb_markers`: lines of all trajectories, the selected one again, points of obstacles and
/// via points, each in upstream's namespace.
std::vector<visualization_msgs::Marker> band_markers(const ControlDetails& details,
                                                     const std_msgs::Header& header);
/// TEB's `teb_feedback`. `moving`: obstacles with a velocity. Needs a selected trajectory.
teb_local_planner::FeedbackMsg feedback_message(const ControlDetails& details, const Tracks& moving,
                                                const std_msgs::Header& header);
/// MPPI's `trajectories`: points of the samples, colored by cost, and the line of the result.
visualization_msgs::MarkerArray fan_markers(const ControlDetails& details,
                                            const std_msgs::Header& header);
/// DWA's `trajectory_cloud`: fields x, y, z, theta, cost.
sensor_msgs::PointCloud2 trajectory_cloud(const ControlDetails& details,
                                          const std_msgs::Header& header);
/// DWA's `cost_cloud`: fields x, y, z, path_cost, goal_cost, occ_cost, total_cost.
sensor_msgs::PointCloud2 cost_cloud(const ControlDetails& details, const std_msgs::Header& header);

/// The obstacle of a message, in the message's frame.
ReportedObstacle to_reported(const costmap_converter::ObstacleMsg& message);
/// What is wrong with reported obstacles: item, field, value, what is legal; empty: nothing is.
std::string obstacles_problem(const costmap_converter::ObstacleArrayMsg& message,
                              const ros::Time& now);
/// The same for via points.
std::string via_points_problem(const nav_msgs::Path& message);

}  // namespace trident::nav
