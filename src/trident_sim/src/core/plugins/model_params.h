// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plugin_util.h"

namespace trident::sim {

// Parameters that many plugins of gazebo_plugins read alike.

constexpr Limits kLength{1e-6, 1e6};
constexpr Limits kNotNegative{0.0, 1e12};

/// Whether frames are prefixed by the namespace where there is no tf_prefix: some of upstream's
/// plugins do that, others do not.
enum class FramePrefix { kTfPrefix, kTfPrefixOrNamespace };

/// "prefix/name" as tf::resolve() makes it; a name that begins with '/' is kept, without that.
std::string resolved_frame(const PluginContext& context, const std::string& name, FramePrefix from);

/// Throws Error for a plugin of a world.
Model& required_model(const PluginContext& context);

/// The revolute joint that `key` names, or `fallback`. Throws Error for one that is unknown or
/// cannot be turned by a motor.
Joint& motor_joint(const PluginContext& context, const std::string& key,
                   const std::string& fallback);

/// Text of `key`, which must be one of two, in capitals or not. Returns whether it is the second.
bool is_second_choice(const PluginParams& params, const std::string& key, const char* first,
                      const char* second);

/// Where odometry goes: the topic, scoped, and two frames, resolved.
struct OdometryNames {
  std::string topic, odom_frame, base_frame;
};
/// <odometryTopic>, <odometryFrame>, <robotBaseFrame>.
OdometryNames read_odometry_names(const PluginContext& context, FramePrefix from,
                                  const char* base_frame = "base_footprint");

/// <commandTopic>, scoped.
std::string read_command_topic(const PluginParams& params);

}  // namespace trident::sim
