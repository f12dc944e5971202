// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Long paths, terminal speeds and drift by slip of carts, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cart.h"
#include "trident_base/angle.h"
#include "trident_base/vehicle/diff_drive_odometry.h"

namespace trident::sim {
namespace {

constexpr double kRadius = 0.1;

CartOptions plugin_with(ParamList params, double mu = 1.0) {
  CartOptions options;
  options.params = std::move(params);
  options.mu = mu;
  return options;
}

/// One side of a square and the corner after it, by what the odometry reports.
void drive_side(CartWorld& cart, double side_m, double yaw_rad) {
  const Eigen::Vector2d start = cart.reported_pose().p;
  for (double left = side_m; left > 1e-3; left = side_m - (cart.reported_pose().p - start).norm()) {
    cart.command(std::clamp(left, 0.02, 2.0), 0.0);
    cart.run(0.02);
  }
  cart.command(0.0, 0.0);
  cart.run(0.5);
  for (double error = 1.0; std::abs(error) > 1e-3;) {
    error = angle_difference(yaw_rad, cart.reported_pose().angle);
    cart.command(0.0, std::copysign(std::clamp(2.0 * std::abs(error), 0.02, 1.0), error));
    cart.run(0.02);
  }
  cart.command(0.0, 0.0);
  cart.run(0.5);
}

/// Four sides of 100 m: what the encoders report stays within a thousandth of the 400 m driven.
TEST(DiffDrive, ASquareWithSidesOfAHundredMetersClosesWithinATenthOfAPercent) {
  CartWorld cart(plugin_with({{"odometrySource", "encoder"}, {"wheelAcceleration", "1"}}), 0.002);
  double worst = 0.0;
  for (int side = 1; side <= 4; ++side) {
    drive_side(cart, 100.0, side * 0.5 * kPi);
    worst = std::max(worst, (cart.reported_pose().p - cart.truth().p).norm());
  }
  EXPECT_LT(cart.reported_pose().p.norm(), 0.4) << "as the encoders report";
  EXPECT_LT(worst, 0.4) << "against where it is, at any corner";
  RecordProperty("error_mm", static_cast<int>(1000.0 * worst));
}

/// Speed of a cart after `seconds` at full command.
double speed_after(const ModelSpec& spec, double seconds) {
  TestWorld world(world_spec(0.001));
  Surface rough;
  rough.mu = rough.mu2 = 100.0;
  world.add(make_ground(rough));
  Model& model = world.add(spec);
  world->step(200);
  world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {100, 0, 0}, {0, 0, 0}});
  world->step(static_cast<std::uint64_t>(std::llround(seconds / 0.001)));
  return model.bodies[0]->velocity().x();
}

/// Torque T of each of four wheels against damping b of each joint: r T / b at the end, and before
/// that 1 - exp(-t / tau) of it, tau = (m + 4 I / r^2) / (4 b / r^2).
TEST(SkidSteer, WheelTorqueAgainstDampingOfTheJointsIsATerminalSpeed) {
  const double torque = 0.2, damping = 0.01;
  CartOptions options = plugin_with({{"torque", "0.2"}, {"updateRate", "0"}});
  options.four_wheels = true;
  ModelSpec spec = make_cart(options);
  for (JointSpec& joint : spec.joints) joint.damping = damping;
  const double terminal = kRadius * torque / damping;
  const double moved = 5.0 + 4 * 0.5 + 4 * 0.5 * 0.5;  // plugin_with I / r^2 of discs of 0.5 kg
  const double tau = moved / (4.0 * damping / (kRadius * kRadius));
  EXPECT_NEAR(speed_after(spec, tau), terminal * (1.0 - std::exp(-1.0)), 0.01 * terminal);
  EXPECT_NEAR(speed_after(spec, 8.0 * tau), terminal, 0.005 * terminal);
}

/// Thrust 4 T / r of the wheels against a drag of `decay` times mass and speed of every body, and
/// of the wheels' turning: 4 T / r = decay (m + 4 I / r^2) v.
TEST(SkidSteer, WheelTorqueAgainstDragIsATerminalSpeed) {
  const double torque = 0.1, decay = 0.8;
  CartOptions options = plugin_with({{"torque", "0.1"}, {"updateRate", "0"}});
  options.four_wheels = true;
  ModelSpec spec = make_cart(options);
  for (LinkSpec& link : spec.links) link.linear_damping = link.angular_damping = decay;
  const double terminal = 4.0 * torque / kRadius / (decay * (5.0 + 4 * 0.5 + 4 * 0.5 * 0.5));
  EXPECT_NEAR(speed_after(spec, 10.0 / decay), terminal, 0.01 * terminal);
}

/// What a user makes of the ticks: the plugin's joint states and the odometry class.
struct TickOdometry {
  explicit TickOdometry(CartWorld& cart)
      : ticks(cart.world->ports().find_out<JointStateSample>("wheel_encoders")),
        odometry({0.4, kRadius, 0.0}) {
    ticks->add_listener();
  }
  void update() {
    const Eigen::Vector2d now(ticks->value.positions[0], ticks->value.positions[1]);
    odometry.update(now[0] - last[0], now[1] - last[1]);
    last = now;
  }
  OutPort<JointStateSample>* ticks;
  DiffDriveOdometry odometry;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
};

class Slalom : public testing::Test {
 protected:
  struct Result {
    double drift_m, distance_m, reported_m;
  };
  /// Jerks and turns for ten seconds, followed by ticks of the wheels.
  static Result drive(double mu) {
    CartOptions options = plugin_with({{"wheelAcceleration", "2"}}, mu);
    options.more_plugins = {make_plugin("ticks", "libtrident_wheel_encoder.so",
                                        {{"jointName", "left right"}, {"ticksPerTurn", "4096"}})};
    CartWorld cart(options);
    TickOdometry ticks(cart);
    Result result{0.0, 0.0, 0.0};
    for (int i = 0; i < 500; ++i) {
      const double t = 0.02 * i;
      cart.command(std::fmod(t, 2.0) < 1.0 ? 1.5 : 0.2, std::fmod(t, 3.0) < 1.5 ? 0.8 : -0.8);
      const Eigen::Vector2d before = cart.truth().p;
      cart.run(0.02);
      ticks.update();
      result.distance_m += (cart.truth().p - before).norm();
    }
    result.reported_m = ticks.odometry.distance_m();
    result.drift_m = (ticks.odometry.T_odom_base().p - cart.truth().p).norm();
    return result;
  }
};

TEST_F(Slalom, WithGripTheTicksFollowTheCart) {
  const Result result = drive(1.0);
  ASSERT_GT(result.distance_m, 7.0);
  EXPECT_LT(result.drift_m, 0.01 * result.distance_m);
}

TEST_F(Slalom, OnIceTheyDriftBySlip) {
  const Result result = drive(0.05);
  ASSERT_GT(result.distance_m, 2.0);
  EXPECT_GT(result.drift_m, 0.05 * result.distance_m);
  EXPECT_GT(result.reported_m, 1.05 * result.distance_m);
}

}  // namespace
}  // namespace trident::sim
