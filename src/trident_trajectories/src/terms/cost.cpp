// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "terms/cost.h"

#include <algorithm>
#include <cmath>

namespace trident::trajectories {
namespace {

constexpr double kSlow_m_s = 0.02;       // a length's gradient is smooth below that speed
constexpr double kTimeConstant_s = 1.0;  // of the power that acceleration takes

}  // namespace

Cost::Cost(const Problem& problem, const SplineBasis& basis,
           const std::vector<RobotMotion>& undisturbed, double jerk_scale)
    : problem_(problem), gram_(basis.jerk_gram()), weights_(problem.cost) {
  double time = 0.0, path = 0.0, used = 0.0;
  std::vector<RobotMotion> motions = undisturbed;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    time += motions[i].duration;
    path += std::max(1.0, length(motions[i], 0.0));
    used += std::max(1.0, energy(problem_.robots[i], motions[i], 0.0));
  }
  weights_.jerk /= jerk_scale;
  weights_.length /= path;
  weights_.time /= time;
  weights_.energy /= used;
}

int Cost::derivative() const {
  if (weights_.energy > 0.0) return 2;
  return weights_.length > 0.0 ? 1 : 0;
}

double Cost::evaluate(std::vector<RobotMotion>& motions) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    RobotMotion& motion = motions[i];
    if (weights_.jerk > 0.0) sum += weights_.jerk * jerk(motion, weights_.jerk);
    if (weights_.length > 0.0) sum += weights_.length * length(motion, weights_.length);
    if (weights_.energy > 0.0)
      sum += weights_.energy * energy(problem_.robots[i], motion, weights_.energy);
    sum += weights_.time * motion.duration;
    motion.duration_gradient += weights_.time;
  }
  return sum;
}

double Cost::jerk(RobotMotion& motion, double weight) const {
  const double by_time = std::pow(motion.duration, -5);
  double integral = 0.0;
  const int size = static_cast<int>(gram_.rows());
  for (int axis = 0; axis < 3; ++axis) {
    const auto points = motion.points.col(axis);
    for (int i = 0; i < size; ++i) {
      // The matrix is banded: control points that share no segment do not interact.
      const int begin = std::max(0, i - kDegree), end = std::min(size, i + kOrder);
      const double product =
          gram_.col(i).segment(begin, end - begin).dot(points.segment(begin, end - begin));
      integral += product * points[i];
      motion.points_gradient(i, axis) += 2.0 * weight * by_time * product;
    }
  }
  motion.duration_gradient -= 5.0 * weight * by_time * integral / motion.duration;
  return by_time * integral;
}

double Cost::length(RobotMotion& motion, double weight) const {
  const Samples& v = motion.at_samples(1);
  Samples& gradient = motion.gradient(1);
  const double share = 1.0 / static_cast<double>(v.rows());
  double sum = 0.0;
  for (int k = 0; k < v.rows(); ++k) {
    const double speed = std::sqrt(v.row(k).squaredNorm() + kSlow_m_s * kSlow_m_s);
    sum += speed;
    gradient.row(k) += weight * share * motion.duration / speed * v.row(k);
  }
  motion.duration_gradient += weight * share * sum;
  return share * motion.duration * sum;
}

double Cost::energy(const Robot& robot, RobotMotion& motion, double weight) const {
  const Samples& v = motion.at_samples(1);
  const Samples& a = motion.at_samples(2);
  Samples& by_v = motion.gradient(1);
  Samples& by_a = motion.gradient(2);
  const double share = 1.0 / static_cast<double>(v.rows());
  double sum = 0.0;
  for (int k = 0; k < v.rows(); ++k) {
    const double speed = v.row(k).norm();
    sum += kTimeConstant_s * a.row(k).squaredNorm() + robot.drag * speed * speed * speed;
    const double factor = weight * share * motion.duration;
    by_v.row(k) += 3.0 * factor * robot.drag * speed * v.row(k);
    by_a.row(k) += 2.0 * factor * kTimeConstant_s * a.row(k);
  }
  motion.duration_gradient += weight * share * sum;
  return share * motion.duration * sum;
}

}  // namespace trident::trajectories
