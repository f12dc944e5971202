// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/amcl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "room.h"
#include "trident_base/error.h"

namespace trident::estimation {
namespace {

const Eigen::Matrix3d kUnsure = Eigen::Vector3d(0.25, 0.25, 0.07).asDiagonal();

AmclParams params_of(LaserModel laser = LaserModel::kLikelihoodField,
                     OdomModel odom = OdomModel::kDiffCorrected) {
  AmclParams params;
  params.laser.laser_model_type = laser;
  params.laser.laser_max_beams = 60;
  params.laser.laser_z_hit = 0.9;
  // Deviations of 2 cm and 2 degrees in 0.3 m, whichever reading of the alphas is used.
  const double alpha = odom == OdomModel::kDiff || odom == OdomModel::kOmni ? 0.2 : 0.005;
  params.motion = {odom, alpha, alpha, alpha, alpha, alpha};
  params.kld_err = 0.05;
  params.max_particles = 1500;
  params.recovery_alpha_slow = params.recovery_alpha_fast = 0.0;
  return params;
}

/// A robot that drives to and fro in the flat, its odometry 2 % short.
class Drive {
 public:
  explicit Drive(const AmclParams& params, const OccupancyGrid& map = test_flat())
      : T_grid_base_(SE2::from_xy_yaw(2.5, 2.2, 0.0)), amcl_(params, map) {}

  SE2 truth() const { return grid_.T_map_origin * T_grid_base_; }
  /// Continues along a curve in the free middle of the left room.
  AmclStep step() {
    const SE2 motion = SE2::exp({0.3, 0.0, 0.3 / 0.9});
    T_grid_base_ = T_grid_base_ * motion;
    T_odom_base_ = T_odom_base_ * SE2::exp(0.98 * motion.log());
    return amcl_.update(test_scan(grid_, truth(), ++number_), T_odom_base_);
  }
  /// Odometry begins here, by a scan without motion.
  AmclStep stand() { return amcl_.update(test_scan(grid_, truth(), ++number_), T_odom_base_); }
  void kidnap(const SE2& T_grid_base) { T_grid_base_ = T_grid_base; }
  double error_m() const { return (amcl_.estimate().T_map_base.p - truth().p).norm(); }
  double error_rad() const {
    return std::abs(angle_difference(amcl_.estimate().T_map_base.angle, truth().angle));
  }
  Amcl& amcl() { return amcl_; }
  SE2 T_odom_base() const { return T_odom_base_; }
  const OccupancyGrid& grid() const { return grid_; }

 private:
  OccupancyGrid grid_ = test_flat();
  SE2 T_grid_base_, T_odom_base_;
  std::uint64_t number_ = 0;
  Amcl amcl_;
};

SE2 near(const SE2& T) { return SE2::from_xy_yaw(T.p.x() + 0.3, T.p.y() - 0.2, T.angle + 0.15); }

class EveryModel : public ::testing::TestWithParam<std::tuple<LaserModel, OdomModel>> {};

TEST_P(EveryModel, ConvergesToThePlaceAndNeedsFewerParticles) {
  AmclParams params = params_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  if (std::get<0>(GetParam()) == LaserModel::kBeam) params.max_particles = 500;
  Drive drive(params);
  drive.amcl().set_pose(near(drive.truth()), kUnsure);
  drive.stand();
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(drive.step().is_updated);
  EXPECT_LT(drive.error_m(), 0.08);
  EXPECT_LT(drive.error_rad(), 0.04);
  EXPECT_LT(drive.amcl().particle_count(), 500U);
  EXPECT_GE(drive.amcl().particle_count(), 100U);
  EXPECT_GT(drive.amcl().estimate().agreement, 0.9);
}

INSTANTIATE_TEST_SUITE_P(
    Amcl, EveryModel,
    ::testing::Combine(::testing::Values(LaserModel::kBeam, LaserModel::kLikelihoodField,
                                         LaserModel::kLikelihoodFieldProb),
                       ::testing::Values(OdomModel::kDiff, OdomModel::kOmniCorrected)));

TEST(Amcl, TwoRunsAreEqualToTheBit) {
  std::vector<SE2> ends;
  for (int run = 0; run < 2; ++run) {
    AmclParams params = params_of();
    params.recovery_alpha_slow = 0.01;
    params.recovery_alpha_fast = 0.3;
    Drive drive(params);
    drive.amcl().set_anywhere();
    for (int i = 0; i < 6; ++i) drive.step();
    ends.push_back(drive.amcl().estimate().T_map_base);
  }
  EXPECT_EQ(ends[0].p, ends[1].p);
  EXPECT_EQ(ends[0].angle, ends[1].angle);
}

TEST(Amcl, FindsItselfAnywhere) {
  Drive drive(params_of());
  drive.amcl().set_anywhere();
  for (int i = 0; i < 5; ++i) drive.step();
  EXPECT_LT(drive.error_m(), 0.1);
}

TEST(Amcl, AKidnappedRobotIsFoundAgain) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  for (int i = 0; i < 5; ++i) drive.step();
  ASSERT_LT(drive.error_m(), 0.1);
  drive.kidnap(SE2::from_xy_yaw(9.8, 3.5, 2.0));
  std::size_t hypotheses = 0;
  int updates = 0;
  for (; updates < 8 && (hypotheses == 0 || drive.error_m() > 0.3); ++updates) {
    hypotheses += drive.step().hypotheses;
  }
  EXPECT_GT(hypotheses, 0U);
  for (int i = 0; i < 3; ++i) drive.step();
  EXPECT_LT(drive.error_m(), 0.15);
  EXPECT_LT(drive.error_rad(), 0.1);
}

TEST(Amcl, ARobotThatSeesWhatTheMapDoesNotKnowIsNotLookedFor) {
  OccupancyGrid map = test_flat();
  fill(map, 0.0, 0.0, 1.2, 8.0, OccupancyGrid::kUnknown);
  fill(map, 4.4, 0.0, 7.0, 2.1, OccupancyGrid::kUnknown);
  Drive drive(params_of(), map);
  drive.amcl().set_pose(drive.truth(), 0.01 * kUnsure);
  drive.stand();
  for (int i = 0; i < 30; ++i) {
    EXPECT_FALSE(drive.step().is_searched) << i;
    EXPECT_LT(drive.error_m(), 0.15) << i;
  }
}

TEST(Amcl, ScansThatNearlyFitAreBorneLongerThanThoseThatDoNot) {
  const auto updates_before_search = [](double part) {
    Drive drive(params_of());
    drive.amcl().set_pose(drive.truth(), 1e-6 * kUnsure);
    LaserScan scan = test_scan(drive.grid(), drive.truth(), 1);
    const auto strangers = static_cast<std::ptrdiff_t>(part * static_cast<double>(scan.size()));
    std::fill_n(scan.ranges.begin(), strangers, 0.4F);
    for (int i = 1; i < 100; ++i) {
      drive.amcl().force_update();
      if (drive.amcl().update(scan, drive.T_odom_base()).is_searched) return i;
    }
    return 100;
  };
  EXPECT_EQ(updates_before_search(0.2), 100) << "the scan agrees";
  const int nearly = updates_before_search(0.4);
  EXPECT_GE(nearly, 5);
  EXPECT_LT(nearly, 20);
  EXPECT_EQ(updates_before_search(1.0), 2);
}

TEST(Amcl, SearchesInVainBecomeRare) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  LaserScan tent = test_scan(drive.grid(), drive.truth(), 1);
  tent.ranges.assign(tent.size(), 0.4F);
  int searches = 0;
  for (int i = 0; i < 100; ++i) {
    drive.amcl().force_update();
    searches += drive.amcl().update(tent, drive.T_odom_base()).is_searched ? 1 : 0;
  }
  EXPECT_GE(searches, 2);
  EXPECT_LE(searches, 6) << "after 2, 4, 8, 16, 32 updates";
}

TEST(Amcl, WithoutMatchingRandomParticlesFindIt) {
  AmclParams params = params_of();
  params.recover_by_matching = false;
  params.recovery_alpha_slow = 0.01;
  params.recovery_alpha_fast = 0.5;
  params.min_particles = 1500;
  Drive drive(params);
  drive.amcl().set_pose(drive.truth(), kUnsure);
  for (int i = 0; i < 5; ++i) drive.step();
  drive.kidnap(SE2::from_xy_yaw(4.0, 3.5, 2.0));
  int updates = 0;
  while (updates < 60 && drive.error_m() > 0.2) {
    EXPECT_EQ(drive.step().hypotheses, 0U);
    ++updates;
  }
  EXPECT_LT(updates, 60);
}

TEST(Amcl, StandsStillUntilTheRobotHasMovedOrItIsForced) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  EXPECT_TRUE(drive.step().is_updated);
  const LaserScan scan = test_scan(drive.grid(), drive.truth(), 99);
  EXPECT_FALSE(drive.amcl().update(scan, drive.T_odom_base()).is_updated);
  drive.amcl().force_update();
  EXPECT_TRUE(drive.amcl().update(scan, drive.T_odom_base()).is_updated);
}

TEST(Amcl, BadInputIsReportedAndChangesNothing) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  for (int i = 0; i < 4; ++i) drive.step();
  const SE2 before = drive.amcl().estimate().T_map_base;
  const LaserScan good = test_scan(drive.grid(), drive.truth(), 1);
  LaserScan empty = good, no_angle = good, no_range = good;
  empty.ranges.clear();
  no_angle.angle_increment = std::nan("");
  no_range.range_max = std::nan("");
  for (const LaserScan& scan : {empty, no_angle, no_range}) {
    drive.amcl().force_update();
    const AmclStep step = drive.amcl().update(scan, drive.T_odom_base());
    EXPECT_FALSE(step.problem.empty());
    EXPECT_FALSE(step.is_updated);
  }
  SE2 nowhere = drive.T_odom_base();
  nowhere.p.x() = std::nan("");
  EXPECT_EQ(drive.amcl().update(good, nowhere).problem,
            "odometry is not finite; the scan is not used");
  EXPECT_EQ(drive.amcl().estimate().T_map_base.p, before.p);
  EXPECT_THROW(drive.amcl().set_pose(nowhere, kUnsure), Error);
  EXPECT_THROW(drive.amcl().set_pose(SE2(), -kUnsure), Error);
}

TEST(Amcl, NanAndZeroRangesAndOtherBeamCountsDoNotHarmIt) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  for (int i = 0; i < 6; ++i) drive.step();
  LaserScan scan = test_scan(drive.grid(), drive.truth(), 1);
  for (std::size_t i = 0; i < scan.size(); i += 2) scan.ranges[i] = i % 4 == 0 ? NAN : 0.0F;
  drive.amcl().force_update();
  EXPECT_TRUE(drive.amcl().update(scan, drive.T_odom_base()).problem.empty());
  scan.ranges.resize(100);
  drive.amcl().force_update();
  EXPECT_TRUE(drive.amcl().update(scan, drive.T_odom_base()).problem.empty());
  scan.ranges.assign(100, NAN);
  drive.amcl().force_update();
  EXPECT_FALSE(drive.amcl().update(scan, drive.T_odom_base()).problem.empty());
  EXPECT_LT(drive.error_m(), 0.1);
}

TEST(Amcl, AJumpOfOdometryIsTakenOut) {
  Drive drive(params_of());
  drive.amcl().set_pose(drive.truth(), kUnsure);
  for (int i = 0; i < 6; ++i) drive.step();
  const SE2 reset = SE2::from_xy_yaw(40.0, 3.0, 1.0);
  drive.amcl().force_update();
  const AmclStep step = drive.amcl().update(test_scan(drive.grid(), drive.truth(), 1), reset);
  EXPECT_NE(step.problem.find("odometry jumped by"), std::string::npos);
  EXPECT_LT(drive.error_m(), 0.1);
}

TEST(Amcl, ParametersAndMapsAreChecked) {
  AmclParams params;
  params.min_particles = 6000;
  EXPECT_THROW(Amcl(params, test_flat()), Error);
  OccupancyGrid unknown = test_flat();
  unknown.cells.assign(unknown.cells.size(), OccupancyGrid::kUnknown);
  EXPECT_THROW(Amcl(AmclParams(), unknown), Error);
}

}  // namespace
}  // namespace trident::estimation
