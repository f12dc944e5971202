// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/refusal.h"

namespace trident::bridges::nmea {

/// The archive that writes a sentence's struct as fields; see FieldReader for what each function
/// stands for. A value that is not legal is refused, and nothing of the sentence is sent.
class FieldWriter {
 public:
  /// `omitted_decimals`: digits that numbers of Rounding::kAllowed are cut by, so that a long
  /// sentence fits. `out` outlives the writer.
  FieldWriter(CharWriter& out, int omitted_decimals)
      : out_(out), omitted_decimals_(omitted_decimals) {}

  void time(const char* name, std::optional<TimeOfDay>& value);      ///< hhmmss.ss
  void date(const char* name, std::optional<CivilDate>& value);      ///< ddmmyy
  void latitude(const char* name, std::optional<double>& degrees);   ///< minutes with 5 decimals
  void longitude(const char* name, std::optional<double>& degrees);  ///< minutes with 5 decimals
  /// Cut by `omitted_decimals` where that many and one more are asked for.
  void real(const char* name, std::optional<double>& value, const Limits& limits,
            const NumberFormat& format);
  void whole(const char* name, std::optional<int>& value, const Limits& limits, int min_digits = 1);
  void sided(const char* name, std::optional<double>& value, const Limits& limits,
             const NumberFormat& format, const char* letters);    ///< magnitude and letter
  void letter(const char* name, char& value, const char* legal);  ///< '\0': an empty field
  void constant(const char* name, char letter);                   ///< always written
  /// Without the characters that the standard reserves, which are left out.
  template <std::size_t Capacity>
  void text(const char* name, FixedText<Capacity>& value) {
    put_text(name, value.view());
  }
  void may_end() {}  ///< the newest revision is written
  /// One group behind the other.
  template <class T, std::size_t Capacity>
  void groups(const char* /*name*/, FixedList<T, Capacity>& items, std::size_t /*behind*/ = 0) {
    for (T& item : items) item.visit(*this);
  }

  /// Whether all was legal; else `refusal` is filled.
  bool finish(Refusal* refusal) const;

 private:
  bool accepts(const char* name, double value, const Limits& limits);
  void angle(const char* name, const std::optional<double>& degrees, int degree_digits,
             double limit, const char* letters);
  void put_text(const char* name, std::string_view text);

  CharWriter& out_;
  int omitted_decimals_;
  bool has_failed_ = false;
  Refusal refusal_;
};

}  // namespace trident::bridges::nmea
