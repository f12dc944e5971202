// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "trident_bridges/autopilot/vehicle.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// Sticks of MANUAL_CONTROL and RC_CHANNELS_OVERRIDE for one vehicle. Channels are those of
/// ArduPilot: 1 roll or steering, 2 pitch (low is forward), 3 throttle, 4 yaw; 1000 to 2000 us.
class StickReader {
 public:
  /// For the vehicle `self` of a class.
  StickReader(Address self, VehicleClass vehicle) : self_(self), vehicle_(vehicle) {}
  /// Where the sticks are after this message; nullopt: it is another one, for another vehicle, or
  /// all channels are released.
  std::optional<Sticks> read(const Message& message);

 private:
  std::optional<Sticks> read_manual(const Message& message) const;
  std::optional<Sticks> read_channels(const Message& message);

  Address self_;
  VehicleClass vehicle_;
  std::array<std::uint16_t, 4> channels_us_{};  // 0: released
};

}  // namespace trident::bridges::mavlink
