// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "motion/odometry_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "trident_base/random_stream.h"

namespace trident::slam {
namespace {

const SE2 kNominal = SE2::from_xy_yaw(0.20, 0.0, 0.0);
const SE2 kTrue = SE2::from_xy_yaw(0.26, -0.04, 0.05);
constexpr double kDistance = 1.03;
constexpr double kTurn = 0.94;
constexpr double kDrift = 0.01;
const Eigen::Vector3d kScanSigma(0.003, 0.003, 0.001);
const Eigen::Matrix3d kScanCovariance = kScanSigma.cwiseAbs2().asDiagonal();

CalibrationVector truth() {
  CalibrationVector parameters;
  parameters << kDistance, kTurn, kDrift, kTrue.p, kTrue.angle;
  return parameters;
}

/// A robot of those errors that drives as commanded, step by step: what odometry and what scan
/// matching say of each step.
class Drive {
 public:
  using Twist = std::function<SE2::Tangent(int step)>;

  explicit Drive(std::uint64_t seed) : stream_(seed, "drive") {}

  void run(OdometryCalibration* calibration, int steps, const Twist& twist) {
    for (int i = 0; i < steps; ++i, ++k_) {
      const SE2 reported = SE2::exp(twist(i));
      CalibratedMotion motion(truth());
      motion.add(reported);
      T_map_laser_ = T_map_laser_ * motion.of_laser();
      const SE2 T_map_seen = T_map_laser_ * SE2::exp(noise(0, kScanSigma));
      const double size = std::sqrt(reported.p.norm() + std::abs(reported.angle));
      const SE2 odometry =
          reported * SE2::exp(noise(3, size * Eigen::Vector3d(0.005, 0.001, 0.003)));
      SE2 seen = T_seen_last_.inverse() * T_map_seen;
      if (slip_every_ > 0 && k_ % slip_every_ == 0) seen = seen * SE2::exp({0.3, -0.2, 0.2});
      calibration->add(odometry, seen, kScanCovariance);
      T_seen_last_ = T_map_seen;
    }
  }
  void slip_every(int steps) { slip_every_ = steps; }

 private:
  Eigen::Vector3d noise(std::uint32_t channel, const Eigen::Vector3d& sigma) const {
    return {sigma[0] * stream_.normal(k_, channel), sigma[1] * stream_.normal(k_, channel + 1),
            sigma[2] * stream_.normal(k_, channel + 2)};
  }

  RandomStream stream_;
  SE2 T_map_laser_, T_seen_last_;
  std::uint64_t k_ = 1;
  int slip_every_ = 0;
};

SE2::Tangent ahead(int /*step*/) { return {0.08, 0.0, 0.0}; }
SE2::Tangent circle(int /*step*/) { return {0.08, 0.0, 0.04}; }
SE2::Tangent on_the_spot(int step) { return {0.0, 0.0, step / 100 % 2 == 0 ? 0.1 : -0.08}; }
/// Straight ahead, left, straight ahead, right, and a little on the spot.
SE2::Tangent about_the_house(int step) {
  const int part = step / 20 % 5;
  if (part == 4) return {0.0, 0.0, 0.1};
  return {0.08, 0.0, part == 1 ? 0.08 : part == 3 ? -0.08 : 0.0};
}

void expect_truth(const OdometryCalibration& calibration, double scale_bound, double place_bound) {
  const CalibrationVector off = calibration.parameters() - truth();
  EXPECT_LT(std::abs(off[kDistanceScale]), scale_bound);
  EXPECT_LT(std::abs(off[kTurnScale]), scale_bound);
  EXPECT_LT(std::abs(off[kYawDrift]), 0.3 * scale_bound) << "rad/m";
  EXPECT_LT(off.segment<2>(kLaserX).norm(), place_bound) << "m";
  EXPECT_LT(std::abs(off[kLaserYaw]), 0.5 * scale_bound) << "rad";
}

CalibrationVector numeric_column(const CalibrationVector& at, int i, double step) {
  CalibrationVector moved = at;
  moved[i] += step;
  return moved;
}

TEST(CalibratedMotion, JacobianIsThatOfTheMotion) {
  for (const double wheel_base : {0.0, 0.4}) {
    const auto moved = [wheel_base](const CalibrationVector& parameters) {
      CalibratedMotion motion(parameters, wheel_base);
      for (int k = 0; k < 6; ++k) motion.add(SE2::exp({0.1, 0.02 * k, 0.3 * k - 0.5}));
      motion.add(SE2::exp({0.1, 0.02, 3e-5}));
      return motion;
    };
    const auto J = moved(truth()).laser_jacobian();
    const SE2 T_now_first = moved(truth()).of_laser().inverse();
    for (int i = 0; i < kCalibrationParameters; ++i) {
      constexpr double h = 1e-6;
      const SE2 above = moved(numeric_column(truth(), i, h)).of_laser();
      const SE2 below = moved(numeric_column(truth(), i, -h)).of_laser();
      const Eigen::Vector3d slope =
          ((T_now_first * above).log() - (T_now_first * below).log()) / (2.0 * h);
      EXPECT_LT((J.col(i) - slope).norm(), 1e-8) << kCalibrationNames[static_cast<size_t>(i)];
    }
  }
}

TEST(OdometryCalibration, FindsWhatIsWrong) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    OdometryCalibration calibration(kNominal);
    Drive(seed).run(&calibration, 3000, about_the_house);
    expect_truth(calibration, 0.01, 0.01);
    const CalibrationVector off = calibration.parameters() - truth();
    EXPECT_LT(off.dot(calibration.covariance().llt().solve(off)), 30.0)
        << "squared Mahalanobis distance, 6 degrees of freedom";
    for (int i = 0; i < kCalibrationParameters; ++i) {
      EXPECT_TRUE(calibration.is_observed(static_cast<CalibrationParameter>(i)));
    }
    EXPECT_GT(calibration.used(), 500);
    EXPECT_LE(calibration.outliers(), 3) << "one of a thousand by chance";
  }
}

TEST(OdometryCalibration, FindsItAmongOutliers) {
  OdometryCalibration calibration(kNominal);
  Drive drive(4);
  drive.slip_every(40);
  drive.run(&calibration, 4000, about_the_house);
  expect_truth(calibration, 0.015, 0.015);
  EXPECT_GE(calibration.outliers(), 95);
  EXPECT_LE(calibration.outliers(), 105);
}

TEST(OdometryCalibration, FollowsWhatChanges) {
  OdometryCalibration calibration(kNominal);
  const auto drive = [&calibration](double scale) {
    for (int k = 0; k < 4000; ++k) {
      const SE2 reported = SE2::exp(about_the_house(k));
      CalibrationVector parameters = truth();
      parameters[kDistanceScale] = scale;
      CalibratedMotion motion(parameters);
      motion.add(reported);
      calibration.add(reported, motion.of_laser(), kScanCovariance);
    }
  };
  drive(1.0);
  EXPECT_NEAR(calibration.parameters()[kDistanceScale], 1.0, 0.002);
  drive(1.04);
  EXPECT_NEAR(calibration.parameters()[kDistanceScale], 1.04, 0.002);
}

TEST(OdometryCalibration, StraightAheadSaysNothingOfTurnsNorOfWhereTheLaserSits) {
  OdometryCalibration calibration(kNominal);
  Drive(5).run(&calibration, 3000, ahead);
  for (const auto parameter : {kTurnScale, kLaserX, kLaserY}) {
    EXPECT_FALSE(calibration.is_observed(parameter)) << kCalibrationNames[parameter];
    EXPECT_NEAR(calibration.sigma(parameter), 0.1, 1e-6);
  }
  EXPECT_NEAR(calibration.parameters()[kTurnScale], 1.0, 1e-9);
  EXPECT_NEAR((calibration.parameters().segment<2>(kLaserX) - kNominal.p).norm(), 0.0, 1e-9);
  for (const auto parameter : {kDistanceScale, kYawDrift, kLaserYaw}) {
    EXPECT_TRUE(calibration.is_observed(parameter)) << kCalibrationNames[parameter];
  }
  EXPECT_NEAR(calibration.parameters()[kDistanceScale], kDistance, 0.01);
  EXPECT_NEAR(calibration.parameters()[kYawDrift], kDrift, 0.003);
  EXPECT_NEAR(calibration.parameters()[kLaserYaw], kTrue.angle, 0.005);
}

TEST(OdometryCalibration, OneCircleDoesNotDistinguishScalesFromPlaces) {
  OdometryCalibration calibration(kNominal);
  Drive(6).run(&calibration, 4000, circle);
  for (const auto parameter : {kDistanceScale, kTurnScale, kYawDrift, kLaserX, kLaserY}) {
    EXPECT_FALSE(calibration.is_observed(parameter)) << kCalibrationNames[parameter];
  }
  Drive(7).run(&calibration, 2000, about_the_house);
  expect_truth(calibration, 0.015, 0.015);
}

TEST(OdometryCalibration, OnTheSpotSaysNothingOfDistances) {
  OdometryCalibration calibration(kNominal);
  Drive(8).run(&calibration, 2000, on_the_spot);
  EXPECT_TRUE(calibration.is_observed(kTurnScale));
  EXPECT_NEAR(calibration.parameters()[kTurnScale], kTurn, 0.005);
  EXPECT_FALSE(calibration.is_observed(kDistanceScale));
  EXPECT_FALSE(calibration.is_observed(kYawDrift));
  EXPECT_NEAR(calibration.parameters()[kDistanceScale], 1.0, 1e-9);
}

TEST(OdometryCalibration, CalibratedMotionIsThatOfTheNominalBase) {
  OdometryCalibration calibration(kNominal);
  Drive(9).run(&calibration, 3000, about_the_house);
  const SE2 reported = SE2::exp({0.3, 0.0, 0.4});
  CalibratedMotion motion(truth());
  motion.add(reported);
  const SE2 expected = kNominal * motion.of_laser() * kNominal.inverse();
  const SE2 off = expected.inverse() * calibration.calibrated(reported);
  EXPECT_LT(off.p.norm(), 0.005);
  EXPECT_LT(std::abs(off.angle), 0.004);
  const SE2 raw = expected.inverse() * reported;
  EXPECT_GT(raw.p.norm(), 0.015) << "what it corrects";
}

TEST(OdometryCalibration, AnInterruptionIsNotAMotion) {
  OdometryCalibration calibration(kNominal);
  Drive drive(10);
  for (int part = 0; part < 60; ++part) {
    drive.run(&calibration, 50, about_the_house);
    calibration.interrupt();
    calibration.add(SE2::exp({0.2, 0.0, 0.0}), SE2::exp({0.0, 0.2, 0.1}), kScanCovariance);
    calibration.interrupt();
  }
  EXPECT_LE(calibration.outliers(), 3);
  EXPECT_NEAR(calibration.parameters()[kDistanceScale], kDistance, 0.015);
}

/// Wheels of unequal radii on another axle than odometry believes (Censi et al. 2013, table I).
TEST(OdometryCalibration, FindsTheWheelsOfADifferentialDrive) {
  constexpr double kNominalBase = 0.4;
  constexpr double kBase = 0.43;
  constexpr double kLeft = 0.97;
  constexpr double kRight = 1.02;
  OdometryCalibrationOptions options;
  options.wheel_base = kNominalBase;
  options.sigma[kYawDrift] = 0.3;
  OdometryCalibration calibration(kNominal, options);
  for (int k = 0; k < 4000; ++k) {
    const SE2::Tangent reported = about_the_house(k);
    const double left = kLeft * (reported[0] - 0.5 * kNominalBase * reported[2]);
    const double right = kRight * (reported[0] + 0.5 * kNominalBase * reported[2]);
    const SE2 moved = SE2::exp({0.5 * (left + right), 0.0, (right - left) / kBase});
    calibration.add(SE2::exp(reported), kTrue.inverse() * moved * kTrue, kScanCovariance);
  }
  ASSERT_TRUE(calibration.drive());
  EXPECT_NEAR(calibration.drive()->left_scale, kLeft, 0.002);
  EXPECT_NEAR(calibration.drive()->right_scale, kRight, 0.002);
  EXPECT_NEAR(calibration.drive()->wheel_base, kBase, 0.002);
  EXPECT_FALSE(OdometryCalibration(kNominal).drive());
}

}  // namespace
}  // namespace trident::slam
