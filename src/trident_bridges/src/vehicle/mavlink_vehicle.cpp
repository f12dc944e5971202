// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/mavlink_vehicle.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/small_services.h"
#include "trident_bridges/mavlink/timesync.h"
#include "trident_bridges/vehicle/commands.h"
#include "trident_bridges/vehicle/targets.h"
#include "vehicle/vehicle_class.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kGroundStationTimeout_s = 10.0;  // of the monitor alone, which nobody hears
constexpr double kSameRefusal_s = 5.0;            // between two texts about set-points

std::vector<Parameter> parameters_of(const ParameterTable& table) {
  std::vector<Parameter> parameters;
  for (const bridges::Parameter& one : table.all()) {
    const ParameterType type = one.is_integer ? ParameterType::kInt32 : ParameterType::kReal32;
    parameters.push_back({one.name, type, one.value, one.min, one.max});
  }
  return parameters;
}

/// Of a command that asks for one message alone.
std::optional<std::uint32_t> message_asked_for(std::uint16_t command) {
  switch (command) {
    case MAV_CMD_GET_HOME_POSITION:
      return MAVLINK_MSG_ID_HOME_POSITION;
    case MAV_CMD_REQUEST_PROTOCOL_VERSION:
      return MAVLINK_MSG_ID_PROTOCOL_VERSION;
    case MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES:
      return MAVLINK_MSG_ID_AUTOPILOT_VERSION;
    default:
      return std::nullopt;
  }
}

/// Firmware whose modes, names and rules are imitated.
VehicleVersion version_of(const MavlinkVehicleOptions& options) {
  VehicleVersion version;
  version.is_px4 = options.flavour == AutopilotFlavour::kPx4;
  version.major = version.is_px4 ? 1 : 4;
  version.minor = version.is_px4 ? 15 : 6;
  version.uid = options.system_id;
  return version;
}

}  // namespace

MavlinkVehicle::MavlinkVehicle(const MavlinkVehicleOptions& options, MessageSink send)
    : options_(options),
      self_{options.system_id, MAV_COMP_ID_AUTOPILOT1},
      send_(std::move(send)),
      geo_(options.origin),
      clock_(options.utc_start),
      autopilot_({flavor_of(options.flavour), class_of(options.kind), options.system_id}),
      commands_(
          self_, send_,
          [this](const Command& command, SimTime now) { return execute(command, now); },
          [this](const std::string& reason) { say(Severity::kError, reason); }),
      missions_(self_, send_, mission_events()),
      parameters_(self_, send_,
                  options.flavour == AutopilotFlavour::kPx4 ? ParameterEncoding::kBytewise
                                                            : ParameterEncoding::kCast,
                  parameters_of(autopilot_.parameters()),
                  {[this](const Parameter& one) { autopilot_.set_parameter(one.name, one.value); },
                   [this](const std::string& reason) { say(Severity::kError, reason); }}),
      streams_(self_, send_, vehicle_stream_rates(options.flavour == AutopilotFlavour::kPx4),
               [this](std::uint32_t id) { return emit(id); }),
      texts_(self_),
      stations_{{kGroundStationTimeout_s, {}, {}}, {self_, class_of(options.kind)}} {}

PlaceContext MavlinkVehicle::places() const {
  return {geo_, autopilot_.home().value_or(Eigen::Vector3d::Zero()), newest_.state.p_world_m,
          newest_.state.yaw()};
}

void MavlinkVehicle::say(Severity severity, const std::string& text) {
  for (const Message& message : texts_.write(severity, text)) send_(message);
}

bool MavlinkVehicle::emit(std::uint32_t id) {
  if (id == MAVLINK_MSG_ID_AUTOPILOT_VERSION) {
    send_(autopilot_version_message(version_of(options_), self_));
    return true;
  }
  if (id == MAVLINK_MSG_ID_PROTOCOL_VERSION) {
    send_(protocol_version_message(options_.accept_mavlink1, self_));
    return true;
  }
  const auto message = telemetry_message(id, {self_, options_.kind, options_.flavour, autopilot_,
                                              newest_.state, readings_, geo_, clock_, newest_.now});
  if (message) send_(*message);
  return message.has_value();
}

bool MavlinkVehicle::handle(const Message& message, const BothTimes& now) {
  if (message.source == self_) return false;
  newest_.now = std::max(newest_.now, now.simulated);
  if (stations_.heartbeats.handle(message, now)) return true;
  return handle_protocol(message, now.simulated) || handle_set_point(message, now) ||
         handle_setting(message, now.simulated) || answer_small_services(message, now.simulated);
}

bool MavlinkVehicle::handle_protocol(const Message& message, SimTime now) {
  return commands_.handle(message, now) || missions_.handle(message, now) ||
         parameters_.handle(message, now) || streams_.handle(message, now);
}

bool MavlinkVehicle::handle_set_point(const Message& message, const BothTimes& both) {
  if (const auto received = read_target(message, self_, places())) {
    follow(*received, both);
    return true;
  }
  if (const auto sticks = stations_.sticks.read(message)) {
    autopilot_.set_sticks(*sticks, both.simulated);
    return true;
  }
  return false;
}

void MavlinkVehicle::follow(const ReceivedTarget& received, const BothTimes& both) {
  const SimTime now = both.simulated;
  if (!received.problem.empty()) return refuse_set_point(received.problem, now);
  const Answer answer = autopilot_.set_target(received.target, received.stamp.value_or(now), now);
  const bool is_denied = answer.result == Result::kDenied;
  if (!is_denied) newest_.set_point = both;
  // They may come before a mode that follows them; that is no mistake.
  const bool is_mistake = is_denied || follows_targets(autopilot_.mode());
  if (!answer.is_good() && is_mistake) refuse_set_point(answer.text, now);
}

/// Set-points come often: the same reason is said once in a while.
void MavlinkVehicle::refuse_set_point(const std::string& reason, SimTime now) {
  const bool is_said =
      reason == newest_.refusal && (now - newest_.refused_at).seconds() < kSameRefusal_s;
  if (is_said) return;
  newest_.refusal = reason;
  newest_.refused_at = now;
  say(Severity::kError, reason);
}

bool MavlinkVehicle::handle_setting(const Message& message, SimTime now) {
  if (is<mavlink_set_mode_t>(message)) {
    const auto payload = unpack<mavlink_set_mode_t>(message);
    if (payload.target_system != self_.system) return false;
    set_mode(payload.base_mode, payload.custom_mode, now);
    return true;
  }
  if (is<mavlink_set_home_position_t>(message)) {
    const auto payload = unpack<mavlink_set_home_position_t>(message);
    if (payload.target_system != self_.system) return false;
    const GeoPlace home{payload.latitude / 1e7, payload.longitude / 1e7, payload.altitude / 1e3};
    say_refusal(autopilot_.handle(HomeRequest{geo_.to_world(home)}, now));
    return true;
  }
  return false;
}

void MavlinkVehicle::set_mode(std::uint8_t base_mode, std::uint32_t custom_mode, SimTime now) {
  if ((base_mode & MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) == 0) {
    return say_refusal(denied("SET_MODE: base_mode " + std::to_string(base_mode) +
                              ", legal: an odd number, with the mode in custom_mode"));
  }
  if (waits_for_set_points(custom_mode, now)) return;
  say_refusal(autopilot_.handle(ModeRequest{custom_mode}, now));
}

/// For messages that have no answer of their own.
void MavlinkVehicle::say_refusal(const Answer& answer) {
  const CommandReply reply = to_reply(answer);
  if (!reply.reason.empty()) say(Severity::kError, reply.reason);
}

bool MavlinkVehicle::answer_small_services(const Message& message, SimTime now) {
  const std::optional<Message> answers[] = {timesync_answer(message, self_, now.ns),
                                            file_transfer_answer(message, self_),
                                            log_list_answer(message, self_)};
  bool is_answered = false;
  for (const auto& answer : answers) {
    if (!answer) continue;
    send_(*answer);
    is_answered = true;
  }
  return is_answered;
}

CommandReply MavlinkVehicle::emit_asked(std::uint32_t id) {
  if (emit(id)) return {};
  return {CommandResult::kTemporarilyRejected, "home: it is not known", 0};
}

CommandReply MavlinkVehicle::execute(const Command& command, SimTime now) {
  if (auto reply = streams_.execute(command, now)) return *std::move(reply);
  if (const auto wanted = message_asked_for(command.command)) return emit_asked(*wanted);
  const Interpretation asked = interpret(command, flavor_of(options_.flavour), places());
  if (const auto* reply = std::get_if<CommandReply>(&asked)) return *reply;
  const auto& request = std::get<Request>(asked);
  const auto* mode = std::get_if<ModeRequest>(&request);
  if (mode != nullptr && waits_for_set_points(mode->custom_mode, now)) {
    return {CommandResult::kInProgress, {}, 0};
  }
  return to_reply(autopilot_.handle(request, now));
}

/// A client that asks for OFFBOARD right after its first set-point is not turned away, as MAVSDK
/// does it: the decision falls when its set-points have come for long enough, or come no more.
bool MavlinkVehicle::waits_for_set_points(std::uint32_t custom_mode, SimTime now) {
  if (!autopilot_.is_offboard_near(custom_mode, now)) return false;
  awaited_ = AwaitedMode{custom_mode, autopilot_.mode()};
  return true;
}

void MavlinkVehicle::decide_awaited_mode(SimTime now) {
  if (!awaited_) return;
  const bool is_outdated = autopilot_.mode() != awaited_->from;
  if (!is_outdated && autopilot_.is_offboard_near(awaited_->custom_mode, now)) return;
  CommandReply reply{CommandResult::kCancelled, {}, 0};
  if (!is_outdated) reply = to_reply(autopilot_.handle(ModeRequest{awaited_->custom_mode}, now));
  awaited_.reset();
  commands_.progress(MAV_CMD_DO_SET_MODE, reply, now);
}

/// The autopilot may have said the reason itself.
CommandReply MavlinkVehicle::to_reply(const Answer& answer) {
  const bool is_said = flush_events(answer.text);
  return {static_cast<CommandResult>(answer.result),
          answer.is_good() || is_said ? std::string() : answer.text, 0};
}

/// Sends what happened. True when `wanted_text` is part of it.
bool MavlinkVehicle::flush_events(const std::string& wanted_text) {
  bool is_said = false;
  for (const AutopilotEvent& event : autopilot_.take_events()) {
    if (event.kind == AutopilotEvent::Kind::kText) {
      say(static_cast<Severity>(event.severity), event.text);
      is_said =
          is_said || (!wanted_text.empty() && event.text.find(wanted_text) != std::string::npos);
    } else if (event.kind == AutopilotEvent::Kind::kMissionReached) {
      mavlink_mission_item_reached_t payload{};
      payload.seq = static_cast<std::uint16_t>(event.index);
      send_(pack(payload, self_));
    } else {
      on_home_changed();
    }
  }
  return is_said;
}

/// Heights above home change with it. A mission that is flown keeps those that it began with.
void MavlinkVehicle::on_home_changed() {
  emit(MAVLINK_MSG_ID_HOME_POSITION);
  emit(MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN);
  const int current = autopilot_.mission().current();
  const bool is_flown = autopilot_.is_armed() && autopilot_.mode() == Mode::kMission && current > 0;
  if (is_flown || missions_.mission(MissionType::kMission).empty()) return;
  load_list(MissionType::kMission);
  autopilot_.handle(MissionItemRequest{current}, newest_.now);
}

void MavlinkVehicle::update(const BothTimes& now) {
  newest_.now = std::max(newest_.now, now.simulated);
  const double silence_s = stations_.heartbeats.ground_station_age_s(now);
  if (silence_s < kGroundStationTimeout_s) {
    autopilot_.note_ground_station(now.simulated - SimTime::from_seconds(silence_s));
  }
  if (newest_.set_point) {
    autopilot_.keep_targets(now.simulated - SimTime::from_seconds(age_s(*newest_.set_point, now)));
  }
  decide_awaited_mode(now.simulated);
  missions_.update(now.simulated);
  parameters_.update(now.simulated);
  streams_.update(now.simulated);
}

Setpoint MavlinkVehicle::step(SimTime now, const VehicleState& state) {
  newest_.now = now;
  newest_.state = state;
  Setpoint setpoint = autopilot_.step(now, state);
  flush_events({});
  return setpoint;
}

}  // namespace trident::bridges::mavlink
