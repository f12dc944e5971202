// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "autopilot/obedient_body.h"
#include "trident_bridges/autopilot/autopilot.h"

namespace trident::bridges {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// To be flown to.
inline MissionItem waypoint(double x, double y, double z, double hold_s = 0.0) {
  MissionItem item;
  item.params[0] = hold_s;
  item.p_world_m = {x, y, z};
  return item;
}

/// Without a place.
inline MissionItem item_of(std::uint16_t command, std::array<double, 4> params = {}) {
  MissionItem item;
  item.command = command;
  item.params = params;
  item.has_place = false;
  return item;
}

/// Up to a height.
inline MissionItem take_off_item(double z) {
  MissionItem item = waypoint(0, 0, z);
  item.command = mission_command::kTakeOff;
  return item;
}

/// A place alone.
inline Target place(double x, double y, double z) {
  Target target;
  target.p_m = Eigen::Vector3d(x, y, z);
  return target;
}

/// An autopilot and a body that obeys it. 50 steps a second.
class FlownVehicle {
 public:
  explicit FlownVehicle(Flavor flavor, VehicleClass vehicle = VehicleClass::kMultirotor)
      : pilot({flavor, vehicle, 1}) {
    state.position_stamp = now;
    state.battery = 0.9;
    step();
  }

  void step() {
    now = now + SimTime{20'000'000};
    if (has_position) state.position_stamp = now;
    obey(pilot.step(now, state), 0.02, state);
    for (const AutopilotEvent& event : pilot.take_events()) {
      if (event.kind == AutopilotEvent::Kind::kText) texts.push_back(event.text);
      if (event.kind == AutopilotEvent::Kind::kMissionReached) reached.push_back(event.index);
    }
    track.push_back(state.p_world_m);
  }

  /// Steps until a condition holds; false: it did not within the time.
  bool run_until(const std::function<bool()>& condition, double limit_s = 600.0) {
    const SimTime end = now + SimTime::from_seconds(limit_s);
    while (!condition() && now < end) step();
    return condition();
  }
  void run(double time_s) {
    run_until([] { return false; }, time_s);
  }

  bool has_text(const std::string& part) const {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find(part) != std::string::npos;
    });
  }
  Answer ask(const Request& request) { return pilot.handle(request, now); }
  Answer mode(const char* name) {
    const auto& entry = *find_mode(flavor(), vehicle(), std::string_view(name));
    return ask(ModeRequest{entry.custom_mode});
  }
  Flavor flavor() const {
    return pilot.parameters().find("WPNAV_SPEED") || pilot.parameters().find("WP_SPEED")
               ? Flavor::kArduPilot
               : Flavor::kPx4;
  }
  VehicleClass vehicle() const {
    const bool flies =
        pilot.parameters().find("WPNAV_SPEED") || pilot.parameters().find("MPC_TKO_SPEED");
    return flies ? VehicleClass::kMultirotor : VehicleClass::kGround;
  }
  /// Armed and hovering at a height.
  void take_off(double height_m) {
    if (flavor() == Flavor::kArduPilot) mode("GUIDED");
    ask(ArmRequest{});
    ask(TakeOffRequest{height_m});
    run_until([&] { return state.p_world_m.z() > height_m - 0.05; }, 60.0);
    run(3.0);
  }

  SimTime now;
  VehicleState state;
  bool has_position = true;
  Autopilot pilot;
  std::vector<std::string> texts;
  std::vector<int> reached;
  std::vector<Eigen::Vector3d> track;
};

}  // namespace trident::bridges
