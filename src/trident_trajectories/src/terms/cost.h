// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "curves/robot_motion.h"
#include "trident_trajectories/problem.h"

namespace trident::trajectories {

/// What is minimized: CostWeights' integrals of the whole team, each divided by a scale.
class Cost {
 public:
  /// `undisturbed`: the team on its path of least jerk, with derivatives up to 2, whose integrals
  /// are the scales; `jerk_scale` is that of jerk. The problem must outlive this.
  Cost(const Problem& problem, const SplineBasis& basis,
       const std::vector<RobotMotion>& undisturbed, double jerk_scale);

  /// Highest derivative that motions must have at their samples.
  int derivative() const;

  /// The cost; adds its gradient to that of the motions.
  double evaluate(std::vector<RobotMotion>& motions) const;

 private:
  double jerk(RobotMotion& motion, double weight) const;
  double length(RobotMotion& motion, double weight) const;
  double energy(const Robot& robot, RobotMotion& motion, double weight) const;

  const Problem& problem_;
  const Eigen::MatrixXd& gram_;
  CostWeights weights_;  ///< divided by the scales
};

}  // namespace trident::trajectories
