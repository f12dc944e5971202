// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/lee_position_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "reference_model.h"
#include "trident_base/error.h"

namespace trident::control {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> speeds_of(const LeeParams& params, const OdometryState& state,
                              const TrajectoryPoint& reference) {
  std::vector<double> speeds(params.vehicle.rotors.size(), -1.0);
  EXPECT_EQ(LeePositionController(params).compute(state, reference, speeds), ControlStatus::ok);
  return speeds;
}

void expect_same_speeds(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  // On squares: the square root magnifies rounding where a rotor is about to stop.
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i] * a[i], b[i] * b[i], 1e-6 * (1e4 + b[i] * b[i]));
}

LeeParams with_vehicle(const VehicleParams& vehicle) {
  LeeParams params;
  params.vehicle = vehicle;
  return params;
}

class LeeEquation : public testing::TestWithParam<int> {
 protected:
  static LeeParams params() {
    if (GetParam() == 6) return {};
    return with_vehicle(test::regular_multirotor(GetParam(), 0.3, 0.4));
  }

  static void expect_agreement(const LeeParams& params, std::uint64_t seed) {
    const LeePositionController controller(params);
    std::vector<double> speeds(params.vehicle.rotors.size());
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 500; ++trial) {
      const OdometryState state = test::random_state(random);
      const TrajectoryPoint reference = test::random_point(random);
      ASSERT_EQ(controller.compute(state, reference, speeds), ControlStatus::ok);
      expect_same_speeds(speeds, test::reference_lee_speeds(params, state, reference));
    }
  }
};

TEST_P(LeeEquation, agrees_with_a_scalar_derivation) { expect_agreement(params(), 1); }

TEST_P(LeeEquation, agrees_with_products_of_inertia) {
  LeeParams skewed = params();
  skewed.vehicle.inertia << 0.035, 0.004, -0.003, 0.004, 0.046, 0.002, -0.003, 0.002, 0.098;
  expect_agreement(skewed, 2);
}

TEST_P(LeeEquation, agrees_with_every_quirk_switched) {
  LeeParams corrected = params();
  corrected.quirks.rotate_yaw_rate_with_RdT_R = false;
  corrected.quirks.omit_gyroscopic_term = false;
  corrected.quirks.unlimited_rotor_speed = false;
  expect_agreement(corrected, 3);
}

INSTANTIATE_TEST_SUITE_P(RotorCounts, LeeEquation, testing::Values(4, 6, 8));

TEST(LeePositionController, hover_thrust_carries_the_weight_without_torque) {
  for (const int rotors : {4, 6, 8}) {
    const LeeParams params = with_vehicle(test::regular_multirotor(rotors, 0.215, M_PI / rotors));
    const std::vector<double> speeds = speeds_of(params, {}, {});
    for (const double speed : speeds) {
      EXPECT_NEAR(speed, std::sqrt(1.56779 * 9.81 / (rotors * 8.54858e-6)), 1e-9);
    }
    const std::array<double, 4> wrench = test::wrench_of(params.vehicle, speeds);
    EXPECT_NEAR(wrench[3], 1.56779 * 9.81, 1e-12);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(wrench[i], 0.0, 1e-12);
  }
}

TEST(LeePositionController, height_error_changes_thrust_by_the_position_gain) {
  OdometryState state;
  state.p_world_body.z() = -0.5;
  const LeeParams params;
  const std::array<double, 4> wrench =
      test::wrench_of(params.vehicle, speeds_of(params, state, {}));
  EXPECT_NEAR(wrench[3], 1.56779 * 9.81 + 6.0 * 0.5, 1e-9);
}

TEST(LeePositionController,
     wants_to_pitch_forward_for_a_point_ahead_and_roll_left_for_one_to_the_left) {
  const LeeParams params;
  TrajectoryPoint ahead;
  ahead.p_world.x() = 0.2;
  const auto forward = test::wrench_of(params.vehicle, speeds_of(params, {}, ahead));
  EXPECT_GT(forward[1], 1e-3);  // positive pitch torque takes b3 towards +x
  EXPECT_NEAR(forward[0], 0.0, 1e-9);
  TrajectoryPoint left;
  left.p_world.y() = 0.2;
  const auto roll = test::wrench_of(params.vehicle, speeds_of(params, {}, left));
  EXPECT_LT(roll[0], -1e-3);
  EXPECT_NEAR(roll[1], 0.0, 1e-9);
}

TEST(LeePositionController, answer_does_not_depend_on_where_the_world_lies_or_how_it_is_turned) {
  const LeeParams params;
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const OdometryState state = test::random_state(random);
    const TrajectoryPoint reference = test::random_point(random);
    const double turn = 0.1 * trial;
    const Eigen::Quaterniond R(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d shift(3.0, -1.0, 2.0);
    OdometryState moved = state;
    moved.p_world_body = R * state.p_world_body + shift;
    moved.R_world_body = R * state.R_world_body;
    TrajectoryPoint moved_reference = reference;
    moved_reference.p_world = R * reference.p_world + shift;
    moved_reference.v_world = R * reference.v_world;
    moved_reference.a_world = R * reference.a_world;
    moved_reference.yaw = reference.yaw + turn;
    expect_same_speeds(speeds_of(params, state, reference),
                       speeds_of(params, moved, moved_reference));
  }
}

TEST(LeePositionController, quirk_of_the_yaw_rate_shows_only_when_tilted_and_turning) {
  LeeParams corrected;
  corrected.quirks.rotate_yaw_rate_with_RdT_R = false;
  TrajectoryPoint turning;
  turning.yaw_rate = 1.0;
  EXPECT_EQ(speeds_of({}, {}, turning), speeds_of(corrected, {}, turning));
  OdometryState tilted;
  tilted.R_world_body = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  EXPECT_NE(speeds_of({}, tilted, turning), speeds_of(corrected, tilted, turning));
}

TEST(LeePositionController, quirk_of_the_gyroscopic_term_adds_w_cross_Jw) {
  LeeParams corrected;
  corrected.quirks.omit_gyroscopic_term = false;
  OdometryState spinning;
  spinning.w_body = Eigen::Vector3d(0.5, -0.4, 0.6);
  const auto with = test::wrench_of(corrected.vehicle, speeds_of(corrected, spinning, {}));
  const auto without = test::wrench_of(corrected.vehicle, speeds_of({}, spinning, {}));
  const Eigen::Vector3d expected =
      spinning.w_body.cross(Eigen::Vector3d(corrected.vehicle.inertia * spinning.w_body));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(with[i] - without[i], expected[i], 1e-12);
}

TEST(LeePositionController, has_no_upper_clamp_unless_asked_for) {
  TrajectoryPoint high;
  high.p_world.z() = 50.0;
  EXPECT_GT(speeds_of({}, {}, high).front(), 1500.0);
  LeeParams clamped;
  clamped.quirks.unlimited_rotor_speed = false;
  EXPECT_EQ(speeds_of(clamped, {}, high).front(), 838.0);
}

TEST(LeePositionController, never_asks_a_rotor_to_turn_backwards) {
  TrajectoryPoint low;
  low.p_world.z() = -50.0;
  for (const double speed : speeds_of({}, {}, low)) EXPECT_EQ(speed, 0.0);
}

TEST(LeePositionController, zero_thrust_vector_keeps_the_attitude) {
  TrajectoryPoint falling;
  falling.a_world.z() = -9.81;
  for (const double speed : speeds_of({}, {}, falling)) EXPECT_NEAR(speed, 0.0, 1e-3);
  OdometryState tilted;
  tilted.R_world_body = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 1, 0).normalized());
  for (const double speed : speeds_of({}, tilted, falling)) EXPECT_TRUE(std::isfinite(speed));
}

TEST(LeePositionController, thrust_along_the_heading_still_has_an_attitude) {
  for (const Eigen::Quaterniond& R :
       {Eigen::Quaterniond::Identity(),
        Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()))}) {
    OdometryState state;
    state.R_world_body = R;
    TrajectoryPoint sideways;
    sideways.a_world = Eigen::Vector3d(5.0, 0.0, -9.81);
    for (const double speed : speeds_of({}, state, sideways)) EXPECT_TRUE(std::isfinite(speed));
  }
}

TEST(LeePositionController, an_idle_reference_stops_the_rotors_whatever_the_state) {
  OdometryState state;
  state.p_world_body = {1, 2, 30};
  state.w_body = {1, -1, 2};
  TrajectoryPoint reference;
  reference.level = ControlLevel::idle;
  for (const double speed : speeds_of({}, state, reference)) EXPECT_EQ(speed, 0.0);
}

TEST(LeePositionController, a_reference_of_attitude_does_not_look_at_the_position) {
  TrajectoryPoint reference;
  reference.level = ControlLevel::attitude;
  reference.R_world_body =
      Eigen::Quaternion<double, Eigen::DontAlign>(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()));
  reference.thrust = 15.0;
  OdometryState here;
  OdometryState there;
  there.p_world_body = {100, -50, 7};
  there.v_body = {3, 2, 1};
  EXPECT_EQ(speeds_of({}, here, reference), speeds_of({}, there, reference));
}

/// Of a level one that shall hover: the answer of the position loop at its goal.
TEST(LeePositionController, a_level_attitude_with_the_weight_as_thrust_is_hovering) {
  const LeeParams params;
  TrajectoryPoint attitude;
  attitude.level = ControlLevel::attitude;
  attitude.thrust = params.vehicle.mass * params.vehicle.gravity;
  expect_same_speeds(speeds_of(params, {}, attitude), speeds_of(params, {}, TrajectoryPoint()));
}

TEST(LeePositionController, a_reference_of_rates_turns_towards_them_alone) {
  const LeeParams params;
  const auto squares = [&](const Eigen::Vector3d& w, const Eigen::Vector3d& wanted) {
    OdometryState state;
    state.R_world_body = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 1, 0).normalized());
    state.w_body = w;
    TrajectoryPoint reference;
    reference.level = ControlLevel::rates;
    reference.w_body = wanted;
    reference.thrust = 16.0;
    return speeds_of(params, state, reference);
  };
  // At the wanted rates nothing turns it further, and only the difference counts.
  const auto at_rest = squares({0, 0, 0}, {0, 0, 0});
  expect_same_speeds(squares({0.5, -0.2, 0.1}, {0.5, -0.2, 0.1}), at_rest);
  expect_same_speeds(squares({0.3, 0, 0}, {0.5, 0, 0}), squares({0, 0, 0}, {0.2, 0, 0}));
  EXPECT_NE(squares({0, 0, 0}, {0.2, 0, 0}), at_rest);
}

TEST(LeePositionController, refuses_an_attitude_that_is_no_rotation) {
  TrajectoryPoint reference;
  reference.level = ControlLevel::attitude;
  reference.R_world_body.coeffs().setZero();
  std::vector<double> speeds(6, -1.0);
  EXPECT_EQ(LeePositionController(LeeParams()).compute({}, reference, speeds),
            ControlStatus::invalid_reference);
}

TEST(LeePositionController, refuses_non_finite_numbers_and_leaves_the_output_alone) {
  const LeePositionController controller{LeeParams{}};
  const auto status_of = [&](const OdometryState& state, const TrajectoryPoint& reference) {
    std::vector<double> speeds(6, 7.0);
    const ControlStatus status = controller.compute(state, reference, speeds);
    for (const double speed : speeds) EXPECT_EQ(speed, 7.0);
    return status;
  };
  for (const double bad : {kNan, HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 3; ++i) {
      for (Eigen::Vector3d OdometryState::*field :
           {&OdometryState::p_world_body, &OdometryState::v_body, &OdometryState::w_body}) {
        OdometryState state;
        (state.*field)[i] = bad;
        EXPECT_EQ(status_of(state, {}), ControlStatus::invalid_state);
      }
      for (Eigen::Vector3d TrajectoryPoint::*field :
           {&TrajectoryPoint::p_world, &TrajectoryPoint::v_world, &TrajectoryPoint::a_world}) {
        TrajectoryPoint point;
        (point.*field)[i] = bad;
        EXPECT_EQ(status_of({}, point), ControlStatus::invalid_reference);
      }
    }
    OdometryState state;
    state.R_world_body.z() = bad;
    EXPECT_EQ(status_of(state, {}), ControlStatus::invalid_state);
    TrajectoryPoint point;
    point.yaw = bad;
    EXPECT_EQ(status_of({}, point), ControlStatus::invalid_reference);
    point.yaw = 0.0;
    point.yaw_rate = bad;
    EXPECT_EQ(status_of({}, point), ControlStatus::invalid_reference);
  }
  OdometryState no_rotation;
  no_rotation.R_world_body.coeffs().setZero();
  EXPECT_EQ(status_of(no_rotation, {}), ControlStatus::invalid_state);
}

TEST(LeePositionController, refuses_an_output_of_another_length) {
  const LeePositionController controller{LeeParams{}};
  std::vector<double> five(5, 7.0);
  EXPECT_EQ(controller.compute({}, {}, five), ControlStatus::wrong_rotor_count);
  EXPECT_EQ(five, std::vector<double>(5, 7.0));
}

TEST(LeePositionController, refuses_bad_gains_by_name) {
  const auto error_of = [](const std::function<void(LeeParams&)>& spoil) -> std::string {
    LeeParams params;
    spoil(params);
    try {
      LeePositionController controller(params);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(
      error_of([](LeeParams& p) { p.gains.position.y() = -1; }).find("'position_gain/y' is -1"),
      std::string::npos);
  EXPECT_NE(
      error_of([](LeeParams& p) { p.gains.velocity.x() = kNan; }).find("'velocity_gain/x' is nan"),
      std::string::npos);
  EXPECT_NE(
      error_of([](LeeParams& p) { p.gains.attitude.z() = HUGE_VAL; }).find("'attitude_gain/z'"),
      std::string::npos);
  EXPECT_NE(
      error_of([](LeeParams& p) { p.gains.angular_rate.z() = -2; }).find("'angular_rate_gain/z'"),
      std::string::npos);
  EXPECT_NE(error_of([](LeeParams& p) {
              p.quirks.unlimited_rotor_speed = false;
              p.quirks.max_rotor_speed = 0.0;
            }).find("'max_rotor_speed'"),
            std::string::npos);
}

}  // namespace
}  // namespace trident::control
