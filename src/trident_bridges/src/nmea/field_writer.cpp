// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/field_writer.h"

#include <cmath>
#include <cstring>

namespace trident::bridges::nmea {
namespace {

constexpr long long kMinuteScale = 100'000;  ///< 5 decimals
constexpr long long kDegreeScale = 60 * kMinuteScale;
constexpr int kMinuteDecimals = 5;
constexpr int kSecondHundredths = 100;

/// Characters that the standard reserves (NMEA 0183 4.11, table 1).
bool is_reserved(char c) { return c < ' ' || c > '~' || std::strchr("$*,!\\^~", c) != nullptr; }

}  // namespace

bool FieldWriter::accepts(const char* name, double value, const Limits& limits) {
  // The comparison is false for NaN, too.
  if (value >= limits.lo && value <= limits.hi) return true;
  if (!has_failed_) refusal_ = {RefusalKind::kOutOfRange, name, value, limits.lo, limits.hi};
  has_failed_ = true;
  return false;
}

void FieldWriter::time(const char* name, std::optional<TimeOfDay>& value) {
  out_.put(',');
  if (!value) return;
  const bool is_legal = accepts(name, value->hour, {0.0, 23.0}) &&
                        accepts(name, value->minute, {0.0, 59.0}) &&
                        accepts(name, value->second, {0.0, 60.999'999'999});
  if (!is_legal) return;
  out_.put_digits(value->hour, 2);
  out_.put_digits(value->minute, 2);
  // Cut, not rounded: 59.999 is not yet the next minute.
  const auto hundredths = static_cast<long long>(value->second * kSecondHundredths + 1e-6);
  out_.put_digits(hundredths / kSecondHundredths, 2);
  out_.put('.');
  out_.put_digits(hundredths % kSecondHundredths, 2);
}

void FieldWriter::date(const char* name, std::optional<CivilDate>& value) {
  out_.put(',');
  if (!value || !accepts(name, value->year, {1980.0, 2079.0})) return;
  out_.put_digits(value->day, 2);
  out_.put_digits(value->month, 2);
  out_.put_digits(value->year % 100, 2);
}

void FieldWriter::latitude(const char* name, std::optional<double>& degrees) {
  angle(name, degrees, 2, 90.0, "NS");
}

void FieldWriter::longitude(const char* name, std::optional<double>& degrees) {
  angle(name, degrees, 3, 180.0, "EW");
}

void FieldWriter::angle(const char* name, const std::optional<double>& degrees, int degree_digits,
                        double limit, const char* letters) {
  out_.put(',');
  long long units = 0;
  if (degrees && accepts(name, *degrees, {-limit, limit})) {
    // All in units of the last decimal of a minute, so that 59.999999 minutes become a degree.
    units = std::llround(std::abs(*degrees) * static_cast<double>(kDegreeScale));
    const long long minute_units = units % kDegreeScale;
    out_.put_digits(units / kDegreeScale, degree_digits);
    out_.put_digits(minute_units / kMinuteScale, 2);
    out_.put('.');
    out_.put_digits(minute_units % kMinuteScale, kMinuteDecimals);
  }
  out_.put(',');
  if (degrees) out_.put(*degrees < 0.0 && units != 0 ? letters[1] : letters[0]);
}

void FieldWriter::real(const char* name, std::optional<double>& value, const Limits& limits,
                       const NumberFormat& format) {
  out_.put(',');
  if (!value || !accepts(name, *value, limits)) return;
  const int decimals = std::max(format.decimals - omitted_decimals_, std::min(format.decimals, 1));
  out_.put_number(*value, {decimals, format.min_digits});
}

void FieldWriter::whole(const char* name, std::optional<int>& value, const Limits& limits,
                        int min_digits) {
  out_.put(',');
  if (!value || !accepts(name, *value, limits)) return;
  out_.put_number(*value, {0, min_digits});
}

void FieldWriter::sided(const char* name, std::optional<double>& value, const Limits& limits,
                        const NumberFormat& format, const char* letters) {
  std::optional<double> magnitude;
  if (value) magnitude = std::abs(*value);
  real(name, magnitude, limits, format);
  out_.put(',');
  // What is written as zero lies on the first side.
  const bool is_zero = value && *magnitude * std::pow(10.0, format.decimals) < 0.5;
  if (value) out_.put(*value < 0.0 && !is_zero ? letters[1] : letters[0]);
}

void FieldWriter::letter(const char* name, char& value, const char* legal) {
  out_.put(',');
  if (value == '\0') return;
  if (std::strchr(legal, value) == nullptr) {
    refusal_ = {RefusalKind::kOutOfRange, name, static_cast<double>(value), 0.0, 0.0};
    refusal_.legal = legal;
    has_failed_ = true;
    return;
  }
  out_.put(value);
}

void FieldWriter::constant(const char* /*name*/, char letter) {
  out_.put(',');
  out_.put(letter);
}

void FieldWriter::put_text(const char* /*name*/, std::string_view text) {
  out_.put(',');
  for (const char c : text) {
    if (!is_reserved(c)) out_.put(c);
  }
}

bool FieldWriter::finish(Refusal* refusal) const {
  if (has_failed_) *refusal = refusal_;
  return !has_failed_;
}

}  // namespace trident::bridges::nmea
