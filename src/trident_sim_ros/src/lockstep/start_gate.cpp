// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "start_gate.h"

#include <algorithm>
#include <vector>

namespace trident::sim {
namespace {

constexpr auto kMasterPollPeriod = std::chrono::milliseconds(50);

void add_missing_models(const World& world, const std::vector<std::string>& names,
                        std::vector<std::string>& missing) {
  for (const std::string& name : names) {
    if (world.find_model(name) == nullptr) missing.push_back("model " + name);
  }
}

}  // namespace

template <class IsAsked>
void StartGate::add_missing_controllers(const IsAsked& is_asked,
                                        std::vector<std::string>& missing) const {
  for (const auto& [port, vehicle] : vehicles_.links()) {
    if (is_asked(port) && !vehicle->has_controller()) {
      missing.push_back("the controller of " + vehicle->name());
    }
  }
}

std::string StartGate::missing(const World& world) {
  std::vector<std::string> missing;
  add_missing_models(world, options_.wait_for_models, missing);
  const int absent = options_.wait_for - static_cast<int>(vehicles_.size());
  if (absent > 0) missing.push_back(std::to_string(absent) + " more vehicle(s)");
  if (options_.wait_for > 0) {
    add_missing_controllers([](const std::string&) { return true; }, missing);
  }
  add_missing_models(world, options_.wait_for_spawned, missing);
  add_missing_controllers([this](const std::string& port) { return is_to_be_controlled(port); },
                          missing);
  LockstepHub& hub = vehicles_.hub();
  const Lock lock(hub.mutex);
  const int silent = options_.wait_for_sources - static_cast<int>(hub.sources.all().size());
  if (silent > 0) missing.push_back(std::to_string(silent) + " more set-point source(s)");
  return join(missing);
}

bool StartGate::is_to_be_controlled(const std::string& port) const {
  const auto& topics = options_.wait_for_controllers;
  return std::find(topics.begin(), topics.end(), "/" + port) != topics.end();
}

/// A controller that announces that it confirms set-points is registered with the master before it
/// reads the first state. Until its confirmations reach this process time zero is held.
bool StartGate::all_announced_confirm() {
  const auto& links = vehicles_.links();
  const auto confirms = [](const auto& entry) { return entry.second->hears_confirmations(); };
  if (std::all_of(links.begin(), links.end(), confirms)) return true;
  if (Clock::now() < next_master_poll_) return false;
  next_master_poll_ = Clock::now() + kMasterPollPeriod;
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return false;
  for (const auto& [name, vehicle] : links) {
    const std::string topic = "/" + vehicle->confirmation_topic();
    const bool will = std::any_of(topics.begin(), topics.end(),
                                  [&](const auto& info) { return info.name == topic; });
    if (will && !vehicle->hears_confirmations()) return false;
  }
  return true;
}

bool StartGate::allows_start(const World& world, PortBinder& binder) {
  if (!is_held()) return true;
  if (!missing(world).empty() || !all_announced_confirm()) return false;
  // A confirmation's connection, too, has to be known at both ends.
  if (!missing(world).empty()) return false;
  is_released_ = true;
  binder.scan_subscribers();
  release(world);
  return true;
}

void StartGate::release(const World& world) {
  LockstepHub& hub = vehicles_.hub();
  const Lock lock(hub.mutex);
  hub.take_heard();
  for (const auto& [name, vehicle] : vehicles_.links()) {
    vehicle->assert_hub_is_locked();
    // A controller of an unknown kind may not answer each state; it enrols by its first answer.
    if (options_.wait_for_spawned.empty() || is_to_be_controlled(name)) vehicle->lockstep.enroll();
    vehicle->close_confirming();
    if (hub.sources.feeds(vehicle->name()) && !vehicle->confirms_setpoints()) {
      repeatability_.spoil("the controller of " + vehicle->name(), world.time(),
                           "does not confirm its set-points: when they reach it is left to chance");
    }
  }
  hub.events.push_back(std::to_string(vehicles_.size()) + " vehicle(s) with controllers and " +
                       std::to_string(hub.sources.all().size()) +
                       " set-point source(s) are there: time runs");
}

}  // namespace trident::sim
