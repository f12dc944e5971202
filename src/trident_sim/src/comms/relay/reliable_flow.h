// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The two ends of a reliable flow: parts with numbers, selective acknowledgements, and messages
// that are given up at their deadline (SCTP, RFC 9260, with the partial reliability of RFC 3758).
// Loss is found by what was sent later and has arrived (RACK, RFC 8985), else by a timeout (RFC
// 6298), which sends one part, as the air's share is up to the radio.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "comms/relay/datagram.h"
#include "comms/relay/relay_message.h"

namespace trident::sim {

/// Keeps messages until they are acknowledged or given up, and says what is to be sent. A value.
class ReliableSender {
 public:
  /// `depth`: messages that it keeps; `deadline`: age at which they are given up, zero: never.
  ReliableSender(std::uint16_t rule, int depth, SimTime deadline)
      : rule_(rule), depth_(static_cast<std::size_t>(depth)), deadline_(deadline) {}

  /// `passed`, here and below: the part that the receiver continues with. Who is before it is
  /// counted there.
  void add(const RelayMessage& message, std::uint64_t passed, RelayCounts* counts);
  void acknowledge(const AckDatagram& ack, SimTime now);
  /// The first of what is to be sent now; empty: nothing. The caller sends it and says so by
  /// sent(), or asks again later.
  std::optional<PartDatagram> next(SimTime now, std::uint64_t passed, RelayCounts* counts);
  void sent(SimTime now, RelayCounts* counts);
  /// Parts before this one were acknowledged, or given up.
  std::uint64_t first() const { return first_; }
  /// Nothing waits, neither to be sent nor for an acknowledgement.
  bool is_idle() const { return parts_.empty() && acknowledged_ >= first_; }

 private:
  struct Part {
    RelayMessage message;
    std::uint16_t part = 0, parts = 1;
    SimTime sent{-1};  ///< last; negative: never
    int tries = 0;
    bool is_acknowledged = false;
  };

  void give_up_front(std::uint64_t passed, std::uint64_t* count);
  void note_arrival(Part* part, SimTime now);
  void measure(SimTime round_trip);
  bool is_lost(const Part& part, SimTime now) const;
  std::optional<std::size_t> choose(SimTime now);
  PartDatagram datagram(std::size_t index) const;

  std::uint16_t rule_;
  std::size_t depth_;
  SimTime deadline_;
  std::deque<Part> parts_;          ///< numbered from first_
  std::uint64_t first_ = 0;         ///< number of the oldest part that is offered
  std::uint64_t acknowledged_ = 0;  ///< the part that the receiver continues with
  std::size_t messages_ = 0;        ///< that parts_ are of
  std::optional<std::size_t> chosen_;
  bool is_skip_chosen_ = false;
  bool is_first_ = false;       ///< nothing else awaits an answer
  bool is_probe_ = false;       ///< it is sent after a timeout
  SimTime newest_arrived_{-1};  ///< when what has arrived was sent, the last of it
  SimTime timer_;               ///< since when it waits for an answer
  SimTime round_trip_, variation_, timeout_;
};

/// Puts parts into their order, once each, and says what to acknowledge. A value.
class ReliableReceiver {
 public:
  ReliableReceiver(std::uint16_t rule, SimTime deadline) : rule_(rule), deadline_(deadline) {}

  /// Appends the messages that are whole now, in order. `given_up`: messages of parts before this
  /// one have been counted by the sender, as expired or superseded.
  void take(const PartDatagram& part, SimTime now, std::uint64_t given_up,
            std::vector<RelayMessage>* messages, RelayCounts* counts);
  /// The part that it continues with.
  std::uint64_t next() const { return next_; }
  /// To be sent once after what was taken; empty: nothing came.
  std::optional<AckDatagram> take_ack();

 private:
  struct Part {
    std::uint16_t part, parts;
    SimTime born;
    std::string data;
  };
  void skip_to(std::uint64_t oldest);

  std::uint16_t rule_;
  SimTime deadline_;
  std::uint64_t next_ = 0;
  std::map<std::uint64_t, Part> waiting_;
  std::string begun_;  ///< parts of the message that next_ continues
  bool is_ack_due_ = false;
};

}  // namespace trident::sim
