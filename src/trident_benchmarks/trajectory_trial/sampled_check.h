// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "trident_trajectories/problem.h"
#include "trident_trajectories/trajectory.h"

namespace trident::benchmarks {

/// Position, velocity, acceleration and jerk of a robot at a time.
struct Instant {
  Eigen::Vector3d p, v, a, j;
};
/// A robot's path, by whatever planner it was made.
using Path = std::function<Instant(double)>;

/// The optimizer's trajectory as a path.
Path path_of(const trajectories::Trajectory& trajectory);

/// By how much a robot misses its own limits at an instant, relative; negative within. Written
/// from the definitions of the limits, without the optimizer's own code.
double own_excess(const trajectories::Problem& problem, std::size_t robot, const Instant& at);

/// The same for the separation of two.
double pair_excess(const trajectories::Problem& problem, std::size_t first, std::size_t second,
                   const Eigen::Vector3d& p, const Eigen::Vector3d& q);

/// The greatest excess of all limits at `rate` [Hz] samples.
double sampled_excess(const trajectories::Problem& problem, const std::vector<Path>& paths,
                      double duration, double rate);

}  // namespace trident::benchmarks
