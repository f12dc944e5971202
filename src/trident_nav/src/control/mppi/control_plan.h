// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "mppi_model.h"
#include "rollout.h"
#include "trident_nav/control/control_details.h"

namespace trident::nav {

/// Velocities at the ends of the horizon's steps.
using ControlPlan = std::vector<Twist2>;

/// A plan as it continues after `elapsed_s`; its last velocity is held.
ControlPlan shifted(const ControlPlan& plan, double dt_s, double elapsed_s);

/// The velocity of a plan after `after_s`, if it is `start` now.
Twist2 plan_at(const ControlPlan& plan, const Twist2& start, double dt_s, double after_s);

/// The poses that a plan leads to from another one, without the limits that made the plan: every so
/// many steps, and the last one.
ConsideredTrajectory trajectory_of(const ControlPlan& plan, const Pose2& start, double dt_s,
                                   std::size_t every);

void write_lane(const ControlPlan& plan, int lane, Rollouts* rollouts);
ControlPlan read_lane(const Rollouts& rollouts, int lane);

}  // namespace trident::nav
