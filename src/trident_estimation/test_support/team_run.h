// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "team_scene.h"
#include "trident_estimation/filter/history.h"

namespace trident::estimation {

/// How a scene is filtered.
struct RunOptions {
  FilterKind kind = FilterKind::kEkf;
  double judged_from = 0.0;  ///< errors count from then on [s]
  bool has_gates = true;     ///< without, all measurements are used
  /// Which sources are used; empty: all.
  std::function<bool(const std::string& source)> uses;
};

/// What a filter made of a scene.
struct TeamRun {
  std::vector<double> nees;              ///< of all degrees of freedom, at each judged tick
  std::array<double, 3> square_error{};  ///< of positions, mean over judged ticks [m^2], by robot
  std::array<double, 3> worst_error{};   ///< of positions over judged ticks [m], by robot
  std::vector<std::pair<double, int>> nis;  ///< of each judged measurement, with its size
  double cpu_s = 0.0;                       ///< of the thread, without the scene's own
  std::map<std::string, SourceReport> reports;
  Eigen::VectorXd state;       ///< at the end
  Eigen::MatrixXd covariance;  ///< at the end
};

/// All measurements tick by tick, as a node takes them in, and what is believed at each tick.
TeamRun run(const TeamScene& scene, const RunOptions& options);

/// CPU time of this thread [s].
double thread_cpu_s();

}  // namespace trident::estimation
