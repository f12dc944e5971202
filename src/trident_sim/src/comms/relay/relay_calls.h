// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "comms/relay/relay.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {

/// Of a request or an answer, at most: a message has kind and number, too.
constexpr std::size_t kMaxCallBytes = Relay::kMaxBytes - 1 - sizeof(std::uint64_t);

/// What a message of a service's rule is.
enum class CallMessageKind : char { kRequest = 'Q', kAnswer = 'R', kError = 'E' };

/// Such a message.
struct CallMessage {
  CallMessageKind kind = CallMessageKind::kRequest;
  std::uint64_t number = 0;  ///< of the call
  std::string_view data;     ///< request, answer, or text of an error
};

std::string encode(const CallMessage& message);
/// Empty: the bytes are something else. `data` points into `bytes`.
std::optional<CallMessage> decode_call(std::string_view bytes);

/// Calls of services: a request and its answer, each a message of a reliable flow of the relay,
/// whose ages are counted from the call, so that both share its deadline. Called between steps. A
/// value.
class RelayCalls {
 public:
  /// Begins a call by a service's rule and returns its number. One that cannot be ends at once.
  std::uint64_t begin(const Relay::Key& key, const std::string& request, SimTime now, Relay* relay);
  /// A message of a service's rule that has crossed by the end of a step.
  void take(const RelayDelivery& delivery, SimTime end, const std::vector<RelayRule>& rules);
  /// Sends what a server has answered, if the call is still in progress.
  void answer(const CallResult& answer, Relay* relay);
  /// Ends a call with an error, if it is still in progress.
  void abort(std::uint64_t number, const std::string& why, const std::vector<RelayRule>& rules);
  /// Ends calls whose deadline is over.
  void expire(SimTime now, const std::vector<RelayRule>& rules);
  /// Ends calls of robots that are not among these, in alphabetical order.
  void set_robots(const std::vector<std::string>& robots, const std::vector<RelayRule>& rules);
  /// All calls end; numbers are not given again.
  void reset(const std::vector<RelayRule>& rules);

  /// See RelayServices.
  std::vector<ServedCall> take_served() { return std::exchange(served_, {}); }
  std::vector<CallResult> take_results() { return std::exchange(results_, {}); }  ///< the same
  const std::map<Relay::Key, CallCounts>& counts() const { return counts_; }

 private:
  enum class Stage { kRequested, kServed, kAnswered };
  struct Call {
    Relay::Key key;  ///< from its caller to its server
    SimTime begun;
    Stage stage = Stage::kRequested;
  };
  using Calls = std::map<std::uint64_t, Call>;

  int in_progress(const Relay::Key& key) const;
  void end(Calls::iterator call, bool is_answered, std::string data);
  void end_with_error(Calls::iterator call, const std::vector<RelayRule>& rules,
                      const std::string& why);

  std::uint64_t next_ = 1;
  Calls calls_;  ///< in progress, by number
  std::vector<ServedCall> served_;
  std::vector<CallResult> results_;
  std::map<Relay::Key, CallCounts> counts_;
};

}  // namespace trident::sim
