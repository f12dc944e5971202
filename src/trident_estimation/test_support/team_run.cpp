// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "team_run.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace trident::estimation {
namespace {

void judge(const Filter& filter, const Eigen::VectorXd& truth, TeamRun& result) {
  result.nees.push_back(nees(filter, truth));
  for (std::size_t robot = 0; robot < 3; ++robot) {
    const double error = position_error(filter, truth, robot);
    result.square_error[robot] += error * error;
    result.worst_error[robot] = std::max(result.worst_error[robot], error);
  }
}

void judge(const std::vector<Outcome>& outcomes, TeamRun& result) {
  for (const Outcome& outcome : outcomes) {
    if (outcome.kind == Outcome::Kind::kRefused) continue;
    result.nis.emplace_back(outcome.normalized_squared,
                            static_cast<int>(outcome.innovation.size()));
  }
}

}  // namespace

double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TeamRun run(const TeamScene& scene, const RunOptions& options) {
  TeamRun result;
  History history(first_belief(scene, options.kind), SimTime::from_seconds(1.0), TrustParams{});
  auto next = scene.measurements.begin();
  for (std::size_t tick = 1; tick < scene.truth.size(); ++tick) {
    std::vector<Measurement> due;
    for (; next != scene.measurements.end() && next->stamp <= tick_time(tick); ++next) {
      if (options.uses && !options.uses(next->source)) continue;
      due.push_back(*next);
      if (!options.has_gates) due.back().gate.reset();
    }
    const double start_s = thread_cpu_s();
    const std::vector<Outcome> outcomes = history.add_all(std::move(due));
    const Filter filter = history.at(tick_time(tick)).value();
    result.cpu_s += thread_cpu_s() - start_s;
    if (tick_time(tick).seconds() < options.judged_from) continue;
    judge(filter, scene.truth[tick], result);
    judge(outcomes, result);
  }
  for (double& square : result.square_error) square /= static_cast<double>(result.nees.size());
  result.reports = history.reports();
  result.state = history.newest().state();
  result.covariance = history.newest().covariance();
  return result;
}

}  // namespace trident::estimation
