// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trident_bridges/autopilot/autopilot.h"
#include "trident_bridges/mavlink/command_server.h"
#include "trident_bridges/mavlink/heartbeat_monitor.h"
#include "trident_bridges/mavlink/message_streams.h"
#include "trident_bridges/mavlink/mission_server.h"
#include "trident_bridges/mavlink/parameter_server.h"
#include "trident_bridges/mavlink/status_text.h"
#include "trident_bridges/mavlink/vehicles.h"
#include "trident_bridges/vehicle/geo_frame.h"
#include "trident_bridges/vehicle/sticks.h"
#include "trident_bridges/vehicle/telemetry.h"

namespace trident::bridges::mavlink {

struct ReceivedTarget;

/// Which vehicle, and where its world is.
struct MavlinkVehicleOptions {
  VehicleKind kind = VehicleKind::kQuadrotor;         ///< what moves it
  AutopilotFlavour flavour = AutopilotFlavour::kPx4;  ///< modes, parameters and habits
  std::uint8_t system_id = 1;                         ///< 1 to 254
  GeoPlace origin;                                    ///< of the world frame
  std::string utc_start = UtcClock::kDefaultStart;    ///< see UtcClock
  bool accept_mavlink1 = false;                       ///< as PROTOCOL_VERSION says
};

/// An autopilot that speaks MAVLink: commands, missions, fences, rally points, parameters,
/// set-points and sticks in, telemetry and texts out. Without links: what it says goes to a sink,
/// for all of them. All times are simulated; it has no clock of its own.
class MavlinkVehicle {
 public:
  /// Disarmed. `send` gets all messages, within the calls below. Throws Error for options that are
  /// not legal.
  MavlinkVehicle(const MavlinkVehicleOptions& options, MessageSink send);
  MavlinkVehicle(const MavlinkVehicle&) = delete;
  MavlinkVehicle& operator=(const MavlinkVehicle&) = delete;

  /// True when the message was for this vehicle, alone or with others.
  bool handle(const Message& message, const BothTimes& now);
  /// Sends what is due: to be called at least every 50 ms, before or after step().
  void update(const BothTimes& now);
  /// One step of the autopilot at the stamp of the state.
  Setpoint step(SimTime now, const VehicleState& state);
  /// What telemetry says besides the state.
  void set_readings(const VehicleReadings& readings) { readings_ = readings; }

  Address address() const { return self_; }                  ///< of all that it sends
  const Autopilot& autopilot() const { return autopilot_; }  ///< as it stands
  const GeoFrame& geo() const { return geo_; }               ///< its world on the earth

 private:
  bool handle_protocol(const Message& message, SimTime now);
  bool handle_set_point(const Message& message, const BothTimes& both);
  void follow(const ReceivedTarget& received, const BothTimes& both);
  bool handle_setting(const Message& message, SimTime now);
  void set_mode(std::uint8_t base_mode, std::uint32_t custom_mode, SimTime now);
  void say_refusal(const Answer& answer);
  bool answer_small_services(const Message& message, SimTime now);
  CommandReply execute(const Command& command, SimTime now);
  CommandReply emit_asked(std::uint32_t id);
  CommandReply to_reply(const Answer& answer);
  bool waits_for_set_points(std::uint32_t custom_mode, SimTime now);
  void decide_awaited_mode(SimTime now);
  MissionServerEvents mission_events();
  MissionVerdict check_mission(MissionType type, const Mission& list);
  MissionVerdict check_fence(const Mission& list);
  void note_payload_items(const Mission& list);
  void load_list(MissionType type);
  void on_home_changed();
  bool emit(std::uint32_t id);
  bool flush_events(const std::string& wanted_text);
  void say(Severity severity, const std::string& text);
  void refuse_set_point(const std::string& reason, SimTime now);
  PlaceContext places() const;

  MavlinkVehicleOptions options_;
  Address self_;
  MessageSink send_;
  GeoFrame geo_;
  UtcClock clock_;
  Autopilot autopilot_;
  CommandServer commands_;
  MissionServer missions_;
  ParameterServer parameters_;
  MessageStreams streams_;
  StatusTextWriter texts_;
  /// What ground stations and pilots send without being asked.
  struct Stations {
    HeartbeatMonitor heartbeats;
    StickReader sticks;
  };
  Stations stations_;
  VehicleReadings readings_;
  /// The last of each.
  struct Newest {
    SimTime now;
    VehicleState state;
    std::string refusal;  // of a set-point
    SimTime refused_at;
    std::optional<BothTimes> set_point;  // that was good
  } newest_;
  /// A mode that was asked for, and is entered once set-points have come for long enough.
  struct AwaitedMode {
    std::uint32_t custom_mode = 0;
    Mode from = Mode::kHold;  // another one: somebody has asked for that since
  };
  std::optional<AwaitedMode> awaited_;
};

}  // namespace trident::bridges::mavlink
