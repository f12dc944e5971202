// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "fusion/robot_motion.h"

#include <algorithm>
#include <cmath>

#include "trident_base/so3.h"

namespace trident::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMaxStep_s = 0.05;
constexpr int kMaxSteps = 100;  // what is not heard for longer moves in longer steps

enum Block : int { kP = 0, kR = 3, kV = 6, kW = 9 };

int steps(double dt) {
  return static_cast<int>(std::clamp(std::ceil(dt / kMaxStep_s), 1.0, double{kMaxSteps}));
}

// Up, along the base's axes.
Vector3d up_in_base(const SE3& T_world_base) {
  return T_world_base.R.conjugate() * Vector3d::UnitZ();
}

// A velocity that is forgotten, v' = -v / time + white noise, over a step.
struct Forgetting {
  double kept;      // of the velocity
  double integral;  // of the velocity, what it moves by [s]
  // Of the noise for a standard deviation of 1 in the long run: variances of the position and of
  // the velocity, and their covariance.
  double pp, pv, vv;
};

Forgetting forgetting(double time, double dt) {
  const double x = dt / time;
  const double gone = -std::expm1(-x);
  // 2 x - 3 + 4 exp(-x) - exp(-2 x), which loses its digits near zero.
  const double cubic = x < 0.05 ? x * x * x * (2.0 / 3 + x * (-1.0 / 2 + x * (7.0 / 30 - x / 12)))
                                : 2.0 * x - 3.0 + 4.0 * std::exp(-x) - std::exp(-2.0 * x);
  return {1.0 - gone, time * gone, time * time * cubic, time * gone * gone, -std::expm1(-2.0 * x)};
}

// One step of
//   p' = R v,  R' = R [w],  v' = -v / speed_time,  w' = -w / turn_time + leveling^2 (z x up),
// with the rotation in the middle of the step for p.
RobotState step(const RobotMotion& motion, const RobotState& robot, double dt) {
  const Forgetting v = forgetting(motion.speed_time, dt), w = forgetting(motion.turn_time, dt);
  RobotState next = robot;
  const Vector3d turn = w.integral * robot.w_base;
  next.T_world_base.p += v.integral * (robot.T_world_base.R * (so3_exp(0.5 * turn) * robot.v_base));
  next.T_world_base.R = (robot.T_world_base.R * so3_exp(turn)).normalized();
  const Vector3d up = up_in_base(robot.T_world_base);
  next.v_base *= v.kept;
  next.w_base *= w.kept;
  next.w_base += w.integral * motion.leveling * motion.leveling * Vector3d::UnitZ().cross(up);
  return next;
}

MotionMatrix step_jacobian(const RobotMotion& motion, const RobotState& robot, double dt) {
  const Forgetting v = forgetting(motion.speed_time, dt), w = forgetting(motion.turn_time, dt);
  MotionMatrix F = MotionMatrix::Identity();
  const Vector3d turn = w.integral * robot.w_base;
  const Matrix3d R = robot.T_world_base.R.toRotationMatrix();
  const Matrix3d half = so3_exp(0.5 * turn).toRotationMatrix();
  F.block<3, 3>(kP, kR) = -v.integral * R * skew(half * robot.v_base);
  F.block<3, 3>(kP, kV) = v.integral * R * half;
  // The left Jacobian of -r is the right one of r.
  F.block<3, 3>(kP, kW) = -0.5 * v.integral * w.integral * R * half * skew(robot.v_base) *
                          so3_left_jacobian(-0.5 * turn);
  F.block<3, 3>(kR, kR) = so3_exp(-turn).toRotationMatrix();
  F.block<3, 3>(kR, kW) = w.integral * so3_left_jacobian(-turn);
  F.block<3, 3>(kV, kV) *= v.kept;
  F.block<3, 3>(kW, kW) *= w.kept;
  F.block<3, 3>(kW, kR) = w.integral * motion.leveling * motion.leveling * skew(Vector3d::UnitZ()) *
                          skew(up_in_base(robot.T_world_base));
  return F;
}

// Along the axes of the base.
MotionMatrix step_noise(const RobotMotion& motion, const RobotState& robot, double dt) {
  const Forgetting v = forgetting(motion.speed_time, dt), w = forgetting(motion.turn_time, dt);
  const Matrix3d R = robot.T_world_base.R.toRotationMatrix();
  const Matrix3d speed = motion.speed.cwiseAbs2().asDiagonal();
  const Matrix3d turn = motion.turn.cwiseAbs2().asDiagonal();
  MotionMatrix Q = MotionMatrix::Zero();
  Q.block<3, 3>(kP, kP) = v.pp * R * speed * R.transpose();
  Q.block<3, 3>(kP, kV) = v.pv * R * speed;
  Q.block<3, 3>(kV, kP) = Q.block<3, 3>(kP, kV).transpose();
  Q.block<3, 3>(kV, kV) = v.vv * speed;
  Q.block<3, 3>(kR, kR) = w.pp * turn;
  Q.block<3, 3>(kR, kW) = w.pv * turn;
  Q.block<3, 3>(kW, kR) = w.pv * turn;
  Q.block<3, 3>(kW, kW) = w.vv * turn;
  return Q;
}

}  // namespace

RobotState moved(const RobotMotion& motion, const RobotState& robot, double dt) {
  const int count = steps(dt);
  RobotState next = robot;
  for (int i = 0; i < count; ++i) next = step(motion, next, dt / count);
  return next;
}

MotionMatrix motion_jacobian(const RobotMotion& motion, const RobotState& robot, double dt) {
  const int count = steps(dt);
  if (count == 1) return step_jacobian(motion, robot, dt);
  RobotState next = robot;
  MotionMatrix F = MotionMatrix::Identity();
  for (int i = 0; i < count; ++i) {
    F = (step_jacobian(motion, next, dt / count) * F).eval();
    next = step(motion, next, dt / count);
  }
  return F;
}

MotionMatrix motion_noise(const RobotMotion& motion, const RobotState& robot, double dt) {
  const int count = steps(dt);
  if (count == 1) return step_noise(motion, robot, dt);
  RobotState next = robot;
  MotionMatrix Q = MotionMatrix::Zero();
  for (int i = 0; i < count; ++i) {
    const MotionMatrix F = step_jacobian(motion, next, dt / count);
    Q = (F * Q * F.transpose()).eval() + step_noise(motion, next, dt / count);
    next = step(motion, next, dt / count);
  }
  return Q;
}

}  // namespace trident::estimation
