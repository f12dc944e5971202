// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/motion.h"

#include <gtest/gtest.h>

#include "trident_base/random_stream.h"
#include "trident_bridges/autopilot/setpoint_stream.h"

namespace trident::bridges {
namespace {

const MotionLimits kLimits{5.0, 2.5, 1.5, 2.0};

SimTime at(double seconds) { return SimTime::from_seconds(seconds); }

TEST(Motion, EndsAtItsGoalAtRest) {
  Motion motion;
  motion.stop_at({1, 2, 3}, at(10));
  motion.go_to({31, -8, 6}, kLimits, at(10));
  EXPECT_FALSE(motion.is_at_rest(at(12)));
  const Reference end = motion.at(at(60));
  EXPECT_TRUE(motion.is_at_rest(at(60)));
  EXPECT_LT((end.p_m - Eigen::Vector3d(31, -8, 6)).norm(), 1e-9);
  EXPECT_LT(end.v_m_s.norm(), 1e-9);
}

TEST(Motion, KeepsToItsLimitsFromRest) {
  for (const Eigen::Vector3d goal : {Eigen::Vector3d(100, 0, 0), Eigen::Vector3d(0, 0, 20),
                                     Eigen::Vector3d(3, 4, -12), Eigen::Vector3d(0.2, 0, 0)}) {
    Motion motion;
    motion.stop_at({0, 0, 30}, at(0));
    motion.go_to(goal + Eigen::Vector3d(0, 0, 30), kLimits, at(0));
    for (double t = 0.0; t < 60.0; t += 0.01) {
      const Reference r = motion.at(at(t));
      EXPECT_LE(r.v_m_s.head<2>().norm(), kLimits.horizontal_m_s + 1e-9);
      EXPECT_LE(r.v_m_s.z(), kLimits.up_m_s + 1e-9);
      EXPECT_GE(r.v_m_s.z(), -kLimits.down_m_s - 1e-9);
      EXPECT_LE(r.a_m_s2.norm(), kLimits.a_m_s2 + 1e-9);
    }
  }
}

/// Whatever comes when: place and velocity do not jump, and are the integrals of each other.
TEST(Motion, IsContinuousUnderAnyOrderOfCommands) {
  RandomStream random(7, "motion");
  Motion motion;
  motion.stop_at({0, 0, 5}, at(0));
  Reference last = motion.at(at(0));
  for (int k = 1; k < 20000; ++k) {
    const SimTime now = at(k * 0.002);
    if (k % 400 == 0) {
      const Eigen::Vector3d p(10 * random.normal(k, 0), 10 * random.normal(k, 1),
                              random.normal(k, 2));
      const int which = k / 400 % 3;
      if (which == 0) motion.go_to(p, kLimits, now);
      if (which == 1) motion.set_velocity(0.3 * p, kLimits, now);
      if (which == 2) motion.brake(kLimits, now);
    }
    const Reference r = motion.at(now);
    EXPECT_LT((r.p_m - last.p_m - 0.001 * (r.v_m_s + last.v_m_s)).norm(), 1e-4);
    EXPECT_LT((r.v_m_s - last.v_m_s).norm(), 0.002 * 2.0 * kLimits.a_m_s2 + 1e-6);
    last = r;
  }
}

TEST(Motion, AVelocityThatComesAgainAndAgainIsReachedAsSoonAsOneThatComesOnce) {
  const MotionLimits limits;
  Motion once, often;
  once.set_velocity({2.0, 0.0, 0.0}, limits, {});
  const SimTime end = SimTime::from_seconds(1.0);
  for (SimTime now; now <= end; now = now + SimTime{20'000'000}) {
    often.set_velocity({2.0, 0.0, 0.0}, limits, now);
  }
  EXPECT_NEAR(often.at(end).v_m_s.x(), 2.0, 1e-9);
  EXPECT_NEAR(once.at(end).p_m.x(), often.at(end).p_m.x(), 1e-6);
}

TEST(Motion, BrakesWithinItsAcceleration) {
  Motion motion;
  motion.stop_at({0, 0, 0}, at(0));
  motion.set_velocity({4, 0, 0}, kLimits, at(0));
  ASSERT_TRUE(motion.is_settled(at(5)));
  motion.brake(kLimits, at(5));
  EXPECT_TRUE(motion.is_at_rest(at(5 + 4 / 2.0 + 0.01)));
  EXPECT_NEAR((motion.goal(at(5)) - motion.at(at(5)).p_m).x(), 0.5 * 4 * (4 / 2.0), 1e-9);
}

TEST(SetpointStream, FindsVelocityAndAccelerationOfACircle) {
  SetpointStream stream;
  RandomStream random(3, "jitter");
  double worst_v = 0.0;
  double worst_a = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double t = 0.05 * k;
    const double w = 2.0 / 3.0;
    stream.push(at(t + 0.001 * random.normal(k, 0)), {3 * std::cos(w * t), 3 * std::sin(w * t), 5},
                2.5);
    if (k < 40) continue;
    const Eigen::Vector3d v(-2 * std::sin(w * t), 2 * std::cos(w * t), 0);
    const Eigen::Vector3d a = -w * w * Eigen::Vector3d(3 * std::cos(w * t), 3 * std::sin(w * t), 0);
    worst_v = std::max(worst_v, (stream.newest().v_m_s - v).norm());
    worst_a = std::max(worst_a, (stream.newest().a_m_s2 - a).norm());
  }
  EXPECT_LT(worst_v, 0.15);
  EXPECT_LT(worst_a, 1.0);
}

TEST(SetpointStream, BeginsAgainAfterAGapOrAJump) {
  SetpointStream stream;
  for (int k = 0; k < 10; ++k) stream.push(at(0.1 * k), {0.1 * k, 0, 5}, 2.5);
  EXPECT_TRUE(stream.is_steady());
  stream.push(at(1.0), {50, 0, 5}, 2.5);
  EXPECT_FALSE(stream.is_steady());
  EXPECT_EQ(stream.newest().v_m_s.norm(), 0.0);
}

}  // namespace
}  // namespace trident::bridges
