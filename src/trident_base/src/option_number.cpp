// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/option_number.h"

#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& kind, double lo, double hi) {
  throw Error("option " + option + " is '" + text + "', must be a " + kind + " in [" +
              number_text(lo) + ", " + number_text(hi) + "]");
}

}  // namespace

double option_number(const std::string& option, const std::string& text, double lo, double hi) {
  const std::optional<double> value = number_from_text(text);
  if (value && *value >= lo && *value <= hi) return *value;
  refuse(option, text, "number", lo, hi);
}

std::int64_t option_count(const std::string& option, const std::string& text, std::int64_t lo,
                          std::int64_t hi) {
  const std::optional<double> value = number_from_text(text);
  const auto low = static_cast<double>(lo);
  const auto high = static_cast<double>(hi);
  if (value && *value >= low && *value <= high && *value == std::floor(*value)) {
    return static_cast<std::int64_t>(*value);
  }
  refuse(option, text, "whole number", low, high);
}

}  // namespace trident
