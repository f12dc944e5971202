// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A scanner that sends several beam patterns by turns.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "graph_slam/polygon_world.h"
#include "scans/scan_check.h"
#include "trident_slam/carmen_log.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/offline_run.h"

namespace trident::slam {
namespace {

constexpr double kDegree = kPi / 180.0;

struct Pattern {
  double angle_min;  ///< [rad]
  double angle_increment;
  std::uint32_t beams;
};

/// An interlaced SICK: 181 beams a degree apart, then 180 that start a quarter of a degree later
/// each time.
constexpr std::array<Pattern, 4> kInterlaced = {{{-90.0 * kDegree, kDegree, 181},
                                                 {-89.75 * kDegree, kDegree, 180},
                                                 {-89.5 * kDegree, kDegree, 180},
                                                 {-89.25 * kDegree, kDegree, 180}}};

LaserScan scan_of(const Pattern& pattern) {
  LaserScan scan;
  scan.angle_min = pattern.angle_min;
  scan.angle_increment = pattern.angle_increment;
  scan.range_max = 10.0;
  scan.ranges.assign(pattern.beams, 2.0F);
  return scan;
}

TEST(ScanCheckPatterns, ThoseOfOneScannerAreTakenAtOnce) {
  ScanCheck check;
  for (int round = 0; round < 3; ++round) {
    for (const Pattern& pattern : kInterlaced) EXPECT_EQ(check.problem(scan_of(pattern)), "");
  }
}

TEST(ScanCheckPatterns, ANumberOfBeamsThatChangesWithEveryTurnIsTaken) {
  ScanCheck check;  // a lidar whose motor is not synchronised: all around in 395 to 404 beams
  for (std::uint32_t k = 0; k < 60; ++k) {
    const std::uint32_t beams = 395 + (7 * k) % 10;
    EXPECT_EQ(check.problem(scan_of({-kPi, 2.0 * kPi / (beams - 1), beams})), "") << beams;
  }
}

TEST(ScanCheckPatterns, OtherStepsByTurnsAreBelievedAfterSome) {
  ScanCheck check;
  int refused = 0;
  for (int k = 0; k < 100; ++k) {
    const Pattern pattern = k % 2 == 0 ? Pattern{-90.0 * kDegree, kDegree, 181}
                                       : Pattern{-90.0 * kDegree, 0.5 * kDegree, 361};
    if (!check.problem(scan_of(pattern)).empty()) ++refused;
  }
  EXPECT_EQ(refused, ScanCheck::kPatience - 1);
}

TEST(ScanCheckPatterns, DamagedScansThatComeNowAndThenAreNeverBelieved) {
  ScanCheck check;
  for (int k = 0; k < 2000; ++k) {
    const bool is_damaged = k % 40 == 10;  // half of the readings are missing
    const std::string problem = check.problem(
        scan_of({-90.0 * kDegree, kDegree, is_damaged ? std::uint32_t{90} : std::uint32_t{181}}));
    EXPECT_EQ(problem.empty(), !is_damaged);
    if (is_damaged) EXPECT_NE(problem.find("90 beams from"), std::string::npos) << problem;
  }
}

/// The ring as a CARMEN log of such a scanner, with odometry that drifts.
class InterlacedLog : public testing::Test {
 protected:
  std::string folder_ = testing::TempDir() + "interlaced_" + std::to_string(getpid());
  std::string log_ = folder_ + "/interlaced.clf";
  std::vector<SE2> path_ = ring_path(1.25);

  InterlacedLog() { std::filesystem::create_directories(folder_); }
  ~InterlacedLog() override { std::filesystem::remove_all(folder_); }

  /// Patterns by turns, or the first of them alone.
  void write(std::size_t patterns) const {
    const PolygonWorld world = ring_world();
    const std::vector<SE2> odometry = drifting_odometry(path_, 1.03, 0.98);
    std::ofstream file(log_);
    file.precision(10);
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const Pattern& pattern = kInterlaced[i % patterns];
      const LaserScan scan =
          world.scan(path_[i], i, 0.01, pattern.angle_min, pattern.angle_increment, pattern.beams);
      file << "ROBOTLASER1 0 " << scan.angle_min << ' ' << kPi << ' ' << scan.angle_increment
           << " 20 0.01 0 " << scan.size();
      for (const float range : scan.ranges) file << ' ' << range;
      file << " 0";  // remissions
      const SE2& T = odometry[i];
      for (int pose = 0; pose < 2; ++pose) {
        file << ' ' << T.p.x() << ' ' << T.p.y() << ' ' << T.angle;
      }
      file << " 0 0 0 0 0 " << 0.1 * static_cast<double>(i) << " host 0\n";
    }
  }

  OfflineResult run(GraphSlam2d& slam) const {
    CarmenLog log(log_);
    return run_offline(log, slam, folder_, nullptr);
  }
};

TEST_F(InterlacedLog, EveryScanIsUsedByItsOwnAngles) {
  write(kInterlaced.size());
  GraphSlam2d slam;
  const OfflineResult result = run(slam);
  EXPECT_EQ(result.scans, path_.size());
  EXPECT_EQ(result.unused_scans, 0U);
  EXPECT_EQ(result.scan_problems.count(), 0U);
  const std::vector<StampedPose2d> poses = slam.trajectory();
  ASSERT_EQ(poses.size(), path_.size());
  for (std::size_t i = 0; i < poses.size(); i += 7) {
    const SE2 error = (path_.front().inverse() * path_[i]).inverse() * poses[i].T_map_base;
    EXPECT_LT(error.p.norm(), 0.05) << "scan " << i;
    EXPECT_LT(std::abs(error.angle), 0.01) << "scan " << i;  // beams off by one would be 0.017
  }
}

TEST_F(InterlacedLog, KeepingItTakesNoMoreThanWithOnePattern) {
  const auto session_size = [this](std::size_t patterns) {
    write(patterns);
    GraphSlam2d slam;
    run(slam);
    const std::string session = folder_ + "/session";
    slam.save_session(session);
    return static_cast<double>(std::filesystem::file_size(session));
  };
  EXPECT_LT(session_size(kInterlaced.size()), 1.02 * session_size(1));
}

}  // namespace
}  // namespace trident::slam
