// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/graph_slam_2d.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "graph_slam/polygon_world.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph_g2o.h"
#include "trident_slam/pose_graph_optimizer.h"
#include "trident_slam/scan_matcher.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The ring, odometry that is wrong by 5 % of distance and 3 % of turns, and what is made of both.
class GraphSlamRing : public ::testing::Test {
 protected:
  void drive(GraphSlam2d& slam, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      last_ = slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
    }
  }
  /// Where scan i is in the map, whose origin is the first pose of the path.
  SE2 truth(std::size_t i) const { return path_.front().inverse() * path_[i]; }
  double error(const SE2& T, std::size_t i) const { return (T.p - truth(i).p).norm(); }

  static GraphSlamOptions options() {
    GraphSlamOptions options;
    options.reuse_distance = 30.0;
    return options;
  }

  PolygonWorld world_ = ring_world();
  std::vector<SE2> path_ = ring_path(1.5);
  std::vector<SE2> odometry_ = drifting_odometry(path_, 1.05, 0.97);
  ScanPose2d last_;
};

TEST_F(GraphSlamRing, EveryScanEndsNearItsTruePose) {
  GraphSlam2d slam(options());
  drive(slam, 0, path_.size());
  slam.finish();
  const std::vector<StampedPose2d> poses = slam.trajectory();
  ASSERT_EQ(poses.size(), path_.size());
  for (std::size_t i = 0; i < poses.size(); i += 7) {
    EXPECT_LT(error(poses[i].T_map_base, i), 0.05) << "scan " << i;
    EXPECT_EQ(poses[i].stamp_ns, static_cast<std::int64_t>(i) * 100'000'000);
  }
  EXPECT_GT(error(SE2(odometry_.back()), path_.size() - 1), 1.0);  // odometry alone does not
}

TEST_F(GraphSlamRing, TheGraphThatIsWrittenHoldsWhatTheFinalPosesComeFrom) {
  GraphSlam2d slam(options());
  drive(slam, 0, path_.size());
  slam.finish();
  const std::string file = ::testing::TempDir() + "trident_final_graph.g2o";
  slam.save_g2o(file);
  PoseGraph2d graph = std::get<PoseGraph2d>(read_g2o(file));
  const PoseGraph2d before = graph;
  PoseGraphOptimizer<SE2>(PoseGraphOptions{}).optimize(graph);
  double farthest = 0.0;
  for (int i = 0; i < slam.nodes(); ++i) {
    farthest = std::max(farthest, (graph.pose(i).p - before.pose(i).p).norm());
  }
  EXPECT_LT(farthest, 0.01);
  std::remove(file.c_str());
}

TEST_F(GraphSlamRing, SameScansGiveSameBitsAndPosesDoNotKnowTheFuture) {
  GraphSlam2d whole(options());
  GraphSlam2d part(options());
  for (std::size_t i = 0; i < 200; ++i) {
    const SE2 a = whole.add_scan(world_.scan(path_[i], i), odometry_[i]).T_map_base;
    if (i >= 100) continue;
    const SE2 b = part.add_scan(world_.scan(path_[i], i), odometry_[i]).T_map_base;
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.angle, b.angle);
  }
  part.finish();
  GraphSlam2d again(options());
  drive(again, 0, 100);
  again.finish();
  EXPECT_EQ(part.map().cells, again.map().cells);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(part.trajectory()[i].T_map_base.p, again.trajectory()[i].T_map_base.p);
  }
}

TEST_F(GraphSlamRing, BadScansAreReportedAndDoNotHarmTheMap) {
  GraphSlam2d slam(options());
  drive(slam, 0, 60);
  const std::size_t keyframes = slam.graph_view().nodes.size();
  const OccupancyGrid before = slam.map();
  LaserScan scan = world_.scan(path_[60], 60);
  for (const float value : {std::nanf(""), kInfinity, -kInfinity, 0.0F, -1.0F, 1e30F}) {
    LaserScan bad = scan;
    bad.ranges.assign(bad.ranges.size(), value);
    const ScanPose2d pose = slam.add_scan(bad, odometry_[60]);
    EXPECT_FALSE(pose.is_used);
    EXPECT_NE(pose.problem.find("0 of 180 beams"), std::string::npos) << pose.problem;
    EXPECT_LT(error(pose.T_map_base, 60), 0.05);
  }
  LaserScan fewer = scan;
  fewer.ranges.resize(90);
  EXPECT_FALSE(slam.add_scan(fewer, odometry_[60]).is_used);
  EXPECT_EQ(slam.graph_view().nodes.size(), keyframes);
  EXPECT_EQ(slam.map().cells, before.cells);
  scan.ranges[3] = std::nanf("");
  scan.ranges[4] = 0.0F;
  EXPECT_TRUE(slam.add_scan(scan, odometry_[60]).is_used);
}

TEST_F(GraphSlamRing, AJumpOfOdometryIsNotBelieved) {
  GraphSlam2d slam(options());
  drive(slam, 0, 60);
  const SE2 elsewhere = SE2::from_xy_yaw(500.0, -300.0, 1.0);
  const ScanPose2d jumped = slam.add_scan(world_.scan(path_[60], 60), elsewhere * odometry_[60]);
  EXPECT_NE(jumped.problem.find("odometry jumped"), std::string::npos) << jumped.problem;
  EXPECT_LT(error(jumped.T_map_base, 60), 0.05);
  SE2 lost;
  lost.p.x() = std::nan("");
  EXPECT_LT(error(slam.add_scan(world_.scan(path_[61], 61), lost).T_map_base, 61), 0.05);
  EXPECT_LT(
      error(slam.add_scan(world_.scan(path_[62], 62), elsewhere * odometry_[62]).T_map_base, 62),
      0.05);
}

TEST_F(GraphSlamRing, OdometryThatStoodStillCatchesUpFromWhereItStood) {
  GraphSlam2d slam(options());
  drive(slam, 0, 200);
  for (std::size_t i = 200; i < 230; ++i) {  // 2 m that are reported in one step
    const std::size_t reported = i < 220 ? 199 : i;
    const ScanPose2d pose = slam.add_scan(world_.scan(path_[i], i), odometry_[reported]);
    EXPECT_LT(error(pose.T_map_base, i), 0.05) << i;
  }
}

TEST_F(GraphSlamRing, ASessionContinuesAsIfItHadNotBeenInterrupted) {
  const std::string path = ::testing::TempDir() + "/graph_slam_session.tsl";
  GraphSlam2d first(options());
  drive(first, 0, 100);
  first.save_session(path);
  GraphSlam2d second(options());
  second.load_session(path);
  EXPECT_EQ(second.map().cells, first.map().cells);
  drive(second, 100, 140);
  EXPECT_LT(error(last_.T_map_base, 139), 0.05);
  EXPECT_EQ(second.trajectory().size(), 140U);
  second.clear();
  EXPECT_TRUE(second.graph_view().nodes.empty());
  std::remove(path.c_str());
}

TEST_F(GraphSlamRing, ADamagedSessionIsRefusedAndNothingChanges) {
  const std::string path = ::testing::TempDir() + "/graph_slam_damaged.tsl";
  GraphSlam2d slam(options());
  drive(slam, 0, 40);
  slam.save_session(path);
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string whole = text.str();
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  std::string other_version = whole;
  other_version.replace(whole.find("session 2"), 9, "session 9");
  const std::size_t keyframes = slam.graph_view().nodes.size();
  for (const std::string& bytes : {changed, whole.substr(0, whole.size() / 3),
                                   std::string("P5 3 3"), other_version, std::string()}) {
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      slam.load_session(path);
      FAIL() << "accepted";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
    EXPECT_EQ(slam.graph_view().nodes.size(), keyframes);
  }
  std::remove(path.c_str());
}

TEST_F(GraphSlamRing, LocalizationKeepsTheMapAndFindsAKidnappedRobot) {
  GraphSlam2d slam(options());
  drive(slam, 0, path_.size() * 2 / 3);
  slam.finish();
  const OccupancyGrid map = slam.map();
  slam.set_mode(SlamMode::kLocalization);
  const std::size_t elsewhere = 250;
  const auto found = slam.relocalize(world_.scan(path_[elsewhere], 5000));
  ASSERT_TRUE(found);
  EXPECT_LT(error(*found, elsewhere), 0.1);
  slam.set_pose(SE2::from_xy_yaw(8.0, 8.0, 0.7));  // amid the block: the robot finds out by itself
  for (std::size_t i = elsewhere; i < elsewhere + 60; ++i) {
    last_ = slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
  }
  EXPECT_LT(error(last_.T_map_base, elsewhere + 59), 0.1);
  EXPECT_EQ(slam.map().cells, map.cells);
}

TEST_F(GraphSlamRing, PausedScansArePlacedButNotKept) {
  GraphSlam2d slam(options());
  drive(slam, 0, 30);
  const std::size_t keyframes = slam.graph_view().nodes.size();
  slam.set_paused(true);
  drive(slam, 30, 50);
  EXPECT_EQ(slam.graph_view().nodes.size(), keyframes);
  EXPECT_LT(error(last_.T_map_base, 49), 0.1);
  slam.set_paused(false);
  drive(slam, 50, 60);
  EXPECT_GT(slam.graph_view().nodes.size(), keyframes);
}

TEST_F(GraphSlamRing, LoopsThatAreClosedInTheBackgroundGiveAnEquallyGoodMap) {
  GraphSlamOptions asynchronous = options();
  asynchronous.is_asynchronous = true;
  GraphSlam2d slam(asynchronous);
  drive(slam, 0, path_.size());
  slam.finish();
  EXPECT_LT(error(slam.trajectory().back().T_map_base, path_.size() - 1), 0.05);
}

/// The laser is configured to be on the base's axle, but sits ahead of it and to the left.
TEST_F(GraphSlamRing, WhatIsWrongWithOdometryIsFoundWhileDriving) {
  const SE2 T_base_laser = SE2::from_xy_yaw(0.12, 0.05, 0.03);
  std::vector<SE2> base_path;
  for (const SE2& T_map_laser : path_) base_path.push_back(T_map_laser * T_base_laser.inverse());
  odometry_ = drifting_odometry(base_path, 1.05, 0.97);
  const std::map<std::string, double> expected = {{"distance_scale", 1.0 / 1.05},
                                                  {"turn_scale", 1.0 / 0.97},
                                                  {"yaw_drift", 0.0},
                                                  {"laser_x", 0.12},
                                                  {"laser_y", 0.05},
                                                  {"laser_yaw", 0.03}};
  for (const bool is_applied : {false, true}) {
    GraphSlamOptions calibrating = options();
    calibrating.calibrate_odometry = is_applied;
    GraphSlam2d slam(calibrating);
    drive(slam, 0, 80);
    for (const CalibrationEstimate& estimate : slam.odometry_calibration()) {
      const bool is_of_turns =
          std::string(estimate.name) == "turn_scale" || std::string(estimate.name) == "laser_x";
      if (is_of_turns) EXPECT_FALSE(estimate.is_observed) << "so far it drove straight ahead";
    }
    drive(slam, 80, path_.size());
    ASSERT_EQ(slam.odometry_calibration().size(), expected.size());
    for (const CalibrationEstimate& estimate : slam.odometry_calibration()) {
      EXPECT_TRUE(estimate.is_observed) << estimate.name;
      EXPECT_NEAR(estimate.value, expected.at(estimate.name), 0.015) << estimate.name;
    }
    EXPECT_LT(error(last_.T_map_base, path_.size() - 1), 0.05);
  }
}

/// 5 % of distance and rotation and 0.03 rad/m: a prior that errs always to the same side bends the
/// map, by little with each scan and by what loops can hardly mend in the end.
TEST_F(GraphSlamRing, OdometryThatAlwaysErrsAlikeDoesNotBendTheMap) {
  odometry_ = {SE2::identity()};
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const SE2 moved = path_[i - 1].inverse() * path_[i];
    odometry_.push_back(odometry_.back() *
                        SE2::from_xy_yaw(1.05 * moved.p.x(), 1.05 * moved.p.y(),
                                         1.05 * moved.angle + 0.03 * moved.p.norm()));
  }
  GraphSlamOptions without_loops = options();
  without_loops.do_loop_closing = false;
  without_loops.reuse_distance = 10.0;
  GraphSlam2d slam(without_loops);
  const std::size_t once_around = path_.size() * 2 / 3;
  drive(slam, 0, once_around);
  EXPECT_LT(std::abs(angle_difference(last_.T_map_base.angle, truth(once_around - 1).angle)),
            0.012);
}

TEST_F(GraphSlamRing, ALoopOfAUserMustFit) {
  GraphSlam2d slam(options());
  drive(slam, 0, 100);
  const std::vector<SE2> poses = slam.graph_view().nodes;
  EXPECT_TRUE(slam.close_loop(1, 4, poses[1].inverse() * poses[4]));
  EXPECT_EQ(slam.loops_closed(), 1);
  EXPECT_FALSE(slam.close_loop(1, 20, SE2::from_xy_yaw(0.0, 40.0, 1.0)));
  EXPECT_THROW(slam.close_loop(1, 100000, {}), Error);
}

// A tracker that may not reuse what is old and may not close loops drifts: a user corrects it.
TEST_F(GraphSlamRing, AKeyframeThatAUserMovesClosesTheLoop) {
  GraphSlamOptions blind = options();
  blind.reuse_distance = 5.0;
  blind.do_loop_closing = false;
  blind.use_scan_matching = false;  // odometry alone
  GraphSlam2d slam(blind);
  odometry_ = drifting_odometry(path_, 1.0, 0.97);
  std::size_t at = path_.size() * 5 / 6;  // once around and a quarter
  drive(slam, 0, at);
  const int newest = static_cast<int>(slam.graph_view().nodes.size());
  for (; static_cast<int>(slam.graph_view().nodes.size()) == newest; ++at) drive(slam, at, at + 1);
  --at;  // that keyframe's scan
  ASSERT_GT(error(slam.graph_view().nodes.back(), at), 1.0);
  EXPECT_EQ(slam.move_nodes({{newest, SE2::from_xy_yaw(8.0, 8.0, 0.0)}}),
            std::vector<int>{newest});  // amid the block
  EXPECT_EQ(slam.loops_closed(), 0);
  const SE2 dropped = truth(at) * SE2::from_xy_yaw(0.3, -0.2, 0.1);  // by a hand, roughly
  EXPECT_TRUE(slam.move_nodes({{newest, dropped}}).empty());
  EXPECT_EQ(slam.loops_closed(), 1);
  EXPECT_LT(error(slam.graph_view().nodes.back(), at), 0.1);
  EXPECT_THROW(slam.move_nodes({{newest + 1, dropped}}), Error);
}

TEST_F(GraphSlamRing, AKeyframeReportsWhatItSaw) {
  GraphSlam2d slam(options());
  drive(slam, 0, 40);
  const std::vector<Eigen::Vector2f> points = slam.node_points(0);
  ASSERT_EQ(points.size(), 180U);
  EXPECT_NEAR(points[90].norm(), world_.scan(path_[0], 0).ranges[90], 1e-3);
  EXPECT_THROW(slam.node_points(4711), Error);
}

TEST_F(GraphSlamRing, TwoSessionsBecomeOneMap) {
  const std::string path = ::testing::TempDir() + "/graph_slam_second.tsl";
  const std::size_t from = path_.size() / 3, to = path_.size();
  {
    GraphSlam2d second(options());
    drive(second, from, to);
    second.save_session(path);
  }
  GraphSlam2d slam(options());
  drive(slam, 0, path_.size() / 2);
  const std::size_t scans = slam.trajectory().size();
  const SE2 dropped = SE2::from_xy_yaw(0.5, -0.4, 0.05) * truth(from);  // by a hand, roughly
  EXPECT_GT(slam.append_session(path, dropped), 0);
  slam.finish();
  const std::vector<StampedPose2d> poses = slam.trajectory();
  ASSERT_EQ(poses.size(), scans + (to - from));
  for (std::size_t i = 0; i < poses.size(); i += 11) {
    EXPECT_LT(error(poses[i].T_map_base, i < scans ? i : from + i - scans), 0.1) << "scan " << i;
  }
  std::remove(path.c_str());
  EXPECT_THROW(slam.append_session(path, {}), Error);
  EXPECT_EQ(slam.trajectory().size(), poses.size());
}

class CountingSolver : public PoseGraphSolver<SE2> {
 public:
  explicit CountingSolver(int* calls) : calls_(calls) {}
  PoseGraphReport optimize(PoseGraph<SE2>& graph) override {
    ++*calls_;
    return PoseGraphOptimizer<SE2>().optimize(graph);
  }

 private:
  int* calls_;
};

TEST_F(GraphSlamRing, TheSolverIsTheOneThatWasGiven) {
  int calls = 0;
  GraphSlam2d slam(options(), [&calls](int) { return std::make_unique<CountingSolver>(&calls); });
  drive(slam, 0, 60);
  slam.clear();
  drive(slam, 0, 60);
  slam.finish();
  EXPECT_GT(calls, 0);
  EXPECT_LT(error(slam.trajectory()[59].T_map_base, 59), 0.05);
}

std::vector<std::string> scan_matcher_names() {
  Registry<ScanMatcherFactory> registry("scan matcher");
  register_builtin_scan_matchers(registry);
  return registry.names();
}

/// The names in back quotes that begin the rows of the table in a section of docs/howto/slam.md,
/// sorted.
std::vector<std::string> first_cells(const std::string& heading) {
  std::ifstream file(SLAM_MANUAL);
  std::vector<std::string> names;
  bool is_there = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("## ", 0) == 0) is_there = line == heading;
    if (!is_there || line.rfind("| `", 0) != 0) continue;
    names.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Every scan matcher as the front end, over a part of the ring.
class GraphSlamMatchers : public GraphSlamRing, public testing::WithParamInterface<std::string> {};

TEST_P(GraphSlamMatchers, TracksAndGivesTheSameBits) {
  GraphSlamOptions chosen = options();
  chosen.scan_matcher = GetParam();
  GraphSlam2d slam(chosen);
  GraphSlam2d again(chosen);
  for (std::size_t i = 0; i < 230; i += 2) {  // past the first corner
    const ScanPose2d pose = slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
    EXPECT_EQ(pose.problem, "");
    EXPECT_LT(error(pose.T_map_base, i), 0.1) << "scan " << i;
    if (i > 60) continue;
    const ScanPose2d same = again.add_scan(world_.scan(path_[i], i), odometry_[i]);
    EXPECT_EQ(pose.T_map_base.p, same.T_map_base.p);
    EXPECT_EQ(pose.covariance, same.covariance);
  }
}

TEST_P(GraphSlamMatchers, ContinuesInASession) {
  GraphSlamOptions chosen = options();
  chosen.scan_matcher = GetParam();
  GraphSlam2d slam(chosen);
  for (std::size_t i = 0; i < 60; i += 2) slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
  const std::string file = testing::TempDir() + "matcher_" + GetParam() + ".posegraph";
  slam.save_session(file);
  GraphSlam2d next(chosen);
  next.load_session(file);
  for (std::size_t i = 58; i < 100; i += 2) {  // where the session ended
    EXPECT_LT(error(next.add_scan(world_.scan(path_[i], i), odometry_[i]).T_map_base, i), 0.1);
  }
  std::remove(file.c_str());
}

INSTANTIATE_TEST_SUITE_P(Matchers, GraphSlamMatchers, testing::ValuesIn(scan_matcher_names()),
                         [](const auto& info) { return info.param; });

TEST(GraphSlamOptionsTest, ImpossibleRangesAreAnError) {
  EXPECT_THROW(load_yaml_string<GraphSlamOptions>("min_laser_range: 5\nmax_laser_range: 2\n", "x"),
               Error);
  EXPECT_THROW(load_yaml_string<GraphSlamOptions>("resolution: 0\n", "x"), Error);
  EXPECT_THROW(load_yaml_string<GraphSlamOptions>("resolutoin: 0.1\n", "x"), Error);
}

TEST(GraphSlamOptionsTest, AnUnknownScanMatcherIsAnErrorWithTheLegalNames) {
  try {
    load_yaml_string<GraphSlamOptions>("scan_matcher: icp\n", "graph.yaml");
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("scan_matcher"), std::string::npos) << text;
    EXPECT_NE(text.find(join(scan_matcher_names())), std::string::npos) << text;
  }
}

TEST(GraphSlamOptionsTest, TheNamesOfMatchersInTheShippedFileAreThoseOfTheRegistry) {
  const std::string comment = "# " + join(scan_matcher_names(), " | ");
  std::ifstream file(GRAPH_SLAM_CONFIG);
  std::string line;
  while (std::getline(file, line) && line.rfind("scan_matcher:", 0) != 0) {
  }
  EXPECT_EQ(line.substr(std::min(line.find('#'), line.size())), comment);
}

TEST(GraphSlamOptionsTest, TheNamesInTheManualAreThoseOfTheRegistries) {
  EXPECT_EQ(first_cells("## The algorithms"), builtin_slam_2d().names());
  EXPECT_EQ(first_cells("## Matching scans"), scan_matcher_names());
}

TEST(GraphSlamOptionsTest, TheShippedFileHoldsTheDefaults) {
  auto shipped = load_yaml<GraphSlamOptions>(GRAPH_SLAM_CONFIG);
  const GraphSlamOptions defaults;
  EXPECT_EQ(shipped.max_laser_range, defaults.max_laser_range);
  EXPECT_EQ(shipped.calibrate_odometry, defaults.calibrate_odometry);
  EXPECT_EQ(shipped.reuse_distance, defaults.reuse_distance);
  EXPECT_EQ(shipped.scan_matcher, defaults.scan_matcher);
  EXPECT_EQ(shipped.minimum_travel_distance, defaults.minimum_travel_distance);
  EXPECT_EQ(shipped.loop_match_minimum_response_fine, defaults.loop_match_minimum_response_fine);
}

}  // namespace
}  // namespace trident::slam
