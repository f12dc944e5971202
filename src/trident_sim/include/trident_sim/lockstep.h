// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// Wall time in nanoseconds, handed in by the caller: nothing here reads a clock.
using WallTime = std::int64_t;

/// One vehicle's conversation with its controller. States go out by their stamps, at most one of
/// them unanswered (RotorS' controller keeps a queue of one and would drop the second); answers
/// carry the stamp of their state.
///
/// A controller enrols with its first answer to a state it was sent. From then on states wait in
/// line here until their predecessor is answered, and the world may ask whether a stamp is
/// answered.
class LockstepVehicle {
 public:
  /// What an answer is to the world.
  enum class Answer {
    kForeign,   ///< not the stamp of a state that was sent; the controller runs free
    kEnrolled,  ///< the first answer: from now on the world waits for this controller
    kExpected   ///< the answer that was waited for
  };

  /// A state with this stamp was made. True: send it now; false: keep it until next_to_send().
  bool on_state(SimTime stamp, WallTime now);
  /// A controller has answered the state with this stamp.
  Answer on_answer(SimTime stamp, WallTime now);
  /// After an answer: the stamp of the state to send next, or nothing (ns < 0).
  SimTime next_to_send(WallTime now);

  /// The world has seen that a controller is connected and waits for it from the first state on.
  void enroll() { enrolled_ = true; }
  /// The controller is gone, or too slow: states flow freely again.
  void release();
  /// Time was set back or the states in flight are void.
  void clear();

  bool enrolled() const { return enrolled_; }  ///< whether the world waits for its controller
  /// The first state that was ever sent, or since clear(); ns < 0: none was.
  SimTime first_sent() const { return sent_count_ == 0 ? SimTime{-1} : first_sent_; }
  /// True when every state stamped up to `stamp` has its answer (or nobody is waited for).
  bool answered_up_to(SimTime stamp) const;
  /// Wall time for which the oldest state has been without an answer, 0 if no state waits.
  WallTime waiting_for(WallTime now) const;

 private:
  static constexpr std::size_t kRemembered = 256;
  void remember(SimTime stamp);
  bool was_sent(SimTime stamp) const;

  bool enrolled_ = false;
  bool in_flight_ = false;
  WallTime sent_at_ = 0;
  std::deque<SimTime> waiting_;  ///< front: sent when in_flight_, the rest in line
  /// The latest stamps [ns], for recognising an answer; of older ones only the first is kept, for a
  /// controller that joins a world which runs far ahead of it.
  std::array<std::int64_t, kRemembered> sent_{};
  std::size_t sent_count_ = 0;
  SimTime first_sent_;
};

/// Nodes that give set-points ahead of time. The world does not pass a multiple of a source's
/// period before each of its vehicles has a set-point that covers it.
class SetpointSources {
 public:
  /// A node that gives set-points, and the span of simulated time over which it does.
  struct Source {
    std::vector<std::string> vehicles;  ///< that it gives set-points to, at least one
    SimTime period, start, end;         ///< end 0: not known yet
    /// While the run continues beyond `end`, because of others, the world waits for this source.
    bool waits_beyond_end = false;
  };

  /// Throws Error for a period that is not positive or a source without vehicles. `now`: sim time.
  SimTime enroll(const std::string& node, const std::vector<std::string>& vehicles, SimTime period,
                 SimTime end, SimTime now, bool waits_beyond_end = false);
  /// The node is gone or too slow: the world no longer waits for it. Unknown names are ignored.
  void release(const std::string& node);
  /// No sources, and no set-points seen.
  void clear() { sources_.clear(), covered_.clear(), replaced_.clear(); }

  /// A set-point for `vehicle` stamped `stamp` has reached the one that uses it. `replaces`: it
  /// took the place of all later ones there, so nothing beyond it is covered any more. True: that
  /// has taken something from a source.
  bool on_setpoint(const std::string& vehicle, SimTime stamp, bool replaces = false);
  /// What was replaced counts as covered again: its source has not sent it once more. False: there
  /// is no such thing.
  bool forget_replacements();
  /// One of the sources gives set-points for this vehicle.
  bool feeds(const std::string& vehicle) const;

  /// The first source that the world must wait for before it may reach `time`, or nullptr.
  const std::string* blocking(SimTime time) const;
  /// Vehicles of `node` whose set-point for `time` is missing.
  std::vector<std::string> missing(const std::string& node, SimTime time) const;

  /// The latest end of all sources; ns 0 while one has none or there are no sources.
  SimTime end() const;
  const std::map<std::string, Source>& all() const { return sources_; }  ///< by node name
  std::map<std::string, Source>& all() { return sources_; }              ///< to change ends

 private:
  bool covers(const Source& source, SimTime time) const;
  bool is_covered(const std::string& vehicle, SimTime due) const;

  std::map<std::string, Source> sources_;
  std::map<std::string, SimTime> covered_;   ///< the latest set-point of each vehicle
  std::map<std::string, SimTime> replaced_;  ///< where it is less, because of another node's
};

}  // namespace trident::sim
