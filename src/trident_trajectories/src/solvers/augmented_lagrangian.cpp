// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "solvers/augmented_lagrangian.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::trajectories {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFirstPenalty = 10.0, kGreatestPenalty = 1e6;
constexpr double kNearPenalty = 100.0;  // of a beginning that is feasible, or nearly so
constexpr double kPenaltyGrowth = 4.0;
constexpr double kEnoughProgress = 0.4;  // of the violation, or the penalty grows
constexpr double kGreatestMultiplier = 1e4;
constexpr double kFeasible = 3e-4;         // of g, for what is judged between samples afterwards
constexpr double kRoughlyFeasible = 3e-3;  // before limits have been moved by what is between
constexpr double kFirstTolerance = 1e-3;   // of the Lagrangian, relative
constexpr double kStiffPenalty = 500.0;
constexpr int kStuck = 3;              // renewals without progress at a stiff penalty
constexpr int kInnerEvaluations = 60;  // before multipliers are renewed

}  // namespace

double AugmentedLagrangian::objective(unsigned /*n*/, const double* x, double* gradient,
                                      void* self) {
  auto& own = *static_cast<AugmentedLagrangian*>(self);
  ++own.evaluations_;
  return own.program_->lagrangian(x, own.multipliers_.data(), own.penalty_, gradient);
}

void AugmentedLagrangian::begin(Program& program) {
  program_ = &program;
  evaluations_ = 0;
  if (lbfgs_) return;
  const unsigned variables = static_cast<unsigned>(program.decision().variables());
  lbfgs_.emplace(nlopt::LD_LBFGS, variables);
  lbfgs_->set_min_objective(objective, this);
  lbfgs_->set_lower_bounds(program.decision().lower());
  lbfgs_->set_upper_bounds(program.decision().upper());
  multipliers_.assign(program.constraints(), 0.0);
  penalty_ = begins_near_ ? kNearPenalty : kFirstPenalty;
  worst_ = kInfinity;
}

bool AugmentedLagrangian::descend(std::vector<double>& x, int evaluations, double tolerance) {
  double cost = 0.0;
  lbfgs_->set_ftol_rel(tolerance);
  lbfgs_->set_maxeval(std::max(1, evaluations));
  try {
    return lbfgs_->optimize(x, cost) != nlopt::MAXEVAL_REACHED;
  } catch (const nlopt::roundoff_limited&) {
    // As near to the minimum as doubles allow.
  } catch (const std::runtime_error&) {
    // L-BFGS reports a step that does not descend so; x is the best so far.
  }
  return true;
}

void AugmentedLagrangian::update(double worst) {
  const std::vector<double>& values = program_->values();
  for (std::size_t i = 0; i < multipliers_.size(); ++i)
    multipliers_[i] = std::clamp(multipliers_[i] + penalty_ * values[i], 0.0, kGreatestMultiplier);
  if (worst > kFeasible && worst > kEnoughProgress * std::max(worst_, kFeasible))
    penalty_ = std::min(kPenaltyGrowth * penalty_, kGreatestPenalty);
  worst_ = worst;
}

int AugmentedLagrangian::minimize(Program& program, std::vector<double>& x, int max_evaluations) {
  begin(program);
  const bool is_first = worst_ == kInfinity;
  const double feasible = is_first || begins_near_ ? kRoughlyFeasible : kFeasible;
  worst_ = kInfinity;
  int stuck = 0;
  for (double tolerance = kFirstTolerance; evaluations_ < max_evaluations && stuck < kStuck;) {
    const int allowed = std::min(kInnerEvaluations, max_evaluations - evaluations_);
    const bool is_minimum = descend(x, allowed, tolerance);
    program.constrain(x.data(), nullptr, nullptr);
    const double worst = *std::max_element(program.values().begin(), program.values().end());
    const bool is_done = is_minimum && worst < feasible && tolerance < (is_first ? 1e-3 : 1e-4);
    stuck = penalty_ >= kStiffPenalty && worst > kEnoughProgress * worst_ ? stuck + 1 : 0;
    update(worst);
    if (is_done) break;
    tolerance = std::max(1e-5, 0.3 * tolerance);
  }
  return evaluations_;
}

double AugmentedLagrangian::slack_price(const std::vector<double>& values) const {
  double price = 0.0;
  for (std::size_t i = 0; i < multipliers_.size(); ++i)
    price += multipliers_[i] * std::abs(values[i]);
  return price;
}

}  // namespace trident::trajectories
