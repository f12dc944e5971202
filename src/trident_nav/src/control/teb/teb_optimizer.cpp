// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "teb_problem.h"

namespace trident::nav {
namespace {

// The first pose is where the robot is, the last one where it shall be; the last one's duration
// means nothing.
void fix_ends(std::size_t nodes, NormalEquations* equations) {
  const std::size_t last = (nodes - 1) * kTebVariables;
  for (std::size_t i = 0; i < 3; ++i) equations->fix(i);
  for (std::size_t i = 0; i < kTebVariables; ++i) equations->fix(last + i);
}

// How much of a step may be taken at once: far steps leave the place that the equations hold for,
// and what is cut off of single variables would leave the kinematics.
double share_of(const TebBand& band, const std::vector<double>& step) {
  constexpr double kMaxMove = 0.2;    // [m]
  constexpr double kMaxTurn = 0.4;    // [rad]
  constexpr double kMaxShrink = 0.5;  // of a duration
  double share = 1.0;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const double* const d = &step[i * kTebVariables];
    const double move = std::max(std::fabs(d[0]), std::fabs(d[1]));
    if (share * move > kMaxMove) share = kMaxMove / move;
    if (share * std::fabs(d[2]) > kMaxTurn) share = kMaxTurn / std::fabs(d[2]);
    if (share * std::fabs(d[3]) > kMaxShrink * band[i].dt_s) {
      share = kMaxShrink * band[i].dt_s / std::fabs(d[3]);
    }
  }
  return share;
}

TebBand moved(const TebBand& band, const std::vector<double>& step) {
  const double share = share_of(band, step);
  TebBand result = band;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const double* const d = &step[i * kTebVariables];
    TebNode& node = result[i];
    node.pose.x += share * d[0];
    node.pose.y += share * d[1];
    node.pose.yaw = wrap_angle(node.pose.yaw + share * d[2]);
    if (i + 1 < band.size()) node.dt_s = std::max(node.dt_s + share * d[3], kMinTebDuration_s);
  }
  return result;
}

/// Gauss-Newton steps with damping that grows where they fail (Levenberg 1944, Marquardt 1963). A
/// step that fails because it runs into bounds is first looked for again with these in mind.
class Descent {
 public:
  Descent(TebProblem& problem, TebBand* band) : problem_(problem), band_(band) {}

  void run(int steps, double obstacle_factor);

 private:
  bool try_step(double obstacle_factor);

  static constexpr double kGrowth = 6.0, kDecay = 0.2, kMaxDamping = 1e6;

  TebProblem& problem_;
  TebBand* band_;
  NormalEquations here_, there_;
  TebBand next_;
  std::vector<double> step_;
  TebActiveSet expected_;  ///< The bounds that steps are looked for with.
  double damping_ = 0.01;
};

bool Descent::try_step(double obstacle_factor) {
  fix_ends(band_->size(), &here_);
  if (!here_.solve(damping_, &step_)) return false;
  next_ = moved(*band_, step_);
  problem_.linearize(next_, obstacle_factor, expected_, &there_);
  return there_.cost() < here_.cost();
}

void Descent::run(int steps, double obstacle_factor) {
  constexpr double kConverged = 1e-6;  // of the cost
  constexpr int kMaxGuesses = 3;       // of the bounds that will hold
  expected_.clear();
  problem_.linearize(*band_, obstacle_factor, expected_, &here_);
  int guesses = 0;
  for (int i = 0; i < steps && damping_ < kMaxDamping;) {
    const double before = here_.cost();
    if (try_step(obstacle_factor)) {
      *band_ = next_;
      std::swap(here_, there_);
      damping_ *= kDecay;
      guesses = 0;
      ++i;
      if (before - here_.cost() < kConverged * before) return;
      continue;
    }
    if (guesses < kMaxGuesses) {
      ++guesses;
    } else {
      damping_ *= kGrowth;
      ++i;
    }
    expected_ = problem_.active();
    problem_.linearize(*band_, obstacle_factor, expected_, &here_);
  }
}

}  // namespace

TebCost optimize_band(TebProblem& problem, const TebModel& model, TebBand* band) {
  const TebParams& params = model.params;
  double obstacle_factor = 1.0;
  Descent descent(problem, band);
  for (int i = 0; params.optimization_activate && i < params.no_outer_iterations; ++i) {
    if (params.teb_autosize) resize_band(model.spacing, band);
    problem.associate(*band);
    descent.run(params.no_inner_iterations, obstacle_factor);
    obstacle_factor *= params.weights.adapt_factor;
  }
  NormalEquations equations;
  problem.associate(*band);
  return problem.linearize(*band, 1.0, {}, &equations);
}

}  // namespace trident::nav
