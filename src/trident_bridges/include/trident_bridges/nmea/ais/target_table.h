// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trident_bridges/nmea/ais/messages.h"
#include "trident_bridges/nmea/ais/six_bit.h"
#include "trident_bridges/nmea/refusal.h"
#include "trident_bridges/nmea/sentences/ais_part.h"

namespace trident::bridges::nmea {

/// Puts messages together that come in several sentences.
class AisAssembler {
 public:
  /// The bits of a message when its last part has come; valid until the next call. nullptr: parts
  /// are missing, or with `refusal` filled it is wrong. `now_s`: any clock that does not go back.
  const AisBits* add(const AisPart& part, double now_s, Refusal* refusal, bool* is_refused);

  static constexpr double kMaxAgeS = 10.0;  ///< parts that are older are forgotten

 private:
  struct Slot {
    AisBits bits;
    int next_part = 0;  ///< 0: not in use
    int total = 0;
    double began_s = 0.0;
  };
  static constexpr std::size_t kSlots = 11;  ///< by sequence, and one for those without

  std::array<Slot, kSlots> slots_;
};

/// What is known of another station.
struct AisVessel {
  std::uint32_t mmsi = 0;
  std::uint32_t message_type = 0;  ///< of the newest message
  std::uint32_t status = 15;       ///< 15: not defined
  std::optional<double> turn_rate_deg_min;
  AisMotion motion;
  FixedText<20> name;
  FixedText<7> call_sign;
  std::uint32_t ship_type = 0;
  AisExtent extent;
  double heard_s = 0.0;  ///< when the newest message came
};

/// Keeps what stations have sent about themselves, so that a position comes with the name that was
/// sent minutes before.
class AisTargetTable {
 public:
  /// Reads a message and merges it with what is known. nullptr: of a type that is not understood,
  /// or with `refusal` filled it is wrong. Valid until the next call.
  const AisVessel* add(const AisBits& bits, double now_s, Refusal* refusal, bool* is_refused);
  std::size_t size() const { return vessels_.size(); }  ///< stations that are known

  static constexpr std::size_t kMaxVessels = 2'000;  ///< then the one not heard longest goes

 private:
  AisVessel& vessel(std::uint32_t mmsi);

  std::vector<AisVessel> vessels_;  ///< ordered by number
};

}  // namespace trident::bridges::nmea
