// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "starts.h"

namespace trident::trajectories {
namespace {

constexpr int kRounds = 12;           // of looking between samples
constexpr double kHopeless = 0.1;     // violation after which a start is given up
constexpr double kGain = 5e-4;        // of the cost, that is not worth another round
constexpr double kWarmMargin = 2e-2;  // of a plan that must be found at once and is soon replaced

std::vector<Peak> peaks_of(const Program& program, const std::vector<Trajectory>& trajectories) {
  const HullCheck check(program.problem(), trajectories);
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < program.constraints(); ++i)
    peaks.push_back(check.peak(program.constraint(i)));
  return peaks;
}

double worst_of(const Program& program, const std::vector<Peak>& peaks) {
  double worst = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < peaks.size(); ++i)
    worst = std::max(worst, relative_excess(program.constraint(i).limit(), peaks[i].value));
  return worst;
}

/// Moves each limit so that the smooth maximum of samples stands for the true one between them,
/// plus a margin that an optimizer may miss it by, which grows from round to round. Returns what
/// constraints truly are.
std::vector<double> shift(Program& program, const std::vector<Peak>& peaks, double margin) {
  std::vector<double> values = program.values();
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (peaks[i].value <= kPeakFloor) continue;
    program.shifts[i] += values[i] - (peaks[i].value + margin);
    values[i] = peaks[i].value;
  }
  return values;
}

}  // namespace

double relative_excess(LimitKind kind, double g) {
  switch (kind) {
    case LimitKind::kVelocity:
    case LimitKind::kAcceleration:
    case LimitKind::kJerk:
    case LimitKind::kTurnRate:
    case LimitKind::kTurningRadius:
      return std::sqrt(std::max(0.0, 1.0 + g)) - 1.0;
    case LimitKind::kSeparation:
    case LimitKind::kMovingObstacle:
      return 1.0 - std::sqrt(std::max(0.0, 1.0 - g));
    default:
      return g;
  }
}

Found search(const Problem& problem, const std::shared_ptr<const SplineBasis>& basis,
             const OptimizeOptions& options, std::vector<double> x) {
  Program program(problem, basis);
  const std::unique_ptr<Solver> solver = make_solver(options.method);
  const bool is_warm = !options.warm_start.empty();
  if (is_warm) solver->begin_near();
  Found best{false, std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity(), x, 0};
  double margin = is_warm ? kWarmMargin : options.tolerance;
  for (int round = 0; round < kRounds && best.evaluations < options.max_evaluations; ++round) {
    best.evaluations += solver->minimize(program, x, options.max_evaluations - best.evaluations);
    const double cost = program.cost(x.data(), nullptr);
    const std::vector<Peak> peaks = peaks_of(program, program.trajectories(x.data()));
    program.constrain(x.data(), nullptr, nullptr);
    const double worst = worst_of(program, peaks);
    const bool is_feasible = worst <= options.tolerance;
    const double before = best.cost;
    if (is_feasible ? !best.is_feasible || cost < best.cost
                    : !best.is_feasible && worst < best.worst)
      best = {is_feasible, cost, worst, x, best.evaluations};
    const std::vector<double> values = shift(program, peaks, margin);
    margin *= 2.0;
    const bool is_tight = solver->slack_price(values) < kGain * cost;
    const bool is_still = std::abs(before - cost) < 0.5 * kGain * cost;
    if (is_feasible && (is_warm || is_tight || is_still)) break;
    if (worst > kHopeless && round > 0) break;
  }
  return best;
}

Found search_from(Start start, const Problem& problem,
                  const std::shared_ptr<const SplineBasis>& basis, const OptimizeOptions& options) {
  Program program(problem, basis);
  return search(problem, basis, options, start_of(start, program, *basis, options.seed));
}

}  // namespace trident::trajectories
