// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What Smac's planners each do on their own.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bench_maps.h"
#include "planning/curves/footprint_contact.h"
#include "planning/curves/motion_curve.h"
#include "planning/grids/path_points.h"
#include "planning/poses/pose_route.h"
#include "planning/poses/smac_options.h"
#include "planning/reference_search.h"
#include "trident_base/random_stream.h"
#include "trident_nav/planning/planner_registry.h"
#include "trident_nav/planning/smac_2d_planner.h"
#include "trident_nav/planning/smac_hybrid_planner.h"

namespace trident::nav {
namespace {

/// Defaults, but for a time that no machine is too slow for.
SmacHybridParams patient() {
  SmacHybridParams params;
  params.max_planning_time = 1e4;
  return params;
}

using testing::kRunning;
using testing::TestGrid;

Footprint car() {
  Footprint footprint;
  footprint.points = {{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}};
  return completed(footprint);
}

PlanOutcome run(Planner& planner, const CostGrid& grid, const Pose2& start, const Pose2& goal) {
  return planner.plan(grid, car(), start, goal, MotionLimits{}, kRunning);
}

/// At 1 cm along the straight lines between poses.
bool is_free(const CostGrid& grid, const Path& path) {
  const FootprintContact contact(grid, car(), FootprintContact::Unknown::kFree);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose2& a = path[i - 1];
    const Pose2& b = path[i];
    const int parts = 1 + static_cast<int>(distance(a.x, a.y, b.x, b.y) / 0.01);
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const Pose2 p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                    a.yaw + t * wrap_angle(b.yaw - a.yaw)};
      if (contact.in_contact(p)) return false;
    }
  }
  return true;
}

/// The highest curvature between poses, from the chord of the arc [1/m].
double highest_curvature(const Path& path) {
  double highest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double chord = distance(path[i - 1].x, path[i - 1].y, path[i].x, path[i].y);
    const double turn = std::abs(wrap_angle(path[i].yaw - path[i - 1].yaw));
    if (turn < 1e-6) continue;
    highest = std::max(highest, 2.0 * std::sin(turn / 2.0) / chord);
  }
  return highest;
}

bool drives_backwards(const Path& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose2& a = path[i - 1];
    const double ahead = (path[i].x - a.x) * std::cos(a.yaw) + (path[i].y - a.y) * std::sin(a.yaw);
    if (ahead < -1e-6) return true;
  }
  return false;
}

class RandomPoses {
 public:
  RandomPoses(const bench::BenchMap& map, std::uint64_t seed) : map_(map), stream_(seed, "smac") {}
  Pose2 next() {
    const GridGeometry& g = map_.geometry;
    while (true) {
      const double x = draw() * g.width * g.resolution;
      const double y = draw() * g.height * g.resolution;
      if (map_.distance_m[g.index(g.cell(x, y))] > 0.35F) return {x, y, 6.28 * draw()};
    }
  }

 private:
  double draw() { return 0.999 * stream_.uniform(next_++, 0); }
  const bench::BenchMap& map_;
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

struct HybridCase {
  SmacMotionModel model;
  double radius_m;
  bool smooths;
};

class SmacHybrid : public ::testing::TestWithParam<HybridCase> {};

TEST_P(SmacHybrid, PathsOnRandomMapsAreFreeAndKeepTheTurningRadius) {
  SmacHybridParams params = patient();
  params.motion_model_for_search = GetParam().model;
  params.minimum_turning_radius = GetParam().radius_m;
  params.smooth_path = GetParam().smooths;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto map =
        seed % 2 == 0 ? bench::hall_map(240, 240, seed) : bench::office_map(240, 240, seed);
    SmacHybridPlanner planner(params);
    RandomPoses poses(map, seed);
    for (int i = 0; i < 8; ++i) {
      const Pose2 start = poses.next();
      const PlanOutcome outcome = run(planner, map.view(), start, poses.next());
      if (outcome.failure != Failure::kNone) continue;
      ++found;
      EXPECT_TRUE(is_free(map.view(), outcome.path));
      EXPECT_LE(highest_curvature(outcome.path), 1.0 / params.minimum_turning_radius + 1e-6);
      EXPECT_EQ(outcome.path.front().yaw, start.yaw);
      if (params.motion_model_for_search == SmacMotionModel::kDubin) {
        EXPECT_FALSE(drives_backwards(outcome.path));
      }
      for (std::size_t k = 1; k < outcome.path.size(); ++k) {
        const Pose2& a = outcome.path[k - 1];
        ASSERT_LE(distance(a.x, a.y, outcome.path[k].x, outcome.path[k].y), 0.0501);
      }
    }
  }
  EXPECT_GE(found, 20);
}

INSTANTIATE_TEST_SUITE_P(Models, SmacHybrid,
                         ::testing::Values(HybridCase{SmacMotionModel::kDubin, 0.4, true},
                                           HybridCase{SmacMotionModel::kDubin, 0.8, false},
                                           HybridCase{SmacMotionModel::kReedsShepp, 0.4, true},
                                           HybridCase{SmacMotionModel::kReedsShepp, 0.7, false}));

TEST(SmacHybridPlanner, APathInTheOpenIsTheShortestCurve) {
  TestGrid grid(400, 400, kFreeCost, 0.05);
  grid.measure_distances(1.0F);
  SmacHybridPlanner planner{patient()};
  const Pose2 start{3.0, 10.0, 0.0};
  for (const Pose2& goal : {Pose2{15.0, 12.0, 0.5}, Pose2{3.0, 8.0, 3.0}, Pose2{5.0, 10.0, -2.0}}) {
    const PlanOutcome outcome = run(planner, grid.view(), start, goal);
    ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
    const double shortest = dubins_curve(start, goal, 0.4).length();
    EXPECT_LE(path_length(outcome.path), 1.1 * shortest);
    EXPECT_NEAR(wrap_angle(outcome.path.back().yaw - goal.yaw), 0.0, 1e-9);
  }
}

TEST(SmacHybridPlanner, OnlyReedsSheppBacksOutOfADeadEnd) {
  TestGrid grid(200, 200, kFreeCost, 0.05);
  for (int y = 95; y <= 105; ++y) {
    grid(110, y) = kLethalCost;
    if (y == 95 || y == 105) {
      for (int x = 80; x <= 110; ++x) grid(x, y) = kLethalCost;
    }
  }
  grid.measure_distances(2.0F);
  const Pose2 start{5.25, 5.02, 0.0};
  SmacHybridPlanner forwards{patient()};
  EXPECT_EQ(run(forwards, grid.view(), start, {2.0, 5.0, 0.0}).failure, Failure::kNoPath);
  SmacHybridParams params = patient();
  params.motion_model_for_search = SmacMotionModel::kReedsShepp;
  SmacHybridPlanner both{params};
  const PlanOutcome outcome = run(both, grid.view(), start, {2.0, 5.0, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_TRUE(drives_backwards(outcome.path));
}

/// Two parked cars at a curb; the goal is between them.
constexpr Pose2 kSlot{3.0, 0.96, 0.0};

TestGrid slot_grid() {
  TestGrid grid(240, 160, kFreeCost, 0.025);
  const auto fill = [&](double x0, double y0, double x1, double y1) {
    for (int y = static_cast<int>(y0 / 0.025); y < static_cast<int>(y1 / 0.025); ++y) {
      for (int x = static_cast<int>(x0 / 0.025); x < static_cast<int>(x1 / 0.025); ++x) {
        grid(x, y) = kLethalCost;
      }
    }
  };
  double length = 0.0;
  for (const Point2& p : car().points) length = std::max(length, 2.0 * p.x);
  const double ahead = 0.7 * length;  // from the middle of the slot to the cars about it
  fill(0.0, 0.0, 6.0, 0.65);
  fill(3.0 - ahead - length, 0.7, 3.0 - ahead, 1.1);
  fill(3.0 + ahead, 0.7, 3.0 + ahead + length, 1.1);
  grid.measure_distances(2.0F);
  return grid;
}

class ASlotOfOnePointFourLengths : public ::testing::TestWithParam<Pose2> {};

TEST_P(ASlotOfOnePointFourLengths, IsEnteredInSeveralMoves) {
  const TestGrid grid = slot_grid();
  SmacHybridParams params = patient();
  params.motion_model_for_search = SmacMotionModel::kReedsShepp;
  params.minimum_turning_radius = 0.75;
  SmacHybridPlanner planner{params};
  const PlanOutcome outcome = run(planner, grid.view(), GetParam(), kSlot);
  ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_EQ(outcome.reason, "") << "the goal itself is reached";
  EXPECT_NEAR(outcome.path.back().yaw, 0.0, 1e-9);
  EXPECT_TRUE(is_free(grid.view(), outcome.path));
  EXPECT_TRUE(drives_backwards(outcome.path));
}

// From the lane, and by a car that stands in it already, but badly: it leaves it first.
INSTANTIATE_TEST_SUITE_P(SmacHybridPlanner, ASlotOfOnePointFourLengths,
                         ::testing::Values(Pose2{1.2, 2.0, 0.1}, Pose2{3.02, 1.0, 0.2},
                                           Pose2{2.99, 1.01, -0.2}));

TEST(SmacHybridPlanner, AGoalThatCannotBeEnteredIsReplacedWithinTheTolerance) {
  TestGrid grid(200, 200, kFreeCost, 0.05);
  for (int y = 0; y < 200; ++y) grid(100, y) = kLethalCost;
  grid.measure_distances(2.0F);
  // The robot's back is at the wall: forwards nothing leads there.
  const Pose2 goal{5.30, 5.0, 0.0};
  SmacHybridParams params = patient();
  params.tolerance = 0.0;
  SmacHybridPlanner strict{params};
  const PlanOutcome refused = run(strict, grid.view(), {8.0, 8.0, 3.0}, goal);
  EXPECT_EQ(refused.failure, Failure::kNoPath);
  EXPECT_NE(refused.reason.find("leave no room"), std::string::npos) << refused.reason;
  SmacHybridPlanner tolerant{patient()};
  const PlanOutcome outcome = run(tolerant, grid.view(), {8.0, 8.0, 3.0}, goal);
  ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_LE(distance(outcome.path.back().x, outcome.path.back().y, goal.x, goal.y), 0.25);
  EXPECT_NE(outcome.reason.find("cannot be reached"), std::string::npos) << outcome.reason;
}

TEST(SmacHybridPlanner, TheRobotsOwnTurningRadiusCounts) {
  TestGrid grid(300, 300, kFreeCost, 0.05);
  SmacHybridPlanner planner{patient()};
  MotionLimits limits;
  limits.min_turning_radius = 1.5;
  const PlanOutcome outcome =
      planner.plan(grid.view(), car(), {4.0, 7.0, 0.0}, {4.0, 9.0, 3.1}, limits, kRunning);
  ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_LE(highest_curvature(outcome.path), 1.0 / 1.5 + 1e-6);
}

TEST(SmacHybridPlanner, FewIterationsEndWithAReason) {
  const auto map = bench::office_map(300, 300, 5);
  SmacHybridParams params = patient();
  params.max_iterations = 1;
  params.analytic_expansion_max_length = 0.01;
  SmacHybridPlanner planner{params};
  const PlanOutcome outcome = run(planner, map.view(), {1.0, 1.0, 0.0}, {14.0, 14.0, 0.0});
  EXPECT_EQ(outcome.failure, Failure::kTimeout);
  EXPECT_NE(outcome.reason.find("max_iterations"), std::string::npos) << outcome.reason;
}

TEST(SmacHybridPlanner, ACanceledSearchComesToFewPoses) {
  const auto map = bench::office_map(300, 300, 5);
  const PoseRouteOptions options =
      pose_route_options(SmacHybridParams{}, MotionModel::kDubins, 0.05, 0.4, false, true);
  PoseRoute route(arc_motions(ArcMotions{}), options);
  // The first plan leaves the heuristic of this goal, so that the second is canceled in the search.
  const Pose2 start{1.0, 1.0, 0.0}, goal{14.0, 14.0, 2.0};
  EXPECT_EQ(route.plan(map.view(), car(), start, goal, kRunning).failure, Failure::kNone);
  EXPECT_GT(route.iterations(), 100U);
  const CancelFlag canceled{true};
  EXPECT_EQ(route.plan(map.view(), car(), start, goal, canceled).failure, Failure::kCanceled);
  EXPECT_LE(route.iterations(), 1U);
}

TEST(SmacHybridPlanner, ChangedCostsAreSeen) {
  TestGrid grid(200, 200, kFreeCost, 0.05);
  for (int y = 0; y < 190; ++y) grid(100, y) = kLethalCost;
  grid.measure_distances(2.0F);
  SmacHybridPlanner planner{patient()};
  const Pose2 start{3.0, 5.0, 0.0}, goal{7.0, 5.0, 0.0};
  ASSERT_EQ(run(planner, grid.view(), start, goal).failure, Failure::kNone);
  for (int y = 190; y < 200; ++y) grid(100, y) = kLethalCost;
  for (int y = 0; y < 200; ++y) {
    for (int x = 97; x < 104; ++x) {
      if (x != 100) grid(x, y) = kInscribedCost;
    }
  }
  grid.measure_distances(2.0F);
  EXPECT_EQ(run(planner, grid.view(), start, goal).failure, Failure::kNoPath);
}

TEST(Smac2dPlanner, CostIsThatOfDijkstrasAlgorithm) {
  TestGrid grid(40, 40);
  for (int y = 0; y < 35; ++y) grid(20, y) = kLethalCost;
  for (int x = 0; x < 40; ++x) grid(x, 20) = 80;
  StepCosts costs;
  for (int c = 0; c <= 252; ++c) costs.step[c] = 1.0F + static_cast<float>(c) / 252.0F;
  Smac2dPlanner planner{Smac2dParams{}};
  const PlanOutcome outcome = run(planner, grid.view(), {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone);
  const double expected =
      testing::reference_potential(grid.view(), costs, {35, 5})[grid.geometry.index({5, 5})];
  EXPECT_NEAR(outcome.cost, expected, 1e-4 * expected);
}

TEST(SmacPlanners, ParametersAreUpstreamsAndChecked) {
  const auto make = [](const char* text) {
    return builtin_planners().get("nav2_smac_planner/SmacPlannerHybrid")(parse_yaml(text, "x.yaml"),
                                                                         "x.yaml");
  };
  EXPECT_NO_THROW(
      make("{motion_model_for_search: REEDS_SHEPP, minimum_turning_radius: 0.5, smoother: {w_data: "
           "0.1}}"));
  EXPECT_THROW(make("{motion_model_for_search: OMNI}"), ConfigError);
  EXPECT_THROW(make("{minimum_turning_radius: 0.0}"), ConfigError);
  EXPECT_DOUBLE_EQ(Smac2dParams{}.tolerance, 0.125);
}

}  // namespace
}  // namespace trident::nav
