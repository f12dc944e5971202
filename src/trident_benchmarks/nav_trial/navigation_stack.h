// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulated_robot.h"
#include "trident_base/config_node.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_nav/control/moving_obstacles.h"
#include "trident_nav/costmap/beam_source.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/navigator/costmap_world.h"
#include "trident_nav/navigator/navigator.h"
#include "trident_nav_ros/move_base_params.h"

namespace trident::benchmarks {

/// The maps of files, one over the other: maps are merged key by key, of anything else the later
/// file's counts. Throws ConfigError.
ConfigNode merged_parameters(const std::vector<std::string>& files);

/// All that the node move_base has, made from the same parameters, without ROS: the local costmap
/// in the frame of odometry and the global one in the map's, which is the same until
/// set_map_pose(), planner, controller, recoveries, navigator. One thread.
class NavigationStack {
 public:
  /// `parameters`: the node's map. Throws Error.
  explicit NavigationStack(const ConfigNode& parameters);

  /// Sentences about parameters without effect.
  const std::vector<std::string>& warnings() const { return warnings_; }
  double control_period_s() const { return 1.0 / params_.controller_frequency; }
  bool is_control_due(double now_s) const;

  /// Gives a map to all static layers. Throws Error.
  void set_map(const OccupancyGrid& map);
  /// Where the frame of odometry lies in the map's from now on.
  void set_map_pose(const SE2& T_map_odom) { T_map_odom_ = T_map_odom; }

  /// `goal`: in the map's frame.
  void set_goal(const nav::Pose2& goal, double now_s) { navigator_->set_goal(goal, now_s); }
  void cancel() { navigator_->cancel(); }
  /// Gives a scan to all sources of both costmaps, and tracks what moves in those of the local one.
  void add_scan(const PlacedScan& placed);
  /// What the control thread does once per period: costmaps at their rates, then the navigator.
  /// `robot`: as odometry has it.
  nav::NavigatorOutput cycle(double now_s, const nav::RobotState& robot);

  /// What moved, as the last cycle had it, in the frame of odometry.
  const nav::Tracks& tracks() const { return tracks_; }
  const nav::Navigator& navigator() const { return *navigator_; }

 private:
  struct TimedCostmap {
    std::unique_ptr<nav::Costmap> costmap;
    double updated_s = -1.0;

    void update(double now_s, const nav::Pose2& robot);
  };
  TimedCostmap make_costmap(const ConfigNode& parameters, const std::string& name);
  void track(const nav::BeamSource& source, const LaserScan& scan, const std::vector<SE3>& poses);

  nav::MoveBaseParams params_;
  nav::Warnings warnings_;
  nav::MovingObstacles moving_;
  nav::Tracks tracks_;
  TimedCostmap global_, local_;
  std::unique_ptr<nav::Planner> planner_;
  std::unique_ptr<nav::Controller> controller_;
  std::unique_ptr<nav::CostmapWorld> world_;
  std::unique_ptr<nav::Navigator> navigator_;
  SE2 T_map_odom_;
  double controlled_s_ = -1.0;
};

}  // namespace trident::benchmarks
