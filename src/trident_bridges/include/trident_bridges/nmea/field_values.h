// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace trident::bridges::nmea {

/// hhmmss.ss of a sentence, UTC.
struct TimeOfDay {
  int hour = 0;         ///< [0, 23]
  int minute = 0;       ///< [0, 59]
  double second = 0.0;  ///< [0, 61): 60 in a leap second

  friend bool operator==(const TimeOfDay& a, const TimeOfDay& b) {
    return a.hour == b.hour && a.minute == b.minute && a.second == b.second;
  }
};

/// Whatever the locale is.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// What talkers and sentences have as names.
inline bool is_capital_or_digit(char c) { return is_digit(c) || (c >= 'A' && c <= 'Z'); }

/// Legal values of a number in a sentence, in the sentence's unit.
struct Limits {
  double lo = 0.0;  ///< legal itself
  double hi = 0.0;  ///< legal itself
};

/// How a number is written.
struct NumberFormat {
  int decimals = 0;    ///< behind the point; 0: no point
  int min_digits = 1;  ///< before the point, filled with zeros
};

/// Reads a number: an optional sign, digits, optionally a point and more digits; no exponent, no
/// "nan", no "inf", no blanks. The nearest double to numbers of up to 15 digits. False: it is
/// something else.
bool parse_number(std::string_view text, double* value);
/// Reads an unsigned whole number of up to nine digits. False: it is something else.
bool parse_digits(std::string_view text, int* value);

/// Writes numbers and texts one behind another into a buffer of fixed size.
class CharWriter {
 public:
  /// `buffer` holds `capacity` characters and outlives the writer.
  CharWriter(char* buffer, std::size_t capacity) : buffer_(buffer), capacity_(capacity) {}

  void put(char c);                 ///< one character
  void put(std::string_view text);  ///< all of it
  /// Rounded half away from zero. Requires |value| * 10^decimals < 2^53.
  void put_number(double value, const NumberFormat& format);
  /// Requires value >= 0.
  void put_digits(long long value, int min_digits);

  std::size_t size() const { return size_; }                  ///< written so far
  bool has_overflowed() const { return overflowed_; }         ///< something did not fit
  std::string_view view() const { return {buffer_, size_}; }  ///< what was written

 private:
  char* buffer_;
  std::size_t capacity_, size_ = 0;
  bool overflowed_ = false;
};

}  // namespace trident::bridges::nmea
