// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/parameter_names.h"

#include <XmlRpcValue.h>
#include <ros/console.h>

#include <algorithm>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

bool has(const ParameterNames& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

UnusedParameters unused_parameters(const ParameterNames& given, const ParameterNames& used,
                                   const ParameterNames& upstream) {
  UnusedParameters result;
  for (const std::string& name : given) {
    if (has(used, name)) continue;
    if (has(upstream, name)) {
      result.without_effect.push_back(name);
      continue;
    }
    std::string text = name;
    const std::string meant = closest_match(name, used);
    if (!meant.empty()) text.append(" (did you mean ").append(meant).append("?)");
    result.unknown.push_back(text);
  }
  return result;
}

void tell_unused(const ros::NodeHandle& own, const ParameterNames& used,
                 const ParameterNames& upstream) {
  XmlRpc::XmlRpcValue root;
  own.getParam("", root);
  if (root.getType() != XmlRpc::XmlRpcValue::TypeStruct) return;
  ParameterNames given;
  for (const auto& [name, value] : root) given.push_back(name);
  const UnusedParameters unused = unused_parameters(given, used, upstream);
  if (!unused.without_effect.empty()) {
    ROS_WARN("parameters without effect here: %s", join(unused.without_effect).c_str());
  }
  if (!unused.unknown.empty()) {
    ROS_WARN("unknown parameters, not used: %s", join(unused.unknown).c_str());
  }
}

}  // namespace trident::slam
