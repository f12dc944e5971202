// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/setpoint_queue.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace trident::control {
namespace {

/// Points for which there is memory from the start: usual trajectories allocate nothing in flight.
constexpr std::size_t kReserved = 256;

SetpointResult check(Span<const TimedSetpoint> points) {
  if (points.empty()) return SetpointResult::empty;
  if (points.size() > SetpointQueue::kMaxPoints) return SetpointResult::too_many_points;
  SimTime previous;
  for (const TimedSetpoint& timed : points) {
    if (!is_valid(timed.point)) return SetpointResult::non_finite;
    if (timed.time_from_start < previous) return SetpointResult::unordered;
    previous = timed.time_from_start;
  }
  return SetpointResult::accepted;
}

/// FNV-1a, by words.
class Digest {
 public:
  void add(const void* data, std::size_t words) {
    for (std::size_t i = 0; i < words; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, static_cast<const char*>(data) + sizeof(word) * i, sizeof(word));
      value_ = (value_ ^ word) * 0x100000001b3ull;
      // A product carries bits upwards only; this brings
      // a double's leading digits down to the others.
      value_ ^= value_ >> 32;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace

SetpointQueue::SetpointQueue(const SetpointQueueParams& params) : params_(params) {
  pending_.reserve(kReserved);
  scheduled_.reserve(kReserved);
}

SetpointResult SetpointQueue::push(SimTime stamp, Span<const TimedSetpoint> points) {
  const SetpointResult result = check(points);
  if (result != SetpointResult::accepted) return result;
  // While no states come, an unbounded stream of messages must not fill the memory.
  if (pending_.size() + points.size() > 2 * kMaxPoints) pending_.clear();
  const SimTime first = params_.first_point_at_start ? points.front().time_from_start : SimTime{};
  const std::size_t begin = pending_.size();
  bool starts_message = true;
  for (const TimedSetpoint& timed : points) {
    pending_.push_back({stamp, timed.time_from_start - first, timed.point, starts_message});
    starts_message = false;
  }
  const Span<const Pending> message(pending_.data() + begin, pending_.size() - begin);
  repeats_ = is_repeated_in_pending(begin) || is_repeated(message);
  pending_[begin].is_repeated = repeats_;
  return result;
}

// While the world stands still no state takes what came, so that it is there twice.
bool SetpointQueue::is_repeated_in_pending(std::size_t begin) const {
  const SimTime stamp = pending_[begin].stamp;
  if (stamp == SimTime{}) return false;
  const Span<const Pending> pending(pending_.data(), pending_.size());
  const std::uint64_t digest = digest_of(pending.subspan(begin, pending.size() - begin));
  for (std::size_t end = begin, i = begin; i-- > 0;) {
    if (pending[i].stamp == SimTime{}) return false;  // it takes the place of all before
    if (!pending[i].starts_message) continue;
    if (pending[i].is_repeated) {  // it does not describe what came before it
      end = i;
      continue;
    }
    if (pending[i].stamp == stamp && digest_of(pending.subspan(i, end - i)) == digest) return true;
    if (pending[i].stamp <= stamp) return false;
    end = i;
  }
  return false;
}

const TrajectoryPoint* SetpointQueue::advance(SimTime state_stamp) {
  was_reset_ = last_state_ && state_stamp < *last_state_;
  if (was_reset_) reset_to(state_stamp);
  if (!pending_.empty()) schedule_pending(state_stamp);
  // Of points that have become due since the last state only the newest counts.
  while (next_ < scheduled_.size() && scheduled_[next_].effect <= state_stamp) {
    active_ = scheduled_[next_++].point;
  }
  last_state_ = state_stamp;
  return active_ ? &*active_ : nullptr;
}

void SetpointQueue::reset_to(SimTime state_stamp) {
  if (!params_.keep_setpoint_over_reset) active_.reset();
  scheduled_.clear();
  next_ = 0;
  // A message of the old time that comes again is a new one in the new time.
  accepted_count_ = 0;
  // What came in since the last state of the old time may already be meant for the new one:
  // unstamped messages are, and those whose stamp lies nearer to the new time than to the old.
  const SimTime old_now = *last_state_;
  const auto is_of_old_time = [&](const Pending& pending) {
    if (pending.stamp == SimTime{}) return false;
    const auto distance = [&](SimTime now) { return std::abs((pending.stamp - now).ns); };
    return distance(state_stamp) >= distance(old_now);
  };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), is_of_old_time), pending_.end());
}

SimTime SetpointQueue::start_of(SimTime stamp, SimTime state_stamp) const {
  if (stamp == SimTime{}) return state_stamp;
  // A stamp far from the state's is one of another clock, or too old to anchor a trajectory.
  const SimTime lead = stamp - state_stamp;
  const bool is_usable = lead <= SimTime::from_seconds(params_.max_lead_s) &&
                         lead >= SimTime::from_seconds(-params_.max_age_s);
  return is_usable ? stamp : state_stamp;
}

void SetpointQueue::drop_from(SimTime start) {
  // An active point is before next_ and stays; what is scheduled is in order of time.
  const auto first = std::lower_bound(
      scheduled_.begin() + static_cast<std::ptrdiff_t>(next_), scheduled_.end(), start,
      [](const Scheduled& scheduled, SimTime time) { return scheduled.effect < time; });
  scheduled_.erase(first, scheduled_.end());
}

std::uint64_t SetpointQueue::digest_of(Span<const Pending> message) {
  Digest digest;
  for (const Pending& pending : message) {
    constexpr std::size_t kWords = sizeof(pending.point) / sizeof(double);
    static_assert(sizeof(pending.point) == kWords * sizeof(double));
    digest.add(&pending.offset.ns, 1);
    digest.add(&pending.point, kWords);
  }
  return digest.value();
}

// What came since an equal message has replaced nothing of it, as far as it began later.
bool SetpointQueue::is_repeated(Span<const Pending> message) const {
  const SimTime stamp = message[0].stamp;
  if (stamp == SimTime{}) return false;
  const std::uint64_t digest = digest_of(message);
  const std::size_t known = std::min(accepted_count_, kKnownAgain);
  for (std::size_t back = 1; back <= known; ++back) {
    const Accepted& before = accepted_[(accepted_count_ - back) % kKnownAgain];
    if (before.stamp == stamp && before.digest == digest) return true;
    if (before.stamp <= stamp) return false;
  }
  return false;
}

void SetpointQueue::remember(Span<const Pending> message) {
  if (message[0].stamp == SimTime{}) {
    accepted_count_ = 0;  // it takes the place of all
    return;
  }
  accepted_[accepted_count_++ % kKnownAgain] = {message[0].stamp, digest_of(message)};
}

void SetpointQueue::schedule_pending(SimTime state_stamp) {
  // Points that have taken effect go first, so that the vector does not grow with the flight.
  scheduled_.erase(scheduled_.begin(), scheduled_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  const Span<const Pending> pending(pending_.data(), pending_.size());
  for (std::size_t begin = 0; begin < pending.size();) {
    std::size_t end = begin + 1;
    while (end < pending.size() && !pending[end].starts_message) ++end;
    schedule(pending.subspan(begin, end - begin), state_stamp);
    begin = end;
  }
  pending_.clear();
}

void SetpointQueue::schedule(Span<const Pending> message, SimTime state_stamp) {
  if (is_repeated(message)) return;
  remember(message);
  const SimTime start = start_of(message[0].stamp, state_stamp);
  drop_from(start);
  for (const Pending& pending : message) {
    scheduled_.push_back({start + pending.offset, pending.point});
  }
}

}  // namespace trident::control
