// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What every registered planner keeps. A new planner is tested by being registered.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "bench_maps.h"
#include "planning/curves/footprint_contact.h"
#include "planning/reference_search.h"
#include "trident_base/random_stream.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::TestGrid;

Footprint box_footprint() {
  Footprint footprint;
  footprint.points = {{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}};
  return completed(footprint);
}

MotionLimits box_limits() {
  MotionLimits limits;
  limits.vx_max = 0.5;
  limits.vx_min = -0.2;
  limits.wz_max = 1.0;
  return limits;
}

bool equal_bits(const PlanOutcome& a, const PlanOutcome& b) {
  if (a.failure != b.failure || a.reason != b.reason || a.path.size() != b.path.size())
    return false;
  return a.path.empty() ||
         std::memcmp(a.path.data(), b.path.data(), a.path.size() * sizeof(Pose2)) == 0;
}

/// Random poses of a map.
class Poses {
 public:
  explicit Poses(const bench::BenchMap& map) : map_(map), stream_(7, "poses") {}
  Pose2 any() {
    const GridGeometry& g = map_.geometry;
    return {number(-0.1, 1.1) * g.width * g.resolution, number(-0.1, 1.1) * g.height * g.resolution,
            number(-4.0, 4.0)};
  }
  /// One at which the robot fits whatever its heading.
  Pose2 roomy() {
    const CostGrid grid = map_.view();
    while (true) {
      const Pose2 p = any();
      const Cell c = grid.geometry.cell(p.x, p.y);
      if (grid.geometry.contains(c) && grid.distance_m[grid.geometry.index(c)] > 0.35F) return p;
    }
  }

 private:
  double number(double low, double high) {
    return low + (high - low) * stream_.uniform(next_++, 0);
  }
  const bench::BenchMap& map_;
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

class PlannerConformance : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Planner> make() const {
    ConfigNode parameters;
    parameters.kind = ConfigNode::Kind::kMap;
    return builtin_planners().get(GetParam())(parameters, "test");
  }
  static PlanOutcome run(Planner& planner, const CostGrid& grid, const Pose2& start,
                         const Pose2& goal) {
    return planner.plan(grid, box_footprint(), start, goal, box_limits(), kRunning);
  }
  /// A carrot's line is not searched for: it may touch obstacles.
  bool avoids_obstacles() const { return GetParam() != "carrot_planner/CarrotPlanner"; }
  /// Planners that know the footprint are free of contact as a whole, others with the center.
  bool knows_footprint() const {
    return GetParam() == "nav2_smac_planner/SmacPlannerHybrid" ||
           GetParam() == "nav2_smac_planner/SmacPlannerLattice";
  }
  void expect_free(const CostGrid& grid, const Path& path) const {
    const FootprintContact contact(grid, box_footprint(), FootprintContact::Unknown::kFree);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      if (knows_footprint()) {
        expect_free_between(contact, path[i - 1], path[i]);
      } else {
        const std::uint8_t cost = grid.at(path[i].x, path[i].y);
        ASSERT_TRUE(cost < kInscribedCost || cost == kUnknownCost)
            << path[i].x << ", " << path[i].y;
      }
    }
  }
  /// At 1 cm along the straight line between two poses of a path.
  static void expect_free_between(const FootprintContact& contact, const Pose2& a, const Pose2& b) {
    const int parts = 1 + static_cast<int>(distance(a.x, a.y, b.x, b.y) / 0.01);
    for (int k = 0; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const Pose2 p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                    a.yaw + t * wrap_angle(b.yaw - a.yaw)};
      ASSERT_FALSE(contact.in_contact(p)) << p.x << ", " << p.y << ", " << p.yaw;
    }
  }
  static void expect_explained(const PlanOutcome& outcome, const Pose2& start, const Pose2& goal) {
    if (outcome.failure != Failure::kNone) {
      EXPECT_TRUE(outcome.path.empty());
      EXPECT_FALSE(outcome.reason.empty());
      return;
    }
    ASSERT_FALSE(outcome.path.empty());
    EXPECT_EQ(outcome.path.front().x, start.x);
    EXPECT_EQ(outcome.path.front().y, start.y);
    const double off = distance(outcome.path.back().x, outcome.path.back().y, goal.x, goal.y);
    const double turned = std::abs(wrap_angle(outcome.path.back().yaw - goal.yaw));
    EXPECT_TRUE((off < 1e-9 && turned < 1e-9) || !outcome.reason.empty()) << off << " " << turned;
    for (const Pose2& p : outcome.path) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.yaw));
    }
  }
};

const bench::BenchMap& office() {
  static const bench::BenchMap map = bench::office_map(300, 300, 5);
  return map;
}

TEST_P(PlannerConformance, PathsAreFreeAndEndAtTheGoalOrSayWhy) {
  const auto planner = make();
  Poses poses(office());
  const CostGrid grid = office().view();
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose2 start = poses.roomy();
    const Pose2 goal = poses.roomy();
    const PlanOutcome outcome = run(*planner, grid, start, goal);
    expect_explained(outcome, start, goal);
    if (avoids_obstacles()) expect_free(grid, outcome.path);
    found += outcome.failure == Failure::kNone ? 1 : 0;
  }
  EXPECT_GT(found, 20);
}

TEST_P(PlannerConformance, EqualBitsOnRepeat) {
  Poses poses(office());
  const auto one = make();
  const auto two = make();
  for (int i = 0; i < 10; ++i) {
    const Pose2 start = poses.roomy();
    const Pose2 goal = poses.roomy();
    EXPECT_TRUE(equal_bits(run(*one, office().view(), start, goal),
                           run(*two, office().view(), start, goal)));
  }
}

TEST_P(PlannerConformance, AMovingStartKeepsTheGoal) {
  const auto planner = make();
  Poses poses(office());
  const CostGrid grid = office().view();
  const Pose2 goal = poses.roomy();
  Pose2 start = poses.roomy();
  for (int i = 0; i < 10; ++i) {
    const PlanOutcome outcome = run(*planner, grid, start, goal);
    if (outcome.failure != Failure::kNone) break;
    EXPECT_NEAR(outcome.path.back().x, goal.x, 1e-9);
    start = outcome.path[std::min<std::size_t>(outcome.path.size() - 1, 5)];
  }
}

TEST_P(PlannerConformance, ACanceledPlanReturnsCanceled) {
  const CancelFlag canceled{true};
  TestGrid grid(600, 600, kFreeCost, 0.05);
  for (int y = 0; y < 590; ++y) {
    for (int x = 290; x < 310; ++x) grid(x, y) = kLethalCost;
  }
  const PlanOutcome outcome = make()->plan(grid.view(), box_footprint(), {2.0, 2.0, 0.0},
                                           {27.0, 2.0, 0.0}, box_limits(), canceled);
  EXPECT_EQ(outcome.failure, Failure::kCanceled);
}

TEST_P(PlannerConformance, UnknownSpaceIsCrossedWhereAllowed) {
  TestGrid grid(120, 120, kUnknownCost, 0.05);
  const PlanOutcome outcome = run(*make(), grid.view(), {1.0, 3.0, 0.0}, {5.0, 3.0, 0.0});
  expect_explained(outcome, {1.0, 3.0, 0.0}, {5.0, 3.0, 0.0});
  if (avoids_obstacles()) {
    EXPECT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  }
}

TEST_P(PlannerConformance, AStartInInflationIsLeft) {
  const CostGrid grid = office().view();
  Poses poses(office());
  int tried = 0;
  while (tried < 20) {
    const Pose2 start = poses.any();
    const Cell c = grid.geometry.cell(start.x, start.y);
    if (!grid.geometry.contains(c) || grid.at(c) != kInscribedCost) continue;
    if (start.x < 0.5 || start.y < 0.5 || start.x > 14.5 || start.y > 14.5) continue;
    ++tried;
    const Pose2 goal = poses.roomy();
    const PlanOutcome outcome = run(*make(), grid, start, goal);
    expect_explained(outcome, start, goal);
    EXPECT_NE(outcome.failure, Failure::kStartOccupied) << outcome.reason;
  }
}

TEST_P(PlannerConformance, AnObstacleInsideTheFootprintDoesNotHoldTheRobot) {
  TestGrid grid(200, 200, kFreeCost, 0.05);
  grid(60, 100) = kLethalCost;
  for (int y = 97; y <= 103; ++y) {
    for (int x = 57; x <= 63; ++x) {
      if (x != 60 || y != 100) grid(x, y) = kInscribedCost;
    }
  }
  grid.measure_distances(1.0F);
  const Pose2 start{3.03, 5.02, 0.3};
  const PlanOutcome outcome = run(*make(), grid.view(), start, {7.0, 7.0, 0.0});
  EXPECT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_NEAR(outcome.path.back().x, 7.0, 1e-9);
}

TEST_P(PlannerConformance, PosesOutsideAreRefused) {
  const auto planner = make();
  const CostGrid grid = office().view();
  EXPECT_EQ(run(*planner, grid, {5.0, 1.0, 0.0}, {50.0, 1.0, 0.0}).failure, Failure::kGoalOutside);
  EXPECT_EQ(run(*planner, grid, {-5.0, 1.0, 0.0}, {5.0, 1.0, 0.0}).failure, Failure::kStartOutside);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(run(*planner, grid, {5.0, 1.0, nan}, {5.0, 1.0, 0.0}).failure, Failure::kInvalidInput);
  EXPECT_EQ(run(*planner, grid, {5.0, 1.0, 0.0}, {5.0, INFINITY, 0.0}).failure,
            Failure::kInvalidInput);
}

TEST_P(PlannerConformance, AMapOfOneCellOrNoneIsNoTrap) {
  TestGrid one(1, 1, kFreeCost, 1.0);
  expect_explained(run(*make(), one.view(), {0.2, 0.3, 0.0}, {0.8, 0.5, 1.0}), {0.2, 0.3, 0.0},
                   {0.8, 0.5, 1.0});
  EXPECT_EQ(run(*make(), CostGrid{}, {0.2, 0.3, 0.0}, {0.8, 0.5, 1.0}).failure,
            Failure::kInvalidInput);
}

TEST_P(PlannerConformance, TenThousandPosesHaveAPathOrAReason) {
  static const bench::BenchMap map = bench::office_map(160, 160, 9);
  const auto planner = make();
  Poses poses(map);
  for (int i = 0; i < 10000; ++i) {
    const Pose2 start = poses.any();
    const Pose2 goal = poses.any();
    expect_explained(run(*planner, map.view(), start, goal), start, goal);
    if (HasFailure()) break;
  }
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  return info.param.substr(info.param.find('/') + 1);
}

INSTANTIATE_TEST_SUITE_P(AllPlanners, PlannerConformance,
                         ::testing::ValuesIn(builtin_planners().names()), test_name);

}  // namespace
}  // namespace trident::nav
