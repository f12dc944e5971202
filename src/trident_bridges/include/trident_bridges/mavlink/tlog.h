// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_bridges/mavlink/packet_parser.h"

namespace trident::bridges::mavlink {

/// A packet of a telemetry log.
struct TlogRecord {
  std::int64_t time_us = 0;  ///< [us] since 1970, as the log has it
  Packet packet;             ///< lies in the log's bytes
};

/// Reads a telemetry log (.tlog): packets of MAVLink 1 and 2, each behind its time in 8 bytes,
/// highest first.
class TlogReader {
 public:
  /// `log`: the whole file, which must stay where it is.
  explicit TlogReader(Bytes log) : rest_(log) {}
  /// The next record; nullopt: the log is at its end. What is no record is skipped.
  std::optional<TlogRecord> next();
  std::uint64_t skipped_bytes() const { return skipped_bytes_; }  ///< that were no record

 private:
  PacketParser parser_{/*accept_mavlink1=*/true};
  Bytes rest_;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace trident::bridges::mavlink
