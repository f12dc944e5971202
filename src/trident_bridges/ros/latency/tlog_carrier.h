// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/Mavlink.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "probe_options.h"

namespace trident::bridges {

/// No number: the message is not one of the source's.
inline constexpr std::uint64_t kNoNumber = std::numeric_limits<std::uint64_t>::max();

/// The packets of a telemetry log, again and again. A number is a packet's place: the packets carry
/// none, so who reads them counts, and finds its place again behind lost ones. They must arrive in
/// their order. Packets for one system alone are left out: a router keeps them from others.
class TlogCarrier {
 public:
  using Message = mavros_msgs::Mavlink;
  /// Reads the file. Throws Error when it has no packets.
  explicit TlogCarrier(const ProbeOptions& options);

  /// The packet of this number.
  void put(std::uint64_t number, std::size_t size, Message& message) const;
  /// The number of a packet, which is the last one's again or a later one's.
  std::uint64_t number(const Message& message);

 private:
  static std::uint64_t key_of(const Message& message);

  std::vector<Message> packets_;
  std::vector<std::uint64_t> keys_;
  std::uint64_t next_ = 0;  // number that is expected
};

}  // namespace trident::bridges
