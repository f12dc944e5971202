// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/parameter.h"
#include "trident_bridges/mavlink/retry_timer.h"

namespace trident::bridges::mavlink {

/// The ground's end of the parameter protocol, for one vehicle: reads all parameters, asks again
/// for those that were lost, and sets values.
class ParameterClient {
 public:
  static constexpr double kSilence_s = 10.0;  ///< after which something has failed
  /// Whether it succeeded; if not, why.
  using Done = std::function<void(bool, const std::string& reason)>;

  ParameterClient(Address self, Address target, MessageSink send, ParameterEncoding encoding);

  /// Reads all parameters.
  void fetch(SimTime now, Done done);
  /// Sets a value, once those before are done. An unknown name is set as a real number.
  void set(const std::string& name, double value, SimTime now, Done done);

  /// Ends all that is waited for, for that reason.
  void cancel(const std::string& reason);

  /// True when the message is a PARAM_VALUE of the vehicle.
  bool handle(const Message& message, SimTime now);
  /// Repeats and gives up; to be called at least every 50 ms while is_busy().
  void update(SimTime now);
  bool is_busy() const { return fetch_.has_value() || !sets_.empty(); }  ///< waits for answers
  /// All that were heard, by name.
  const std::map<std::string, Parameter>& parameters() const { return parameters_; }

 private:
  struct Fetch {
    std::size_t count = 0;           // 0: not known yet
    std::set<std::size_t> received;  // indices
    SimTime asked, heard;
    Done done;
  };
  struct Set {
    std::string name;
    double value = 0.0;
    ParameterType type = ParameterType::kReal32;
    RetryTimer timer;
    Done done;
  };

  void request_list();
  void request_missing();
  void request_again(SimTime now);
  void give_fetch_up();
  void begin_set(SimTime now);
  void update_set(SimTime now);
  void send_set();
  void end_set(bool is_good, const std::string& reason, SimTime now);
  void note_fetched(std::size_t index, std::size_t count, SimTime now);
  void note_set(const Parameter& parameter, SimTime now);

  Address self_, target_;
  MessageSink send_;
  ParameterEncoding encoding_;
  std::map<std::string, Parameter> parameters_;
  std::optional<Fetch> fetch_;
  std::deque<Set> sets_;  // the first one was sent
};

}  // namespace trident::bridges::mavlink
