// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "terms/distance_constraints.h"

#include <algorithm>
#include <cmath>

namespace trident::trajectories {

bool must_separate(const Problem& problem, std::size_t first, std::size_t second) {
  return std::none_of(
      problem.contacts.begin(), problem.contacts.end(), [&](const AllowedContact& contact) {
        return std::minmax(contact.first, contact.second) == std::minmax(first, second);
      });
}

double vertical_factor(const Problem& problem, std::size_t first, std::size_t second) {
  const bool both_fly =
      problem.robots[first].kind == Kind::kUav && problem.robots[second].kind == Kind::kUav;
  return both_fly ? problem.downwash : 1.0;
}

double separation_of(const Problem& problem, std::size_t first, std::size_t second) {
  return problem.robots[first].limits.collision_radius +
         problem.robots[second].limits.collision_radius;
}

SeparationLimit::SeparationLimit(const Problem& problem, std::size_t first, std::size_t second,
                                 int samples)
    : Constraint(LimitKind::kSeparation, first, second),
      horizontal_(std::pow(separation_of(problem, first, second), -2)),
      vertical_(horizontal_ * std::pow(vertical_factor(problem, first, second), -2)),
      maximum_(samples) {}

double SeparationLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const Samples& a = motions[first()].at_common();
  const Samples& b = motions[second()].at_common();
  maximum_.values() = 1.0 -
                      horizontal_ * ((a.col(0) - b.col(0)).array().square() +
                                     (a.col(1) - b.col(1)).array().square()) -
                      vertical_ * (a.col(2) - b.col(2)).array().square();
  return maximum_.compute(sharpness);
}

void SeparationLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  const Samples& a = motions[first()].at_common();
  const Samples& b = motions[second()].at_common();
  Samples& by_a = motions[first()].common_gradient();
  Samples& by_b = motions[second()].common_gradient();
  const Eigen::RowVector3d factors(horizontal_, horizontal_, vertical_);
  for (const auto& [k, share] : maximum_.shares()) {
    const Eigen::RowVector3d by_difference =
        -2.0 * weight * share * (a.row(k) - b.row(k)).cwiseProduct(factors);
    by_a.row(k) += by_difference;
    by_b.row(k) -= by_difference;
  }
}

HeightLimit::HeightLimit(const Problem& problem, std::size_t robot, int samples)
    : Constraint(LimitKind::kHeight, robot, robot), least_(problem.min_height), maximum_(samples) {}

double HeightLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  maximum_.values() = least_ - motions[first()].at_samples(0).col(2).array();
  return maximum_.compute(sharpness);
}

void HeightLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  Samples& gradient = motions[first()].gradient(0);
  for (const auto& [k, share] : maximum_.shares()) gradient(k, 2) -= weight * share;
}

ObstacleLimit::ObstacleLimit(const Problem& problem, std::size_t robot, int samples)
    : Constraint(LimitKind::kObstacle, robot, robot),
      map_(*problem.obstacles),
      radius_(problem.robots[robot].limits.collision_radius),
      maximum_(samples),
      slopes_(samples, 3) {}

double ObstacleLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const Samples& p = motions[first()].at_samples(0);
  Eigen::Vector3d slope;
  for (int k = 0; k < p.rows(); ++k) {
    maximum_.values()[k] = 1.0 - map_.distance(p.row(k).transpose(), slope) / radius_;
    slopes_.row(k) = slope.transpose();
  }
  return maximum_.compute(sharpness);
}

void ObstacleLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  Samples& gradient = motions[first()].gradient(0);
  for (const auto& [k, share] : maximum_.shares())
    gradient.row(k) -= weight / radius_ * share * slopes_.row(k);
}

MovingObstacleLimit::MovingObstacleLimit(const Problem& problem, std::size_t robot,
                                         std::size_t obstacle, const SplineBasis& basis)
    : Constraint(LimitKind::kMovingObstacle, robot, robot),
      obstacle_(problem.moving[obstacle]),
      item_(obstacle),
      factor_(std::pow(obstacle_.radius + problem.robots[robot].limits.collision_radius, -2)),
      shares_(basis.samples()),
      maximum_(basis.samples()),
      away_(basis.samples(), 3),
      velocity_(basis.samples(), 3) {
  for (int k = 0; k < basis.samples(); ++k) shares_[k] = basis.sample(k);
}

double MovingObstacleLimit::evaluate(const std::vector<RobotMotion>& motions, double sharpness) {
  const RobotMotion& motion = motions[first()];
  const Samples& p = motion.at_samples(0);
  for (int k = 0; k < p.rows(); ++k) {
    const MotionState there = obstacle_.prediction.at(shares_[k] * motion.duration);
    away_.row(k) = p.row(k) - there.p.transpose();
    away_(k, 2) /= obstacle_.height_factor;
    velocity_.row(k) = there.v.transpose();
    maximum_.values()[k] = 1.0 - factor_ * away_.row(k).squaredNorm();
    away_(k, 2) /= obstacle_.height_factor;  // from here on half the slope of the square
  }
  return maximum_.compute(sharpness);
}

void MovingObstacleLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  RobotMotion& motion = motions[first()];
  Samples& gradient = motion.gradient(0);
  for (const auto& [k, share] : maximum_.shares()) {
    const Eigen::RowVector3d by_p = -2.0 * weight * factor_ * share * away_.row(k);
    gradient.row(k) += by_p;
    motion.duration_gradient -= by_p.dot(velocity_.row(k)) * shares_[k];
  }
}

RendezvousLimit::RendezvousLimit(const Problem& problem, std::size_t rendezvous,
                                 const SplineBasis& basis)
    : Constraint(LimitKind::kRendezvous, problem.rendezvous[rendezvous].first,
                 problem.rendezvous[rendezvous].second),
      rendezvous_(problem.rendezvous[rendezvous]),
      item_(rendezvous),
      segment_(basis.segment_of(rendezvous_.fraction)),
      weights_(basis.weights_at(0, segment_, rendezvous_.fraction)) {}

double RendezvousLimit::evaluate(const std::vector<RobotMotion>& motions, double /*sharpness*/) {
  const Eigen::RowVector3d delta =
      weights_.transpose() * (motions[first()].points.middleRows<kOrder>(segment_) -
                              motions[second()].points.middleRows<kOrder>(segment_)) -
      rendezvous_.offset.transpose();
  const double distance = delta.norm();
  direction_ = distance > 0.0 ? Eigen::RowVector3d(delta / distance) : Eigen::RowVector3d::Zero();
  return distance - rendezvous_.tolerance;
}

void RendezvousLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  motions[first()].points_gradient.middleRows<kOrder>(segment_) += weight * weights_ * direction_;
  motions[second()].points_gradient.middleRows<kOrder>(segment_) -= weight * weights_ * direction_;
}

OrderLimit::OrderLimit(const Problem& problem, std::size_t order)
    : Constraint(LimitKind::kOrder, problem.order[order].earlier, problem.order[order].later),
      item_(order),
      gap_(problem.order[order].gap),
      scale_(1.0 / problem.durations[problem.robots[second()].duration].value) {}

double OrderLimit::evaluate(const std::vector<RobotMotion>& motions, double /*sharpness*/) {
  return scale_ * (motions[first()].duration + gap_ - motions[second()].duration);
}

void OrderLimit::pull_back(double weight, std::vector<RobotMotion>& motions) const {
  motions[first()].duration_gradient += weight * scale_;
  motions[second()].duration_gradient -= weight * scale_;
}

}  // namespace trident::trajectories
