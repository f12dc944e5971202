// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "relaxation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include "trident_base/is_one_of.h"

namespace trident::trajectories {
namespace {

constexpr double kGreatestFactor = 16.0;   // by which a limit is changed
constexpr double kPrecision = 0.01;        // of the factor
constexpr int kAttemptEvaluations = 1000;  // of one attempt
constexpr std::size_t kCandidates = 3;     // limits that are tried

/// Limits of one kind and their robots.
struct Candidate {
  LimitKind limit;
  std::set<std::size_t> robots;
  std::optional<double> factor;  ///< least change that is enough
};

void relax_robot(LimitKind limit, double factor, Limits& limits) {
  switch (limit) {
    case LimitKind::kVelocity:
      limits.max_velocity *= factor;
      break;
    case LimitKind::kAcceleration:
      limits.max_acceleration *= factor;
      break;
    case LimitKind::kJerk:
      limits.max_jerk *= factor;
      break;
    case LimitKind::kTurnRate:
      limits.max_turn_rate *= factor;
      break;
    case LimitKind::kTurningRadius:
      limits.min_turning_radius /= factor;
      break;
    case LimitKind::kThrust:
      limits.max_thrust *= factor;
      break;
    case LimitKind::kReverseThrust:
      limits.max_reverse_thrust *= factor;
      break;
    case LimitKind::kSeparation:
    case LimitKind::kObstacle:
    case LimitKind::kMovingObstacle:
      limits.collision_radius /= factor;
      break;
    case LimitKind::kHeight:
    case LimitKind::kRendezvous:
    case LimitKind::kOrder:
      break;  // of the team, below
  }
}

Problem relaxed(const Problem& problem, const Candidate& candidate, double factor) {
  Problem out = problem;
  for (const std::size_t robot : candidate.robots)
    relax_robot(candidate.limit, factor, out.robots[robot].limits);
  if (candidate.limit == LimitKind::kRendezvous)
    for (Rendezvous& rendezvous : out.rendezvous) rendezvous.tolerance *= factor;
  if (candidate.limit == LimitKind::kHeight) out.min_height -= factor - 1.0;  // [m]
  if (candidate.limit == LimitKind::kOrder)
    for (ArrivalOrder& order : out.order) order.gap /= factor;
  return out;
}

Problem slower(const Problem& problem, double factor) {
  Problem out = problem;
  for (Duration& duration : out.durations) {
    duration.value *= factor;
    duration.max *= factor;
  }
  return out;
}

/// The least factor > 1 that makes a problem feasible, to kPrecision; none up to kGreatestFactor.
template <class Change>
std::optional<double> least_factor(const OptimizeOptions& options, double guess, Change change) {
  const auto is_feasible = [&](double factor) {
    return optimize(change(factor), options).is_feasible;
  };
  double low = 1.0, high = std::clamp(1.1 * guess, 1.02, kGreatestFactor);
  while (!is_feasible(high)) {
    if (high >= kGreatestFactor) return std::nullopt;
    low = high;
    high = std::min(kGreatestFactor, high * high);
  }
  while (high / low > 1.0 + kPrecision) {
    const double middle = std::sqrt(low * high);
    (is_feasible(middle) ? high : low) = middle;
  }
  return high;
}

std::vector<Candidate> candidates_of(const std::vector<Violation>& found, double tolerance) {
  std::vector<Candidate> out;
  for (const Violation& violation : found) {
    if (violation.relative <= tolerance) continue;
    auto known = std::find_if(out.begin(), out.end(),
                              [&](const Candidate& c) { return c.limit == violation.limit; });
    if (known == out.end()) {
      if (out.size() == kCandidates) continue;
      out.push_back({violation.limit, {}, std::nullopt});
      known = std::prev(out.end());
    }
    known->robots.insert(violation.robots.begin(), violation.robots.end());
  }
  return out;
}

/// Limits whose bound is the least legal value.
constexpr LimitKind kMinimumBounds[] = {LimitKind::kSeparation, LimitKind::kObstacle,
                                        LimitKind::kMovingObstacle, LimitKind::kTurningRadius,
                                        LimitKind::kOrder};

/// A limit's value after a change, as it is written in a message.
double changed(const Violation& violation, double factor) {
  if (violation.limit == LimitKind::kHeight) return violation.bound - (factor - 1.0);
  const bool shrinks = is_one_of(violation.limit, kMinimumBounds);
  return shrinks ? violation.bound / factor : violation.bound * factor;
}

void put_first(LimitKind limit, std::vector<Violation>& found) {
  std::stable_partition(found.begin(), found.end(),
                        [&](const Violation& violation) { return violation.limit == limit; });
}

/// The candidate that alone makes the problem feasible with the least factor; nullptr: none does.
const Candidate* least_change(const std::vector<Candidate>& candidates) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates) {
    if (!candidate.factor) continue;
    if (best == nullptr || *candidate.factor < *best->factor) best = &candidate;
  }
  return best;
}

/// What makes the problem feasible: one limit's change, or a longer duration.
std::string remedy(const Violation& violation, const Candidate* change,
                   const std::optional<double>& longer) {
  std::ostringstream text;
  text.precision(4);
  if (change == nullptr && !longer)
    text << "; no change of one limit up to a factor of " << kGreatestFactor << " is enough";
  if (change != nullptr)
    text << "; feasible with " << name_of(change->limit) << " "
         << changed(violation, *change->factor);
  if (longer)
    text << (change != nullptr ? ", or" : "; feasible") << " with " << *longer
         << " times the duration";
  return text.str();
}

}  // namespace

std::string explain(const Problem& problem, const OptimizeOptions& options,
                    std::vector<Violation>& found) {
  OptimizeOptions quick = options;
  quick.explain = false;
  quick.use_fallbacks = false;
  quick.starts = {Start::kSwirlLeft, Start::kSwirlLayers};
  quick.max_evaluations = std::min(options.max_evaluations, kAttemptEvaluations);
  const double guess = 1.0 + std::max(0.0, found.front().relative);
  std::vector<Candidate> candidates = candidates_of(found, options.tolerance);
  for (Candidate& candidate : candidates) {
    candidate.factor = least_factor(
        quick, guess, [&](double factor) { return relaxed(problem, candidate, factor); });
  }
  const Candidate* const best = least_change(candidates);
  if (best != nullptr) put_first(best->limit, found);
  const auto longer =
      least_factor(quick, guess, [&](double factor) { return slower(problem, factor); });
  return describe(found.front(), problem) + remedy(found.front(), best, longer);
}

}  // namespace trident::trajectories
