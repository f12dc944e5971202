// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/history.h"

#include <algorithm>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

bool is_less(const double* a, Eigen::Index count_a, const double* b, Eigen::Index count_b) {
  return std::lexicographical_compare(a, a + count_a, b, b + count_b);
}

// An order that does not know when a measurement arrived.
bool is_before(const Measurement& a, const Measurement& b) {
  if (a.stamp != b.stamp) return a.stamp < b.stamp;
  if (a.source != b.source) return a.source < b.source;
  if (is_less(a.z.data(), a.z.size(), b.z.data(), b.z.size())) return true;
  if (is_less(b.z.data(), b.z.size(), a.z.data(), a.z.size())) return false;
  return is_less(a.R.data(), a.R.size(), b.R.data(), b.R.size());
}

std::string too_old(const Measurement& measurement, SimTime oldest) {
  return measurement.source + ": stamp is " + number_text(measurement.stamp.seconds()) +
         " s, legal is at least " + number_text(oldest.seconds()) + " s";
}

}  // namespace

History::History(Filter start, SimTime keep) : start_(std::move(start)), keep_(keep) {
  if (keep < SimTime{}) {
    throw Error("filter: keep is " + number_text(keep.seconds()) + " s, legal is at least 0");
  }
}

Outcome History::add(Measurement measurement) {
  const SimTime oldest = std::max(start_.stamp(), newest().stamp() - keep_);
  if (measurement.stamp < oldest) {
    Outcome outcome;
    outcome.reason = too_old(measurement, oldest);
    return outcome;
  }
  const auto place = std::upper_bound(
      entries_.begin(), entries_.end(), measurement,
      [](const Measurement& one, const Entry& entry) { return is_before(one, entry.measurement); });
  const auto index = static_cast<std::size_t>(place - entries_.begin());
  entries_.insert(place, Entry{std::move(measurement), start_, {}});
  filter_again(index);
  Outcome outcome = entries_[index].outcome;
  if (outcome.kind == Outcome::Kind::kRefused) {
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(index));
    filter_again(index);
  }
  drop_old();
  return outcome;
}

std::optional<Filter> History::at(SimTime stamp) const {
  if (stamp < start_.stamp()) return std::nullopt;
  const auto after = std::find_if(entries_.begin(), entries_.end(), [stamp](const Entry& entry) {
    return stamp < entry.measurement.stamp;
  });
  Filter filter = after == entries_.begin() ? start_ : std::prev(after)->after;
  if (!filter.predict_to(stamp)) return std::nullopt;
  return filter;
}

void History::filter_again(std::size_t first) {
  for (std::size_t i = first; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    entry.after = i == 0 ? start_ : entries_[i - 1].after;
    if (entry.after.predict_to(entry.measurement.stamp)) {
      entry.outcome = entry.after.update(entry.measurement);
    } else {
      entry.outcome = {};
      entry.outcome.reason = entry.measurement.source + ": the model gives what is not finite";
    }
  }
}

void History::drop_old() {
  const SimTime oldest = newest().stamp() - keep_;
  while (!entries_.empty() && entries_.front().measurement.stamp < oldest) {
    start_ = entries_.front().after;
    entries_.pop_front();
  }
}

}  // namespace trident::estimation
