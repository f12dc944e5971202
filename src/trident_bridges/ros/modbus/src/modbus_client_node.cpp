// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_client_node.h"

namespace trident::bridges::modbus {

ModbusClientNode::ModbusClientNode(ros::NodeHandle& node, NodePollLoop& loop,
                                   const ModbusNodeParams& params)
    : ModbusNode(node, loop, params, Role::kClient),
      client_(map_, map_.spec.transport.kind == TransportKind::kTcp,
              {[this](std::size_t entry, const Value& value) { outputs_->set(entry, value); },
               [this](const std::string& kind, const std::string& text) {
                 note(kind, link_->name() + ": " + text);
               },
               [this](bool answers) {
                 ROS_INFO("%s: unit %d %s", link_->name().c_str(), map_.spec.unit,
                          answers ? "answers" : "does not answer");
               }}),
      device_(client_, loop.loop()),
      ticker_(node, loop, 1.0 / map_.spec.poll, [this] { device_.poll(); }) {
  open(node, params);
}

void ModbusClientNode::on_joined(PeerId peer) { device_.open(*link_, peer); }

void ModbusClientNode::on_left(PeerId /*peer*/) { device_.close(); }

void ModbusClientNode::on_frame(const LinkFrame& frame) {
  device_.receive(frame);
  outputs_->publish();
}

void ModbusClientNode::on_topic(std::size_t entry, const Value& value) {
  client_.set(entry, value, ros::Time::now().toSec());
  device_.pump();
}

std::string ModbusClientNode::problem() const {
  if (!device_.is_open()) return "no connection";
  return client_.is_answering() ? "" : "no answer";
}

ModbusNode::Rows ModbusClientNode::counts() const {
  const ClientCounts& counts = client_.counts();
  const RtuCounts line = link_->line_counts();
  return {{"requests", std::to_string(counts.requests)},
          {"responses", std::to_string(counts.responses)},
          {"values read", std::to_string(counts.registers)},
          {"values written", std::to_string(counts.writes)},
          {"exceptions", std::to_string(counts.exceptions)},
          {"timeouts", std::to_string(counts.timeouts)},
          {"malformed", std::to_string(counts.malformed)},
          {"late", std::to_string(counts.late)},
          {"skipped blocks", std::to_string(counts.skipped)},
          {"reconnects", std::to_string(link_->counts().reconnects)},
          {"bad frames", std::to_string(line.bad_frames)},
          {"noise bytes", std::to_string(line.noise_bytes)}};
}

}  // namespace trident::bridges::modbus
