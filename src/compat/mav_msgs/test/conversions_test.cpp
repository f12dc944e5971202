// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mav_msgs/conversions.h"

#include <gtest/gtest.h>

#include <random>

#include "mav_msgs/default_topics.h"

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Position 1 m around a tilted circle that breathes, with exact derivatives up to snap: each
/// axis is a sine.
struct Lissajous {
  Vector3d amplitude{1.0, 0.7, 0.4};
  Vector3d rate{1.3, 0.9, 1.7};
  Vector3d phase{0.1, 1.1, 2.0};

  Vector3d derivative(double t, int order) const {
    Vector3d out;
    for (int i = 0; i < 3; ++i) {
      out[i] = amplitude[i] * std::pow(rate[i], order) *
               std::sin(rate[i] * t + phase[i] + 0.5 * M_PI * order);
    }
    return out;
  }
};

struct FlatState {
  Quaterniond q_W_B;
  Vector3d specific_force_B, w_B, w_dot_B;
};

FlatState flat_state(const Lissajous& path, double t) {
  FlatState s;
  mav_msgs::EigenMavStateFromEigenTrajectoryPoint(
      path.derivative(t, 2), path.derivative(t, 3), path.derivative(t, 4), 0.4, 0.0, 0.0, 9.81,
      &s.q_W_B, &s.specific_force_B, &s.w_B, &s.w_dot_B);
  return s;
}

mav_msgs::EigenTrajectoryPoint example_point() {
  mav_msgs::EigenTrajectoryPoint point(1'500'000'000, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 0},
                                       {0, 0, 0}, mav_msgs::quaternionFromYaw(0.7), {0.1, 0.2, 0.3},
                                       {0.4, 0.5, 0.6});
  return point;
}

TEST(Common, GravityMatchesTheFormulaAtEquatorPoleAndHeight) {
  EXPECT_NEAR(mav_msgs::MagnitudeOfGravity(0.0, 0.0), 9.780327, 1e-9);
  EXPECT_NEAR(mav_msgs::MagnitudeOfGravity(0.0, M_PI / 2), 9.832186, 1e-6);
  EXPECT_NEAR(mav_msgs::MagnitudeOfGravity(1000.0, 0.0) - 9.780327, -3.0857e-3, 1e-6);
  EXPECT_NEAR(mav_msgs::kGravity, 9.8066, 2e-3);
}

TEST(Common, QuaternionOfAnEmptyMessageIsIdentityAndOthersAreNormalized) {
  geometry_msgs::Quaternion msg;
  msg.w = 0.0;
  EXPECT_TRUE(mav_msgs::quaternionFromMsg(msg).isApprox(Quaterniond::Identity()));
  msg.z = 3.0;
  const Quaterniond q = mav_msgs::quaternionFromMsg(msg);
  EXPECT_DOUBLE_EQ(q.norm(), 1.0);
  EXPECT_DOUBLE_EQ(q.z(), 1.0);
}

TEST(Common, YawAndEulerAnglesInvertTheirRotation) {
  std::mt19937 gen(7);
  std::uniform_real_distribution<double> full(-3.1, 3.1), half(-1.5, 1.5);
  for (int i = 0; i < 200; ++i) {
    const Vector3d rpy(full(gen), half(gen), full(gen));
    const Quaterniond q = Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                          Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX());
    Vector3d out;
    mav_msgs::getEulerAnglesFromQuaternion(q, &out);
    EXPECT_LT((out - rpy).norm(), 1e-9) << rpy.transpose();
    EXPECT_NEAR(mav_msgs::yawFromQuaternion(q), rpy.z(), 1e-9);
  }
}

TEST(Common, RotationVectorAndMatrixInvertEachOther) {
  for (const Vector3d& v : {Vector3d(0, 0, 0), Vector3d(0.3, -1.2, 0.8), Vector3d(0, 3.1, 0)}) {
    Matrix3d R;
    mav_msgs::matrixFromRotationVector(v, &R);
    EXPECT_TRUE(mav_msgs::isRotationMatrix(R));
    Vector3d back;
    ASSERT_TRUE(mav_msgs::vectorFromRotationMatrix(R, &back));
    EXPECT_LT((back - v).norm(), 1e-9);
  }
  Vector3d unused;
  EXPECT_FALSE(mav_msgs::vectorFromRotationMatrix(2.0 * Matrix3d::Identity(), &unused));
  EXPECT_FALSE(mav_msgs::isRotationMatrix(-Matrix3d::Identity()));
}

TEST(Common, SkewMatrixIsTheCrossProduct) {
  const Vector3d v(1, 2, 3), u(-2, 0.5, 4);
  Matrix3d skew;
  mav_msgs::skewMatrixFromVector(v, &skew);
  EXPECT_LT((skew * u - v.cross(u)).norm(), 1e-12);
  Vector3d back;
  EXPECT_TRUE(mav_msgs::vectorFromSkewMatrix(skew, &back));
  EXPECT_EQ(back, v);
  EXPECT_FALSE(mav_msgs::vectorFromSkewMatrix(Matrix3d::Identity(), &back));
}

TEST(Common, OmegaOfARotationVectorMatchesFiniteDifferences) {
  const Vector3d r0(0.4, -0.9, 1.3), v(0.5, 0.2, -0.7), a(-0.3, 0.8, 0.1);
  const double h = 1e-5;
  const auto r = [&](double t) { return Vector3d(r0 + v * t + 0.5 * a * t * t); };
  Matrix3d minus, plus, at;
  mav_msgs::matrixFromRotationVector(r(-h), &minus);
  mav_msgs::matrixFromRotationVector(r(h), &plus);
  mav_msgs::matrixFromRotationVector(r(0), &at);
  const Matrix3d skew = (plus - minus) / (2 * h) * at.transpose();
  const Vector3d w_numeric(skew(2, 1), skew(0, 2), skew(1, 0));
  EXPECT_LT((mav_msgs::omegaFromRotationVector(r0, v) - w_numeric).norm(), 1e-8);

  const Vector3d w_plus = mav_msgs::omegaFromRotationVector(r(h), v + a * h);
  const Vector3d w_minus = mav_msgs::omegaFromRotationVector(r(-h), v - a * h);
  EXPECT_LT((mav_msgs::omegaDotFromRotationVector(r0, v, a) - (w_plus - w_minus) / (2 * h)).norm(),
            1e-8);
}

TEST(FlatState, AttitudeMakesTheThrustThatThePathNeeds) {
  const Lissajous path;
  const FlatState s = flat_state(path, 0.7);
  const Vector3d gravity(0, 0, -9.81);
  EXPECT_LT((s.q_W_B * s.specific_force_B + gravity - path.derivative(0.7, 2)).norm(), 1e-12);
  EXPECT_NEAR(s.specific_force_B.head<2>().norm(), 0.0, 1e-12);
}

TEST(FlatState, BodyRatesMatchFiniteDifferencesOfTheThrustAxis) {
  const Lissajous path;
  const double t = 0.7, h = 1e-4;
  const auto z_axis = [&](double at) {
    return Vector3d(flat_state(path, at).q_W_B * Vector3d::UnitZ());
  };
  const FlatState s = flat_state(path, t);
  const Vector3d z = z_axis(t), w = s.q_W_B * s.w_B, w_dot = s.q_W_B * s.w_dot_B;
  const Vector3d z_dot = (z_axis(t + h) - z_axis(t - h)) / (2 * h);
  const Vector3d z_ddot = (z_axis(t + h) - 2 * z + z_axis(t - h)) / (h * h);
  EXPECT_LT((w.cross(z) - z_dot).norm(), 1e-6);
  EXPECT_LT((w_dot.cross(z) + w.cross(w.cross(z)) - z_ddot).norm(), 1e-5);
}

TEST(FlatState, FullyActuatedVehicleKeepsItsOwnAttitude) {
  mav_msgs::EigenTrajectoryPoint point = example_point();
  point.degrees_of_freedom = mav_msgs::DOF6;
  mav_msgs::EigenMavState state;
  mav_msgs::EigenMavStateFromEigenTrajectoryPoint(point, &state);
  EXPECT_TRUE(state.orientation_W_B.isApprox(point.orientation_W_B));
  const Vector3d force_W = state.orientation_W_B * state.acceleration_B;
  EXPECT_LT((force_W - point.acceleration_W - Vector3d(0, 0, mav_msgs::kGravity)).norm(), 1e-9);
}

TEST(Conversions, OdometryKeepsStampPoseTwistAndCovariance) {
  nav_msgs::Odometry msg;
  msg.header.stamp = ros::Time(12, 345);
  msg.pose.pose.position.x = 1.0;
  msg.pose.pose.orientation.w = 1.0;
  msg.twist.twist.linear.y = 2.0;
  msg.twist.twist.angular.z = 3.0;
  msg.pose.covariance[1] = 0.25;
  mav_msgs::EigenOdometry odometry;
  mav_msgs::eigenOdometryFromMsg(msg, &odometry);
  EXPECT_EQ(odometry.timestamp_ns, 12'000'000'345);
  EXPECT_EQ(odometry.position_W, Vector3d(1, 0, 0));
  EXPECT_EQ(odometry.velocity_B, Vector3d(0, 2, 0));
  EXPECT_EQ(odometry.angular_velocity_B, Vector3d(0, 0, 3));
  EXPECT_EQ(odometry.pose_covariance_(0, 1), 0.25);

  nav_msgs::Odometry back;
  mav_msgs::msgOdometryFromEigen(odometry, &back);
  EXPECT_EQ(back.header.stamp, msg.header.stamp);
  EXPECT_EQ(back.pose.pose, msg.pose.pose);
  EXPECT_EQ(back.twist.twist, msg.twist.twist);
}

TEST(Conversions, OdometryVelocityTurnsIntoTheWorldAndBack) {
  mav_msgs::EigenOdometry odometry;
  odometry.setFromYaw(M_PI / 2);
  odometry.setVelocityWorld({0, 2, 1});
  EXPECT_LT((odometry.velocity_B - Vector3d(2, 0, 1)).norm(), 1e-12);
  EXPECT_LT((odometry.getVelocityWorld() - Vector3d(0, 2, 1)).norm(), 1e-12);
  EXPECT_NEAR(odometry.getYaw(), M_PI / 2, 1e-12);
}

TEST(Conversions, TrajectoryPointSurvivesTheMessage) {
  const mav_msgs::EigenTrajectoryPoint point = example_point();
  trajectory_msgs::MultiDOFJointTrajectory msg;
  mav_msgs::msgMultiDofJointTrajectoryFromEigen(point, "frame", &msg);
  ASSERT_EQ(msg.joint_names, std::vector<std::string>{"frame"});
  mav_msgs::EigenTrajectoryPointVector vector;
  mav_msgs::eigenTrajectoryPointVectorFromMsg(msg, &vector);
  mav_msgs::EigenTrajectoryPointDeque deque;
  mav_msgs::eigenTrajectoryPointDequeFromMsg(msg, &deque);
  ASSERT_EQ(vector.size(), 1u);
  ASSERT_EQ(deque.size(), 1u);
  for (const auto& out : {vector.front(), deque.front()}) {
    EXPECT_EQ(out.time_from_start_ns, point.time_from_start_ns);
    EXPECT_EQ(out.position_W, point.position_W);
    EXPECT_EQ(out.velocity_W, point.velocity_W);
    EXPECT_EQ(out.acceleration_W, point.acceleration_W);
    EXPECT_EQ(out.angular_velocity_W, point.angular_velocity_W);
    EXPECT_EQ(out.angular_acceleration_W, point.angular_acceleration_W);
    EXPECT_NEAR(out.getYaw(), 0.7, 1e-12);
  }
}

TEST(Conversions, PointWithoutVelocitiesIsAtRestAndAnEmptyOneChangesNothing) {
  mav_msgs::EigenTrajectoryPoint point = example_point();
  trajectory_msgs::MultiDOFJointTrajectoryPoint msg;
  mav_msgs::eigenTrajectoryPointFromMsg(msg, &point);
  EXPECT_EQ(point.position_W, Vector3d(1, 2, 3));
  msg.transforms.resize(1);
  mav_msgs::eigenTrajectoryPointFromMsg(msg, &point);
  EXPECT_EQ(point.position_W, Vector3d::Zero());
  EXPECT_EQ(point.velocity_W, Vector3d::Zero());
  EXPECT_EQ(point.acceleration_W, Vector3d::Zero());
}

TEST(Conversions, PositionYawMakesOneWaypointOfTheBaseLink) {
  trajectory_msgs::MultiDOFJointTrajectory msg;
  mav_msgs::msgMultiDofJointTrajectoryFromPositionYaw({1, 2, 3}, M_PI / 3, &msg);
  ASSERT_EQ(msg.points.size(), 1u);
  EXPECT_EQ(msg.joint_names, std::vector<std::string>{"base_link"});
  EXPECT_EQ(msg.points[0].transforms[0].translation.z, 3.0);
  EXPECT_NEAR(msg.points[0].transforms[0].rotation.z, 0.5, 1e-12);
}

TEST(Conversions, PoseSetsAPointAtRest) {
  geometry_msgs::PoseStamped msg;
  msg.header.stamp = ros::Time(5, 0);
  msg.pose.position.x = 4.0;
  mav_msgs::EigenTrajectoryPoint point = example_point();
  mav_msgs::eigenTrajectoryPointFromPoseMsg(msg, &point);
  EXPECT_EQ(point.timestamp_ns, 5'000'000'000);
  EXPECT_EQ(point.position_W, Vector3d(4, 0, 0));
  EXPECT_EQ(point.velocity_W, Vector3d::Zero());
  EXPECT_TRUE(point.orientation_W_B.isApprox(Quaterniond::Identity()));
}

TEST(Conversions, ActuatorsAndThrustCommandsSurviveTheirMessages) {
  mav_msgs::EigenActuators actuators(Eigen::VectorXd::LinSpaced(6, 100, 600));
  mav_msgs::Actuators msg;
  mav_msgs::msgActuatorsFromEigen(actuators, &msg);
  EXPECT_TRUE(msg.angles.empty());
  mav_msgs::EigenActuators back;
  mav_msgs::eigenActuatorsFromMsg(msg, &back);
  EXPECT_EQ(back.angular_velocities, actuators.angular_velocities);

  const mav_msgs::EigenRollPitchYawrateThrust command(0.1, -0.2, 0.3, {0, 0, 15});
  mav_msgs::RollPitchYawrateThrust command_msg;
  mav_msgs::msgRollPitchYawrateThrustFromEigen(command, &command_msg);
  mav_msgs::EigenRollPitchYawrateThrust command_back;
  mav_msgs::eigenRollPitchYawrateThrustFromMsg(command_msg, &command_back);
  EXPECT_EQ(command_back.pitch, -0.2);
  EXPECT_EQ(command_back.thrust, Vector3d(0, 0, 15));
}

TEST(Conversions, AffineMovesAPointWithItsDerivatives) {
  const mav_msgs::EigenTrajectoryPoint point = example_point();
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.translate(Vector3d(10, 0, 0)).rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  const mav_msgs::EigenTrajectoryPoint out = T * point;
  EXPECT_LT((out.position_W - Vector3d(8, 1, 3)).norm(), 1e-12);
  EXPECT_LT((out.velocity_W - Vector3d(-5, 4, 6)).norm(), 1e-12);
  EXPECT_NEAR(out.getYaw(), 0.7 + M_PI / 2, 1e-12);
}

TEST(Topics, NamesAreTheOnesUsersRemap) {
  EXPECT_STREQ(mav_msgs::default_topics::COMMAND_ACTUATORS, "command/motor_speed");
  EXPECT_STREQ(mav_msgs::default_topics::COMMAND_TRAJECTORY, "command/trajectory");
  EXPECT_STREQ(mav_msgs::default_topics::ODOMETRY, "odometry");
  EXPECT_STREQ(mav_msgs::default_topics::WIND_SPEED, "wind_speed");
}

}  // namespace
