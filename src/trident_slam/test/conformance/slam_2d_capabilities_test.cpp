// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What algorithms of the registry, made by name and file as nodes and programs make them, can do
// beyond Slam2d.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "conformance/scan_world.h"
#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {
namespace {

using testing_world::ScanWorld;

constexpr std::size_t kMapped = 60;  // scans
constexpr double kNear = 0.1;        // [m]

const ScanWorld& abilities_world() {
  static const ScanWorld instance(11);
  return instance;
}

std::unique_ptr<Slam2d> make(const std::string& method, const std::string& config_file = "") {
  return builtin_slam_2d().get(method)(Slam2dSetup(config_file));
}

ScanPose2d add(Slam2d& slam, std::size_t step) {
  return slam.add_scan(abilities_world().steps()[step].scan,
                       abilities_world().steps()[step].T_odom_base);
}

SE2 truth(std::size_t step) { return abilities_world().steps()[step].T_start_base; }

/// How far the pose of a scan is from the truth [m].
double error(const ScanPose2d& pose, std::size_t step) {
  return (pose.T_map_base.p - truth(step).p).norm();
}

/// graph_slam_2d with the shipped file, after a part of the drive.
class GraphSlamOfAFile : public testing::Test {
 protected:
  GraphSlamOfAFile() {
    for (std::size_t k = 0; k < kMapped; ++k) add(*slam_, k);
  }
  ~GraphSlamOfAFile() override { std::remove(file_.c_str()); }

  template <class Ability>
  Ability& able(Slam2d& slam) {
    return dynamic_cast<Ability&>(slam);
  }
  std::size_t nodes(Slam2d& slam) { return able<Slam2dGraph>(slam).graph_view().nodes.size(); }

  std::string file_ =
      testing::TempDir() + "slam_2d_abilities_" + std::to_string(getpid()) + ".posegraph";
  std::unique_ptr<Slam2d> slam_ = make("graph_slam_2d", GRAPH_SLAM_CONFIG);
};

TEST_F(GraphSlamOfAFile, ContinuesInASessionWhereItIsAskedTo) {
  able<Slam2dSession>(*slam_).save_session(file_);
  const std::map<SessionStart, std::size_t> steps = {{SessionStart::kSessionEnd, kMapped},
                                                     {SessionStart::kFirstNode, 0},
                                                     {SessionStart::kGivenPose, kMapped / 2},
                                                     {SessionStart::kLocalize, kMapped / 2}};
  for (const auto& [start, step] : steps) {
    const std::unique_ptr<Slam2d> next = make("graph_slam_2d", GRAPH_SLAM_CONFIG);
    // A pose that is not read where another start is asked for.
    const bool reads_pose = start == SessionStart::kGivenPose || start == SessionStart::kLocalize;
    const SE2 T_map_base = reads_pose ? truth(step) : SE2::from_xy_yaw(3.0, 1.0, 2.0);
    able<Slam2dSession>(*next).load_session(file_, start, T_map_base);
    EXPECT_EQ(nodes(*next), nodes(*slam_));
    EXPECT_LT(error(add(*next, step), step), kNear) << static_cast<int>(start);
  }
}

TEST_F(GraphSlamOfAFile, DoesNotChangeTheMapOfASessionInWhichItLocalizes) {
  able<Slam2dSession>(*slam_).session_snapshot()(file_);
  able<Slam2dSession>(*slam_).load_session(file_, SessionStart::kLocalize, truth(0));
  const std::size_t before = nodes(*slam_);
  for (std::size_t k = 0; k < kMapped; ++k) EXPECT_LT(error(add(*slam_, k), k), kNear);
  EXPECT_EQ(nodes(*slam_), before);
  EXPECT_EQ(able<Slam2dMapSnapshot>(*slam_).map_snapshot()().cells, slam_->map().cells);
}

TEST_F(GraphSlamOfAFile, TakesAnInitialPoseAndAMovedNode) {
  able<PoseInitializable>(*slam_).set_pose(truth(10));
  EXPECT_LT(error(add(*slam_, 10), 10), kNear);
  const GraphView2d before = able<Slam2dGraph>(*slam_).graph_view();
  const int newest = static_cast<int>(before.nodes.size()) - 1;
  const std::map<int, SE2> moved = {
      {newest, before.nodes.back() * SE2::from_xy_yaw(0.1, 0.05, 0.02)}};
  EXPECT_TRUE(able<GraphEditable>(*slam_).move_nodes(moved).empty());
  able<GraphEditable>(*slam_).realign();
  EXPECT_FALSE(able<GraphEditable>(*slam_).node_points(newest).empty());
  const GraphView2d after = able<Slam2dGraph>(*slam_).graph_view();
  EXPECT_LT((after.nodes.back().p - before.nodes.back().p).norm(), kNear);
}

TEST(HectorSlamByName, TakesAnInitialPose) {
  const std::unique_ptr<Slam2d> slam = make("hector_slam_2d");
  for (std::size_t k = 0; k < kMapped; ++k) add(*slam, k);
  dynamic_cast<PoseInitializable&>(*slam).set_pose(truth(10));
  EXPECT_LT(error(add(*slam, 10), 10), 2.0 * kNear);
}

}  // namespace
}  // namespace trident::slam
