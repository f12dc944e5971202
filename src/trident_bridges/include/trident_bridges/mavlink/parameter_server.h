// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/parameter.h"

namespace trident::bridges::mavlink {

/// What a vehicle hears of its parameters. Each may be left empty.
struct ParameterServerEvents {
  /// A partner has set a value; the server has it.
  std::function<void(const Parameter&)> changed;
  /// Something was refused: one sentence with the name, the value and the legal range.
  std::function<void(const std::string& reason)> refused;
};

/// The vehicle's end of the parameter protocol (https://mavlink.io/en/services/parameter.html).
class ParameterServer {
 public:
  static constexpr double kListRate_hz = 200.0;  ///< of PARAM_VALUE while a list is sent

  /// Throws Error for names that are empty, too long or listed twice.
  ParameterServer(Address self, MessageSink send, ParameterEncoding encoding,
                  std::vector<Parameter> parameters, ParameterServerEvents events);

  /// True when the message belongs to this protocol and is for this vehicle.
  bool handle(const Message& message, SimTime now);
  /// Sends the next of a list that was asked for.
  void update(SimTime now);
  /// In the order of their indices.
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// nullptr: there is no such parameter.
  const Parameter* find(const std::string& name) const;
  /// Sets a value from this side and says so to the partners. Throws Error for an unknown name or a
  /// value out of range.
  void set(const std::string& name, double value);

 private:
  void on_read(const std::string& name, int index);
  void on_set(const std::string& name, float field, std::uint8_t type);
  void send_value(std::size_t index);
  void refuse(const std::string& reason);

  Address self_;
  MessageSink send_;
  ParameterEncoding encoding_;
  std::vector<Parameter> parameters_;
  ParameterServerEvents events_;
  std::size_t next_;  // of the list that is being sent; at the end: none
  SimTime next_due_;
};

}  // namespace trident::bridges::mavlink
