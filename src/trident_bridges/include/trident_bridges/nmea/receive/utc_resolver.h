// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/receive/events.h"

namespace trident::bridges::nmea {

/// Finds the day of a time of day: of the last sentence that had a date, or of the
/// reader's clock. Across midnight the day is the one that is nearer.
class UtcResolver {
 public:
  /// A sentence that had both.
  void set(const CivilDate& date, const TimeOfDay& time);
  /// Unix time; nothing without any date. The days of later times are counted from it.
  std::optional<std::int64_t> unix_ns(const TimeOfDay& time, const Receipt& receipt);

 private:
  std::optional<std::int64_t> newest_ns_;  ///< Unix time of the newest, if one had a date
};

}  // namespace trident::bridges::nmea
