// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/ekf_slam.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident::slam {
namespace {

constexpr double kObservationSigma = 0.05;
const Eigen::Matrix3d kMotionCovariance = Eigen::Vector3d(1e-4, 1e-5, 1e-5).asDiagonal();

/// A robot that drives laps of a circle of 10 m among posts on two rings, with odometry that turns
/// too far.
struct Drive {
  explicit Drive(std::uint64_t seed, double yaw_scale = 1.0)
      : stream(seed, "drive"), yaw_scale(yaw_scale) {
    for (int i = 0; i < 24; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / 24.0;
      const double radius = i % 2 == 0 ? 14.0 : 5.5;
      posts.emplace_back(radius * std::cos(angle), 10.0 + radius * std::sin(angle));
    }
  }

  void step(EkfSlam& slam) {
    const SE2 motion = SE2::exp({0.5, 0.0, 0.05});
    T_map_base = T_map_base * motion;
    const double s = 1e-2;
    const SE2 reported = SE2::from_xy_yaw(motion.p.x() + s * stream.normal(k, 0),
                                          motion.p.y() + 0.3 * s * stream.normal(k, 1),
                                          motion.angle / yaw_scale + 0.3 * s * stream.normal(k, 2));
    slam.predict(reported, kMotionCovariance);
    std::vector<PointObservation> seen;
    true_ids.clear();
    for (std::size_t i = 0; i < posts.size(); ++i) {
      const Eigen::Vector2d p = T_map_base.inverse() * posts[i];
      if (p.norm() > 8.0 || p.x() < 0.0) continue;
      PointObservation observation;
      const auto channel = static_cast<std::uint32_t>(10 + 2 * i);
      observation.p_base = p + kObservationSigma * Eigen::Vector2d(stream.normal(k, channel),
                                                                   stream.normal(k, channel + 1));
      observation.covariance = kObservationSigma * kObservationSigma * Eigen::Matrix2d::Identity();
      seen.push_back(observation);
      true_ids.push_back(static_cast<int>(i));
    }
    found_ids = slam.observe(seen);
    ++k;
  }

  double nees(const EkfSlam& slam) const {
    const SE2 error = T_map_base.inverse() * slam.T_map_base();
    const Eigen::Matrix2d R = T_map_base.rotation();
    Eigen::Vector3d e;
    e << R * error.p, error.angle;
    return e.dot(slam.pose_covariance().llt().solve(e));
  }

  RandomStream stream;
  double yaw_scale;
  std::vector<Eigen::Vector2d> posts;
  SE2 T_map_base;
  std::uint64_t k = 0;
  std::vector<int> true_ids;
  std::vector<int> found_ids;
};

EkfSlamParams params() {
  EkfSlamParams result;
  result.new_distance = 1.0;
  result.yaw_scale_walk = 0.0;
  result.curvature_walk = 0.0;
  return result;
}

TEST(EkfSlam, FindsEveryPostOnceAndStaysConsistent) {
  double sum_nees = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(seed);
    EkfSlam slam(params());
    for (int i = 0; i < 400; ++i) drive.step(slam);
    EXPECT_EQ(slam.landmark_count(), drive.posts.size()) << "seed " << seed;
    EXPECT_LT((slam.T_map_base().p - drive.T_map_base.p).norm(), 0.5) << "seed " << seed;
    sum_nees += drive.nees(slam);
    ++count;
  }
  EXPECT_LT(sum_nees / count, 3.0 * 3.0);  // 3 expected; a filter too sure of itself has tens
}

TEST(EkfSlam, LearnsThatOdometryMisjudgesTurns) {
  Drive drive(3, 1.08);
  EkfSlam slam(params());
  for (int i = 0; i < 400; ++i) drive.step(slam);
  EXPECT_EQ(slam.landmark_count(), drive.posts.size());
  EXPECT_LT((slam.T_map_base().p - drive.T_map_base.p).norm(), 0.5);
}

TEST(EkfSlam, OneLandmarkKeepsOneId) {
  Drive drive(5);
  EkfSlam slam(params());
  std::vector<int> id_of(drive.posts.size(), EkfSlam::kAmbiguous);
  for (int i = 0; i < 300; ++i) {
    drive.step(slam);
    for (std::size_t j = 0; j < drive.true_ids.size(); ++j) {
      if (drive.found_ids[j] == EkfSlam::kAmbiguous) continue;
      int& id = id_of[static_cast<std::size_t>(drive.true_ids[j])];
      if (id == EkfSlam::kAmbiguous) id = drive.found_ids[j];
      EXPECT_EQ(drive.found_ids[j], id);
    }
  }
}

TEST(EkfSlam, TheSameInputGivesTheSameBits) {
  EkfSlam a(params());
  EkfSlam b(params());
  Drive drive_a(7);
  Drive drive_b(7);
  for (int i = 0; i < 100; ++i) {
    drive_a.step(a);
    drive_b.step(b);
  }
  EXPECT_EQ(a.T_map_base().p, b.T_map_base().p);
  EXPECT_EQ(a.pose_covariance(), b.pose_covariance());
}

TEST(EkfSlam, AGhostThatIsNeverSeenAgainIsForgotten) {
  EkfSlamParams few = params();
  few.forget_misses = 4;
  EkfSlam slam(few);
  PointObservation ghost;
  ghost.p_base = {3.0, 0.0};
  PointObservation post;
  post.p_base = {5.0, 3.0};
  slam.observe({ghost, post});
  EXPECT_EQ(slam.landmark_count(), 2U);
  for (int i = 0; i < 5; ++i) slam.observe({post});
  EXPECT_EQ(slam.landmark_count(), 1U);
  EXPECT_NEAR((slam.landmarks()[0].p_map - post.p_base).norm(), 0.0, 1e-9);
}

TEST(EkfSlam, BadInputDoesNotHarmTheMap) {
  EkfSlam slam;
  PointObservation good;
  good.p_base = {4.0, 1.0};
  PointObservation no_number = good;
  no_number.p_base.x() = std::numeric_limits<double>::quiet_NaN();
  PointObservation no_covariance = good;
  no_covariance.covariance << 1.0, 2.0, 2.0, 1.0;
  const std::vector<int> ids = slam.observe({no_number, no_covariance, good});
  EXPECT_EQ(ids, (std::vector<int>{EkfSlam::kAmbiguous, EkfSlam::kAmbiguous, 0}));
  EXPECT_EQ(slam.landmark_count(), 1U);
  SE2 nowhere;
  nowhere.angle = std::numeric_limits<double>::infinity();
  EXPECT_THROW(slam.predict(nowhere, kMotionCovariance), Error);
  EXPECT_TRUE(slam.T_map_base().p.allFinite());
  EXPECT_THROW(slam.observe_known({good}, {}), Error);
}

TEST(EkfSlam, ParametersOutOfRangeAreRefused) {
  EkfSlamParams wrong;
  wrong.new_probability = 0.5;  // below match_probability
  EXPECT_THROW(EkfSlam{wrong}, Error);
  wrong.match_probability = 1.0;
  EXPECT_THROW(EkfSlam{wrong}, Error);
}

}  // namespace
}  // namespace trident::slam
