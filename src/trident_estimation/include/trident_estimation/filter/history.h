// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "trident_estimation/filter/filter.h"

namespace trident::estimation {

/// A filter that takes measurements in any order: one that comes late is put where its stamp
/// belongs, and all after it are filtered again. What it believes depends on the measurements, not
/// on the order of their arrival, as long as none comes later than `keep`.
class History {
 public:
  /// `start`: the belief before all measurements. `keep`: how much later than a newer one a
  /// measurement may come, not negative; throws Error else.
  History(Filter start, SimTime keep);

  /// What became of it now; a later call with an older measurement may change that. Refused when it
  /// is older than `keep` behind the newest, or than the start.
  Outcome add(Measurement measurement);

  /// The belief after the newest measurement.
  const Filter& newest() const { return entries_.empty() ? start_ : entries_.back().after; }

  /// The belief at a moment, by what was measured until then; none for one that is not kept.
  std::optional<Filter> at(SimTime stamp) const;

  std::size_t size() const { return entries_.size(); }  ///< measurements that are kept

 private:
  struct Entry {
    Measurement measurement;
    Filter after;
    Outcome outcome;
  };

  void filter_again(std::size_t first);
  void drop_old();

  Filter start_;  ///< before the first entry
  SimTime keep_;
  std::deque<Entry> entries_;  ///< by stamp, source, values
};

}  // namespace trident::estimation
