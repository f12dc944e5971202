// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "input_binder.h"
#include "look_schedule.h"
#include "port_binder.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/samples/bytes_sample.h"

namespace trident::sim {

/// What joins topics and ports of bytes, which the relay of the radios reads and writes
/// (libtrident_radio_medium.so with <rules>): an input whose topic the simulator publishes itself
/// gets its messages within the step; an output is advertised as soon as the type of the input is
/// known that its messages come from. By the stepping thread, with the world's mutex held.
class RadioRelay {
 public:
  RadioRelay(PortBoard& board, PortBinder& outputs, InputBinder& inputs)
      : board_(board), outputs_(outputs), inputs_(inputs) {}

  /// Follows ports that came or went; after both binders.
  void sync();
  /// Hands over what the simulator has published in the step that has ended at `end`, and
  /// advertises what has crossed for the first time.
  void take_outputs(SimTime end);
  /// Advertises what has a type now. Looks only now and then.
  void look_for_types(SimTime now);

 private:
  /// An input whose topic is one of the simulator's own.
  struct Tap {
    OutputBinding* topic;
    InPort<BytesSample>* input;
    std::uint64_t seen;  ///< of the output's values
    bool has_header;
  };
  ros_utils::TopicType type_of(const std::string& input) const;
  void take(const std::string& name, Tap& tap, SimTime end);
  bool advertise(const std::string& output);

  PortBoard& board_;
  PortBinder& outputs_;
  InputBinder& inputs_;
  std::uint64_t version_ = ~std::uint64_t{0};
  std::shared_ptr<const RelayReport> relay_;  ///< nullptr: the world has no rules
  LookSchedule looks_;
  std::map<std::string, Tap> taps_;                 ///< by name
  std::vector<std::string> untyped_;                ///< outputs that are not advertised yet
  std::map<std::string, std::uint32_t> sequences_;  ///< of the headers of taps' messages
};

}  // namespace trident::sim
