// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/motion_curve.h"
#include "planning/curves/curve_checker.h"
#include "planning/curves/path_shortcuts.h"
#include "planning/reference_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/curves/curve_checker.h"
#include "planning/curves/path_shortcuts.h"
#include "planning/reference_search.h"
#include "trident_base/random_stream.h"
#ifdef TRIDENT_TEST_OMPL
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#endif

namespace trident::nav {
namespace {

Pose2 end_of(const MotionCurve& curve, const Pose2& from) {
  Pose2 pose = from;
  for (int i = 0; i < curve.size(); ++i) {
    pose = pose_along(pose, curve[i], curve.radius(), curve.radius() * std::abs(curve[i].length));
  }
  return pose;
}

class PosePairs {
 public:
  explicit PosePairs(double extent_m) : stream_(11, "curves"), extent_m_(extent_m) {}
  Pose2 next() {
    return {between(-extent_m_, extent_m_), between(-extent_m_, extent_m_), between(-4.0, 4.0)};
  }

 private:
  double between(double low, double high) {
    return low + (high - low) * stream_.uniform(next_++, 0);
  }
  RandomStream stream_;
  double extent_m_;
  std::uint64_t next_ = 0;
};

void expect_ends_at(const MotionCurve& curve, const Pose2& from, const Pose2& to) {
  const Pose2 end = end_of(curve, from);
  ASSERT_NEAR(end.x, to.x, 1e-7);
  ASSERT_NEAR(end.y, to.y, 1e-7);
  ASSERT_NEAR(wrap_angle(end.yaw - to.yaw), 0.0, 1e-7);
}

TEST(MotionCurve, EndsAtTheGoal) {
  for (const double extent_m : {0.05, 0.5, 1.0, 3.0, 30.0}) {
    PosePairs poses(extent_m);
    for (int i = 0; i < 5000; ++i) {
      const Pose2 from = poses.next();
      const Pose2 to = poses.next();
      expect_ends_at(dubins_curve(from, to, 0.4), from, to);
      expect_ends_at(reeds_shepp_curve(from, to, 0.4), from, to);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(MotionCurve, ReedsSheppIsSymmetricAndNeverLongerThanDubins) {
  PosePairs poses(1.5);
  for (int i = 0; i < 5000; ++i) {
    const Pose2 from = poses.next();
    const Pose2 to = poses.next();
    const double length = reeds_shepp_curve(from, to, 0.5).length();
    const double dubins = dubins_curve(from, to, 0.5).length();
    const double line = distance(from.x, from.y, to.x, to.y);
    ASSERT_LE(length, dubins + 1e-9);
    ASSERT_GE(length, line - 1e-9);
    ASSERT_LE(dubins, line + max_excess(MotionModel::kDubins) * 0.5);
    ASSERT_LE(length, line + max_excess(MotionModel::kReedsShepp) * 0.5);
    ASSERT_NEAR(length, reeds_shepp_curve(to, from, 0.5).length(), 1e-7);
  }
}

// Of curves through a third pose none is shorter: that holds for the shortest only.
TEST(MotionCurve, NoDetourIsShorter) {
  PosePairs poses(1.2);
  for (int i = 0; i < 20000; ++i) {
    const Pose2 a = poses.next();
    const Pose2 b = poses.next();
    const Pose2 c = poses.next();
    for (const MotionModel model : {MotionModel::kDubins, MotionModel::kReedsShepp}) {
      const double direct = motion_curve(model, a, c, 0.5).length();
      const double detour =
          motion_curve(model, a, b, 0.5).length() + motion_curve(model, b, c, 0.5).length();
      ASSERT_LE(direct, detour + 1e-7);
    }
  }
}

TEST(MotionCurve, KnownLengths) {
  const Pose2 origin;
  EXPECT_NEAR(dubins_curve(origin, {3.0, 0.0, 0.0}, 1.0).length(), 3.0, 1e-9);
  EXPECT_NEAR(dubins_curve(origin, {0.0, 2.0, kPi}, 1.0).length(), kPi, 1e-9);
  EXPECT_NEAR(dubins_curve(origin, origin, 1.0).length(), 0.0, 1e-9);
  EXPECT_EQ(dubins_curve(origin, origin, 1.0).size(), 0);
  EXPECT_NEAR(reeds_shepp_curve(origin, {-3.0, 0.0, 0.0}, 1.0).length(), 3.0, 1e-9);
  EXPECT_NEAR(reeds_shepp_curve(origin, {0.0, 0.0, kPi}, 1.0).length(), kPi, 1e-9);
}

#ifdef TRIDENT_TEST_OMPL
template <class Space>
double ompl_length(const Space& space, const Pose2& from, const Pose2& to) {
  const auto& base = static_cast<const ompl::base::StateSpace&>(space);
  auto* a = base.allocState()->template as<typename Space::StateType>();
  auto* b = base.allocState()->template as<typename Space::StateType>();
  a->setXY(from.x, from.y);
  a->setYaw(wrap_angle(from.yaw));
  b->setXY(to.x, to.y);
  b->setYaw(wrap_angle(to.yaw));
  const double length = base.distance(a, b);
  base.freeState(a);
  base.freeState(b);
  return length;
}

TEST(MotionCurve, LengthsEqualThoseOfOmpl) {
  const ompl::base::DubinsStateSpace dubins(0.7);
  const ompl::base::ReedsSheppStateSpace reeds_shepp(0.7);
  for (const double extent_m : {0.3, 1.0, 3.0, 10.0}) {
    PosePairs poses(extent_m);
    for (int i = 0; i < 5000; ++i) {
      const Pose2 from = poses.next();
      const Pose2 to = poses.next();
      ASSERT_NEAR(dubins_curve(from, to, 0.7).length(), ompl_length(dubins, from, to), 1e-5);
      ASSERT_NEAR(reeds_shepp_curve(from, to, 0.7).length(), ompl_length(reeds_shepp, from, to),
                  1e-5);
    }
  }
}
#endif

TEST(PathShortcuts, APathThatEndsWhereItBeginsStays) {
  testing::TestGrid cells(20, 20);
  cells.measure_distances(5.0F);
  const CostGrid grid = cells.view();
  Footprint footprint;
  footprint.inscribed_radius = footprint.circumscribed_radius = 0.5;
  const FootprintContact contact(grid, footprint, FootprintContact::Unknown::kFree);
  const CurveChecker checker(grid, contact, TravelCosts{});
  TravelPath path;
  path.points.push_back({{4.5, 5.5, 1.0}});
  const TravelPath smooth = with_shortcuts(path, checker, ShortcutOptions{}, testing::kRunning);
  ASSERT_EQ(smooth.points.size(), 1U);
  EXPECT_EQ(smooth.points[0].pose.x, 4.5);
}

}  // namespace
}  // namespace trident::nav
