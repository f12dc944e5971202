// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/offline_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "logs/odometry_slam_2d.h"
#include "logs/process_cost.h"
#include "trident_base/error.h"
#include "trident_slam/pose_graph_g2o.h"

namespace trident::slam {
namespace {

// A robot that drives along x between two walls at y = +-1 m and looks to both sides.
class CorridorDrive : public ScanSource {
 public:
  explicit CorridorDrive(int scans) : scans_(scans) {}
  bool next(ScanRecord& record) override {
    if (count_ == scans_) return false;
    record.scan.stamp_ns = 1'000'000'000 + 100'000'000LL * count_;
    record.scan.angle_min = -1.5707963267948966;
    record.scan.angle_increment = 3.141592653589793;
    record.scan.range_max = 10.0;
    record.scan.ranges = {1.0F, 1.0F};
    record.T_odom_base = SE2::from_xy_yaw(5.0 + 0.01 * count_, 2.0, 0.0);
    ++count_;
    return true;
  }
  const LogProblems& problems() const override { return problems_; }
  double progress() const override { return static_cast<double>(count_) / scans_; }

 private:
  int scans_;
  int count_ = 0;
  LogProblems problems_;
};

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

class OfflineRun : public testing::Test {
 protected:
  std::string out_ = testing::TempDir() + "offline_run_test_" + std::to_string(getpid());
  OfflineRun() { std::filesystem::create_directories(out_); }
  ~OfflineRun() override { std::filesystem::remove_all(out_); }
};

TEST_F(OfflineRun, WritesTrajectoriesAndMap) {
  CorridorDrive source(100);
  OdometrySlam2d slam({});
  double part = 0.0;
  const OfflineResult result =
      run_offline(source, slam, out_, [&part](std::size_t, double now) { part = now; });
  EXPECT_EQ(result.scans, 100U);
  EXPECT_EQ(part, 1.0);
  const auto causal = lines_of(out_ + "/causal.tum");
  ASSERT_EQ(causal.size(), 100U);
  EXPECT_EQ(causal[0], "1.000000 0.000000 0.000000 0.000000 0.000000 0.000000 0.000000 1.000000");
  EXPECT_EQ(causal[99], "10.900000 0.990000 0.000000 0.000000 0.000000 0.000000 0.000000 1.000000");
  EXPECT_EQ(lines_of(out_ + "/trajectory.tum"), causal);
  EXPECT_EQ(lines_of(out_ + "/map.yaml")[0], "image: map.pgm");
}

TEST_F(OfflineRun, NamesEachScanBeforeItIsWorkedOnAndTheOneThatCostTheMost) {
  CorridorDrive source(20);
  OdometrySlam2d slam({});
  std::vector<std::size_t> begun;
  const OfflineResult result =
      run_offline(source, slam, out_, nullptr, [&](std::size_t scan, std::int64_t stamp_ns) {
        begun.push_back(scan);
        EXPECT_EQ(slam.trajectory().size(), scan - 1);
        EXPECT_EQ(stamp_ns, 900'000'000 + 100'000'000LL * static_cast<std::int64_t>(scan));
      });
  ASSERT_EQ(begun.size(), 20U);
  EXPECT_EQ(begun.back(), 20U);
  EXPECT_GE(result.slowest_scan, 1U);
  EXPECT_GT(result.slowest_scan_cpu_s, 0.0);
  EXPECT_EQ(result.stamps_back, 0U);
}

TEST_F(OfflineRun, CausalPosesDoNotKnowTheFuture) {
  CorridorDrive whole(50);
  OdometrySlam2d slam({});
  run_offline(whole, slam, out_, nullptr);
  auto expected = lines_of(out_ + "/causal.tum");
  expected.resize(20);
  CorridorDrive part(20);
  OdometrySlam2d again({});
  run_offline(part, again, out_, nullptr);
  EXPECT_EQ(lines_of(out_ + "/causal.tum"), expected);
}

TEST_F(OfflineRun, WallsAreOccupiedAndTheCorridorIsFree) {
  CorridorDrive source(100);
  OdometrySlam2d slam({});
  run_offline(source, slam, out_, nullptr);
  const OccupancyGrid map = slam.map();
  const auto at = [&map](double x, double y) {
    const Eigen::Vector2i cell = map.cell_at({x, y});
    return map.cells[map.index(cell.x(), cell.y())];
  };
  EXPECT_EQ(at(0.52, 1.001), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(0.52, -0.999), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(0.52, 0.5), OccupancyGrid::kFree);
  EXPECT_EQ(at(1.3, 0.0), OccupancyGrid::kUnknown);
}

/// Somebody else's algorithm that has a graph: a node per scan, and the last one sees the first.
class ChainSlam2d : public OdometrySlam2d, public Slam2dGraph {
 public:
  using OdometrySlam2d::OdometrySlam2d;
  GraphView2d graph_view() const override {
    GraphView2d view;
    for (const StampedPose2d& pose : trajectory()) view.nodes.push_back(pose.T_map_base);
    return view;
  }
  std::vector<GraphLoop2d> loops() const override {
    const std::vector<SE2> nodes = graph_view().nodes;
    return {{0, nodes.size() - 1, nodes.front().inverse() * nodes.back(), true}};
  }
  void save_g2o(const std::string& file) const override {
    PoseGraph2d graph;
    const std::vector<SE2> nodes = graph_view().nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) graph.add_vertex(static_cast<int>(i), nodes[i]);
    write_g2o(graph, file);
  }
};

TEST_F(OfflineRun, WritesGraphAndLoopsOfWhateverHasThem) {
  CorridorDrive source(3);
  ChainSlam2d slam{OdometrySlam2dParams()};
  run_offline(source, slam, out_, nullptr);
  const auto graph = lines_of(out_ + "/graph.g2o");
  ASSERT_EQ(graph.size(), 3U);
  EXPECT_EQ(graph[0].substr(0, 13), "VERTEX_SE2 0 ");
  const std::vector<std::string> loops = {"older_scan,newer_scan,x,y,yaw,kind",
                                          "0,2,0.020000,0.000000,0.000000,loop"};
  EXPECT_EQ(lines_of(out_ + "/loops.csv"), loops);
}

TEST_F(OfflineRun, AnEmptyLogIsAnError) {
  CorridorDrive source(0);
  OdometrySlam2d slam({});
  EXPECT_THROW(run_offline(source, slam, out_, nullptr), Error);
}

TEST_F(OfflineRun, AFolderThatIsMissingIsAnError) {
  CorridorDrive source(1);
  OdometrySlam2d slam({});
  EXPECT_THROW(run_offline(source, slam, out_ + "/no/such", nullptr), Error);
}

TEST(ProcessCost, CountsWhatIsUsed) {
  const ProcessCost before = process_cost();
  std::vector<char> memory(64U << 20U, 1);
  double sum = 0.0;
  while (process_cost().cpu_s < before.cpu_s + 0.01) sum += memory[static_cast<std::size_t>(sum)];
  const ProcessCost after = process_cost();
  EXPECT_GE(after.peak_rss_mb, 64.0);
  EXPECT_LT(after.peak_rss_mb, before.peak_rss_mb + 96.0);
}

TEST(TumLine, KeepsMicrosecondsOfLargeAndNegativeStamps) {
  EXPECT_EQ(tum_line({976052857'337530000, SE2::from_xy_yaw(1.0, -2.0, 0.0)}),
            "976052857.337530 1.000000 -2.000000 0.000000 0.000000 0.000000 0.000000 1.000000");
  EXPECT_EQ(tum_line({-500'000'000, {}}).substr(0, 9), "-0.500000");
}

}  // namespace
}  // namespace trident::slam
