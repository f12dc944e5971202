// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/trajectory.h"

#include <Eigen/QR>
#include <cmath>
#include <utility>

namespace trident::trajectories {
namespace {

constexpr int kInstantsPerPoint = 4;  // at which a rest is compared with the whole

}  // namespace

Trajectory::Trajectory(std::shared_ptr<const SplineBasis> basis, ControlPoints control_points,
                       double duration)
    : basis_(std::move(basis)), control_points_(std::move(control_points)), duration_(duration) {}

Eigen::Vector3d Trajectory::derivative(int order, int segment, double t) const {
  const SplineBasis::PointWeights weights = basis_->weights_at(order, segment, t / duration_);
  const Eigen::Vector3d by_s = control_points_.middleRows<kOrder>(segment).transpose() * weights;
  return by_s / std::pow(duration_, order);
}

MotionState Trajectory::at(double t) const {
  if (t <= 0.0) return {derivative(0, 0, 0.0), derivative(1, 0, 0.0), derivative(2, 0, 0.0)};
  if (t >= duration_) {
    const int last = basis_->segments() - 1;
    const Eigen::Vector3d v = derivative(1, last, duration_);
    return {derivative(0, last, duration_) + (t - duration_) * v, v, Eigen::Vector3d::Zero()};
  }
  const int segment = basis_->segment_of(t / duration_);
  return {derivative(0, segment, t), derivative(1, segment, t), derivative(2, segment, t)};
}

Trajectory rest_of(const Trajectory& trajectory, double from) {
  const SplineBasis& basis = trajectory.basis();
  const int points = basis.control_points(), instants = kInstantsPerPoint * points;
  const double duration = trajectory.duration() - from;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(instants, points);
  Samples positions(instants, 3);
  for (int k = 0; k < instants; ++k) {
    const double s = static_cast<double>(k) / (instants - 1);
    const int segment = basis.segment_of(s);
    weights.row(k).segment<kOrder>(segment) = basis.weights_at(0, segment, s).transpose();
    positions.row(k) = trajectory.at(from + s * duration).p.transpose();
  }
  ControlPoints fitted = weights.colPivHouseholderQr().solve(positions);
  return Trajectory(trajectory.shared_basis(), std::move(fitted), duration);
}

double squared_jerk(const Trajectory& trajectory) {
  const ControlPoints& points = trajectory.control_points();
  const double by_s = points.cwiseProduct(trajectory.basis().jerk_gram() * points).sum();
  return by_s / std::pow(trajectory.duration(), 5);
}

}  // namespace trident::trajectories
