// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/field_values.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace trident::bridges::nmea {
namespace {

constexpr int kMaxDigits = 18;  ///< that fit a 64-bit integer

constexpr std::array<double, kMaxDigits + 1> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                     1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                     1e14, 1e15, 1e16, 1e17, 1e18};

constexpr std::array<long long, 10> kWholePowers{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

}  // namespace

bool parse_number(std::string_view text, double* value) {
  std::size_t at = 0;
  const bool is_negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) ++at;
  std::int64_t mantissa = 0;
  int digits = 0, decimals = 0;
  bool has_point = false;
  for (; at < text.size(); ++at) {
    if (text[at] == '.' && !has_point) {
      has_point = true;
    } else if (is_digit(text[at]) && digits < kMaxDigits) {
      mantissa = 10 * mantissa + (text[at] - '0');
      ++digits;
      decimals += has_point ? 1 : 0;
    } else {
      return false;
    }
  }
  if (digits == 0) return false;
  const double magnitude =
      static_cast<double>(mantissa) / kPowers[static_cast<std::size_t>(decimals)];
  *value = is_negative ? -magnitude : magnitude;
  return true;
}

bool parse_digits(std::string_view text, int* value) {
  constexpr std::size_t kMaxDigitsOfWhole = 9;
  if (text.empty() || text.size() > kMaxDigitsOfWhole) return false;
  int result = 0;
  for (const char c : text) {
    if (!is_digit(c)) return false;
    result = 10 * result + (c - '0');
  }
  *value = result;
  return true;
}

void CharWriter::put(char c) {
  if (size_ == capacity_) {
    overflowed_ = true;
    return;
  }
  buffer_[size_++] = c;
}

void CharWriter::put(std::string_view text) {
  for (const char c : text) put(c);
}

void CharWriter::put_number(double value, const NumberFormat& format) {
  const long long scale = kWholePowers[static_cast<std::size_t>(format.decimals)];
  const long long scaled = std::llround(std::abs(value) * static_cast<double>(scale));
  if (value < 0.0 && scaled != 0) put('-');
  put_digits(scaled / scale, format.min_digits);
  if (format.decimals == 0) return;
  put('.');
  put_digits(scaled % scale, format.decimals);
}

void CharWriter::put_digits(long long value, int min_digits) {
  std::array<char, 20> digits{};
  int count = 0;
  for (; value > 0 || count < min_digits; value /= 10) {
    digits[static_cast<std::size_t>(count++)] = static_cast<char>('0' + value % 10);
  }
  while (count > 0) put(digits[static_cast<std::size_t>(--count)]);
}

}  // namespace trident::bridges::nmea
