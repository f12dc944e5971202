// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/lattice_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planning/reference_search.h"
#include "trident_base/error.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

using testing::TestGrid;

LatticeSet made(const std::string& model, double radius_m, int headings = 16) {
  LatticeOptions options;
  options.motion_model = model;
  options.turning_radius_m = radius_m;
  options.headings = headings;
  return make_lattice(options);
}

/// The error of a text, or "none".
std::string error_of(const std::string& text) {
  try {
    parse_lattice(text, "set.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(LatticeSet, MotionsEndAtCellsAndHeadingsAndKeepTheRadius) {
  for (const int headings : {8, 16, 32}) {
    for (const double radius_m : {0.2, 0.5, 2.0}) {
      const LatticeSet set = made("ackermann", radius_m, headings);
      ASSERT_EQ(set.heading_angles.size(), static_cast<std::size_t>(headings));
      for (const LatticeTrajectory& t : set.trajectories) {
        const Pose2& end = t.poses.back();
        EXPECT_NEAR(end.x / 0.05, std::round(end.x / 0.05), 1e-9);
        EXPECT_NEAR(end.y / 0.05, std::round(end.y / 0.05), 1e-9);
        EXPECT_EQ(end.yaw, set.heading_angles[static_cast<std::size_t>(t.end_angle_index)]);
        if (t.arc_length_m > 0.0) {
          EXPECT_GE(t.radius_m, radius_m - 1e-9);
        }
        EXPECT_NEAR(t.length_m, t.arc_length_m + t.straight_length_m, 1e-9);
      }
    }
  }
}

TEST(LatticeSet, PosesLieOnTheArc) {
  const LatticeSet set = made("ackermann", 0.5);
  for (const LatticeTrajectory& t : set.trajectories) {
    Pose2 last{0.0, 0.0, set.heading_angles[static_cast<std::size_t>(t.start_angle_index)]};
    double length_m = 0.0;
    for (const Pose2& p : t.poses) {
      const double chord = distance(last.x, last.y, p.x, p.y);
      const double turn = std::abs(wrap_angle(p.yaw - last.yaw));
      EXPECT_LE(2.0 * std::sin(turn / 2.0) / chord, 1.0 / 0.5 + 1e-6);
      EXPECT_LE(chord, 0.0501);
      length_m += turn < 1e-9 ? chord : chord * turn / (2.0 * std::sin(turn / 2.0));
      last = p;
    }
    EXPECT_NEAR(length_m, t.length_m, 1e-6);
  }
}

TEST(LatticeSet, ModelsDifferInTheirMotions) {
  const auto count = [](const LatticeSet& set, bool on_the_spot) {
    int result = 0;
    for (const LatticeTrajectory& t : set.trajectories) {
      result += (t.length_m == 0.0) == on_the_spot ? 1 : 0;
    }
    return result;
  };
  EXPECT_EQ(count(made("ackermann", 0.5), true), 0);
  EXPECT_EQ(count(made("diff", 0.5), true), 32);
  EXPECT_EQ(count(made("omni", 0.5), false), count(made("diff", 0.5), false) + 32);
}

TEST(LatticeSet, IsTheSameAfterAFile) {
  const LatticeSet set = made("omni", 0.5);
  const LatticeSet read = parse_lattice(lattice_json(set), "set.json");
  EXPECT_EQ(read.motion_model, "omni");
  EXPECT_EQ(read.heading_angles, set.heading_angles);
  ASSERT_EQ(read.trajectories.size(), set.trajectories.size());
  for (std::size_t i = 0; i < set.trajectories.size(); ++i) {
    ASSERT_EQ(read.trajectories[i].poses.size(), set.trajectories[i].poses.size());
    EXPECT_EQ(read.trajectories[i].poses.back().x, set.trajectories[i].poses.back().x);
    EXPECT_EQ(read.trajectories[i].end_angle_index, set.trajectories[i].end_angle_index);
  }
}

TEST(LatticeSet, BrokenFilesAreOneError) {
  const std::string good = lattice_json(made("diff", 0.5));
  EXPECT_EQ(error_of(good), "none");
  EXPECT_NE(error_of(good.substr(0, 900)).find("is not JSON"), std::string::npos);
  EXPECT_NE(error_of("[1]").find("set.json"), std::string::npos);
  EXPECT_EQ(error_of(replaced(good, "\"diff\"", "\"legs\"")),
            "set.json: lattice_metadata.motion_model: \"legs\", legal: diff, ackermann or omni");
  EXPECT_EQ(error_of(replaced(good, "\"end_angle_index\": 13", "\"end_angle_index\": 16")),
            "set.json: primitives[0].end_angle_index: 16, legal: a whole number in [0, 15]");
  EXPECT_NE(error_of(replaced(good, "\"grid_resolution\": 0.05", "\"grid_resolution\": -1"))
                .find("grid_resolution: -1, legal: a number > 0 [m]"),
            std::string::npos);
  EXPECT_NE(error_of(replaced(good, "\"poses\"", "\"places\"")).find("poses: missing"),
            std::string::npos);
  EXPECT_THROW(load_lattice("/nowhere/set.json"), Error);
}

TEST(LatticeSet, OptionsAreChecked) {
  EXPECT_THROW(made("legs", 0.5), Error);
  EXPECT_THROW(made("diff", 0.01), Error);
  EXPECT_THROW(made("diff", 0.5, 12), Error);
}

TEST(LatticeMotions, AreDenseAndLeadWhereTheyShould) {
  const LatticeSet set = made("diff", 0.5);
  LatticeCosts costs;
  costs.reverses = true;
  const MotionSet motions = lattice_motions(set, costs, 0.01);
  int backwards = 0;
  for (const Primitive& p : motions.primitives()) {
    const Pose2* poses = motions.poses(p);
    Pose2 last;
    for (std::uint32_t i = 0; i < p.pose_count; ++i) {
      EXPECT_LE(distance(last.x, last.y, poses[i].x, poses[i].y), 0.2001);
      last = poses[i];
    }
    EXPECT_EQ(last.x, p.dx);
    EXPECT_NEAR(
        wrap_angle(motions.heading(p.start_heading) + last.yaw - motions.heading(p.end_heading)),
        0.0, 1e-9);
    backwards += p.reverses ? 1 : 0;
    const double yaw = motions.heading(p.start_heading);
    const double ahead = poses[0].x * std::cos(yaw) + poses[0].y * std::sin(yaw);
    EXPECT_EQ(p.reverses, ahead < -1e-9);
  }
  EXPECT_GT(backwards, 16);
}

TEST(SmacLatticePlanner, ALatticeOfAnotherResolutionIsRefused) {
  const std::string path = ::testing::TempDir() + "/lattice_of_ten_cm.json";
  LatticeOptions options;
  options.resolution_m = 0.1;
  {
    FILE* file = std::fopen(path.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(lattice_json(make_lattice(options)).c_str(), file);
    std::fclose(file);
  }
  const auto planner = builtin_planners().get("nav2_smac_planner/SmacPlannerLattice")(
      parse_yaml("lattice_filepath: " + path, "x.yaml"), "x.yaml");
  TestGrid grid(100, 100, kFreeCost, 0.05);
  Footprint footprint;
  footprint.inscribed_radius = footprint.circumscribed_radius = 0.2;
  const PlanOutcome outcome = planner->plan(grid.view(), footprint, {1.0, 1.0, 0.0},
                                            {4.0, 4.0, 0.0}, MotionLimits{}, testing::kRunning);
  EXPECT_EQ(outcome.failure, Failure::kInvalidInput);
  EXPECT_NE(outcome.reason.find(path + ": lattice_metadata.grid_resolution: 0.1"),
            std::string::npos)
      << outcome.reason;
}

}  // namespace
}  // namespace trident::nav
