// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_bridges/nmea/receive/utc_resolver.h"
#include "trident_bridges/nmea/sentence.h"

namespace trident::bridges::nmea {

/// Says when each sentence of a recording was sent, by the times in it: GGA, GLL, RMC, GST, GBS and
/// ZDA begin an epoch, to which sentences without a time belong that follow.
class ReplayPacer {
 public:
  /// Seconds since the first time in the recording; never less than for the sentence before. A gap
  /// of more than kMaxGapS, or a time that went back, counts as one of kJumpS.
  double due_s(const Sentence& sentence);

  static constexpr double kMaxGapS = 60.0;  ///< between epochs
  static constexpr double kJumpS = 1.0;     ///< in place of a longer one

 private:
  UtcResolver utc_;
  std::optional<std::int64_t> epoch_ns_;  ///< the newest time
  double due_s_ = 0.0;
};

}  // namespace trident::bridges::nmea
