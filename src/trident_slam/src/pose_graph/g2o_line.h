// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "trident_base/error.h"
#include "trident_base/shown_text.h"
#include "trident_base/string_util.h"

namespace trident::slam {

/// The words of one line of a g2o file, taken one after the other.
class G2oLine {
 public:
  G2oLine(std::string_view text, const std::string& file, int number)
      : rest_(text), file_(file), number_(number) {
    skip_blanks();
  }

  bool is_at_end() const { return rest_.empty(); }
  std::string_view word() {
    const std::size_t end = std::min(rest_.find_first_of(" \t\r"), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(end);
    skip_blanks();
    return result;
  }
  double number(const char* field) {
    const std::string_view text = word();
    const std::string_view digits = text.substr(starts_with(text, "+") ? 1 : 0);
    double value = 0.0;
    const auto [end, problem] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem == std::errc::result_out_of_range) value = 0.0;  // fewer digits than a double has
    const bool is_whole = !text.empty() && end == digits.data() + digits.size();
    if (!is_whole || !std::isfinite(value)) fail(field, text, "a finite number");
    return value;
  }
  int id(const char* field) {
    const std::string_view text = word();
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || problem != std::errc() || end != text.data() + text.size()) {
      fail(field, text, "a whole number that fits into 32 bits");
    }
    return value;
  }
  void end() {
    if (!is_at_end()) fail("what follows the last field", rest_, "nothing");
  }
  [[noreturn]] void fail(std::string_view field, std::string_view value,
                         const std::string& wanted) const {
    const std::string shown =
        value.empty() ? "missing" : "'" + with_short_words(std::string(value)) + "'";
    throw Error(where() + ": " + std::string(field) + " is " + shown + ", but must be " + wanted);
  }
  std::string where() const { return file_ + ":" + std::to_string(number_); }

 private:
  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
  }

  std::string_view rest_;
  const std::string& file_;
  int number_;
};

}  // namespace trident::slam
