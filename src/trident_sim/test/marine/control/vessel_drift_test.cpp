// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "controlled_boat.h"
#include "trident_control/drift_observer.h"

namespace trident::sim {
namespace {

using Path = std::vector<Eigen::Vector2d>;

control::VesselControlParams control_of(const std::string& vessel) {
  return shipped_control(vessel.rfind("wamv", 0) == 0 ? "wamv" : vessel);
}

double distance_to_leg(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                       const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - share * along).norm();
}

/// Root mean square of the distance to the nearest leg, until the last waypoint's circle.
double tracking_rms(ControlledBoat& boat, const Path& path) {
  boat.command(follow(path));
  double sum = 0.0;
  int count = 0;
  while (boat.controller().mode() != control::VesselMode::kStation && boat.time_s() < 300.0) {
    boat.step();
    const Eigen::Vector2d p(boat.x(), boat.y());
    double nearest = 1e9;
    for (std::size_t i = 1; i < path.size(); ++i) {
      nearest = std::min(nearest, distance_to_leg(p, path[i - 1], path[i]));
    }
    sum += nearest * nearest;
    ++count;
  }
  EXPECT_LT(boat.time_s(), 300.0);
  return std::sqrt(sum / count);
}

/// The mission of the cross-domain launch: short legs, so that an integral alone comes too late.
Path short_legs() { return {{0, 0}, {25, 0}, {45, 8}, {65, 8}}; }

class EveryDriftingBoat : public testing::TestWithParam<const char*> {};

TEST_P(EveryDriftingBoat, HoldsShortLegsInACurrentAcrossThem) {
  for (const double direction : {0.5 * kPi, -0.5 * kPi}) {
    ControlledBoat boat(GetParam(), control_of(GetParam()), uniform_current(0.15, direction));
    EXPECT_LT(tracking_rms(boat, short_legs()), 0.5) << "towards " << direction;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryDriftingBoat,
                         testing::Values("otter", "wamv", "wamv_t", "wamv_x", "heron",
                                         "small_catamaran"));

/// What the observer makes of a boat that is steered to one heading after another.
Eigen::Vector2d observed(const EnvironmentParams& sea, const std::vector<double>& headings) {
  ControlledBoat boat("wamv", shipped_control("wamv"), sea);
  control::DriftObserver observer(shipped_model("wamv"), 5.0);
  for (const double heading : headings) {
    boat.command(towards(control::VesselCommand::Kind::kHeading, heading));
    for (int i = 0; i < 3000; ++i) {
      boat.step();
      const Vector6d nu = boat.boat().nu();
      observer.update({{}, boat.heading(), nu[0], nu[1], nu[5]}, 0.0, 0.01);
    }
  }
  return observer.drift();
}

TEST(DriftObserver, LearnsWhatIsAcrossTheBowAndKeepsItOnAnotherHeading) {
  const Eigen::Vector2d straight = observed(uniform_current(0.5, 0.6), {0.0});
  EXPECT_NEAR(straight.x(), 0.0, 0.02) << "along the bow it is not observable";
  EXPECT_NEAR(straight.y(), 0.5 * std::sin(0.6), 0.02);
  const Eigen::Vector2d turned = observed(uniform_current(0.5, 0.6), {0.0, 0.5 * kPi});
  EXPECT_NEAR(turned.x(), 0.5 * std::cos(0.6), 0.05);
  EXPECT_NEAR(turned.y(), 0.5 * std::sin(0.6), 0.05);
}

/// A WAM-V slides half a metre per second to the outside of such turns.
TEST(DriftObserver, TakesNoSlideInATurnForADrift) {
  EXPECT_LT(observed(uniform_current(0.0, 0.0), {1.5, -1.5, 0.0}).norm(), 0.03);
}

}  // namespace
}  // namespace trident::sim
