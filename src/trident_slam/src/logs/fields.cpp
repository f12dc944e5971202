// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "fields.h"

#include <charconv>
#include <cmath>

namespace trident::slam {
namespace {

template <class Number>
bool parse(std::string_view word, Number& value) {
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return code == std::errc() && end == word.data() + word.size() && !word.empty();
}

constexpr std::int64_t kSecond = 1'000'000'000;  // [ns]

bool parse_seconds(std::string_view text, std::int64_t& seconds) {
  constexpr std::int64_t kMaxSeconds = INT64_MAX / kSecond - 1;
  return parse(text, seconds) && seconds >= 0 && seconds <= kMaxSeconds;
}

/// The digits behind the point of a number of seconds.
bool parse_fraction(std::string_view digits, std::int64_t& nanoseconds) {
  nanoseconds = 0;
  std::int64_t unit = kSecond / 10;
  for (const char c : digits) {
    if (c < '0' || c > '9') return false;
    nanoseconds += unit * (c - '0');
    unit /= 10;
  }
  return true;
}

}  // namespace

std::string_view Fields::word() {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t begin = text_.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    text_ = {};
    return {};
  }
  const std::size_t end = std::min(text_.find_first_of(kBlanks, begin), text_.size());
  const std::string_view result = text_.substr(begin, end - begin);
  text_.remove_prefix(end);
  return result;
}

bool Fields::number(double& value) { return parse(word(), value); }

bool Fields::number(float& value) { return parse(word(), value); }

bool Fields::count(std::size_t& value) { return parse(word(), value); }

bool Fields::finite(double& value) { return number(value) && std::isfinite(value); }

/// Digits are read exactly: a double holds a time of today only to some hundred nanoseconds.
bool Fields::stamp(std::int64_t& nanoseconds) {
  std::string_view text = word();
  const bool is_negative = !text.empty() && text.front() == '-';
  if (is_negative) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  std::int64_t seconds = 0;
  if (!parse_seconds(text.substr(0, point), seconds)) return false;
  std::int64_t fraction = 0;
  if (!parse_fraction(text.substr(std::min(point + 1, text.size())), fraction)) return false;
  nanoseconds = seconds * kSecond + fraction;
  if (is_negative) nanoseconds = -nanoseconds;
  return true;
}

}  // namespace trident::slam
