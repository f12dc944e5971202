// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trident::sim {

/// How one station hears one frame.
struct Reception {
  /// A time without a change of what else is on the air.
  struct Segment {
    std::int64_t end_ns;
    double sinr_db;
  };
  int station = 0;
  double signal_mw = 0.0, interference_mw = 0.0, noise_mw = 0.0;
  bool is_audible = false;  ///< keeps the station from sending
  bool is_locked = false;   ///< the station listens to this frame
  std::vector<Segment> segments;

  /// Ends a segment, as something else on the air begins or ends.
  void cut(std::int64_t now_ns);
  /// Probability that bytes which lie in that part of the frame arrive.
  double success(int mcs, std::size_t bytes, std::int64_t begin_ns, std::int64_t end_ns) const;
};

/// A frame on the air.
struct Transmission {
  /// kRequest: asks once more for the acknowledgement of an A-MPDU.
  enum class Kind { kData, kAck, kRequest };
  std::uint64_t id = 0;
  Kind kind = Kind::kData;
  int source = 0, destination = 0;
  std::int64_t begin_ns = 0, end_ns = 0;
  int mcs = 0;  ///< of the modulation and code
  std::size_t subframes = 1;
  std::uint64_t frame = 0;            ///< counts the frames of the pair
  std::vector<Reception> receptions;  ///< by station

  /// nullptr: the station does not hear it.
  Reception* reception(int station);
};

}  // namespace trident::sim
