// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "velocity_command.h"

#include <algorithm>
#include <cmath>

#include "trident_sim/motion_limits.h"

namespace trident::sim {
namespace {

std::string list(const Eigen::Vector3d& v) {
  return "(" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) +
         ")";
}

}  // namespace

VelocityInput::VelocityInput(const PluginContext& context, const std::string& topic,
                             double timeout_s)
    : owner_(context.params.owner()),
      port_(subscribe<TwistCommand>(context, topic)),
      timeout_s_(timeout_s) {}

void VelocityInput::poll(World& world) {
  is_new_ = false;
  // All that came since the last poll are checked, so that
  // each bad one is reported; the last good one counts.
  for (seen_ = std::max(seen_, port_->oldest()); seen_ < port_->count(); ++seen_) {
    const TwistCommand& next = port_->at(seen_);
    if (is_motion(next.v_base, next.w_base)) {
      command_ = next;
      newest_ = world.time();
      is_new_ = true;
    } else {
      refuse(world, next);
    }
  }
  const double age_s = (world.time() - newest_).seconds();
  is_over_ = timeout_s_ >= 0.0 && age_s > timeout_s_;
  if (is_over_) command_ = {};
}

void VelocityInput::refuse(World& world, const TwistCommand& command) const {
  const std::string value = list(command.v_base) + " m/s, " + list(command.w_base) + " rad/s";
  world.diagnose({Severity::kError,
                  owner_,
                  "velocity command refused",
                  "velocity command " + value +
                      " must be finite; such commands are refused, the last good one stays",
                  {{"value", value}, {"legal", "finite, up to 1e5 m/s and 1e4 rad/s"}}});
}

void VelocityInput::reset() {
  port_->clear();
  command_ = {};
  newest_ = {};
  seen_ = 0;
  is_new_ = false;
}

double CommandLimit::factor(World& world, double value, double limit, bool is_new) const {
  const double excess = std::abs(value) / limit;
  if (!(excess > 1.0)) return 1.0;
  // One report a command, not one a control period.
  if (is_new) {
    const std::string legal = "[" + std::to_string(-limit) + ", " + std::to_string(limit) + "]";
    world.diagnose({Severity::kWarning,
                    owner_,
                    texts_.kind,
                    "command asks for a " + texts_.quantity + " of " + std::to_string(value) + " " +
                        texts_.unit + ", " + std::to_string(excess) + " times its limit; " +
                        texts_.what,
                    {{"value", std::to_string(value) + " " + texts_.unit},
                     {"legal", legal + " " + texts_.unit}}});
  }
  return 1.0 / excess;
}

CommandLimit wheel_speed_limit(const std::string& owner) {
  return {owner,
          {"velocity command clamped", "m/s", "speed at a wheel's rim",
           "all wheels are scaled down to the velocity limit of the wheel's joint, turn and all"}};
}

}  // namespace trident::sim
