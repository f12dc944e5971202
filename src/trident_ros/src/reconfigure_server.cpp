// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/reconfigure_server.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::ros_utils {
namespace {

template <class Parameters>
void add_names(const Parameters& parameters, std::vector<std::string>* names) {
  for (const auto& one : parameters) names->push_back(one.name);
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& node, ReconfigureTable table,
                                     Refusals& refusals, Apply apply)
    : node_(node), refusals_(refusals), apply_(std::move(apply)), table_(std::move(table)) {
  descriptions_ =
      node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  const Lock lock(mutex_);
  descriptions_.publish(table_.description());
  updates_.publish(table_.config());
  boost::function<bool(dynamic_reconfigure::ReconfigureRequest&,
                       dynamic_reconfigure::ReconfigureResponse&)>
      callback = [this](const auto& request, auto& response) { return serve(request, response); };
  service_ = node_.advertiseService("set_parameters", callback);
}

bool ReconfigureServer::serve(const dynamic_reconfigure::ReconfigureRequest& request,
                              dynamic_reconfigure::ReconfigureResponse& response) {
  const Lock lock(mutex_);
  std::vector<std::string> notes;
  ConfigNode values = table_.changed(request.config, &notes);
  try {
    apply_(values);
    table_.set_values(std::move(values));
    write_parameters(request.config);
  } catch (const Error& error) {
    notes.push_back(std::string("nothing is changed: ") + error.what());
  }
  if (!notes.empty()) {
    const std::string& name = node_.getNamespace();
    refusals_.note("reconfigure " + name, name + "/set_parameters: " + join(notes, "; "));
  }
  response.config = table_.config();
  updates_.publish(response.config);
  return true;
}

void ReconfigureServer::write_parameters(const dynamic_reconfigure::Config& request) {
  std::vector<std::string> names;
  add_names(request.bools, &names);
  add_names(request.ints, &names);
  add_names(request.doubles, &names);
  add_names(request.strs, &names);
  const dynamic_reconfigure::Config now = table_.config();
  const auto write = [&](const auto& one, auto value) {
    if (is_among(names, one.name) && one.name != "restore_defaults")
      node_.setParam(one.name, value);
  };
  for (const auto& one : now.bools) write(one, static_cast<bool>(one.value));
  for (const auto& one : now.ints) write(one, static_cast<int>(one.value));
  for (const auto& one : now.doubles) write(one, one.value);
  for (const auto& one : now.strs) write(one, one.value);
}

}  // namespace trident::ros_utils
