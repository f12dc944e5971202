// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "trident_bridges/modbus/client.h"
#include "trident_bridges/transport/poll_loop.h"
#include "trident_bridges_ros/modbus/device_connection.h"
#include "trident_bridges_ros/modbus/modbus_link.h"

namespace trident::bridges::modbus {

/// Reads the values of a device again and again, and reports those that have changed as lines of
/// text. Writes nothing.
class DeviceWatch {
 public:
  /// Connects to the map's device; `print` gets lines without their end. Throws Error for an
  /// address that is not legal. `loop` outlives the watch.
  DeviceWatch(const RegisterMap& map, const LinkOptions& options, PollLoop& loop,
              std::function<void(const std::string& line)> print);
  ~DeviceWatch();
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// All values have been read at least once.
  bool has_all() const { return client_.counts().responses >= blocks_; }

 private:
  void poll();

  PollLoop& loop_;
  std::function<void(const std::string& line)> print_;
  double begin_s_;
  std::size_t blocks_;
  std::uint64_t poll_call_ = 0;
  Client client_;
  DeviceConnection device_;
  ModbusLink link_;
};

}  // namespace trident::bridges::modbus
