// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/optimize.h"

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

#include "priorities.h"
#include "relaxation.h"
#include "search.h"
#include "starts.h"
#include "trident_base/error.h"
#include "trident_trajectories/certificate.h"

namespace trident::trajectories {
namespace {

using Basis = std::shared_ptr<const SplineBasis>;

/// One place to begin at.
struct Begin {
  std::string name;
  std::vector<double> x;
};

void check_options(const Problem& problem, const OptimizeOptions& options) {
  make_solver(options.method);
  const auto check = [](bool is_legal, const char* field, double value, const char* legal) {
    if (!is_legal)
      throw Error(std::string("options: ") + field + " is " + std::to_string(value) +
                  "; legal is " + legal);
  };
  check(options.segments >= 4 && options.segments <= 60, "segments", options.segments, "4 ... 60");
  check(options.threads >= 1, "threads", options.threads, ">= 1");
  check(options.max_evaluations >= 1, "max_evaluations", options.max_evaluations, ">= 1");
  check(options.tolerance > 0.0 && options.tolerance < 0.1, "tolerance", options.tolerance,
        "> 0, < 0.1");
  check(options.warm_start.empty() || options.warm_start.size() == problem.robots.size(),
        "number of warm_start", static_cast<double>(options.warm_start.size()),
        "0, or one a robot");
}

std::vector<Begin> begins_of(const std::vector<Start>& starts, const Problem& problem,
                             const Basis& basis, const OptimizeOptions& options) {
  Program program(problem, basis);
  std::vector<Begin> out;
  for (const Start start : starts) {
    std::vector<double> x = start == Start::kPriorities
                                ? priorities_start(problem, basis, options)
                                : start_of(start, program, *basis, options.seed);
    const bool is_new =
        std::none_of(out.begin(), out.end(), [&](const Begin& other) { return other.x == x; });
    if (is_new) out.push_back({name_of(start), std::move(x)});
  }
  return out;
}

std::vector<Begin> warm_begin(const Problem& problem, const Basis& basis,
                              const OptimizeOptions& options) {
  std::vector<ControlPoints> points;
  std::vector<double> durations;
  for (const Duration& duration : problem.durations) durations.push_back(duration.value);
  for (std::size_t i = 0; i < options.warm_start.size(); ++i) {
    const Trajectory& trajectory = options.warm_start[i];
    if (trajectory.basis().segments() != basis->segments()) return {};
    points.push_back(trajectory.control_points());
    durations[problem.robots[i].duration] = trajectory.duration();
  }
  Decision decision(problem, basis);
  std::vector<double> x(decision.variables(), 0.0);
  decision.fit(points, durations, x.data());
  return {{"warm", std::move(x)}};
}

/// All results, in the order of the beginnings, whatever the number of threads is.
std::vector<Found> search_all(const std::vector<Begin>& begins, const Problem& problem,
                              const Basis& basis, const OptimizeOptions& options) {
  std::vector<Found> out(begins.size());
  const auto worker = [&](std::size_t first) {
    for (std::size_t i = first; i < begins.size(); i += options.threads)
      out[i] = search(problem, basis, options, begins[i].x);
  };
  std::vector<std::future<void>> others;
  for (int thread = 1; thread < options.threads; ++thread)
    others.push_back(std::async(std::launch::async, worker, thread));
  worker(0);
  for (std::future<void>& other : others) other.get();
  return out;
}

bool is_better(const Found& a, const Found& b) {
  if (a.is_feasible != b.is_feasible) return a.is_feasible;
  return a.is_feasible ? a.cost < b.cost : a.worst < b.worst;
}

/// Keeps the best so far, and adds up evaluations.
struct Best {
  Found found;
  std::string start;
  int evaluations = 0;

  void take(const std::vector<Begin>& begins, const std::vector<Found>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      evaluations += results[i].evaluations;
      if (!start.empty() && !is_better(results[i], found)) continue;
      found = results[i];
      start = begins[i].name;
    }
  }
};

Best look_for_best(const Problem& problem, const Basis& basis, const OptimizeOptions& options) {
  Best best;
  if (!options.warm_start.empty()) {
    const std::vector<Begin> begins = warm_begin(problem, basis, options);
    best.take(begins, search_all(begins, problem, basis, options));
    if (best.found.is_feasible) return best;
  }
  std::vector<std::vector<Start>> rounds = {options.starts};
  if (options.use_fallbacks) rounds.push_back({Start::kStraight, Start::kPriorities});
  for (const std::vector<Start>& starts : rounds) {
    const std::vector<Begin> begins = begins_of(starts, problem, basis, options);
    best.take(begins, search_all(begins, problem, basis, options));
    if (best.found.is_feasible) break;
  }
  return best;
}

}  // namespace

Solution optimize(const Problem& problem, const OptimizeOptions& options) {
  validate(problem);
  check_options(problem, options);
  const Basis basis = std::make_shared<SplineBasis>(options.segments);
  const Best best = look_for_best(problem, basis, options);
  Program program(problem, basis);
  Solution out;
  out.is_feasible = best.found.is_feasible;
  out.cost = program.cost(best.found.x.data(), nullptr);
  out.trajectories = program.trajectories(best.found.x.data());
  for (const Trajectory& trajectory : out.trajectories) out.jerk += squared_jerk(trajectory);
  out.start = best.start;
  out.evaluations = best.evaluations;
  if (out.is_feasible) return out;
  out.violations = violations(problem, out.trajectories);
  if (out.violations.empty()) return out;
  out.message = options.explain ? explain(problem, options, out.violations)
                                : describe(out.violations.front(), problem);
  return out;
}

}  // namespace trident::trajectories
