// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "terms/constraint.h"

namespace trident::trajectories {

/// |derivative|^2 / limit^2 - 1 of one robot.
class NormLimit : public Constraint {
 public:
  NormLimit(LimitKind kind, std::size_t robot, int derivative, double limit, int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  int derivative() const override { return derivative_; }

 private:
  int derivative_;
  double factor_;
  SmoothMaximum maximum_;
};

/// (v x a)^2 / (limit^2 (|v|^2 + floor^2)^power) - 1 of a robot in the plane, with v through the
/// water: power 2 is turn rate, power 3 curvature.
class TurnLimit : public Constraint {
 public:
  TurnLimit(LimitKind kind, std::size_t robot, int power, double limit, const Robot& of,
            int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  int derivative() const override { return 2; }

 private:
  int power_;
  double factor_, floor2_;
  Eigen::RowVector2d current_;
  SmoothMaximum maximum_;
  Eigen::ArrayX2d by_v_, by_a_;
};

/// Surge force over its limit, less 1, of a vessel: m du/dt + (d1 + d2 u) u with u the speed
/// through the water (Fossen, 2011, without sway).
class ThrustLimit : public Constraint {
 public:
  ThrustLimit(LimitKind kind, std::size_t robot, double limit, const Robot& of, int samples);
  double evaluate(const std::vector<RobotMotion>& motions, double sharpness) override;
  void pull_back(double weight, std::vector<RobotMotion>& motions) const override;
  int derivative() const override { return 2; }

 private:
  double factor_, floor2_;
  const SurgeModel& surge_;
  SmoothMaximum maximum_;
  Eigen::ArrayX2d by_v_, by_a_;
};

}  // namespace trident::trajectories
