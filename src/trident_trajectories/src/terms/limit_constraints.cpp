// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "terms/limit_constraints.h"

#include <cmath>

namespace trident::trajectories {
namespace {

/// Adds weight * share * rows[k] to the first two columns.
void add_rows(double weight, const SmoothMaximum& maximum, const Eigen::ArrayX2d& rows,
              Samples& out) {
  for (const auto& [k, share] : maximum.shares())
    out.row(k).head<2>() += weight * share * rows.row(k).matrix();
}

}  // namespace

double speed_floor(const Limits& limits) { return 0.05 * limits.max_velocity; }

NormLimit::NormLimit(LimitKind kind, std::size_t robot, int derivative, double limit, int samples)
    : Constraint(kind, robot, robot),
      derivative_(derivative),
      factor_(1.0 / (limit * limit)),
      maximum_(samples) {}

double NormLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const Samples& value = motions[first()].at_samples(derivative_);
  maximum_.values() = factor_ * (value.col(0).array().square() + value.col(1).array().square() +
                                 value.col(2).array().square()) -
                      1.0;
  return maximum_.compute(sharpness);
}

void NormLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  const Samples& value = motions[first()].at_samples(derivative_);
  Samples& gradient = motions[first()].gradient(derivative_);
  for (const auto& [k, share] : maximum_.shares())
    gradient.row(k) += 2.0 * weight * factor_ * share * value.row(k);
}

TurnLimit::TurnLimit(LimitKind kind, std::size_t robot, int power, double limit, const Robot& of,
                     int samples)
    : Constraint(kind, robot, robot),
      power_(power),
      factor_(1.0 / (limit * limit)),
      floor2_(std::pow(speed_floor(of.limits), 2)),
      current_(of.surge.current.transpose()),
      maximum_(samples),
      by_v_(samples, 2),
      by_a_(samples, 2) {}

double TurnLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const Samples& v = motions[first()].at_samples(1);
  const Samples& a = motions[first()].at_samples(2);
  for (int k = 0; k < v.rows(); ++k) {
    const double vx = v(k, 0) - current_.x(), vy = v(k, 1) - current_.y();
    const double cross = vx * a(k, 1) - vy * a(k, 0), square = vx * vx + vy * vy + floor2_;
    double scale = factor_ / (square * square);
    if (power_ == 3) scale /= square;
    const double value = cross * cross * scale;
    maximum_.values()[k] = value - 1.0;
    const double by_cross = 2.0 * cross * scale, by_square = -power_ * value / square;
    by_v_.row(k) << by_cross * a(k, 1) + 2.0 * by_square * vx,
        -by_cross * a(k, 0) + 2.0 * by_square * vy;
    by_a_.row(k) << -by_cross * vy, by_cross * vx;
  }
  return maximum_.compute(sharpness);
}

void TurnLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  add_rows(weight, maximum_, by_v_, motions[first()].gradient(1));
  add_rows(weight, maximum_, by_a_, motions[first()].gradient(2));
}

ThrustLimit::ThrustLimit(LimitKind kind, std::size_t robot, double limit, const Robot& of,
                         int samples)
    : Constraint(kind, robot, robot),
      factor_((kind == LimitKind::kThrust ? 1.0 : -1.0) / limit),
      floor2_(std::pow(speed_floor(of.limits), 2)),
      surge_(of.surge),
      maximum_(samples),
      by_v_(samples, 2),
      by_a_(samples, 2) {}

double ThrustLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const Samples& v = motions[first()].at_samples(1);
  const Samples& a = motions[first()].at_samples(2);
  for (int k = 0; k < v.rows(); ++k) {
    const double vx = v(k, 0) - surge_.current.x(), vy = v(k, 1) - surge_.current.y();
    const double u = std::sqrt(vx * vx + vy * vy + floor2_);
    const double ahead = (a(k, 0) * vx + a(k, 1) * vy) / u;  // du/dt
    const double force =
        surge_.mass * ahead + (surge_.linear_damping + surge_.quadratic_damping * u) * u;
    maximum_.values()[k] = factor_ * force - 1.0;
    const double inertia = factor_ * surge_.mass / u;
    const double by_u =
        factor_ * (surge_.linear_damping + 2.0 * surge_.quadratic_damping * u) - inertia * ahead;
    by_v_.row(k) << inertia * a(k, 0) + by_u * vx / u, inertia * a(k, 1) + by_u * vy / u;
    by_a_.row(k) << inertia * vx, inertia * vy;
  }
  return maximum_.compute(sharpness);
}

void ThrustLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  add_rows(weight, maximum_, by_v_, motions[first()].gradient(1));
  add_rows(weight, maximum_, by_a_, motions[first()].gradient(2));
}

}  // namespace trident::trajectories
