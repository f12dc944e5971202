// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "model_params.h"

#include <algorithm>
#include <cctype>

namespace trident::sim {
namespace {

std::string without_outer_slashes(std::string text) {
  while (!text.empty() && text.back() == '/') text.pop_back();
  return text.substr(std::min(text.find_first_not_of('/'), text.size()));
}

}  // namespace

std::string resolved_frame(const PluginContext& context, const std::string& name,
                           FramePrefix from) {
  if (!name.empty() && name.front() == '/') return without_outer_slashes(name);
  const std::string space = without_outer_slashes(context.params.text("robotNamespace", ""));
  std::string prefix = without_outer_slashes(context.world.tf_prefix(space));
  if (prefix.empty() && from == FramePrefix::kTfPrefixOrNamespace) prefix = space;
  return prefix.empty() ? name : prefix + "/" + name;
}

Model& required_model(const PluginContext& context) {
  if (context.model == nullptr) throw Error(context.params.owner() + ": belongs in a model");
  return *context.model;
}

Joint& motor_joint(const PluginContext& context, const std::string& key,
                   const std::string& fallback) {
  Joint& joint = joint_or(context, key, fallback);
  if (joint.ode == nullptr || joint.spec.type != JointType::kRevolute) {
    context.params.refuse(key, joint.spec.name, "a revolute or continuous joint that can turn");
  }
  return joint;
}

bool is_second_choice(const PluginParams& params, const std::string& key, const char* first,
                      const char* second) {
  const std::string given = params.text(key, first);
  std::string value = given;
  for (char& c : value) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (value != first && value != second) {
    params.refuse(key, given, std::string(first) + " or " + second);
  }
  return value == second;
}

OdometryNames read_odometry_names(const PluginContext& context, FramePrefix from,
                                  const char* base_frame) {
  const PluginParams& params = context.params;
  return {scoped_topic(params, params.text("odometryTopic", "odom")),
          resolved_frame(context, params.text("odometryFrame", "odom"), from),
          resolved_frame(context, params.text("robotBaseFrame", base_frame), from)};
}

std::string read_command_topic(const PluginParams& params) {
  return scoped_topic(params, params.text("commandTopic", "cmd_vel"));
}

}  // namespace trident::sim
