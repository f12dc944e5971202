// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_node.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include "trident_base/string_util.h"
#include "trident_ros/diagnostic_counter.h"

namespace trident::bridges::modbus {
namespace {

constexpr double kLookEvery_s = 0.1;  // wall time
constexpr int kLooksPerStatus = 10;

}  // namespace

ModbusNode::ModbusNode(ros::NodeHandle& node, NodePollLoop& loop, const ModbusNodeParams& params,
                       Role role)
    : loop_(loop),
      role_(role),
      map_(params.load()),
      refusals_(node),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {
  const auto errors = errors_of_topics(
      map_,
      [this](const std::string& type) -> const MessageDefinition& { return lookup_.get(type); });
  if (!errors.empty()) throw ConfigError(errors.front());
  outputs_ =
      std::make_unique<TopicOutputs>(node, map_, topic_bindings(map_, role).outputs, lookup_);
}

ModbusNode::~ModbusNode() { loop_.loop().cancel(call_); }

void ModbusNode::open(ros::NodeHandle& node, const ModbusNodeParams& params) {
  LinkEvents events;
  events.frame = [this](const LinkFrame& frame) { on_frame(frame); };
  events.joined = [this](PeerId peer) { on_joined(peer); };
  events.left = [this](PeerId peer) { on_left(peer); };
  events.refused = [this](const std::string& kind, const std::string& text) { note(kind, text); };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  events.notice = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  link_ = std::make_unique<ModbusLink>(map_.spec.transport, role_, params.link(), loop_.loop(),
                                       std::move(events));
  InputEvents inputs;
  inputs.value = [this](std::size_t entry, const Value& value) { on_topic(entry, value); };
  inputs.refused = [this](const std::string& kind, const std::string& text) { note(kind, text); };
  inputs_ = std::make_unique<TopicInputs>(node, loop_, map_, topic_bindings(map_, role_).inputs,
                                          lookup_, std::move(inputs));
  ROS_INFO("%s: %s of unit %d, %zu values of %s", link_->name().c_str(),
           role_ == Role::kServer ? "server" : "client", map_.spec.unit, map_.entries.size(),
           map_.file.c_str());
  look_around();
}

void ModbusNode::look_around() {
  call_ = loop_.loop().call_after(kLookEvery_s, [this] { look_around(); });
  outputs_->serve_late_subscribers();
  if (++looks_ % kLooksPerStatus != 0) return;
  inputs_->look_at_publishers();
  publish_status();
}

void ModbusNode::publish_status() {
  if (diagnostics_.getNumSubscribers() == 0) return;
  using Status = diagnostic_msgs::DiagnosticStatus;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  Status status;
  status.name = ros::this_node::getName().substr(1) + ": modbus";
  status.hardware_id = link_->name();
  const std::string wrong = problem();
  const std::vector<std::string> silent = inputs_->silent_topics();
  status.level = wrong.empty() && silent.empty() ? Status::OK : Status::WARN;
  status.message = wrong;
  if (wrong.empty() && !silent.empty()) status.message = "nobody publishes " + join(silent);
  for (const auto& [key, value] : counts()) {
    status.values.push_back(ros_utils::key_value(key, value));
  }
  array.status.push_back(status);
  diagnostics_.publish(array);
}

}  // namespace trident::bridges::modbus
