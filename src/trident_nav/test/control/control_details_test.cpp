// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What control laws show of a command, and obstacles that others report.
#include "trident_nav/control/control_details.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "control/scene.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/reported_obstacle.h"

namespace trident::nav::testing {
namespace {

struct Shown {
  const char* law;
  const char* params;
  bool has_many;  ///< More than the selected trajectory.
  bool has_cells;
};
constexpr Shown kLaws[] = {
    {"dwa", "{}", false, false},
    {"dwa", "{publish_traj_pc: true, publish_cost_grid_pc: true}", true, true},
    {"trajectory_planner", "{publish_cost_grid_pc: true}", false, true},
    {"dwb", "{}", false, false},
    {"teb", "{}", false, false},
    {"mppi", "{}", false, false},
    {"regulated_pure_pursuit", "{}", false, false},
    {"graceful", "{}", false, false},
    {"mppi", "{visualize: true, TrajectoryVisualizer: {trajectory_step: 50}}", true, false},
};

struct Commanded {
  CommandOutcome outcome;
  ControlDetails details;
};

Commanded commanded(const Shown& shown, const WatchedDetails& watched) {
  const ControlSetup setup = jackal();
  const Scene scene = straight_scene(setup.footprint);
  const auto controller = make_controller(shown.law, setup, parse_yaml(shown.params, "test"));
  controller->set_watched(watched);
  const CostGrid grid = scene.world.grid();
  const Path path = plan_on(grid, scene.start, scene.goal, setup.footprint.inscribed_radius);
  RobotState state;
  state.pose = scene.start;
  state.time_s = 3.0;
  Commanded result;
  result.outcome = controller->command(state, path, grid, {});
  result.details = controller->details();
  return result;
}

TEST(ControlDetails, ShowASelectedTrajectoryThatBeginsAtTheRobotAndLeadsForward) {
  for (const Shown& shown : kLaws) {
    const ControlDetails details = commanded(shown, {true, true}).details;
    SCOPED_TRACE(std::string(shown.law) + shown.params);
    ASSERT_NE(details.selected_trajectory(), nullptr);
    EXPECT_EQ(details.time_s, 3.0);
    const auto& points = details.selected_trajectory()->points;
    ASSERT_GT(points.size(), 2U);
    const Pose2 start = straight_scene(jackal().footprint).start;
    EXPECT_NEAR(points.front().pose.x, start.x, 1e-9);
    EXPECT_NEAR(points.front().pose.y, start.y, 1e-9);
    EXPECT_GT(points.back().pose.x, start.x + 0.05);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
                               [](const auto& a, const auto& b) { return a.after_s < b.after_s; }));
    EXPECT_EQ(details.trajectories.size() > 1, shown.has_many);
    EXPECT_EQ(!details.cells.empty(), shown.has_cells);
  }
}

TEST(ControlDetails, ChangeNoCommandAndAreEmptyWhenNobodyLooks) {
  for (const Shown& shown : kLaws) {
    const Commanded seen = commanded(shown, {true, true});
    const Commanded unseen = commanded(shown, {});
    EXPECT_TRUE(are_equal(seen.outcome.twist, unseen.outcome.twist)) << shown.law;
    EXPECT_FALSE(unseen.details.time_s);
    EXPECT_TRUE(unseen.details.trajectories.empty()) << shown.law;
  }
}

TEST(ControlDetails, CellsScoreLessTowardsTheGoal) {
  const ControlDetails details = commanded(kLaws[1], {false, true}).details;
  const auto [nearest, farthest] =
      std::minmax_element(details.cells.begin(), details.cells.end(),
                          [](const CellScore& a, const CellScore& b) { return a.goal < b.goal; });
  EXPECT_GT(nearest->center.x, farthest->center.x);
  EXPECT_LT(nearest->total, farthest->total);
}

TEST(ControlDetails, OfABandFollowTheViaPointsThatAreGiven) {
  const ControlSetup setup = jackal();
  const auto controller = make_controller("teb", setup, parse_yaml("{weight_viapoint: 50}", "t"));
  const GridWorld world(6.0, 4.0);
  RobotState state;
  state.pose = {1.0, 2.0, 0.0};
  Path path;
  for (double x = 1.0; x < 5.0; x += 0.05) path.push_back({x, 2.0, 0.0});
  const auto farthest_y = [&] {
    controller->set_watched({true, false});
    controller->reset();
    controller->command(state, path, world.grid(), {});
    const ControlDetails details = controller->details();
    double y = -1e9;
    for (const auto& point : details.selected_trajectory()->points) y = std::max(y, point.pose.y);
    return y;
  };
  const double straight = farthest_y();
  EXPECT_NEAR(straight, 2.0, 0.02);
  controller->set_via_points(std::vector<Point2>{{2.2, 2.4}});
  EXPECT_GT(farthest_y(), 2.03);
  controller->set_via_points(std::nullopt);
  EXPECT_DOUBLE_EQ(farthest_y(), straight);
}

bool covers(const Tracks& tracks, const Point2& p) {
  return std::any_of(tracks.begin(), tracks.end(), [&](const Track& track) {
    return distance(track.position.x, track.position.y, p.x, p.y) <= track.radius_m + 1e-9;
  });
}

TEST(ReportedObstacle, DiscsCoverTheOutlineAndLittleMore) {
  const ReportedObstacle wall{7, {{1.0, 1.0}, {5.0, 1.0}}, 0.05, {0.1, 0.0}, {0.01, 0.02}};
  const ReportedObstacle room{8, {{0, 0}, {2, 0}, {2, 3}, {0, 3}}, 0.0, {}, {}};
  for (const ReportedObstacle& obstacle : {wall, room}) {
    const Tracks tracks = covering_tracks(obstacle);
    const std::size_t count = obstacle.outline.size();
    for (std::size_t i = 0; i < (count > 2 ? count : 1); ++i) {
      const Point2 &a = obstacle.outline[i], &b = obstacle.outline[(i + 1) % count];
      for (double t = 0.0; t <= 1.0; t += 0.01) {
        EXPECT_TRUE(covers(tracks, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)})) << t;
      }
    }
    std::set<int> ids;
    for (const Track& track : tracks) {
      ids.insert(track.id);
      EXPECT_LT(track.radius_m, 0.25);
    }
    EXPECT_EQ(ids.size(), tracks.size());
  }
  EXPECT_FALSE(covers(covering_tracks(wall), {3.0, 1.3}));
}

TEST(ReportedObstacle, KeepsWhatIsReportedOfIt) {
  const Tracks tracks = covering_tracks({-3, {{1.0, 2.0}}, 0.4, {0.5, -0.5}, {0.01, 0.04}});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].radius_m, 0.4);
  EXPECT_EQ(tracks[0].velocity.y, -0.5);
  EXPECT_EQ(tracks[0].covariance[10], 0.01);
  EXPECT_EQ(tracks[0].covariance[15], 0.04);
  EXPECT_GE(tracks[0].id, 0);
  EXPECT_TRUE(covering_tracks({}).empty());
}

}  // namespace
}  // namespace trident::nav::testing
