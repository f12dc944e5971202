// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/avoided_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "trident_base/occupancy_grid.h"
#include "trident_base/yaml_config.h"
#include "trident_maps/distance_field.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

/// Free ground with a wall across that has gaps.
class WallWithGaps : public ::testing::Test {
 protected:
  void make(const std::vector<double>& gaps_m) {
    OccupancyGrid map;
    map.width = 120;
    map.height = 80;
    map.resolution = 0.05;
    map.cells.assign(120 * 80, OccupancyGrid::kFree);
    for (int y = 0; y < map.height; ++y) {
      const double y_m = 0.05 * (y + 0.5);
      const bool is_gap = std::any_of(gaps_m.begin(), gaps_m.end(),
                                      [&](double gap_m) { return std::fabs(y_m - gap_m) < 0.35; });
      if (!is_gap) map.cells[static_cast<std::size_t>(y * 120 + 60)] = OccupancyGrid::kOccupied;
    }
    for (const std::int8_t cell : map.cells) {
      costs_.push_back(cell == OccupancyGrid::kOccupied ? kLethalCost : kFreeCost);
    }
    const maps::DistanceField field(map, 2.0);
    for (int y = 0; y < map.height; ++y) {
      const auto row = field.padded().begin() + (y + 1) * field.stride() + 1;
      distances_m_.insert(distances_m_.end(), row, row + map.width);
    }
    grid_ = {{120, 80, 0.05, 0.0, 0.0}, costs_.data(), distances_m_.data(), 2.0F, 1};
  }
  Path plan(double from_x_m = 1.0) {
    const CancelFlag never{false};
    return avoided_
        .plan(*planner_, grid_, circle_footprint(0.2), {from_x_m, 1.0, 0.0}, {5.0, 1.0, 0.0},
              {0.5, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 2.0, 0.0}, never)
        .path;
  }
  static double highest(const Path& path) {
    double y = 0.0;
    for (const Pose2& pose : path) y = std::max(y, pose.y);
    return y;
  }

  std::unique_ptr<Planner> planner_ =
      builtin_planners().get("navfn/NavfnROS")(parse_yaml("{}", "test"), "test");
  AvoidedPlaces avoided_;
  CostGrid grid_;
  std::vector<std::uint8_t> costs_;
  std::vector<float> distances_m_;
};

TEST_F(WallWithGaps, PlansLeadThroughTheOtherGapAfterTheRobotGotStuckInOne) {
  make({1.0, 3.0});
  const Path direct = plan();
  EXPECT_LT(highest(direct), 1.5);
  avoided_.add(grid_, circle_footprint(0.45), {direct.begin() + 30, direct.end()});
  EXPECT_FALSE(avoided_.is_empty());
  EXPECT_GT(highest(plan()), 2.5);
}

TEST_F(WallWithGaps, ARobotInTheMouthOfAGapLeavesItBackwards) {
  make({1.0, 3.0});
  const Path direct = plan();
  avoided_.add(grid_, circle_footprint(0.45), {direct.begin() + 30, direct.end()});
  for (const double from_x_m : {2.95, 2.8, 2.65, 2.4}) {
    EXPECT_GT(highest(plan(from_x_m)), 2.5) << from_x_m;
    EXPECT_FALSE(avoided_.is_empty()) << from_x_m;
  }
}

/// Notes the grids that it is given.
class NotingPlanner : public Planner {
 public:
  PlanOutcome plan(const CostGrid& grid, const Footprint&, const Pose2& start, const Pose2& goal,
                   const MotionLimits&, const CancelFlag&) override {
    costs.assign(grid.cost, grid.cost + grid.geometry.size());
    revision = grid.revision;
    return {{start, goal}, Failure::kNone, "", 1.0};
  }
  std::vector<std::uint8_t> costs;
  std::uint64_t revision = 0;
};

TEST_F(WallWithGaps, AGridThatStaysIsGivenToThePlannerUnderTheSameRevision) {
  make({1.0, 3.0});
  const Path direct = plan();
  avoided_.add(grid_, circle_footprint(0.45), {direct.begin() + 30, direct.end()});
  NotingPlanner planner;
  const auto plan_from = [&](double x) {
    const CancelFlag never{false};
    avoided_.plan(planner, grid_, circle_footprint(0.2), {x, 1.0, 0.0}, {5.0, 1.0, 0.0},
                  MotionLimits{}, never);
    return planner.revision;
  };
  const std::uint64_t far = plan_from(1.0);
  const auto blocked = planner.costs;
  EXPECT_NE(blocked, costs_);
  EXPECT_EQ(plan_from(1.05), far);
  EXPECT_NE(plan_from(3.0), far);  // the robot is in the place: its surroundings stay free
  EXPECT_NE(planner.costs, blocked);
  const std::uint64_t again = plan_from(1.0);
  EXPECT_EQ(planner.costs, blocked);
  costs_[5] = 77;
  ++grid_.revision;
  EXPECT_NE(plan_from(1.0), again);
  EXPECT_EQ(planner.costs[5], 77);
}

TEST_F(WallWithGaps, TheOnlyGapIsTriedAgain) {
  make({1.0});
  const Path direct = plan();
  avoided_.add(grid_, circle_footprint(0.45), {direct.begin() + 30, direct.end()});
  EXPECT_EQ(plan().size(), direct.size());
  EXPECT_TRUE(avoided_.is_empty());
}

}  // namespace
}  // namespace trident::nav
