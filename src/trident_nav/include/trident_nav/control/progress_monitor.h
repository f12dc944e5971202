// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/config_types.h"
#include "trident_nav/control/robot_state.h"

namespace trident::nav {

/// Names and defaults of Nav2's pose progress checker.
struct ProgressParams {
  double required_movement_radius = 0.5;
  double required_movement_angle = 0.5;
  double movement_time_allowance = 10.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("required_movement_radius", required_movement_radius, Range::positive(), "[m]");
    ar.field("required_movement_angle", required_movement_angle, Range::positive(), "[rad]");
    ar.field("movement_time_allowance", movement_time_allowance, Range::positive(), "[s]");
  }
};

/// Whether the robot still gets somewhere: it must move or turn on the spot by what is required
/// within the time that is allowed.
class ProgressMonitor {
 public:
  explicit ProgressMonitor(const ProgressParams& params) : params_(params) {}

  /// False once the allowance is used up.
  bool update(const RobotState& state);
  void reset() { has_reference_ = false; }

 private:
  ProgressParams params_;
  bool has_reference_ = false;
  RobotState reference_;
};

}  // namespace trident::nav
