// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "control/mppi/lanes.h"
#include "control/mppi/mppi_model.h"
#include "control/mppi/rollout.h"
#include "control/scene.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav::testing {
namespace {

Drive corner_drive(int threads) {
  ControlSetup setup = jackal();
  setup.threads = threads;
  const auto controller = make_controller("mppi", setup, parse_yaml("{batch_size: 500}", "test"));
  return drive(*controller, setup, corner_scene(setup.footprint));
}

TEST(Mppi, TwoThreadsGiveTheBitsOfOne) { EXPECT_TRUE(are_equal(corner_drive(1), corner_drive(2))); }

TEST(Mppi, ProcessorsWithoutAvx2GiveTheSameBits) {
  const Drive wide = corner_drive(1);
  force_plain_lanes(true);
  const Drive plain = corner_drive(1);
  force_plain_lanes(false);
  EXPECT_TRUE(are_equal(wide, plain));
}

TEST(Mppi, TheSeedIsWhatDiffersBetweenRuns) {
  ControlSetup setup = jackal();
  const Scene scene = corner_scene(setup.footprint);
  const ConfigNode params = parse_yaml("{batch_size: 300}", "test");
  const Drive first = drive(*make_controller("mppi", setup, params), setup, scene);
  EXPECT_TRUE(are_equal(first, drive(*make_controller("mppi", setup, params), setup, scene)));
  setup.seed = 2;
  EXPECT_FALSE(are_equal(first, drive(*make_controller("mppi", setup, params), setup, scene)));
}

ControlSetup oblong_robot() {
  ControlSetup setup;
  setup.limits = {0.5, -0.25, 0.0, 1.5, 1.0, 1.0, 0.0, 3.0, 0.0};
  setup.footprint =
      polygon_footprint({{-0.21, -0.155}, {0.21, -0.155}, {0.21, 0.155}, {-0.21, 0.155}});
  return setup;
}

TEST(Mppi, LeavesADeadEndBackwardsThatItHasNoRoomToTurnIn) {
  const ControlSetup setup = oblong_robot();
  Scene scene{"narrow dead end", GridWorld(4.0, 3.0, 0.02), {3.2, 1.5, 0.0}, {0.8, 1.2, 3.0}};
  scene.world.fill({2.0, 0.0, 4.0, 1.29});
  scene.world.fill({2.0, 1.71, 4.0, 3.0});
  scene.world.fill({3.6, 0.0, 4.0, 3.0});
  const Drive result = drive(*make_controller("mppi", setup), setup, scene, 25.0);
  EXPECT_TRUE(result.is_reached) << "at " << result.track.back().x << ": " << result.last_reason;
  EXPECT_FALSE(result.has_contact);
}

TEST(Mppi, PassesADoorThatIsWiderByCentimeters) {
  const ControlSetup setup = oblong_robot();
  Scene scene{"narrow door", GridWorld(5.0, 3.0, 0.01), {1.0, 0.8, 1.0}, {4.2, 0.8, 0.0}};
  scene.world.fill({2.4, 0.0, 2.55, 1.5 - 0.185});
  scene.world.fill({2.4, 1.5 + 0.185, 2.55, 3.0});
  const Drive result = drive(*make_controller("mppi", setup), setup, scene, 25.0);
  EXPECT_TRUE(result.is_reached) << "at " << result.track.back().x << ": " << result.last_reason;
  EXPECT_FALSE(result.has_contact);
}

TEST(MppiModel, TheFootprintsCoverContainsEachOfItsPoints) {
  for (const ControlSetup& setup : {jackal(), car(), omni_robot(), burger()}) {
    const auto cover = cover_footprint(setup.footprint);
    for (const Point2& p : setup.footprint.points) {
      const bool is_in = std::any_of(cover.begin(), cover.end(), [&](const CoverCircle& circle) {
        return std::hypot(p.x - static_cast<double>(circle.x),
                          p.y - static_cast<double>(circle.y)) <=
               static_cast<double>(circle.radius) + 1e-6;
      });
      EXPECT_TRUE(is_in) << p.x << " " << p.y;
    }
  }
}

MppiModel fast_model(double sideways_m_s2) {
  ControlSetup setup = jackal();
  setup.limits.vx_max = 2.0;
  setup.limits.wz_max = 4.0;
  setup.limits.ay_max = sideways_m_s2;
  return make_mppi_model(MppiParams{}, setup);
}

TEST(MppiRollout, FastTurnsAreAsWideAsTheSidewaysAccelerationAllows) {
  const MppiModel model = fast_model(1.5);
  Rollouts rollouts(model.steps);
  std::fill(rollouts.vx.begin(), rollouts.vx.end(), 2.0F);
  std::fill(rollouts.wz.begin(), rollouts.wz.end(), 4.0F);
  roll_out(model, {0.0, {2.0, 0.0, 0.0}}, &rollouts);
  for (std::size_t i = 0; i < rollouts.vx.size(); ++i) {
    EXPECT_LE(rollouts.vx[i] * rollouts.wz[i], 1.5F + 1e-4F);
  }
  EXPECT_NEAR(rollouts.at(rollouts.wz, model.steps - 1)[0], 0.75F, 1e-4F);
}

TEST(MppiRollout, WithoutThatLimitTurnsAreAsFastAsTheRobotTurns) {
  const MppiModel model = fast_model(0.0);
  Rollouts rollouts(model.steps);
  std::fill(rollouts.vx.begin(), rollouts.vx.end(), 2.0F);
  std::fill(rollouts.wz.begin(), rollouts.wz.end(), 4.0F);
  roll_out(model, {0.0, {2.0, 0.0, 0.0}}, &rollouts);
  EXPECT_NEAR(rollouts.at(rollouts.wz, model.steps - 1)[0], 4.0F, 1e-4F);
}

// Notes the state that it is asked with.
class NotingLaw final : public ControlLaw {
 public:
  explicit NotingLaw(Pose2* seen) : seen_(seen) {}
  double path_length_m() const override { return 1.0; }
  Proposal propose(const Situation& situation) override {
    *seen_ = situation.state.pose;
    return {{1.0, 0.0, 0.0}, Failure::kNone, ""};
  }
  void reset() override {}

 private:
  Pose2* seen_;
};

TEST(GuardedController, CommandsAreForWhereTheRobotIsWhenTheyAct) {
  ControlSetup setup = jackal();
  setup.command_delay_s = 0.1;
  Pose2 seen;
  GuardedController controller(setup, std::make_unique<NotingLaw>(&seen));
  const GridWorld world(10.0, 4.0);
  controller.command({{1.0, 2.0, 0.0}, {0.5, 0.0, 0.0}, 1.0}, {{1.0, 2.0, 0.0}, {9.0, 2.0, 0.0}},
                     world.grid(), {});
  EXPECT_NEAR(seen.x, 1.05, 1e-9);
  EXPECT_NEAR(seen.y, 2.0, 1e-9);
}

TEST(BrakingGuard, DoesNotBackIntoWhomTheRobotSawPassBehindIt) {
  const ControlSetup setup = jackal();
  const GridWorld world(6.0, 4.0);
  const FootprintChecker checker(setup.footprint);
  const BrakingGuard guard(setup.limits, checker, checker, setup.period_s);
  const RobotState state{{3.0, 2.0, 0.0}, {-0.2, 0.0, 0.0}, 0.0};
  Track walker{5, {1.9, 2.0}, {0.0, 0.0}, 0.25, {}, 0.0};
  for (std::size_t axis = 0; axis < 2; ++axis) walker.covariance[5 * axis] = 0.36;
  const auto contact = [&](double vx) {
    return guard.first_contact(state, {vx, 0.0, 0.0}, world.grid(), {walker}).has_value();
  };
  EXPECT_FALSE(contact(-0.3)) << "it is seen, and too far away to be touched";
  walker.unseen_s = 1.0;
  EXPECT_TRUE(contact(-0.3)) << "it may have come nearer";
  walker.position.x = 2.4;
  const RobotState turning{{3.0, 2.0, 0.0}, {0.0, 0.0, 0.5}, 0.0};
  EXPECT_TRUE(guard.first_contact(turning, {0.0, 0.0, 0.5}, world.grid(), {walker}).has_value());
  const RobotState leaving{{3.0, 2.0, 0.0}, {0.2, 0.0, 0.0}, 0.0};
  EXPECT_FALSE(guard.first_contact(leaving, {0.3, 0.0, 0.0}, world.grid(), {walker}).has_value());
}

TEST(Lanes, TheAngleIsThatOfTheLibrary) {
  for (int i = 0; i < 1000; ++i) {
    const double angle = -3.1415 + 0.00628 * i;
    const auto x = static_cast<float>(2.0 * std::cos(angle));
    const auto y = static_cast<float>(2.0 * std::sin(angle));
    EXPECT_NEAR(static_cast<double>(absolute_angle(y, x)), std::fabs(angle), 2e-4);
  }
}

}  // namespace
}  // namespace trident::nav::testing
