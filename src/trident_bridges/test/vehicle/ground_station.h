// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A vehicle that obeys its autopilot, and a ground station made of the clients' machines.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "autopilot/obedient_body.h"
#include "trident_bridges/autopilot/modes.h"
#include "trident_bridges/mavlink/command_client.h"
#include "trident_bridges/mavlink/mission_client.h"
#include "trident_bridges/mavlink/parameter_client.h"
#include "trident_bridges/mavlink/status_text.h"
#include "trident_bridges/vehicle/mavlink_vehicle.h"

namespace trident::bridges::mavlink::testing {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Where its world is.
inline constexpr GeoPlace kOrigin{47.397742, 8.545594, 488.0};

/// The vehicle in simulated time, 50 steps a second; its messages arrive at once.
class FlownMavlinkVehicle {
 public:
  FlownMavlinkVehicle(VehicleKind kind, AutopilotFlavour flavour)
      : vehicle(options_of(kind, flavour), [this](const Message& message) { receive(message); }),
        commands(kSelf, to_vehicle()),
        missions(kSelf, to_vehicle(), [this](const MissionOutcome& end) { mission_end = end; }),
        parameters(kSelf, vehicle.address(), to_vehicle(),
                   flavour == AutopilotFlavour::kPx4 ? ParameterEncoding::kBytewise
                                                     : ParameterEncoding::kCast) {
    state.battery = 0.9;
    run(0.1);
  }

  void step() {
    now = now + SimTime{20'000'000};
    state.position_stamp = now;
    deliver();
    vehicle.update({now, std::nullopt});
    setpoint = vehicle.step(now, state);
    obey(setpoint, 0.02, state);
    commands.update(now);
    missions.update(now);
    parameters.update(now);
  }
  /// False: the condition did not hold within the time.
  bool run_until(const std::function<bool()>& condition, double limit_s = 300.0) {
    const SimTime end = now + SimTime::from_seconds(limit_s);
    while (!condition() && now < end) step();
    return condition();
  }
  void run(double time_s) {
    run_until([] { return false; }, time_s);
  }
  void send(const Message& message) { pending.push_back(message); }

  /// The vehicle's answer to a command.
  CommandReply command(std::uint16_t number, std::array<double, 7> params = {}) {
    Command command;
    command.command = number;
    command.params = params;
    std::optional<CommandOutcome> outcome;
    commands.send(vehicle.address(), command, now,
                  [&](const CommandOutcome& end) { outcome = end; });
    run_until([&] { return outcome.has_value(); }, 20.0);
    if (!outcome || !outcome->is_answered) return {CommandResult::kFailed, "silent", 0};
    return outcome->reply;
  }
  /// The vehicle's verdict on a list.
  MissionVerdict upload(MissionType type, const Mission& list) {
    mission_end.reset();
    missions.upload(vehicle.address(), type, list, now);
    run_until([&] { return mission_end.has_value(); }, 30.0);
    return mission_end ? mission_end->verdict : MissionVerdict{MissionResult::kError, "silent"};
  }
  Mission download(MissionType type) {
    mission_end.reset();
    missions.download(vehicle.address(), type, now);
    run_until([&] { return mission_end.has_value(); }, 30.0);
    return mission_end ? mission_end->mission : Mission();
  }

  bool has_text(const std::string& part) const { return count_texts(part) > 0; }
  int count_texts(const std::string& part) const {
    return static_cast<int>(std::count_if(texts.begin(), texts.end(), [&](const auto& text) {
      return text.find(part) != std::string::npos;
    }));
  }
  /// The newest message of a type; nullptr: none came.
  const Message* newest(std::uint32_t id) const {
    const auto found = messages.find(id);
    return found == messages.end() ? nullptr : &found->second;
  }

  static constexpr Address kSelf{255, 190};
  SimTime now;
  VehicleState state;
  Setpoint setpoint;
  std::vector<std::string> texts;
  std::map<std::uint32_t, Message> messages;
  std::map<std::uint32_t, int> counts;
  std::vector<Message> pending, answers;
  std::optional<MissionOutcome> mission_end;
  MavlinkVehicle vehicle;
  CommandClient commands;
  MissionClient missions;
  ParameterClient parameters;

 private:
  static MavlinkVehicleOptions options_of(VehicleKind kind, AutopilotFlavour flavour) {
    MavlinkVehicleOptions options;
    options.kind = kind;
    options.flavour = flavour;
    options.origin = kOrigin;
    return options;
  }
  MessageSink to_vehicle() {
    return [this](const Message& message) { pending.push_back(message); };
  }
  void receive(const Message& message) {
    ++counts[message.id];
    messages[message.id] = message;
    if (const auto text = reader_.handle(message, now)) texts.push_back(text->text);
    answers.push_back(message);
  }
  /// Machines are not called from within one another.
  void deliver() {
    for (const Message& message : std::exchange(answers, {})) {
      if (commands.handle(message, now) || missions.handle(message, now)) continue;
      parameters.handle(message, now);
    }
    for (Message message : std::exchange(pending, {})) {
      message.source = kSelf;
      message.sequence = sequence_++;
      vehicle.handle(message, {now, std::nullopt});
    }
  }

  StatusTextReader reader_;
  std::uint8_t sequence_ = 0;
};

}  // namespace trident::bridges::mavlink::testing
