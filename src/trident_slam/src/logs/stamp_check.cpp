// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "stamp_check.h"

#include <cstdio>

namespace trident::slam {

void StampCheck::Kind::add(std::size_t scan, double seconds) {
  if (count++ == 0) first = scan;
  if (seconds <= largest_s) return;
  largest = scan;
  largest_s = seconds;
}

std::string StampCheck::Kind::text(const char* what) const {
  if (count == 0) return {};
  char line[160];
  std::snprintf(line, sizeof(line), "%zu %s, first at scan %zu, most at scan %zu (%.3f s)", count,
                what, first, largest, largest_s);
  return line;
}

void StampCheck::add(std::int64_t stamp_ns) {
  ++scans_;
  if (last_ns_) {
    // As doubles: the difference of two absurd stamps does not fit an integer.
    const double passed = 1e-9 * (static_cast<double>(stamp_ns) - static_cast<double>(*last_ns_));
    if (stamp_ns < *last_ns_) back_.add(scans_, -passed);
    if (passed > kJump) jumps_.add(scans_, passed);
  }
  last_ns_ = stamp_ns;
}

std::string StampCheck::text() const {
  const std::string back = back_.text("stamps go back");
  const std::string jumps = jumps_.text("stamps jump ahead");
  if (back.empty() && jumps.empty()) return {};
  const std::string both = back + (back.empty() || jumps.empty() ? "" : "; ") + jumps;
  return both + ": scans are taken in the order of the log";
}

}  // namespace trident::slam
