// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "curves/robot_motion.h"

#include <algorithm>
#include <utility>

namespace trident::trajectories {

RobotMotion::RobotMotion(std::shared_ptr<const SplineBasis> basis) : basis_(std::move(basis)) {
  points = ControlPoints::Zero(basis_->control_points(), 3);
  points_gradient = points;
  const Samples zero = Samples::Zero(basis_->samples(), 3);
  own_.fill(zero);
  gradient_.fill(zero);
  common_ = common_gradient_ = zero;
  common_samples_.resize(basis_->samples());
}

void RobotMotion::update(int highest, double horizon) {
  horizon_ = horizon;
  is_common_ = horizon == duration;
  double scale = 1.0;
  for (int derivative = 0; derivative <= highest; ++derivative, scale /= duration) {
    basis_->sample(derivative, points, own_[derivative]);
    if (derivative > 0) own_[derivative] *= scale;
  }
  if (!is_common_) sample_common(horizon);
}

void RobotMotion::sample_common(double horizon) {
  for (int k = 0; k < basis_->samples(); ++k) {
    CommonSample& sample = common_samples_[k];
    const double s = basis_->sample(k) * horizon / duration, held = std::min(s, 1.0);
    sample.segment = basis_->segment_of(held);
    sample.slope = basis_->weights_at(1, sample.segment, held);
    sample.weights = basis_->weights_at(0, sample.segment, held) + (s - held) * sample.slope;
    common_.row(k).noalias() =
        sample.weights.transpose() * points.middleRows<kOrder>(sample.segment);
  }
}

void RobotMotion::clear() {
  for (int derivative = 0; derivative < 4; ++derivative)
    if (is_touched_[derivative]) gradient_[derivative].setZero();
  if (is_common_touched_) common_gradient_.setZero();
  is_touched_.fill(false);
  is_common_touched_ = false;
  points_gradient.setZero();
  duration_gradient = horizon_gradient = 0.0;
}

void RobotMotion::pull_back() {
  double scale = 1.0;
  for (int derivative = 0; derivative < 4; ++derivative, scale /= duration) {
    if (!is_touched_[derivative]) continue;
    if (derivative > 0) {
      // Derivative n by time is that by s over duration^n.
      duration_gradient -=
          derivative * gradient_[derivative].cwiseProduct(own_[derivative]).sum() / duration;
      gradient_[derivative] *= scale;
    }
    basis_->pull_back(derivative, gradient_[derivative], points_gradient);
  }
  if (is_common_touched_) pull_back_common();
}

void RobotMotion::pull_back_common() {
  for (int k = 0; k < basis_->samples(); ++k) {
    const CommonSample& sample = common_samples_[k];
    const Eigen::RowVector3d gradient = common_gradient_.row(k);
    points_gradient.middleRows<kOrder>(sample.segment).noalias() += sample.weights * gradient;
    const Eigen::RowVector3d slope =
        sample.slope.transpose() * points.middleRows<kOrder>(sample.segment);
    const double by_s = gradient.dot(slope), share = basis_->sample(k) / duration;
    horizon_gradient += by_s * share;
    duration_gradient -= by_s * share * horizon_ / duration;
  }
}

}  // namespace trident::trajectories
