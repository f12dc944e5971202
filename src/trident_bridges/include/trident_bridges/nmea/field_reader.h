// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/refusal.h"
#include "trident_bridges/nmea/sentence.h"

namespace trident::bridges::nmea {

/// The archive that fills a sentence's struct from its fields, in their order. An empty field
/// leaves a value absent. After the first thing that is wrong nothing more is read.
class FieldReader {
 public:
  /// `sentence` outlives the reader.
  explicit FieldReader(const Sentence& sentence) : sentence_(sentence) {}

  /// hhmmss, seconds with decimals where the sender gives them.
  void time(const char* name, std::optional<TimeOfDay>& value);
  /// ddmmyy, 1980 to 2079.
  void date(const char* name, std::optional<CivilDate>& value);
  /// ddmm.mmmmm and N or S: two fields, north is positive [deg].
  void latitude(const char* name, std::optional<double>& degrees);
  /// dddmm.mmmmm and E or W: two fields, east is positive [deg].
  void longitude(const char* name, std::optional<double>& degrees);
  /// A number; `format` is for the writer.
  void real(const char* name, std::optional<double>& value, const Limits& limits,
            const NumberFormat& format);
  /// A whole number; one with a point is refused.
  void whole(const char* name, std::optional<int>& value, const Limits& limits, int min_digits = 1);
  /// A number and a letter that says on which side it lies: `letters` has that of the positive
  /// side first.
  void sided(const char* name, std::optional<double>& value, const Limits& limits,
             const NumberFormat& format, const char* letters);
  /// One letter of `legal`; '\0' when absent.
  void letter(const char* name, char& value, const char* legal);
  /// A letter that never changes, such as a unit; may be absent.
  void constant(const char* name, char letter);
  /// Any text.
  template <std::size_t Capacity>
  void text(const char* name, FixedText<Capacity>& value) {
    value.assign(next_text(name, Capacity));
  }
  /// Older revisions of the standard end here.
  void may_end();
  /// The rest of the fields, in groups of T::kFields, but for those behind them, of which there are
  /// `behind` or none.
  template <class T, std::size_t Capacity>
  void groups(const char* name, FixedList<T, Capacity>& items, std::size_t behind = 0) {
    items.clear();
    std::size_t groups = count_groups(name, T::kFields, behind, Capacity);
    for (; groups > 0 && !has_failed_; --groups) {
      T item;
      item.visit(*this);
      items.push_back(item);
    }
  }

  /// Whether all was legal, the number of fields included; else `refusal` is filled.
  bool finish(Refusal* refusal);

 private:
  struct AngleForm;

  std::string_view next();
  std::string_view next_text(const char* name, std::size_t capacity);
  void angle(const char* name, std::optional<double>& degrees, const AngleForm& form);
  void refuse(const Refusal& refusal);
  std::size_t count_groups(const char* name, std::size_t fields, std::size_t behind,
                           std::size_t most);

  const Sentence& sentence_;
  std::size_t next_ = 0;       ///< index of the next field
  std::size_t min_count_ = 0;  ///< of fields; 0: no revision ends earlier
  bool has_failed_ = false;
  Refusal refusal_;
};

}  // namespace trident::bridges::nmea
