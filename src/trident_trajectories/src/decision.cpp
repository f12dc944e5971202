// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "decision.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trident::trajectories {
namespace {

constexpr double kJerkOfOneMeter = 720.0;  // of the least jerk from rest to rest, times T^5 [m^2]
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The rows of control points that the ends fix.
Eigen::MatrixXd end_columns(const Eigen::MatrixXd& gram, int free_points) {
  Eigen::MatrixXd columns(free_points, 2 * kEndPoints);
  columns << gram.block(kEndPoints, 0, free_points, kEndPoints),
      gram.block(kEndPoints, kEndPoints + free_points, free_points, kEndPoints);
  return columns;
}

}  // namespace

Decision::Decision(const Problem& problem, std::shared_ptr<const SplineBasis> basis)
    : problem_(problem), basis_(std::move(basis)) {
  const int free = basis_->free_points();
  const Eigen::MatrixXd gram = basis_->jerk_gram().block(kEndPoints, kEndPoints, free, free);
  const Eigen::LLT<Eigen::MatrixXd> llt(gram);
  from_ends_ = -llt.solve(end_columns(basis_->jerk_gram(), free));
  to_x_ = llt.matrixU();
  from_x_ = to_x_.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(free, free));
  add_variables();
  set_scales();
}

/// A free one has a variable, the logarithm of its ratio to the guess.
void Decision::add_duration(const Duration& duration) {
  durations_.push_back(duration.value);
  duration_offset_.push_back(duration.is_free ? variables_++ : -1);
  if (!duration.is_free) return;
  lower_.push_back(duration.min > 0.0 ? std::log(duration.min / duration.value) : -std::log(10.0));
  upper_.push_back(duration.max > 0.0 ? std::log(duration.max / duration.value) : std::log(10.0));
}

void Decision::add_variables() {
  for (std::size_t i = 0; i < problem_.robots.size(); ++i) {
    robot_offset_.push_back(variables_);
    variables_ += basis_->free_points() * axes(i);
  }
  for (std::size_t i = 0; i < problem_.places.size(); ++i, variables_ += 3)
    place_offset_.push_back(variables_);
  lower_.assign(variables_, -kUnbounded);
  upper_.assign(variables_, kUnbounded);
  for (const Duration& duration : problem_.durations) add_duration(duration);
  x_.assign(variables_, 0.0);
}

void Decision::set_scales() {
  scales_.assign(problem_.robots.size(), 0.0);  // so that apply() gives the undisturbed path
  std::vector<RobotMotion> motions(problem_.robots.size(), RobotMotion(basis_));
  apply(x_.data(), 0, motions);
  jerk_scale_ = 0.0;
  double longest = 0.0;
  for (const RobotMotion& motion : motions) {
    const double of_one_meter = kJerkOfOneMeter / std::pow(motion.duration, 5);
    jerk_scale_ += std::max(of_one_meter, undisturbed_jerk(motion.points, motion.duration));
    longest = std::max(longest, motion.duration);
  }
  for (std::size_t i = 0; i < motions.size(); ++i)
    scales_[i] = std::sqrt(std::pow(motions[i].duration, 5) * jerk_scale_);
  place_scale_ = std::sqrt(std::pow(longest, 5) * jerk_scale_ /
                           (kJerkOfOneMeter * static_cast<double>(motions.size())));
}

double Decision::undisturbed_jerk(const ControlPoints& points, double duration) const {
  return points.cwiseProduct(basis_->jerk_gram() * points).sum() / std::pow(duration, 5);
}

int Decision::axes(std::size_t robot) const {
  return problem_.robots[robot].kind == Kind::kUav ? 3 : 2;
}

Decision::End Decision::end_of(std::size_t robot, double duration, const double* x) const {
  const Goal& goal = problem_.robots[robot].goal;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  End end{goal.state.p, goal.state.v, goal.state.a, zero, zero, zero};
  if (goal.deck) {
    const MotionState deck = goal.deck->at(duration);
    end.p += deck.p;
    end.v += deck.v;
    end.a += deck.a;
    end.dp = deck.v;
    end.dv = deck.a;
    end.da = goal.deck->jerk(duration);
  }
  if (goal.place >= 0) {
    const double* place = x + place_offset_[goal.place];
    for (int axis = 0; axis < axes(robot); ++axis)
      end.p[axis] += problem_.places[goal.place][axis] + place_scale_ * place[axis];
  }
  if (axes(robot) < 3) end.p.z() = problem_.robots[robot].start.p.z();
  return end;
}

void Decision::set_ends(std::size_t robot, const End& end, RobotMotion& motion) const {
  const MotionState& start = problem_.robots[robot].start;
  const auto [d1, d2] = basis_->end_velocity();
  const double d3 = basis_->end_acceleration(), T = motion.duration;
  const int last = basis_->control_points() - 1;
  motion.points.row(0) = start.p;
  motion.points.row(1) = start.p + d1 * T * start.v;
  motion.points.row(2) = start.p + d2 * T * start.v + d3 * T * T * start.a;
  motion.points.row(last) = end.p;
  motion.points.row(last - 1) = end.p - d1 * T * end.v;
  motion.points.row(last - 2) = end.p - d2 * T * end.v + d3 * T * T * end.a;
}

void Decision::apply(const double* x, int highest, std::vector<RobotMotion>& motions) {
  std::copy(x, x + variables_, x_.begin());
  for (std::size_t i = 0; i < durations_.size(); ++i)
    if (duration_offset_[i] >= 0)
      durations_[i] = problem_.durations[i].value * std::exp(x[duration_offset_[i]]);
  const auto longest = std::max_element(durations_.begin(), durations_.end());
  last_ = static_cast<std::size_t>(longest - durations_.begin());
  horizon_ = *longest;
  const int free = basis_->free_points(), last = basis_->control_points() - kEndPoints;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    RobotMotion& motion = motions[i];
    motion.duration = durations_[problem_.robots[i].duration];
    set_ends(i, end_of(i, motion.duration, x), motion);
    ends_ << motion.points.topRows<kEndPoints>(), motion.points.middleRows<kEndPoints>(last);
    auto inner = motion.points.middleRows(kEndPoints, free);
    inner.noalias() = from_ends_ * ends_;
    const Eigen::Map<const Eigen::MatrixXd> own(x + robot_offset_[i], free, axes(i));
    inner.leftCols(axes(i)).noalias() += scales_[i] * from_x_.lazyProduct(own);
    motion.update(highest, horizon_);
  }
}

double Decision::duration_pull(std::size_t robot, const End& end, const RobotMotion& motion,
                               const Eigen::Matrix<double, 6, 3>& g) const {
  const MotionState& start = problem_.robots[robot].start;
  const auto [d1, d2] = basis_->end_velocity();
  const double d3 = basis_->end_acceleration(), T = motion.duration;
  const Eigen::Vector3d dv = end.v + T * end.dv, da = 2.0 * T * end.a + T * T * end.da;
  double sum = g.row(1).dot(d1 * start.v) + g.row(2).dot(d2 * start.v + 2.0 * d3 * T * start.a);
  sum += g.row(5).dot(end.dp) + g.row(4).dot(end.dp - d1 * dv);
  return sum + g.row(3).dot(end.dp - d2 * dv + d3 * da);
}

void Decision::pull_back_robot(std::size_t robot, RobotMotion& motion, const double* x,
                               double* gradient) {
  const int free = basis_->free_points(), last = basis_->control_points() - kEndPoints;
  motion.pull_back();
  const auto inner = motion.points_gradient.middleRows(kEndPoints, free);
  Eigen::Map<Eigen::MatrixXd> own(gradient + robot_offset_[robot], free, axes(robot));
  own.noalias() += scales_[robot] * from_x_.transpose().lazyProduct(inner.leftCols(axes(robot)));
  ends_ << motion.points_gradient.topRows<kEndPoints>(),
      motion.points_gradient.middleRows<kEndPoints>(last);
  ends_.noalias() += from_ends_.transpose().lazyProduct(inner);
  const std::size_t duration = problem_.robots[robot].duration;
  if (duration_offset_[duration] >= 0) {
    const End end = end_of(robot, motion.duration, x);
    const double by_duration = motion.duration_gradient + duration_pull(robot, end, motion, ends_);
    gradient[duration_offset_[duration]] += by_duration * motion.duration;
  }
  if (duration_offset_[last_] >= 0)
    gradient[duration_offset_[last_]] += motion.horizon_gradient * horizon_;
  const int place = problem_.robots[robot].goal.place;
  for (int axis = 0; place >= 0 && axis < axes(robot); ++axis)
    gradient[place_offset_[place] + axis] +=
        place_scale_ * ends_.bottomRows<kEndPoints>().col(axis).sum();
}

void Decision::pull_back(std::vector<RobotMotion>& motions, const std::vector<char>& robots,
                         double* gradient) {
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (robots[i]) pull_back_robot(i, motions[i], x_.data(), gradient);
}

void Decision::add_offset(std::size_t robot, const Eigen::Matrix<double, Eigen::Dynamic, 3>& offset,
                          double* x) const {
  const int free = basis_->free_points();
  Eigen::Map<Eigen::MatrixXd> own(x + robot_offset_[robot], free, axes(robot));
  own += to_x_ * offset.leftCols(axes(robot)) / scales_[robot];
}

void Decision::fit(const std::vector<ControlPoints>& points, const std::vector<double>& durations,
                   double* x) const {
  std::fill(x, x + variables_, 0.0);
  for (std::size_t i = 0; i < durations.size(); ++i)
    if (duration_offset_[i] >= 0)
      x[duration_offset_[i]] = std::clamp(std::log(durations[i] / problem_.durations[i].value),
                                          lower_[duration_offset_[i]], upper_[duration_offset_[i]]);
  Decision shaped = *this;
  std::vector<RobotMotion> motions(points.size(), RobotMotion(basis_));
  shaped.apply(x, 0, motions);
  for (std::size_t i = 0; i < points.size(); ++i)
    add_offset(i,
               points[i].middleRows(kEndPoints, basis_->free_points()) -
                   motions[i].points.middleRows(kEndPoints, basis_->free_points()),
               x);
}

}  // namespace trident::trajectories
