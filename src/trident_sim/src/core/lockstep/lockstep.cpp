// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/lockstep.h"

#include <algorithm>

#include "trident_base/error.h"

namespace trident::sim {

void LockstepVehicle::remember(SimTime stamp) {
  if (sent_count_ == 0) first_sent_ = stamp;
  sent_[sent_count_ % kRemembered] = stamp.ns;
  ++sent_count_;
}

/// Of the last kRemembered stamps each is known; before those any stamp since the first one counts.
bool LockstepVehicle::was_sent(SimTime stamp) const {
  if (sent_count_ > kRemembered) {
    // A ring: the place that is written next has the oldest stamp.
    const SimTime oldest{sent_[sent_count_ % kRemembered]};
    if (stamp < oldest) return stamp >= first_sent_;
  }
  const auto end = sent_.begin() + static_cast<std::ptrdiff_t>(std::min(sent_count_, kRemembered));
  return std::find(sent_.begin(), end, stamp.ns) != end;
}

bool LockstepVehicle::on_state(SimTime stamp, WallTime now) {
  if (!enrolled_) {
    remember(stamp);
    return true;
  }
  // One state is in flight at a time: the next one goes when it was answered.
  waiting_.push_back(stamp);
  if (in_flight_) return false;
  in_flight_ = true;
  sent_at_ = now;
  remember(stamp);
  return true;
}

/// A later stamp answers the oldest state, too: its controller has skipped that one.
LockstepVehicle::Answer LockstepVehicle::on_answer(SimTime stamp, WallTime now) {
  if (!was_sent(stamp)) return Answer::kForeign;
  if (!enrolled_) {
    // The first answer to any state that was sent enrolls: from now on the world waits.
    enrolled_ = true;
    return Answer::kEnrolled;
  }
  if (in_flight_ && stamp >= waiting_.front()) {
    waiting_.pop_front();
    in_flight_ = false;
    sent_at_ = now;
  }
  return Answer::kExpected;
}

SimTime LockstepVehicle::next_to_send(WallTime now) {
  if (in_flight_ || waiting_.empty()) return {-1};
  in_flight_ = true;
  sent_at_ = now;
  remember(waiting_.front());
  return waiting_.front();
}

void LockstepVehicle::release() {
  enrolled_ = false;
  in_flight_ = false;
  waiting_.clear();
}

void LockstepVehicle::clear() {
  in_flight_ = false;
  waiting_.clear();
  sent_count_ = 0;
}

/// States are answered in order, so that the oldest one waiting decides.
bool LockstepVehicle::answered_up_to(SimTime stamp) const {
  return !enrolled_ || waiting_.empty() || waiting_.front() > stamp;
}

WallTime LockstepVehicle::waiting_for(WallTime now) const {
  return enrolled_ && in_flight_ ? now - sent_at_ : 0;
}

/// A node that enrolls again with the same period and vehicles keeps its start: a call repeated
/// after a lost response changes nothing.
SimTime SetpointSources::enroll(const std::string& node, const std::vector<std::string>& vehicles,
                                SimTime period, SimTime end, SimTime now, bool waits_beyond_end) {
  if (period.ns <= 0) {
    throw Error("set-point source '" + node + "': period is " + std::to_string(period.seconds()) +
                " s, must be > 0");
  }
  if (vehicles.empty()) throw Error("set-point source '" + node + "': names no vehicles");
  const auto known = sources_.find(node);
  if (known != sources_.end() && known->second.vehicles == vehicles &&
      known->second.period == period) {
    known->second.end = end;
    known->second.waits_beyond_end = waits_beyond_end;
    return known->second.start;
  }
  // Never time zero: a stamp of zero would mean none.
  const SimTime start{(now.ns / period.ns + 1) * period.ns};
  sources_[node] = {vehicles, period, start, end, waits_beyond_end};
  return start;
}

void SetpointSources::release(const std::string& node) { sources_.erase(node); }

bool SetpointSources::on_setpoint(const std::string& vehicle, SimTime stamp, bool replaces) {
  SimTime& covered = covered_.try_emplace(vehicle, SimTime{-1}).first->second;
  // A source that takes back what it has sent covers the time up to its new stamp only, until it
  // has sent again as far as before.
  if (replaces && stamp < covered) {
    replaced_[vehicle] = stamp;
    return feeds(vehicle);
  }
  covered = std::max(covered, stamp);
  const auto replaced = replaced_.find(vehicle);
  if (replaced != replaced_.end() && stamp >= covered) replaced_.erase(replaced);
  return false;
}

bool SetpointSources::forget_replacements() {
  const bool had_some = !replaced_.empty();
  replaced_.clear();
  return had_some;
}

bool SetpointSources::feeds(const std::string& vehicle) const {
  return std::any_of(sources_.begin(), sources_.end(), [&](const auto& entry) {
    const auto& vehicles = entry.second.vehicles;
    return std::find(vehicles.begin(), vehicles.end(), vehicle) != vehicles.end();
  });
}

bool SetpointSources::is_covered(const std::string& vehicle, SimTime due) const {
  const auto replaced = replaced_.find(vehicle);
  if (replaced != replaced_.end() && replaced->second < due) return false;
  const auto covered = covered_.find(vehicle);
  return covered != covered_.end() && covered->second >= due;
}

/// Set-points are due at multiples of the period, whenever the source enrolled.
bool SetpointSources::covers(const Source& source, SimTime time) const {
  const bool has_ended = source.end.ns > 0 && time >= source.end && !source.waits_beyond_end;
  if (time < source.start || has_ended) return true;
  const SimTime due{time.ns / source.period.ns * source.period.ns};
  return std::all_of(source.vehicles.begin(), source.vehicles.end(),
                     [&](const std::string& vehicle) { return is_covered(vehicle, due); });
}

const std::string* SetpointSources::blocking(SimTime time) const {
  for (const auto& [node, source] : sources_) {
    if (!covers(source, time)) return &node;
  }
  return nullptr;
}

/// For messages: blocking() has found that something is missing.
std::vector<std::string> SetpointSources::missing(const std::string& node, SimTime time) const {
  std::vector<std::string> result;
  const Source& source = sources_.at(node);
  const SimTime due{time.ns / source.period.ns * source.period.ns};
  for (const std::string& vehicle : source.vehicles) {
    if (!is_covered(vehicle, due)) result.push_back(vehicle);
  }
  return result;
}

SimTime SetpointSources::end() const {
  SimTime latest{0};
  for (const auto& [node, source] : sources_) {
    // One source without an end, and the run has no end.
    if (source.end.ns == 0) return {0};
    latest = std::max(latest, source.end);
  }
  return latest;
}

}  // namespace trident::sim
