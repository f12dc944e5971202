// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/config_types.h"

#include <cmath>

#include "trident_base/string_util.h"

namespace trident {

bool Range::contains(double value) const {
  if (std::isnan(value) || (std::isinf(value) && !infinite)) return false;
  const bool is_above = lo_open ? value > lo : value >= lo;
  const bool is_below = hi_open ? value < hi : value <= hi;
  return is_above && is_below;
}

namespace {

/// An interval in the notation of mathematics: a round bracket excludes its end.
std::string interval_text(const Range& range) {
  return std::string("in ") + (range.lo_open ? '(' : '[') + number_text(range.lo) + ", " +
         number_text(range.hi) + (range.hi_open ? ')' : ']');
}

}  // namespace

std::string Range::text() const {
  const bool has_lo = std::isfinite(lo);
  const bool has_hi = std::isfinite(hi);
  const std::string suffix = infinite ? " or infinite" : "";
  if (has_lo && has_hi) return interval_text(*this);
  if (has_lo) return (lo_open ? "> " : ">= ") + number_text(lo) + suffix;
  if (has_hi) return (hi_open ? "< " : "<= ") + number_text(hi) + suffix;
  return "finite" + suffix;
}

}  // namespace trident
