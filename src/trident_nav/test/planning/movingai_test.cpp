// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Lengths on maps of the MovingAI benchmarks (Sturtevant 2012), against the optimal ones of their
// scenario files. Needs the maps in $TRIDENT_DATA/movingai.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "bench_maps.h"
#include "planning/grids/path_points.h"
#include "planning/potential/potential.h"
#include "planning/reference_search.h"
#include "trident_nav/planning/theta_star_planner.h"

namespace trident::nav {
namespace {

using testing::kRunning;

class MovingAi : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("TRIDENT_DATA");
    if (data == nullptr || !std::ifstream(path(data))) {
      GTEST_SKIP() << "SKIPPED: TRIDENT_DATA names no folder with movingai/" << GetParam()
                   << ".map";
    }
    map_ = bench::load_movingai_map(path(data));
    scenarios_ = bench::load_movingai_scenarios(path(data) + ".scen");
  }
  static std::string path(const char* data) {
    return std::string(data) + "/movingai/" + GetParam() + ".map";
  }
  bench::BenchMap map_;
  std::vector<bench::Scenario> scenarios_;
};

TEST_P(MovingAi, LengthsAreOptimal) {
  StepCosts costs;
  costs.step[kFreeCost] = 1.0F;
  Potential potential(costs);
  for (std::size_t i = 0; i < scenarios_.size(); i += 37) {
    const auto& s = scenarios_[i];
    ASSERT_EQ(potential.search(map_.view(), s.goal, s.start, kRunning), Potential::Result::kFound);
    EXPECT_NEAR(potential.at(s.start), s.length, 1e-5 * s.length) << i;
  }
}

TEST_P(MovingAi, ThetaStarIsNeverLongerThanTheOctileOptimum) {
  ThetaStarPlanner planner{ThetaStarParams{}};
  for (std::size_t i = 0; i < scenarios_.size(); i += 97) {
    const auto& s = scenarios_[i];
    const Point2 start = map_.geometry.center(s.start);
    const Point2 goal = map_.geometry.center(s.goal);
    const PlanOutcome outcome = planner.plan(map_.view(), Footprint{}, {start.x, start.y, 0.0},
                                             {goal.x, goal.y, 0.0}, MotionLimits{}, kRunning);
    ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
    EXPECT_LE(path_length(outcome.path), s.length * (1.0 + 1e-5)) << i;
  }
}

std::string map_name(const ::testing::TestParamInfo<const char*>& info) {
  std::string name = info.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Maps, MovingAi,
                         ::testing::Values("Berlin_0_512", "den520d", "maze512-1-0",
                                           "random512-10-0"),
                         map_name);

}  // namespace
}  // namespace trident::nav
