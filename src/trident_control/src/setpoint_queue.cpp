// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/setpoint_queue.h"

#include <algorithm>
#include <cstdlib>

namespace trident {
namespace {

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
  bool starts_message = true;
  for (const TimedSetpoint& timed : points) {
    pending_.push_back({stamp, timed.time_from_start - first, timed.point, starts_message});
    starts_message = false;
  }
  return result;
}

const TrajectoryPoint* SetpointQueue::advance(SimTime state_stamp) {
  was_reset_ = last_state_ && state_stamp < *last_state_;
  if (was_reset_) reset_to(state_stamp);
  if (!pending_.empty()) schedule_pending(state_stamp);
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
  const SimTime lead = stamp - state_stamp;
  const bool is_usable = lead <= SimTime::from_seconds(params_.max_lead_s) &&
                         lead >= SimTime::from_seconds(-params_.max_age_s);
  return is_usable ? stamp : state_stamp;
}

void SetpointQueue::drop_from(SimTime start) {
  const auto first = std::lower_bound(
      scheduled_.begin() + static_cast<std::ptrdiff_t>(next_), scheduled_.end(), start,
      [](const Scheduled& scheduled, SimTime time) { return scheduled.effect < time; });
  scheduled_.erase(first, scheduled_.end());
}

void SetpointQueue::schedule_pending(SimTime state_stamp) {
  scheduled_.erase(scheduled_.begin(), scheduled_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  SimTime start;
  for (const Pending& pending : pending_) {
    if (pending.starts_message) {
      start = start_of(pending.stamp, state_stamp);
      drop_from(start);
    }
    scheduled_.push_back({start + pending.offset, pending.point});
  }
  pending_.clear();
}

}  // namespace trident
