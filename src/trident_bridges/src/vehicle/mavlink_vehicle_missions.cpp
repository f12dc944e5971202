// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "trident_bridges/vehicle/mavlink_vehicle.h"
#include "trident_bridges/vehicle/missions.h"
#include "vehicle/vehicle_class.h"

namespace trident::bridges::mavlink {

MissionServerEvents MavlinkVehicle::mission_events() {
  MissionServerEvents events;
  events.check_mission = [this](MissionType type, const Mission& list) {
    return check_mission(type, list);
  };
  events.changed = [this](MissionType type) { load_list(type); };
  events.set_current = [this](std::uint16_t index) {
    return to_verdict(autopilot_.handle(MissionItemRequest{index}, newest_.now));
  };
  events.refused = [this](const std::string& reason) { say(Severity::kError, reason); };
  return events;
}

MissionVerdict MavlinkVehicle::check_mission(MissionType type, const Mission& list) {
  if (type == MissionType::kRally) return {};
  if (type == MissionType::kFence) return check_fence(list);
  MissionVerdict verdict = to_verdict(bridges::check_mission(
      to_autopilot(list, flavor_of(options_.flavour), places()), class_of(options_.kind)));
  if (verdict.is_accepted()) note_payload_items(list);
  return verdict;
}

MissionVerdict MavlinkVehicle::check_fence(const Mission& list) {
  std::vector<Fence::Region> regions;
  MissionVerdict verdict = read_fence(list, places(), regions);
  if (!verdict.is_accepted()) return verdict;
  verdict = to_verdict(autopilot_.load_fence(std::move(regions)));
  const std::string notice = notice_of_fence(list);
  if (verdict.is_accepted() && !notice.empty()) say(Severity::kNotice, notice);
  return verdict;
}

/// Items without effect are named once, with the upload.
void MavlinkVehicle::note_payload_items(const Mission& list) {
  const auto is_without_effect = [](const MissionItem& item) {
    return is_for_payload(item.command);
  };
  const auto first = std::find_if(list.begin(), list.end(), is_without_effect);
  if (first == list.end()) return;
  const auto count = std::count_if(first, list.end(), is_without_effect);
  say(Severity::kNotice,
      "mission: items for cameras, gimbals or relays have no effect: " + std::to_string(count) +
          ", from item " + std::to_string(first - list.begin()) + " (command " +
          std::to_string(first->command) + ")");
}

/// Gives a list that was checked to the autopilot.
void MavlinkVehicle::load_list(MissionType type) {
  if (type == MissionType::kFence) {
    std::vector<Fence::Region> regions;
    read_fence(missions_.mission(type), places(), regions);
    autopilot_.load_fence(std::move(regions));
  }
  if (type != MissionType::kMission) return;
  const Flavor flavor = flavor_of(options_.flavour);
  if (flavor == Flavor::kArduPilot && autopilot_.home() &&
      !missions_.mission(MissionType::kMission).empty()) {
    Mission list = missions_.mission(MissionType::kMission);
    list.front() = home_item(geo_.to_geo(*autopilot_.home()));
    missions_.set_mission(MissionType::kMission, std::move(list));
  }
  autopilot_.load_mission(to_autopilot(missions_.mission(MissionType::kMission), flavor, places()));
}

}  // namespace trident::bridges::mavlink
