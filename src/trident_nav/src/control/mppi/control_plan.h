// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mppi_model.h"
#include "rollout.h"

namespace trident::nav {

/// Velocities at the ends of the horizon's steps.
using ControlPlan = std::vector<Twist2>;

/// A plan as it continues after `elapsed_s`; its last velocity is held.
ControlPlan shifted(const ControlPlan& plan, double dt_s, double elapsed_s);

/// The velocity of a plan after `after_s`, if it is `start` now.
Twist2 plan_at(const ControlPlan& plan, const Twist2& start, double dt_s, double after_s);

void write_lane(const ControlPlan& plan, int lane, Rollouts* rollouts);
ControlPlan read_lane(const Rollouts& rollouts, int lane);

}  // namespace trident::nav
