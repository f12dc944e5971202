// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace trident::bridges::nmea {

/// Kinds of what can be wrong with a sentence, or with what is to become one. Counted and logged by
/// kind.
enum class RefusalKind {
  kNoChecksum,     ///< "*hh" is missing
  kWrongChecksum,  ///< it is not that of the characters
  kTooLong,        ///< more characters than are legal
  kNotText,        ///< a byte within a sentence that is no printable character
  kBadAddress,     ///< no talker and type behind "$" or "!"
  kFieldCount,     ///< too few or too many fields
  kNotANumber,     ///< letters, NaN, infinity, an exponent where a number belongs
  kOutOfRange,     ///< a number or letter that is not legal
  kMissing,        ///< an empty field that the others need
  kBadPayload,     ///< AIS: characters, length or order of parts
  kCount           ///< of kinds
};

/// Number of kinds.
inline constexpr std::size_t kRefusalKinds = static_cast<std::size_t>(RefusalKind::kCount);

/// "wrong checksum": as it is shown in logs and /diagnostics.
const char* name_of(RefusalKind kind);

/// Why something was refused. Texts are views of constants, and `value` of the sentence: copy what
/// is to outlive the call that hands it out.
struct Refusal {
  Refusal() = default;
  /// `legal` says what is; a value that stood there as text.
  Refusal(RefusalKind the_kind, const char* the_field, std::string_view the_value,
          const char* what_is_legal)
      : kind(the_kind), field(the_field), value(the_value), legal(what_is_legal) {}
  /// [lo, hi] is legal; a value that stood there as text.
  Refusal(RefusalKind the_kind, const char* the_field, std::string_view the_value, double low,
          double high)
      : kind(the_kind), field(the_field), value(the_value), lo(low), hi(high) {}
  /// [lo, hi] is legal; a value that is a number.
  Refusal(RefusalKind the_kind, const char* the_field, double the_number, double low, double high)
      : kind(the_kind), field(the_field), number(the_number), is_number(true), lo(low), hi(high) {}

  RefusalKind kind = RefusalKind::kMissing;
  const char* field = "";     ///< name of the field, "checksum", "sentence"
  std::string_view value;     ///< as it stood there
  double number = 0.0;        ///< the value instead, where `is_number`
  bool is_number = false;     ///< whether `number` is the value
  const char* legal = "";     ///< what is legal; empty: [lo, hi]
  double lo = 0.0, hi = 0.0;  ///< the legal range
};

/// "latitude is '9100.00000', legal: [-90, 90]". Allocates.
std::string to_text(const Refusal& refusal);

/// How often each kind occurred.
class RefusalCounts {
 public:
  void count(RefusalKind kind) { ++counts_[static_cast<std::size_t>(kind)]; }  ///< one more
  /// Since the beginning.
  std::size_t of(RefusalKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  std::size_t total() const;  ///< of all kinds

 private:
  std::array<std::size_t, kRefusalKinds> counts_{};
};

}  // namespace trident::bridges::nmea
