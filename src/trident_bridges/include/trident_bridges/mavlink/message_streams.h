// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/command.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// How often a vehicle sends a message unless somebody asks for another rate.
struct StreamRate {
  std::uint32_t id = 0;  ///< of the message
  double rate_hz = 0.0;  ///< 0: only when asked for
};

/// What a simulated vehicle sends, in the habits of PX4 or of ArduPilot.
std::vector<StreamRate> vehicle_stream_rates(bool is_px4);

/// Which messages of a vehicle are due on one link, by SET_MESSAGE_INTERVAL, REQUEST_DATA_STREAM
/// and defaults. In simulated time: a message of 25 Hz is due 25 times in each of its seconds.
class MessageStreams {
 public:
  static constexpr double kMaxRate_hz = 1000.0;  ///< that may be asked for

  /// `emit` sends a message of that id now; false: the vehicle cannot make it.
  MessageStreams(Address self, MessageSink send, const std::vector<StreamRate>& defaults,
                 std::function<bool(std::uint32_t id)> emit);

  /// Has all messages sent that are due. Time may be set back.
  void update(SimTime now);
  /// True when the message is a REQUEST_DATA_STREAM for this vehicle.
  bool handle(const Message& message, SimTime now);
  /// Answers GET_MESSAGE_INTERVAL, SET_MESSAGE_INTERVAL and REQUEST_MESSAGE; nullopt: another
  /// command.
  std::optional<CommandReply> execute(const Command& command, SimTime now);

  /// [Hz] now; 0: not sent.
  double rate_hz(std::uint32_t id) const;

 private:
  struct Stream {
    double default_hz = 0.0;
    std::int64_t period_ns = 0;  // 0: not sent
    SimTime due;
  };

  CommandReply set_interval(double id, double interval_us, SimTime now);
  CommandReply get_interval(double id);
  CommandReply request(double id);
  Stream* find(double id);
  void emit_if_due(std::uint32_t id, Stream& stream, SimTime now);
  void set_rate(Stream& stream, double rate_hz, SimTime now);

  Address self_;
  MessageSink send_;
  std::map<std::uint32_t, Stream> streams_;
  SimTime updated_, next_due_;  // of the last look at all streams
  bool is_changed_ = true;      // since then
  std::function<bool(std::uint32_t)> emit_;
};

}  // namespace trident::bridges::mavlink
