// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>
#include <optional>

#include "trident_base/random_stream.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/fixed.h"

namespace trident::bridges::nmea {

/// An archive that fills sentences with random legal values, one in eight absent.
class RandomFields {
 public:
  explicit RandomFields(std::uint64_t seed) : stream_(seed, "fields") {}

  void time(const char*, std::optional<TimeOfDay>& value) {
    value =
        TimeOfDay{static_cast<int>(below(24)), static_cast<int>(below(60)), 0.01 * below(6'100)};
    if (is_absent()) value.reset();
  }
  void date(const char*, std::optional<CivilDate>& value) {
    value = civil_from_days(3'657 + static_cast<std::int64_t>(below(36'000)));
    if (is_absent()) value.reset();
  }
  void latitude(const char*, std::optional<double>& degrees) { fill(degrees, -90.0, 90.0); }
  void longitude(const char*, std::optional<double>& degrees) { fill(degrees, -180.0, 180.0); }
  void real(const char*, std::optional<double>& value, const Limits& limits, const NumberFormat&) {
    fill(value, limits.lo, limits.hi);
  }
  void whole(const char*, std::optional<int>& value, const Limits& limits, int = 1) {
    const auto count = static_cast<std::uint64_t>(limits.hi - limits.lo) + 1;
    value = static_cast<int>(limits.lo) + static_cast<int>(below(count));
    if (is_absent()) value.reset();
  }
  void sided(const char*, std::optional<double>& value, const Limits& limits, const NumberFormat&,
             const char*) {
    fill(value, -limits.hi, limits.hi);
  }
  void letter(const char*, char& value, const char* legal) {
    value = is_absent() ? '\0' : legal[below(std::strlen(legal))];
  }
  void constant(const char*, char) {}
  template <std::size_t Capacity>
  void text(const char*, FixedText<Capacity>& value) {
    char characters[Capacity + 1] = {};
    const std::size_t size = below(std::min<std::size_t>(Capacity, 6) + 1);
    for (std::size_t i = 0; i < size; ++i) characters[i] = static_cast<char>('A' + below(26));
    value = FixedText<Capacity>(characters);
  }
  void may_end() {}
  template <class T, std::size_t Capacity>
  void groups(const char*, FixedList<T, Capacity>& items, std::size_t = 0) {
    items.clear();
    for (std::size_t size = below(5); size > 0 && !items.full(); --size) {
      T item;
      item.visit(*this);
      items.push_back(item);
    }
  }

 private:
  std::uint64_t below(std::uint64_t count) { return stream_.bits(index_++, 0) % count; }
  bool is_absent() { return below(8) == 0; }
  /// Small magnitudes are as frequent as large ones.
  void fill(std::optional<double>& value, double lo, double hi) {
    const double scale = std::pow(10.0, -static_cast<double>(below(6)));
    const double share = stream_.uniform(index_++, 1) * scale;
    value = below(2) == 0 ? lo * share : hi * share;
    if (*value < lo) value = lo;
    if (is_absent()) value.reset();
  }

  RandomStream stream_;
  std::uint64_t index_ = 0;
};

}  // namespace trident::bridges::nmea
