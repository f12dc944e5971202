// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "step_search.h"

#include <algorithm>
#include <cmath>

namespace trident::slam {
namespace {

constexpr double kMinLambda = 1e-6;
/// Damping that was needed is let go of slowly: from nothing it takes a step that is rejected to
/// find each power of two again.
constexpr double kForgottenLambda = 1e-12;
constexpr double kMaxLambda = 1e12;
constexpr double kMinRadiusRatio = 1e-9;

}  // namespace

template <class Group>
StepSearch<Group>::StepSearch(const PoseGraphOptions& options, PoseSystem<Group>& system)
    : options_(options), system_(system), cholesky_(system.symbolic()) {}

/// Minimizes the robust cost by the chosen strategy until a step promises next to nothing,
/// iterations run out, or no step lowers the cost.
template <class Group>
bool StepSearch<Group>::run() {
  if (system_.unknowns() == 0) return true;
  cost_ = system_.cost(system_.poses).robust;
  while (iterations_ < options_.max_iterations) {
    system_.linearize(system_.poses, H_, g_);
    const Outcome outcome = iterate();
    if (outcome != Outcome::kMoved) return outcome == Outcome::kConverged;
  }
  return false;
}

/// What a step that was taken comes to.
template <class Group>
typename StepSearch<Group>::Outcome StepSearch<Group>::outcome_of(double promised) const {
  return is_negligible(promised) ? Outcome::kConverged : Outcome::kMoved;
}

/// Continues from poses whose cost is higher.
template <class Group>
typename StepSearch<Group>::Outcome StepSearch<Group>::accept_worse() {
  has_rejected_ = true;
  cost_ = system_.cost(trial_).robust;
  std::swap(system_.poses, trial_);
  return std::isfinite(cost_) ? Outcome::kMoved : Outcome::kStuck;
}

/// Gauss-Newton takes its step even where that raises the cost; that it has done so lets the other
/// start be tried.
template <class Group>
typename StepSearch<Group>::Outcome StepSearch<Group>::iterate() {
  if (options_.strategy == TrustStrategy::kLevenbergMarquardt) return iterate_damped();
  if (!solve_somehow()) return Outcome::kStuck;
  if (options_.strategy == TrustStrategy::kDogleg) return iterate_dogleg();
  const double promised = promised_by(newton_);
  // Taken all the same, unless there is nothing left to gain.
  if (!try_step(newton_) && !is_negligible(promised)) return accept_worse();
  return outcome_of(promised);
}

template <class Group>
void StepSearch<Group>::relax_damping(double gain) {
  lambda_ *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
  if (lambda_ < kForgottenLambda) lambda_ = 0.0;
  growth_ = 2.0;
}

/// Levenberg-Marquardt with Nielsen's update of the damping (H. B. Nielsen, Damping parameter in
/// Marquardt's method, 1999): it shrinks with the ratio of actual and promised decrease, and grows
/// by doubling factors. A negligible damping is forgotten, so that the last steps are
/// Gauss-Newton's.
template <class Group>
typename StepSearch<Group>::Outcome StepSearch<Group>::iterate_damped() {
  while (iterations_ < options_.max_iterations && lambda_ < kMaxLambda) {
    if (solve(lambda_)) {
      const double promised = promised_by(newton_);
      const double before = cost_;
      if (try_step(newton_)) {
        relax_damping((before - cost_) / promised);
        return outcome_of(promised);
      }
      if (is_negligible(promised)) return Outcome::kConverged;
    }
    has_rejected_ = true;
    lambda_ = std::max(kMinLambda, lambda_ * growth_);
    growth_ *= 2.0;
  }
  return Outcome::kStuck;
}

/// The Gauss-Newton step, or what the trust region lets of it. `downhill`: the step to the minimum
/// along the gradient; empty until it is needed.
template <class Group>
Eigen::VectorXd StepSearch<Group>::step_within_radius(double newton_length,
                                                      Eigen::VectorXd* downhill) const {
  if (newton_length <= radius_) return newton_;
  if (downhill->size() == 0) *downhill = -(g_.squaredNorm() / curvature(g_)) * g_;
  return dogleg_step(*downhill);
}

template <class Group>
void StepSearch<Group>::adapt_radius(double gain, double step_length) {
  if (gain > 0.75) radius_ = std::max(radius_, 3.0 * step_length);
  if (gain < 0.25) radius_ = 0.5 * step_length;
}

/// Powell's dogleg within a trust region, whose radius starts at the first Gauss-Newton step. The
/// system is factorized once per linearization, however often the radius shrinks.
template <class Group>
typename StepSearch<Group>::Outcome StepSearch<Group>::iterate_dogleg() {
  const double newton_length = length(newton_);
  const double promised_in_full = promised_by(newton_);
  if (radius_ < 0.0) radius_ = newton_length;
  Eigen::VectorXd downhill;
  do {
    const Eigen::VectorXd step = step_within_radius(newton_length, &downhill);
    const double promised = promised_by(step);
    const double before = cost_;
    if (try_step(step)) {
      adapt_radius((before - cost_) / promised, length(step));
      return outcome_of(promised_in_full);
    }
    if (is_negligible(promised)) return Outcome::kConverged;
    has_rejected_ = true;
    radius_ = 0.5 * std::min(radius_, length(step));
    if (radius_ < kMinRadiusRatio * newton_length) return Outcome::kStuck;
  } while (++iterations_ < options_.max_iterations);
  return Outcome::kMoved;
}

/// Damping multiplies the diagonal (Marquardt's scaling), so that it does not depend on units.
template <class Group>
bool StepSearch<Group>::solve(double lambda) {
  ++iterations_;
  const BlockMatrix<kDimension>* matrix = &H_;
  if (lambda > 0.0) {
    damped_ = H_;
    for (auto& block : damped_.diagonal) block.diagonal() *= 1.0 + lambda;
    matrix = &damped_;
  }
  if (!cholesky_.factorize(*matrix)) return false;
  newton_ = -g_;
  cholesky_.solve(newton_);
  return newton_.allFinite();
}

/// A system that is singular within rounding, such as one with a vertex of zero information, gets
/// the least damping that makes it positive definite.
template <class Group>
bool StepSearch<Group>::solve_somehow() {
  if (solve(0.0)) return true;
  for (double lambda = kMinLambda; lambda < kMaxLambda; lambda *= 100.0) {
    if (solve(lambda)) return true;
  }
  return false;
}

/// Scaled by the Hessian's diagonal, as steps have parts in metres and in radians.
template <class Group>
double StepSearch<Group>::length(const Eigen::VectorXd& step) const {
  double sum = 0.0;
  for (int k = 0; k < system_.unknowns(); ++k) {
    const auto part = step.template segment<kDimension>(kDimension * k);
    sum += part.cwiseAbs2().dot(H_.diagonal[k].diagonal());
  }
  return std::sqrt(sum);
}

/// s' H s, from the blocks of one triangle.
template <class Group>
double StepSearch<Group>::curvature(const Eigen::VectorXd& step) const {
  const auto part = [&step](int k) { return step.template segment<kDimension>(kDimension * k); };
  double sum = 0.0;
  for (int k = 0; k < system_.unknowns(); ++k) sum += part(k).dot(H_.diagonal[k] * part(k));
  for (std::size_t k = 0; k < system_.pairs().size(); ++k) {
    const auto [i, j] = system_.pairs()[k];
    sum += 2.0 * part(i).dot(H_.pairs[k] * part(j));
  }
  return sum;
}

template <class Group>
Eigen::VectorXd StepSearch<Group>::dogleg_step(const Eigen::VectorXd& downhill) const {
  const double downhill_length = length(downhill);
  if (downhill_length >= radius_) return (radius_ / downhill_length) * downhill;
  // |downhill + t (newton - downhill)| = radius; the length is a norm of weighted squares.
  const Eigen::VectorXd to_newton = newton_ - downhill;
  const double a = std::pow(length(to_newton), 2);
  const double both = std::pow(length(downhill + to_newton), 2);
  const double b = 0.5 * (both - a - downhill_length * downhill_length);
  const double c = downhill_length * downhill_length - radius_ * radius_;
  const double t = (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
  return downhill + t * to_newton;
}

/// Decrease of the quadratic model: -(2 g's + s'H s), the cost being the whole square without 1/2.
template <class Group>
double StepSearch<Group>::promised_by(const Eigen::VectorXd& step) const {
  return -2.0 * g_.dot(step) - curvature(step);
}

/// Keeps the step if the robust cost does not rise; NaN counts as a rise.
template <class Group>
bool StepSearch<Group>::try_step(const Eigen::VectorXd& step) {
  system_.move(system_.poses, step, trial_);
  const double cost = system_.cost(trial_).robust;
  if (!(cost <= cost_)) return false;
  cost_ = cost;
  std::swap(system_.poses, trial_);
  return true;
}

template <class Group>
bool StepSearch<Group>::is_negligible(double promised) const {
  return promised <= options_.relative_tolerance * cost_ + options_.absolute_tolerance;
}

template class StepSearch<SE2>;
template class StepSearch<SE3>;

}  // namespace trident::slam
