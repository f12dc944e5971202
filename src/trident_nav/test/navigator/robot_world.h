// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_base/occupancy_grid.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/navigator/costmap_world.h"
#include "trident_nav/navigator/navigator.h"

namespace trident::nav::testing {

/// A rectangle that stops robots and beams [m].
struct Wall {
  double x0, y0, x1, y1;
};

/// A room with walls around it, as it is and as the map has it, and a round robot that follows
/// commands at its limits, with a lidar all around. The clock stands still between steps.
class RobotWorld {
 public:
  struct Setup {
    double width_m = 6.0, height_m = 4.0;
    std::vector<Wall> mapped;    ///< In the map and there.
    std::vector<Wall> unmapped;  ///< There alone.
    std::vector<Wall> gone;      ///< In the map alone.
    Pose2 start;
    std::string law = "regulated_pure_pursuit";
    NavigatorParams params;
    std::string source_keys;  ///< Further keys of the lidar's source in both costmaps.
  };

  explicit RobotWorld(const Setup& setup);

  Navigator& navigator() { return *navigator_; }
  const RobotState& state() const { return state_; }
  double now_s() const { return state_.time_s; }
  bool has_touched() const { return has_touched_; }
  const std::vector<std::string>& recoveries() const { return recoveries_; }
  /// The newest reason why the robot stands.
  const std::string& waiting() const { return waiting_; }
  void set_lidar_on(bool is_on) { is_lidar_on_ = is_on; }
  void add(const Wall& wall) { set(truth_, wall, 100); }

  /// One controller period.
  NavigatorOutput step();
  /// Steps until the goal has an outcome or the time is over.
  NavigatorOutput drive(double limit_s);

 private:
  static void set(OccupancyGrid& grid, const Wall& wall, std::int8_t occupancy);
  double range(double angle) const;
  void scan();
  void move(const Twist2& command);

  MotionLimits limits_;
  double period_s_;
  OccupancyGrid truth_;
  std::unique_ptr<Costmap> global_, local_;
  std::unique_ptr<Planner> planner_;
  std::unique_ptr<Controller> controller_;
  std::unique_ptr<CostmapWorld> world_;
  std::unique_ptr<Navigator> navigator_;
  RobotState state_;
  int steps_ = 0;
  bool is_lidar_on_ = true, has_touched_ = false;
  std::vector<std::string> recoveries_;
  std::string waiting_;
};

/// The recoveries that move_base has by default, and a retreat.
std::vector<NamedRecovery> default_recoveries(const RecoverySetup& setup);

}  // namespace trident::nav::testing
