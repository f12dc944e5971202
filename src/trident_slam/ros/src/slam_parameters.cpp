// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_parameters.h"

#include <algorithm>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::slam {

SlamMethod::SlamMethod(ros_utils::NodeParams& params, const std::string& usual,
                       const std::vector<ParameterAlias>& aliases) {
  const auto asked = params.read<SlamMethodParams>({usual, ""});
  name_ = asked.method;
  file_ = asked.config_file;
  factory_ = builtin_slam_2d().get(name_);
  params.accept(factory_.parameters);
  for (const ParameterAlias& alias : aliases) params.accept({alias.upstream});
  if (has_file()) {
    setup_ = Slam2dSetup(file_);
    warn_of_ignored(params, aliases);
  } else {
    read_params(params, aliases);
  }
}

bool SlamMethod::has_parameter(const std::string& name) const {
  const auto& names = factory_.parameters;
  return std::find(names.begin(), names.end(), name) != names.end();
}

void SlamMethod::read_params(ros_utils::NodeParams& params,
                             const std::vector<ParameterAlias>& aliases) {
  for (const auto& [name, upstream] : aliases) {
    const ConfigNode* value = params.find(upstream);
    if (value != nullptr && has_parameter(name) && params.find(name) == nullptr) {
      params.set(name, ConfigNode(*value));
    }
  }
  setup_.config = params.subtree(factory_.parameters);
  setup_.source = ros_utils::NodeParams::label();
  setup_.path = params.name_space();
}

void SlamMethod::warn_of_ignored(ros_utils::NodeParams& params,
                                 const std::vector<ParameterAlias>& aliases) const {
  std::vector<std::string> names = factory_.parameters;
  for (const ParameterAlias& alias : aliases) {
    if (has_parameter(alias.name)) names.push_back(alias.upstream);
  }
  const std::vector<std::string> ignored = params.subtree(names).keys;
  if (ignored.empty()) return;
  params.add_warning("parameters " + join(ignored) + " of " + params.name_space() +
                     " are not used: config_file is " + file_);
}

void SlamMethod::set(const std::string& parameter, const std::string& text) {
  if (has_parameter(parameter)) setup_.set(parameter, text);
}

void SlamMethod::set_default(const std::string& parameter, const std::string& text) {
  if (has_parameter(parameter)) setup_.set_default(parameter, text);
}

std::string SlamMethod::text(const std::string& parameter) const {
  const ConfigNode* value = setup_.config.find(parameter);
  return value == nullptr ? "" : value->scalar;
}

std::function<std::unique_ptr<Slam2d>()> SlamMethod::maker() const {
  return [factory = factory_, setup = setup_] { return factory(setup); };
}

void set_node_defaults(SlamMethod& method) { method.set_default("keep_scans", "false"); }

}  // namespace trident::slam
