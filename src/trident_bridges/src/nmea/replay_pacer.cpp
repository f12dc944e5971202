// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/replay_pacer.h"

#include <type_traits>

#include "trident_bridges/nmea/all_sentences.h"

namespace trident::bridges::nmea {
namespace {

/// Whether sentences of type T say when they were made.
template <class T>
inline constexpr bool has_time_v =
    std::is_same_v<T, Gga> || std::is_same_v<T, Gll> || std::is_same_v<T, Rmc> ||
    std::is_same_v<T, Gst> || std::is_same_v<T, Gbs> || std::is_same_v<T, Zda>;

/// Any day: of a recording only differences of time count.
constexpr std::int64_t kSomeDayNs = 86'400LL * 1'000'000'000 * 10'000;

void note_date(const Rmc& value, UtcResolver& utc) {
  if (value.date && value.time) utc.set(*value.date, *value.time);
}

void note_date(const Zda& value, UtcResolver& utc) {
  if (value.date() && value.time) utc.set(*value.date(), *value.time);
}

/// All others have no date.
template <class T>
void note_date(const T& /*value*/, UtcResolver& /*utc*/) {}

/// Between two sentences whose times are so far apart.
double pause_s(std::int64_t step_ns) {
  const double step_s = 1e-9 * static_cast<double>(step_ns);
  const bool is_steady = step_s >= 0.0 && step_s <= ReplayPacer::kMaxGapS;
  return is_steady ? step_s : ReplayPacer::kJumpS;
}

}  // namespace

double ReplayPacer::due_s(const Sentence& sentence) {
  std::optional<std::int64_t> time_ns;
  const auto find_time = [&](const auto& value) {
    using T = std::decay_t<decltype(value)>;
    note_date(value, utc_);
    if constexpr (has_time_v<T>) {
      if (value.time) time_ns = utc_.unix_ns(*value.time, {0.0, epoch_ns_.value_or(kSomeDayNs)});
    }
  };
  Refusal refusal;
  decode(sentence, find_time, &refusal);
  if (!time_ns) return due_s_;
  if (epoch_ns_) due_s_ += pause_s(*time_ns - *epoch_ns_);
  epoch_ns_ = time_ns;
  return due_s_;
}

}  // namespace trident::bridges::nmea
