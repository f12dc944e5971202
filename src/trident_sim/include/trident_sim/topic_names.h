// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::sim {

struct PluginContext;

/// How a plugin names its topics.
using TopicNaming = std::string (*)(const PluginContext&, const std::string& topic);
/// scoped_topic(): below the robot's namespace; an absolute topic stands alone.
std::string robot_topic(const PluginContext& context, const std::string& topic);
/// As PX4's plugins for Gazebo: always below the vehicle, which is the robot's namespace, or the
/// model where that is empty. A leading slash has no effect.
std::string vehicle_topic(const PluginContext& context, const std::string& topic);

}  // namespace trident::sim
