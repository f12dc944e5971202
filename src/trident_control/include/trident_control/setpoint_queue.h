// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_base/span.h"
#include "trident_control/control_types.h"

namespace trident::control {

/// One point of a set-point message, `time_from_start` after the message's start.
struct TimedSetpoint {
  SimTime time_from_start;  ///< >= 0, and not before the point ahead of it
  TrajectoryPoint point;    ///< holds until the next point takes effect
};

/// Where a queue follows RotorS, and which stamps it believes.
struct SetpointQueueParams {
  /// RotorS applies the first point at the message's start whatever its time_from_start says, and
  /// spaces the others by differences. False: every point waits for its own time_from_start.
  bool first_point_at_start = true;
  /// Stamps further ahead than this are of another clock: the message starts at once [s].
  double max_lead_s = 3600.0;
  /// Stamps older than this no longer anchor a trajectory: the message starts at once [s].
  double max_age_s = 10.0;
  /// A reset of the world forgets the active set-point, so that a run repeats from its first state.
  /// True: it stays active, as in RotorS.
  bool keep_setpoint_over_reset = false;
};

/// Why push() took or refused a message.
enum class SetpointResult {
  accepted,         ///< or known already, see SetpointQueue::repeats()
  empty,            ///< no points
  non_finite,       ///< a point with a NaN or an infinity
  unordered,        ///< time_from_start decreases, or is negative
  too_many_points,  ///< more than SetpointQueue::kMaxPoints
};

/// Stamped set-points, handed out by the stamps of the states they act on; no clock but those
/// stamps, so the outcome does not depend on when, between two states, a message came in.
///  - A message stamped t starts at t; one without a stamp starts at the next state.
///  - Point i takes effect at the first state stamped >= start + time_from_start[i] -
///  time_from_start[0].
///  - A newer message removes all points that lie at or after its start; an active one stays until
///  then.
///  - A stamped message that comes again changes nothing: senders repeat what they have sent while
///    the world stands still, and must not take back what came after it.
///  - A state stamped earlier than its predecessor means the world was reset: the active set-point
///    (unless kept) and all queued ones go, except messages that came after the last state and
///    belong to the new time.
/// Call push() and advance() from one thread. Memory is reused; only a longer trajectory than any
/// before allocates.
class SetpointQueue {
 public:
  static constexpr std::size_t kMaxPoints = 65536;  ///< of one message

  /// Empty: advance() returns nullptr until a message has taken effect.
  explicit SetpointQueue(const SetpointQueueParams& params = {});

  /// `stamp` zero = no stamp. Refused messages change nothing.
  SetpointResult push(SimTime stamp, Span<const TimedSetpoint> points);

  /// The message that was accepted last is one that has come before, and changes nothing.
  bool repeats() const { return repeats_; }

  /// The set-point in effect for the state stamped `state_stamp`; nullptr before the first one.
  /// The pointer is valid until the next call.
  const TrajectoryPoint* advance(SimTime state_stamp);

  /// True when the last advance() saw time run backwards.
  bool was_reset() const { return was_reset_; }

 private:
  struct Pending {  // as received, waiting for the next state to give it its start
    SimTime stamp;
    SimTime offset;
    TrajectoryPoint point;
    bool starts_message = false;
    bool is_repeated = false;  // of the first point: the message had come before
  };
  struct Scheduled {
    SimTime effect;
    TrajectoryPoint point;
  };

  struct Accepted {  // a stamped message, to be known again
    SimTime stamp;
    std::uint64_t digest = 0;
  };
  static constexpr std::size_t kKnownAgain = 128;  // messages: more than a sender repeats at a time

  static std::uint64_t digest_of(Span<const Pending> message);
  bool is_repeated(Span<const Pending> message) const;
  bool is_repeated_in_pending(std::size_t begin) const;
  void remember(Span<const Pending> message);
  void schedule(Span<const Pending> message, SimTime state_stamp);
  void reset_to(SimTime state_stamp);
  void schedule_pending(SimTime state_stamp);
  SimTime start_of(SimTime stamp, SimTime state_stamp) const;
  void drop_from(SimTime start);

  SetpointQueueParams params_;
  std::vector<Pending> pending_;
  std::vector<Scheduled> scheduled_;  // ascending; [0, next_) have taken effect
  std::size_t next_ = 0;
  std::array<Accepted, kKnownAgain> accepted_;  // the newest, a ring
  std::size_t accepted_count_ = 0;              // since the last reset or unstamped message
  std::optional<SimTime> last_state_;
  std::optional<TrajectoryPoint> active_;
  bool was_reset_ = false;
  bool repeats_ = false;
};

}  // namespace trident::control
