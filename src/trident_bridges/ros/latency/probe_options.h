// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident::bridges {

/// Options of latency_probe. Each part uses its own.
struct ProbeOptions {
  std::string part;               ///< source, sink, listener, relay, bridge
  std::string record;             ///< file of a LatencyRecord
  std::string topic;              ///< source: published; sink, listener: subscribed to
  std::string message = "bytes";  ///< see carriers.h
  std::string in, out;            ///< relay, bridge: topics
  std::string url;                ///< bridge: of its endpoint
  std::string tlog;               ///< file of the message "tlog"
  double rate = 500.0;            ///< source: [1/s], at whole ms; 0: as fast as `window` lets
  std::uint64_t count = 1000;     ///< source, listener: messages
  std::uint64_t window = 64;      ///< source, at rate 0: messages on their path at once
  std::uint64_t size = 64;        ///< source: bytes of a message that has no size of its own
  double limit_s = 30.0;          ///< source: until the first message has arrived; listener: in all
};

/// From "PART --name value ...". Throws Error naming the option, its value and the legal range.
ProbeOptions parse_probe_options(int argc, char** argv);

}  // namespace trident::bridges
