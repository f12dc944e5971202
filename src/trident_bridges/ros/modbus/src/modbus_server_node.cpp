// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_server_node.h"

#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

constexpr double kUpdateEvery_s = 0.01;  // how late a value may become safe

double now_s() { return ros::Time::now().toSec(); }

}  // namespace

ModbusServerNode::ModbusServerNode(ros::NodeHandle& node, NodePollLoop& loop,
                                   const ModbusNodeParams& params)
    : ModbusNode(node, loop, params, Role::kServer),
      server_(map_,
              {[this](std::size_t entry, const Value& value, bool is_safe) {
                 outputs_->set(entry, value);
                 if (is_safe) {
                   note("silent writer", map_.entries[entry].label() + " is " +
                                             value_to_text(value) +
                                             ", its safe value: no write for " +
                                             number_text(*map_.entries[entry].timeout) + " s");
                 }
               },
               [this](const std::string& kind, const std::string& text) { note(kind, text); }}),
      ticker_(node, loop, kUpdateEvery_s, [this] {
        server_.update(now_s());
        outputs_->publish();
      }) {
  open(node, params);
}

void ModbusServerNode::on_joined(PeerId peer) {
  callers_[peer] = {peer, link_->peer_text(peer), link_->is_serial()};
}

void ModbusServerNode::on_left(PeerId peer) {
  callers_.erase(peer);
  server_.release(peer);
}

void ModbusServerNode::on_frame(const LinkFrame& frame) {
  const auto response = server_.handle(callers_[frame.peer], frame.unit, frame.pdu, now_s());
  if (response) link_->send(frame.peer, frame.unit, frame.transaction, response->bytes());
  outputs_->publish();
}

void ModbusServerNode::on_topic(std::size_t entry, const Value& value) {
  const Fit fit = server_.set(entry, value);
  if (fit == Fit::kExact) return;
  const RegisterEntry& own = map_.entries[entry];
  note("value does not fit", own.label() + ": topic " + own.topic + " says " +
                                 value_to_text(value) + ", which a " + own.layout.type.text() +
                                 (fit == Fit::kClamped ? " has not; it is the nearest one"
                                                       : " cannot be; it stays as it was"));
}

ModbusNode::Rows ModbusServerNode::counts() const {
  const ServerCounts& counts = server_.counts();
  const EndpointCounts endpoint = link_->counts();
  const RtuCounts line = link_->line_counts();
  return {{"clients", std::to_string(callers_.size())},
          {"requests", std::to_string(counts.requests)},
          {"exceptions", std::to_string(counts.exceptions)},
          {"values read", std::to_string(counts.reads)},
          {"values written", std::to_string(counts.writes)},
          {"safe values", std::to_string(counts.safe)},
          {"refused clients", std::to_string(endpoint.refused_peers)},
          {"bad frames", std::to_string(line.bad_frames)},
          {"noise bytes", std::to_string(line.noise_bytes)}};
}

}  // namespace trident::bridges::modbus
