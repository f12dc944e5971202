// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "curves/robot_motion.h"
#include "trident_trajectories/problem.h"
#include "trident_trajectories/violation.h"

namespace trident::trajectories {

/// The largest of many values h, smoothly: log(sum(exp(sharpness h))) / sharpness, which is between
/// the largest and log(n) / sharpness above it.
class SmoothMaximum {
 public:
  /// A value that counts, and the derivative of the maximum by it.
  struct Share {
    int index;
    double weight;
  };

  explicit SmoothMaximum(int values) : values_(values) { shares_.reserve(values); }
  Eigen::ArrayXd& values() { return values_; }  ///< h, to be set
  /// Those values whose derivative is not negligible, in order.
  const std::vector<Share>& shares() const { return shares_; }
  /// Of the values set. Where all are below -0.4 the largest itself is good enough.
  double compute(double sharpness);

 private:
  Eigen::ArrayXd values_;
  std::vector<Share> shares_;
};

/// One inequality g <= 0 over a whole trajectory or pair, relative to its limit. evaluate() keeps
/// what pull_back() needs; both work without allocation.
class Constraint {
 public:
  Constraint(LimitKind limit, std::size_t first, std::size_t second)
      : limit_(limit), first_(first), second_(second) {}
  virtual ~Constraint() = default;

  /// g.
  virtual double evaluate(const std::vector<RobotMotion>& motions, double sharpness) = 0;
  /// Adds weight times the gradient of the g evaluated last.
  virtual void pull_back(double weight, std::vector<RobotMotion>& motions) const = 0;
  /// Highest derivative by time that is needed.
  virtual int derivative() const { return 0; }

  LimitKind limit() const { return limit_; }      ///< what is kept
  std::size_t first() const { return first_; }    ///< robot
  std::size_t second() const { return second_; }  ///< the other robot, or the first again
  /// Obstacle or rendezvous of the problem that it is about.
  virtual std::size_t item() const { return 0; }

 private:
  LimitKind limit_;
  std::size_t first_, second_;
};

/// All of a problem, in a fixed order. The problem must outlive them.
std::vector<std::unique_ptr<Constraint>> constraints_of(const Problem& problem,
                                                        const SplineBasis& basis);

/// Below this speed a heading is not well defined: turn rate and curvature are those of
/// sqrt(v^2 + floor^2) [m/s].
double speed_floor(const Limits& limits);

/// Whether two robots must keep apart.
bool must_separate(const Problem& problem, std::size_t first, std::size_t second);
/// By what dz is divided between two robots.
double vertical_factor(const Problem& problem, std::size_t first, std::size_t second);
/// Between the centers of two robots [m].
double separation_of(const Problem& problem, std::size_t first, std::size_t second);

}  // namespace trident::trajectories
