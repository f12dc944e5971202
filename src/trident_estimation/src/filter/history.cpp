// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/history.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

constexpr std::size_t kNotNew = std::numeric_limits<std::size_t>::max();

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

Outcome too_old(const Measurement& measurement, SimTime oldest) {
  Outcome outcome;
  outcome.reason = measurement.source + ": stamp is " + number_text(measurement.stamp.seconds()) +
                   " s, legal is at least " + number_text(oldest.seconds()) + " s";
  return outcome;
}

void count(const Outcome& outcome, SourceReport& report) {
  switch (outcome.kind) {
    case Outcome::Kind::kUsed:
      ++report.used;
      break;
    case Outcome::Kind::kGated:
      ++report.gated;
      break;
    case Outcome::Kind::kRefused:
      ++report.refused;
      break;
  }
}

}  // namespace

History::History(Filter start, SimTime keep, std::optional<TrustParams> trust)
    : start_(std::move(start)),
      keep_(keep),
      is_trusting_(!trust),
      start_trust_(trust.value_or(TrustParams{})) {
  if (keep < SimTime{}) {
    throw Error("filter: keep is " + number_text(keep.seconds()) + " s, legal is at least 0");
  }
  if (trust) trust->validate();
}

Outcome History::add(Measurement measurement) {
  std::vector<Measurement> one;
  one.push_back(std::move(measurement));
  return add_all(std::move(one)).front();
}

// Those of new entries, from one on. Whether any was refused.
bool History::take_outcomes(std::size_t first, std::vector<Outcome>& outcomes) {
  bool is_any_refused = false;
  for (std::size_t i = first; i < entries_.size(); ++i) {
    if (entries_[i].arrival == kNotNew) continue;
    outcomes[entries_[i].arrival] = entries_[i].outcome;
    entries_[i].arrival = kNotNew;
    is_any_refused = is_any_refused || entries_[i].outcome.kind == Outcome::Kind::kRefused;
  }
  return is_any_refused;
}

std::vector<Outcome> History::add_all(std::vector<Measurement> measurements) {
  std::vector<Outcome> outcomes(measurements.size());
  std::size_t first = entries_.size();
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const SimTime oldest = std::max(start_.stamp(), newest().stamp() - keep_);
    if (measurements[i].stamp < oldest) {
      outcomes[i] = too_old(measurements[i], oldest);
      count(outcomes[i], past_[number_of(measurements[i].source)]);
      continue;
    }
    first = std::min(first, insert(std::move(measurements[i]), i));
  }
  filter_again(first);
  if (take_outcomes(first, outcomes)) drop_refused(first);
  drop_old();
  return outcomes;
}

std::optional<Filter> History::at(SimTime stamp) const {
  if (stamp < start_.stamp()) return std::nullopt;
  const auto after = std::upper_bound(
      entries_.begin(), entries_.end(), stamp,
      [](SimTime when, const Entry& entry) { return when < entry.measurement.stamp; });
  Filter filter = after == entries_.begin() ? start_ : std::prev(after)->after;
  if (!filter.predict_to(stamp)) return std::nullopt;
  return filter;
}

std::map<std::string, SourceReport> History::reports() const {
  std::vector<SourceReport> all = past_;
  for (const Entry& entry : entries_) count(entry.outcome, all[entry.source]);
  const Trust& trust = entries_.empty() ? start_trust_ : entries_.back().trust;
  std::map<std::string, SourceReport> by_name;
  for (const auto& [name, number] : numbers_) {
    if (number < trust.sources().size()) all[number].trust = trust.sources()[number];
    by_name[name] = all[number];
  }
  return by_name;
}

std::size_t History::number_of(const std::string& source) {
  const auto [place, is_new] = numbers_.emplace(source, numbers_.size());
  if (is_new) past_.emplace_back();
  return place->second;
}

// Returns its place.
std::size_t History::insert(Measurement measurement, std::size_t arrival) {
  const std::size_t source = number_of(measurement.source);
  const auto place = std::upper_bound(
      entries_.begin(), entries_.end(), measurement,
      [](const Measurement& one, const Entry& entry) { return is_before(one, entry.measurement); });
  const auto index = static_cast<std::size_t>(place - entries_.begin());
  entries_.insert(place, Entry{std::move(measurement), source, arrival, start_, start_trust_, {}});
  return index;
}

void History::filter_again(std::size_t first) {
  for (std::size_t i = first; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    entry.after = i == 0 ? start_ : entries_[i - 1].after;
    entry.trust = i == 0 ? start_trust_ : entries_[i - 1].trust;
    if (entry.after.predict_to(entry.measurement.stamp)) {
      entry.outcome = entry.after.update(entry.measurement, entry.trust.inflation(entry.source),
                                         entry.trust.widening(entry.source));
      if (!is_trusting_) entry.trust.note(entry.source, entry.outcome);
    } else {
      entry.outcome = {};
      entry.outcome.reason = entry.measurement.source + ": the model gives what is not finite";
    }
  }
}

// What is refused leaves no trace but in the counts.
void History::drop_refused(std::size_t first) {
  for (std::size_t i = entries_.size(); i-- > first;) {
    if (entries_[i].outcome.kind != Outcome::Kind::kRefused) continue;
    count(entries_[i].outcome, past_[entries_[i].source]);
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  filter_again(first);
}

void History::drop_old() {
  const SimTime oldest = newest().stamp() - keep_;
  while (!entries_.empty() && entries_.front().measurement.stamp < oldest) {
    count(entries_.front().outcome, past_[entries_.front().source]);
    start_ = std::move(entries_.front().after);
    start_trust_ = std::move(entries_.front().trust);
    entries_.pop_front();
  }
}

}  // namespace trident::estimation
