// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <limits>

namespace trident::nav {

/// How old the newest data of a source may be.
struct SourceAgeLimits {
  /// costmap_2d's `expected_update_rate`, which is a period: the limit if positive [s].
  double expected_period_s = 0.0;
  /// `max_source_age`: the limit if positive; 0: none but expected_period_s, which is what
  /// costmap_2d does; negative: three of the source's own periods, and at least 0.3 s [s].
  double max_age_s = -1.0;
};

/// How often a source sends, and whether it has stopped.
class SourceAge {
 public:
  explicit SourceAge(SourceAgeLimits limits = {}) : limits_(limits) {}

  /// Takes note of data that were measured at a time [s]. Older ones than the last mean that time
  /// was set back: the period is measured again.
  void note(double stamp_s);

  bool has_data() const { return has_data_; }
  /// When the newest data were measured; 0 before the first [s].
  double newest_s() const { return newest_s_; }
  /// The median of the latest intervals between data [s]; 0 before the second data.
  double period_s() const;
  /// The most that age_s() may be; infinite when nothing limits it [s].
  double limit_s() const;
  /// How far the newest data lie in the past, or, when time was set back, in the future; infinite
  /// before the first [s].
  double age_s(double now_s) const;
  bool is_stale(double now_s) const { return age_s(now_s) > limit_s(); }

 private:
  SourceAgeLimits limits_;
  bool has_data_ = false;
  double newest_s_ = 0.0;
  std::deque<double> intervals_s_;
};

}  // namespace trident::nav
