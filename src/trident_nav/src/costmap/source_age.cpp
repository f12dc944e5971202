// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/source_age.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trident::nav {
namespace {

constexpr std::size_t kIntervals = 15;  // so many that a lost message or a burst moves no median
constexpr double kPeriods = 3.0;
constexpr double kMinLimit = 0.3;         // [s]
constexpr double kUnmeasuredLimit = 1.0;  // [s]: while the second data are awaited

}  // namespace

void SourceAge::note(double stamp_s) {
  if (has_data_ && stamp_s < newest_s_) intervals_s_.clear();
  if (has_data_ && stamp_s > newest_s_) {
    intervals_s_.push_back(stamp_s - newest_s_);
    if (intervals_s_.size() > kIntervals) intervals_s_.pop_front();
  }
  has_data_ = true;
  newest_s_ = stamp_s;
}

double SourceAge::period_s() const {
  if (intervals_s_.empty()) return 0.0;
  std::vector<double> sorted(intervals_s_.begin(), intervals_s_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

double SourceAge::limit_s() const {
  if (limits_.max_age_s > 0.0) return limits_.max_age_s;
  if (limits_.expected_period_s > 0.0) return limits_.expected_period_s;
  if (limits_.max_age_s == 0.0) return std::numeric_limits<double>::infinity();
  if (intervals_s_.empty()) return kUnmeasuredLimit;
  return std::max(kPeriods * period_s(), kMinLimit);
}

double SourceAge::age_s(double now_s) const {
  if (!has_data_) return std::numeric_limits<double>::infinity();
  return std::abs(now_s - newest_s_);
}

}  // namespace trident::nav
