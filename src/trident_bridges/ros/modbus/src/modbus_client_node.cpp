// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_client_node.h"

#include <algorithm>

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
      ticker_(node, loop, 1.0 / map_.spec.poll, [this] { poll(); }) {
  open(node, params);
}

ModbusClientNode::~ModbusClientNode() {
  if (deadline_call_) loop_.loop().cancel(*deadline_call_);
}

void ModbusClientNode::poll() {
  if (!peer_) return;
  client_.poll();
  pump();
}

void ModbusClientNode::on_joined(PeerId peer) {
  peer_ = peer;
  poll();
}

void ModbusClientNode::on_left(PeerId /*peer*/) {
  peer_.reset();
  client_.disconnect();
}

void ModbusClientNode::on_frame(const LinkFrame& frame) {
  client_.receive(frame.transaction, frame.unit, frame.pdu);
  pump();
  outputs_->publish();
}

void ModbusClientNode::on_topic(std::size_t entry, const Value& value) {
  client_.set(entry, value, ros::Time::now().toSec());
  pump();
}

/// Sends what may be sent.
void ModbusClientNode::pump() {
  if (!peer_) return;
  while (const auto outgoing = client_.next(loop_.loop().now_s())) {
    link_->send(*peer_, outgoing->unit, outgoing->transaction, outgoing->pdu.bytes());
  }
  link_->flush();
  watch_deadline();
}

/// One call waits for the earliest answer that can be overdue; most come before it is made.
void ModbusClientNode::watch_deadline() {
  const auto deadline_s = client_.deadline_s();
  if (deadline_call_ || !deadline_s) return;
  const double delay_s = std::max(0.0, *deadline_s - loop_.loop().now_s());
  deadline_call_ = loop_.loop().call_after(delay_s, [this] {
    deadline_call_.reset();
    client_.update(loop_.loop().now_s());
    pump();
    watch_deadline();
  });
}

std::string ModbusClientNode::problem() const {
  if (!peer_) return "no connection";
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
