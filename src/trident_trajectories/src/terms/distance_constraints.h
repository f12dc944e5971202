// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "terms/constraint.h"

namespace trident::trajectories {

/// 1 - (dx^2 + dy^2 + (dz / k)^2) / separation^2 of two robots at equal times.
class SeparationLimit : public Constraint {
 public:
  SeparationLimit(const Problem& problem, std::size_t first, std::size_t second, int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;

 private:
  double horizontal_, vertical_;  ///< what squares are multiplied with
  SmoothMaximum maximum_;
};

/// (least height - z) / 1 m of one UAV.
class HeightLimit : public Constraint {
 public:
  HeightLimit(const Problem& problem, std::size_t robot, int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;

 private:
  double least_;
  SmoothMaximum maximum_;
};

/// 1 - distance / collision radius of one robot, from what stands still.
class ObstacleLimit : public Constraint {
 public:
  ObstacleLimit(const Problem& problem, std::size_t robot, int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;

 private:
  const DistanceMap& map_;
  double radius_;
  SmoothMaximum maximum_;
  Samples slopes_;
};

/// 1 - distance^2 / separation^2 of one robot, from the center of something that moves, until the
/// robot arrives.
class MovingObstacleLimit : public Constraint {
 public:
  MovingObstacleLimit(const Problem& problem, std::size_t robot, std::size_t obstacle,
                      const SplineBasis& basis);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  std::size_t item() const override { return item_; }

 private:
  const MovingObstacle& obstacle_;
  std::size_t item_;
  double factor_;
  Eigen::ArrayXd shares_;  ///< of the duration, at each sample
  SmoothMaximum maximum_;
  Samples away_, velocity_;
};

/// (|p_first - p_second - offset| - tolerance) / 1 m at one instant.
class RendezvousLimit : public Constraint {
 public:
  RendezvousLimit(const Problem& problem, std::size_t rendezvous, const SplineBasis& basis);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  std::size_t item() const override { return item_; }

 private:
  const Rendezvous& rendezvous_;
  std::size_t item_;
  int segment_;
  SplineBasis::PointWeights weights_;
  Eigen::RowVector3d direction_ = Eigen::RowVector3d::Zero();
};

/// (arrival of the earlier + gap - arrival of the later) over the later's first guess.
class OrderLimit : public Constraint {
 public:
  OrderLimit(const Problem& problem, std::size_t order);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  std::size_t item() const override { return item_; }

 private:
  std::size_t item_;
  double gap_, scale_;
};

}  // namespace trident::trajectories
