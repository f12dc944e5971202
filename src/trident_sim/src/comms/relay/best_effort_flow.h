// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "comms/relay/datagram.h"
#include "comms/relay/relay_message.h"

namespace trident::sim {

/// Puts the parts of messages together that are sent once. What comes after a newer one has been
/// delivered is left out. A value.
class BestEffortReceiver {
 public:
  /// `deadline`: age at which a message is left out, zero: never.
  explicit BestEffortReceiver(SimTime deadline) : deadline_(deadline) {}

  /// The message that is whole now; empty: none is.
  std::optional<RelayMessage> take(const PartDatagram& part, SimTime now, RelayCounts* counts);

 private:
  struct Assembly {
    std::vector<std::string> parts;
    std::vector<bool> has;
    std::size_t missing = 0;
  };

  SimTime deadline_;
  std::uint64_t next_ = 0;  ///< what is older than this one is left out
  std::map<std::uint64_t, Assembly> begun_;
};

}  // namespace trident::sim
