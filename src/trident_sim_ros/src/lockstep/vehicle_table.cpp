// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle_table.h"

#include <algorithm>

namespace trident::sim {
namespace {

const std::string kCommandTopic = "command/motor_speed";

bool ends_with(const std::string& text, const std::string& tail) {
  return text.size() >= tail.size() &&
         text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

/// Returns the inputs that controllers write: not those that a controller interface passes commands
/// on to, which have an output of the same name.
std::map<std::string, InPort<ActuatorCommand>*> commanded_ports(const PortBoard& board) {
  std::map<std::string, InPort<ActuatorCommand>*> result;
  board.for_each([&](PortBase& port) {
    auto* typed = dynamic_cast<InPort<ActuatorCommand>*>(&port);
    if (typed == nullptr || !ends_with(port.name(), kCommandTopic)) return;
    if (board.find(port.name(), PortDirection::kOut) == nullptr) result[port.name()] = typed;
  });
  return result;
}

}  // namespace

VehicleTable::VehicleTable(ros::NodeHandle& node, const ServerOptions& options,
                           Repeatability& repeatability, NodeProbe& probe)
    : node_(node),
      hub_(options.shares_process ? ros_utils::DirectInbox::Sockets::kReadByRoscpp
                                  : ros_utils::DirectInbox::Sockets::kReadHere,
           repeatability, probe) {}

VehicleTable::~VehicleTable() {
  {
    const Lock lock(hub_.mutex);
    hub_.vehicles.clear();
  }
  links_.clear();
}

void VehicleTable::sync(World& world, PortBinder& binder, bool is_confirming_open) {
  const auto commanded = commanded_ports(world.ports());
  unlink_gone(commanded);
  for (const auto& [name, port] : commanded) {
    if (links_.count(name) > 0) continue;
    const std::string prefix = name.substr(0, name.size() - kCommandTopic.size());
    auto link = std::make_unique<VehicleLink>(node_, hub_, *port, binder.hold_back_odometry(prefix),
                                              inline_queue_);
    const Lock lock(hub_.mutex);
    link->assert_hub_is_locked();
    if (is_confirming_open) link->leave_confirming_open();
    hub_.vehicles.push_back(link.get());
    links_.emplace(name, std::move(link));
  }
}

void VehicleTable::unlink_gone(const std::map<std::string, InPort<ActuatorCommand>*>& commanded) {
  for (auto it = links_.begin(); it != links_.end();) {
    const auto now = commanded.find(it->first);
    if (now != commanded.end() && now->second == &it->second->port()) {
      ++it;
      continue;
    }
    {
      const Lock lock(hub_.mutex);
      auto& list = hub_.vehicles;
      list.erase(std::remove(list.begin(), list.end(), it->second.get()), list.end());
    }
    // Without the lock: the link's end waits for callbacks that take it.
    it = links_.erase(it);
  }
}

void VehicleTable::watch_setpoints(const std::vector<std::string>& names) {
  for (const auto& [topic, link] : links_) {
    const bool is_fed = std::find(names.begin(), names.end(), link->name()) != names.end();
    if (is_fed) link->watch_setpoints();
  }
}

std::vector<std::pair<std::string, bool>> VehicleTable::states() {
  const Lock lock(hub_.mutex);
  std::vector<std::pair<std::string, bool>> result;
  for (const VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    result.emplace_back(vehicle->name(), vehicle->lockstep.enrolled());
  }
  return result;
}

}  // namespace trident::sim
