// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "curves/bernstein.h"
#include "terms/constraint.h"
#include "trident_trajectories/trajectory.h"

namespace trident::trajectories {

/// The greatest value of a constraint's g over time, and when.
struct Peak {
  double value = 0.0;
  double t = 0.0;  ///< [s]
};

/// Values of g below that are not distinguished.
constexpr double kPeakFloor = -0.2;

/// Finds the true maxima of constraints between samples.
class HullCheck {
 public:
  /// All three must outlive this.
  HullCheck(const Problem& problem, const std::vector<Trajectory>& trajectories);

  /// Of one constraint of the problem.
  Peak peak(const Constraint& constraint) const;

 private:
  using Axes = std::array<Bernstein, 3>;
  struct Piece {
    double begin, end;  ///< [s]
    Axes p;             ///< position on it
  };
  Axes axes_of(const Trajectory& trajectory, double begin, double end) const;
  Axes axes_of(const Prediction& prediction, double begin, double end) const;
  std::vector<double> breaks(const Trajectory& a, const Trajectory& b) const;
  Peak separation(std::size_t first, std::size_t second) const;
  Peak moving(std::size_t robot, const MovingObstacle& obstacle) const;
  Peak norm(std::size_t robot, int derivative, double limit) const;
  Peak turn(std::size_t robot, LimitKind kind) const;
  Peak thrust(std::size_t robot, double factor) const;
  Peak height(std::size_t robot) const;
  Peak obstacle(std::size_t robot) const;
  Peak rendezvous(const Rendezvous& rendezvous) const;
  Peak order(const ArrivalOrder& order) const;

  const Problem& problem_;
  const std::vector<Trajectory>& trajectories_;
  std::vector<std::vector<Piece>> pieces_;  ///< of each robot
};

}  // namespace trident::trajectories
