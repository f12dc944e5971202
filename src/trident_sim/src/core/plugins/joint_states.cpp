// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "joint_states.h"

#include <algorithm>
#include <cmath>

namespace trident::sim {

JointStates::JointStates(const PluginContext& context, const std::string& topic,
                         const std::vector<Joint*>& joints)
    : topic_(topic) {
  auto* shared = context.world.ports().find_out<JointStateSample>(topic);
  if (shared == nullptr) {
    own_ = advertise<JointStateSample>(context, topic, PortRank::kState);
    shared = own_.get();
  }
  JointStateSample& value = shared->value;
  for (Joint* joint : joints) {
    const auto at = std::find(value.names.begin(), value.names.end(), joint->spec.name);
    entries_.emplace_back(static_cast<std::size_t>(at - value.names.begin()), joint);
    if (at == value.names.end()) value.names.push_back(joint->spec.name);
  }
  value.positions.resize(value.names.size());
  value.velocities.resize(value.names.size());
}

void JointStates::publish(const World& world, SimTime stamp) {
  // The plugin that was first may be gone, and its topic with it.
  auto* port = own_ ? own_.get() : world.ports().find_out<JointStateSample>(topic_);
  if (port == nullptr || !port->wanted()) return;
  JointStateSample& value = port->value;
  for (const auto& [index, joint] : entries_) {
    if (index >= value.velocities.size() || value.names[index] != joint->spec.name) return;
    value.positions[index] = joint->position();
    value.velocities[index] = joint->velocity();
  }
  value.stamp = stamp;
  port->publish();
}

}  // namespace trident::sim
