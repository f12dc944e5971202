// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_bridges/modbus/client.h"
#include "trident_bridges/transport/poll_loop.h"
#include "trident_bridges_ros/modbus/modbus_link.h"

namespace trident::bridges::modbus {

/// A client's connection to its device: what it wants to send goes to the link while there is a
/// peer, and it learns of answers that are overdue. In the loop's thread.
class DeviceConnection {
 public:
  /// Both outlive it.
  DeviceConnection(Client& client, PollLoop& loop) : client_(client), loop_(loop) {}
  ~DeviceConnection();
  DeviceConnection(const DeviceConnection&) = delete;
  DeviceConnection& operator=(const DeviceConnection&) = delete;

  bool is_open() const { return peer_.has_value(); }  ///< the device is there
  /// It has come; all values are read at once.
  void open(ModbusLink& link, PeerId peer);
  /// It is gone.
  void close();
  /// Reads all values again.
  void poll();
  /// Hands on an answer.
  void receive(const LinkFrame& frame);
  /// Sends what may be sent.
  void pump();

 private:
  void watch_deadline();

  Client& client_;
  PollLoop& loop_;
  ModbusLink* link_ = nullptr;  ///< of peer_
  std::optional<PeerId> peer_;
  std::optional<std::uint64_t> deadline_call_;
};

}  // namespace trident::bridges::modbus
