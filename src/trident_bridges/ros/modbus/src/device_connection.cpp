// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/device_connection.h"

#include <algorithm>

namespace trident::bridges::modbus {

DeviceConnection::~DeviceConnection() {
  if (deadline_call_) loop_.cancel(*deadline_call_);
}

void DeviceConnection::open(ModbusLink& link, PeerId peer) {
  link_ = &link;
  peer_ = peer;
  poll();
}

void DeviceConnection::close() {
  peer_.reset();
  client_.disconnect();
}

void DeviceConnection::poll() {
  if (!peer_) return;
  client_.poll();
  pump();
}

void DeviceConnection::receive(const LinkFrame& frame) {
  client_.receive(frame.transaction, frame.unit, frame.pdu);
  pump();
}

void DeviceConnection::pump() {
  if (!peer_) return;
  while (const auto outgoing = client_.next(loop_.now_s())) {
    link_->send(*peer_, outgoing->unit, outgoing->transaction, outgoing->pdu.bytes());
  }
  link_->flush();
  watch_deadline();
}

/// One call waits for the earliest answer that can be overdue; most come before it is made.
void DeviceConnection::watch_deadline() {
  const auto deadline_s = client_.deadline_s();
  if (deadline_call_ || !deadline_s) return;
  const double delay_s = std::max(0.0, *deadline_s - loop_.now_s());
  deadline_call_ = loop_.call_after(delay_s, [this] {
    deadline_call_.reset();
    client_.update(loop_.now_s());
    pump();
    watch_deadline();
  });
}

}  // namespace trident::bridges::modbus
