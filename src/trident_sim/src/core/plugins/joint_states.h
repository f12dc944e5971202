// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin_util.h"
#include "trident_sim/samples.h"

namespace trident::sim {

/// Angles and rates of joints on a topic. Plugins that name the same topic share it.
class JointStates {
 public:
  JointStates(const PluginContext& context, const std::string& topic,
              const std::vector<Joint*>& joints);
  void publish(const World& world, SimTime stamp);

 private:
  std::string topic_;
  OutHandle<JointStateSample> own_;  ///< none: another plugin was first
  std::vector<std::pair<std::size_t, Joint*>> entries_;
};

}  // namespace trident::sim
