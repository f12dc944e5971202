// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace trident::slam {

/// Blank-separated fields of one line, taken from the left.
class Fields {
 public:
  explicit Fields(std::string_view text) : text_(text) {}

  /// Empty at the end of the line.
  std::string_view word();
  /// False when the next field is missing or no number of that kind.
  bool number(double& value);
  bool number(float& value);
  bool count(std::size_t& value);
  bool finite(double& value);
  /// A number of seconds, read digit by digit: 1e9 s and their nanoseconds do not fit a double.
  bool stamp(std::int64_t& nanoseconds);

 private:
  std::string_view text_;
};

}  // namespace trident::slam
