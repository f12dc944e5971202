// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_estimation/filter/filter.h"
#include "trident_estimation/filter/trust.h"

namespace trident::estimation {

/// What became of all measurements of a source.
struct SourceReport {
  std::uint64_t used = 0, gated = 0, refused = 0;  ///< measurements
  Trust::Source trust;                             ///< after the newest measurement of all
};

/// A filter that takes measurements in any order: one that comes late is put where its stamp
/// belongs, and all after it are filtered again. What it believes depends on the measurements, not
/// on the order of their arrival, as long as none comes later than `keep`.
class History {
 public:
  /// `start`: the belief before all measurements. `keep`: how much later than a newer one a
  /// measurement may come, not negative; throws Error else. `trust`: whether covariances that are
  /// too small are inflated, and when; without it all are believed.
  History(Filter start, SimTime keep, std::optional<TrustParams> trust = {});

  /// What became of it now; a later call with an older measurement may change that. Refused when it
  /// is older than `keep` behind the newest, or than the start.
  Outcome add(Measurement measurement);

  /// The same for several, in any order: what is after the oldest is filtered again once.
  std::vector<Outcome> add_all(std::vector<Measurement> measurements);

  /// The belief after the newest measurement.
  const Filter& newest() const { return entries_.empty() ? start_ : entries_.back().after; }

  /// The belief at a moment, by what was measured until then; none for one that is not kept.
  std::optional<Filter> at(SimTime stamp) const;

  std::size_t size() const { return entries_.size(); }  ///< measurements that are kept

  /// By source. What became of measurements that are kept is as it is now.
  std::map<std::string, SourceReport> reports() const;

 private:
  struct Entry {
    Measurement measurement;
    std::size_t source;
    std::size_t arrival;  ///< its place in the call that brought it; of no meaning later
    Filter after;
    Trust trust;  ///< after it
    Outcome outcome;
  };

  std::size_t number_of(const std::string& source);
  std::size_t insert(Measurement measurement, std::size_t arrival);
  void filter_again(std::size_t first);
  bool take_outcomes(std::size_t first, std::vector<Outcome>& outcomes);
  void drop_refused(std::size_t first);
  void drop_old();

  Filter start_;  ///< before the first entry
  SimTime keep_;
  bool is_trusting_;  ///< whether all covariances are believed
  Trust start_trust_;
  std::deque<Entry> entries_;  ///< by stamp, source, values
  std::map<std::string, std::size_t> numbers_;
  std::vector<SourceReport> past_;  ///< by number: of measurements that are not kept
};

}  // namespace trident::estimation
