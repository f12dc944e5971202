// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lockstep_gate.h"

#include <algorithm>
#include <cstdio>

namespace trident::sim {
namespace {

using std::chrono::milliseconds;

constexpr auto kLookAtLossesEvery = milliseconds(2);
constexpr auto kLookAtMasterEvery = milliseconds(50);
/// A set-point source may be a script that starts slowly: it gets this many times a controller's
/// patience.
constexpr double kSourcePatience = 10.0;
/// A source that sees another node's trajectory sends its own again; if it has not by then, it will
/// not.
constexpr WallTime kReplacementPatience = 1'000'000'000;
const std::string kCommandTopic = "command/motor_speed";

bool ends_with(const std::string& text, const std::string& tail) {
  return text.size() >= tail.size() &&
         text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

/// The inputs that controllers write: not those that a controller interface passes commands on to,
/// which have an output of the same name.
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

LockstepGate::LockstepGate(ros::NodeHandle& node, const ServerOptions& options, LossWatch& losses,
                           NodeProbe& probe)
    : node_(node),
      options_(options),
      losses_(losses),
      probe_(probe),
      hub_(options.shares_process ? ros_utils::DirectInbox::Sockets::kReadByRoscpp
                                  : ros_utils::DirectInbox::Sockets::kReadHere,
           losses.repeatability(), probe) {}

LockstepGate::~LockstepGate() {
  {
    const Lock lock(hub_.mutex);
    hub_.vehicles.clear();
  }
  vehicles_.clear();
}

void LockstepGate::sync(World& world, PortBinder& binder) {
  const auto commanded = commanded_ports(world.ports());
  for (auto it = vehicles_.begin(); it != vehicles_.end();) {
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
    it = vehicles_.erase(it);
  }
  for (const auto& [name, port] : commanded) {
    if (vehicles_.count(name) > 0) continue;
    const std::string prefix = name.substr(0, name.size() - kCommandTopic.size());
    auto link = std::make_unique<VehicleLink>(node_, hub_, *port, binder.hold_back_odometry(prefix),
                                              inline_queue_);
    const Lock lock(hub_.mutex);
    const bool is_held = options_.holds_time_zero();
    link->assert_hub_is_locked();
    if (is_held && !released_) link->leave_confirming_open();
    hub_.vehicles.push_back(link.get());
    vehicles_.emplace(name, std::move(link));
  }
}

std::string LockstepGate::missing_for_start(const World& world) {
  std::vector<std::string> missing;
  for (const std::string& name : options_.wait_for_models) {
    if (world.find_model(name) == nullptr) missing.push_back("model " + name);
  }
  const int absent = options_.wait_for - static_cast<int>(vehicles_.size());
  if (absent > 0) missing.push_back(std::to_string(absent) + " more vehicle(s)");
  if (options_.wait_for > 0) {
    for (const auto& [name, vehicle] : vehicles_) {
      if (!vehicle->has_controller()) missing.push_back("the controller of " + vehicle->name());
    }
  }
  for (const std::string& name : options_.wait_for_spawned) {
    if (world.find_model(name) == nullptr) missing.push_back("model " + name);
  }
  for (const auto& [name, vehicle] : vehicles_) {
    if (is_to_be_controlled(name) && !vehicle->has_controller()) {
      missing.push_back("the controller of " + vehicle->name());
    }
  }
  const Lock lock(hub_.mutex);
  const int silent = options_.wait_for_sources - static_cast<int>(hub_.sources.all().size());
  if (silent > 0) missing.push_back(std::to_string(silent) + " more set-point source(s)");
  return join(missing);
}

bool LockstepGate::is_to_be_controlled(const std::string& port) const {
  const auto& topics = options_.wait_for_controllers;
  return std::find(topics.begin(), topics.end(), "/" + port) != topics.end();
}

void LockstepGate::check_losses_at_start() {
  if (released_) return;
  const WallTime now = wall_now();
  const Lock lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    if (vehicle->has_controller()) {
      vehicle->had_controller = true;
      vehicle->waiting.end();
    } else if (vehicle->had_controller) {
      if (vehicle->waiting.since == 0) vehicle->waiting.since = now;
      losses_.gives_up({"the controller of " + vehicle->name(), "", true, 1.0, {}},
                       vehicle->waiting, now);
    }
  }
  for (auto& [node, source] : hub_.sources.all()) {
    Waiting& waiting = sources_[node];
    const bool is_gone = probe_.look(node) == NodeProbe::State::kGone;
    if (!is_gone) waiting.end();
    if (!is_gone) continue;
    if (waiting.since == 0) waiting.since = now;
    losses_.gives_up({"set-point source " + node, "", true, 1.0, {}}, waiting, now);
  }
}

/// A controller that announces that it confirms set-points is registered with the master before it
/// reads the first state. Until its confirmations reach this process time zero is held.
bool LockstepGate::all_confirm_who_will() {
  const auto confirms = [](const auto& entry) { return entry.second->hears_confirmations(); };
  if (std::all_of(vehicles_.begin(), vehicles_.end(), confirms)) return true;
  if (Clock::now() < next_look_) return false;
  next_look_ = Clock::now() + kLookAtMasterEvery;
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return false;
  for (const auto& [name, vehicle] : vehicles_) {
    const std::string topic = "/" + vehicle->confirmation_topic();
    const bool will = std::any_of(topics.begin(), topics.end(),
                                  [&](const auto& info) { return info.name == topic; });
    if (will && !vehicle->hears_confirmations()) return false;
  }
  return true;
}

bool LockstepGate::start_allowed(const World& world, PortBinder& binder) {
  if (released_ || !options_.holds_time_zero()) return true;
  if (!missing_for_start(world).empty() || !all_confirm_who_will()) return false;
  // A confirmation's connection, too, has to be known at both ends.
  if (!missing_for_start(world).empty()) return false;
  released_ = true;
  binder.scan_subscribers();
  const Lock lock(hub_.mutex);
  for (const auto& [name, vehicle] : vehicles_) {
    vehicle->assert_hub_is_locked();
    // A controller of an unknown kind may not answer each state; it enrols by its first answer.
    if (options_.wait_for_spawned.empty() || is_to_be_controlled(name)) vehicle->lockstep.enrol();
    vehicle->close_confirming();
    if (hub_.sources.feeds(vehicle->name()) && !vehicle->confirms_setpoints()) {
      losses_.repeatability().spoil(
          "the controller of " + vehicle->name(), world.time(),
          "does not confirm its set-points: when they reach it is left to chance");
    }
  }
  hub_.news.push_back(std::to_string(vehicles_.size()) + " vehicle(s) with controllers and " +
                      std::to_string(hub_.sources.all().size()) +
                      " set-point source(s) are there: time runs");
  return true;
}

bool LockstepGate::allows_step(const World& world, FairMutex& world_mutex,
                               const std::function<void()>& about_to_wait) {
  bool waits_for_source = false;
  {
    const Lock lock(hub_.mutex);
    const bool delayed = options_.timing == LoopTiming::kRotors;
    hub_.required_stamp = delayed ? world.time() - world.dt() : world.time();
    hub_.next_time = world.time() + world.dt();
    if (!has_just_read_) read_commands(milliseconds(0));
    has_just_read_ = false;
    if (hub_.ready()) {
      losses_.clear();
      for (VehicleLink* vehicle : hub_.vehicles) {
        vehicle->assert_hub_is_locked();
        vehicle->deliver();
      }
      return true;
    }
    waits_for_source = hub_.sources.blocking(hub_.next_time) != nullptr;
  }
  if (waits_for_source) about_to_wait();
  bool ready = false;
  {
    const Unlock world_is_free(world_mutex);
    ready = wait_until_ready();
  }
  has_just_read_ = true;
  if (!ready) check_losses(world);
  return false;  // the world may have changed meanwhile
}

bool LockstepGate::wait_until_ready() {
  const auto limit = Clock::now() + kLookAtLossesEvery;
  const Lock lock(hub_.mutex);
  bool is_over = false;
  while (!hub_.ready() && !is_over) {
    hub_.stepper_waits = true;
    {
      const Unlock hub_is_free(hub_.mutex);
      is_over = !hub_.commands.wait(kLookAtLossesEvery) || Clock::now() > limit;
    }
    hub_.stepper_waits = false;
    hub_.commands.read();
  }
  return hub_.ready();
}

void LockstepGate::read_commands(milliseconds limit) {
  if (hub_.commands.wait(limit)) hub_.commands.read();
}

void LockstepGate::read_while_standing() {
  const Lock lock(hub_.mutex);
  read_commands(milliseconds(0));
}

void LockstepGate::check_losses(const World& world) {
  const WallTime now = wall_now();
  const Lock lock(hub_.mutex);
  losses_.clear();
  for (VehicleLink* vehicle : hub_.vehicles) check_vehicle(*vehicle, now);
  check_source(world.time() + world.dt(), now);
}

void LockstepGate::check_vehicle(VehicleLink& vehicle, WallTime now) {
  vehicle.assert_hub_is_locked();
  const WallTime waited = vehicle.lockstep.waiting_for(now);
  if (waited == 0) return;
  const SimTime time = hub_.next_time;
  const std::string who = "the controller of " + vehicle.name();
  // Whoever reads its odometry since the state was sent has not got it.
  if (vehicle.send_again_to_new_readers()) {
    losses_.repeatability().spoil(who, time, "was started again");
  }
  vehicle.waiting.since = now - waited;
  const bool gives_up = losses_.gives_up(
      {who, "has not answered", vehicle.has_lost_controller(), 1.0, time}, vehicle.waiting, now);
  if (gives_up) vehicle.release();
}

void LockstepGate::check_source(SimTime time, WallTime now) {
  const std::string* blocking = hub_.sources.blocking(time);
  for (auto& [node, waiting] : sources_) {
    if (blocking == nullptr || node != *blocking) waiting.end();
  }
  if (blocking == nullptr) return;
  const std::string node = *blocking;
  Waiting& waiting = sources_[node];
  if (waiting.since == 0) waiting.since = now;
  if (now - waiting.since > kReplacementPatience && hub_.sources.forget_replacements()) {
    losses_.repeatability().spoil(
        "another node than " + node, time,
        "has replaced set-points, and " + node + " has not sent its own again");
  }
  const bool is_gone = probe_.look(node) == NodeProbe::State::kGone;
  const std::string who = "set-point source " + node;
  const std::string what = "has sent nothing for " + join(hub_.sources.missing(node, time)) +
                           " at t = " + seconds_text(time.seconds());
  if (losses_.gives_up({who, what, is_gone, kSourcePatience, time}, waiting, now)) {
    hub_.sources.release(node);
  }
}

void LockstepGate::send_states(SimTime stamp) {
  const Lock lock(hub_.mutex);
  const WallTime now = wall_now();
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    vehicle->send_state(stamp, now);
  }
}

void LockstepGate::keep_on_cores() {
  const std::uint64_t newest = hub_.commands.newest_link();
  // Fewer vehicles than cores leave a controller room for threads that work side by side.
  const bool is_crowded = vehicles_.size() >= cores_.count();
  if (!options_.pin_controllers || newest == newest_link_ || !is_crowded) return;
  newest_link_ = newest;
  const Lock lock(hub_.mutex);
  for (std::size_t i = 0; i < hub_.vehicles.size(); ++i) {
    const VehicleLink& vehicle = *hub_.vehicles[i];
    vehicle.assert_hub_is_locked();
    // Those that confirm set-points are of this workspace: one thread does all, so there is nothing
    // to gain, and beside the server they are cheaper than spread out.
    if (!vehicle.lockstep.enrolled() || vehicle.confirms_setpoints()) continue;
    for (const pid_t process : vehicle.controller_processes()) {
      const int core = cores_.keep(process, i);
      if (core < 0) continue;
      hub_.news.push_back(vehicle.name() + ": controller, process " + std::to_string(process) +
                          ", is kept on core " + std::to_string(core));
    }
  }
}

void LockstepGate::clear(bool with_time) {
  const Lock lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    vehicle->clear();
    if (with_time) vehicle->announce_reset();
  }
  if (with_time) hub_.sources.clear();
  sources_.clear();
}

SimTime LockstepGate::enrol_source(const std::string& node,
                                   const std::vector<std::string>& vehicles, SimTime period,
                                   SimTime end, bool waits_beyond_end, SimTime now) {
  for (const auto& [topic, vehicle] : vehicles_) {
    const bool is_fed =
        std::find(vehicles.begin(), vehicles.end(), vehicle->name()) != vehicles.end();
    if (is_fed) vehicle->watch_setpoints();
  }
  const Lock lock(hub_.mutex);
  const bool is_new = hub_.sources.all().count(node) == 0;
  probe_.look(node);  // so that its end will be one
  if (is_new && losses_.repeatability().running()) {
    losses_.repeatability().spoil("set-point source " + node, now, "enrolled while time ran");
  }
  const SimTime start = hub_.sources.enrol(node, vehicles, period, end, now, waits_beyond_end);
  if (is_new) {
    hub_.news.push_back("set-point source " + node + " enrolled for " + join(vehicles) +
                        " from t = " + seconds_text(start.seconds()));
  }
  return start;
}

void LockstepGate::release_source(const std::string& node) {
  const Lock lock(hub_.mutex);
  hub_.sources.release(node);
}

SimTime LockstepGate::sources_end() {
  const Lock lock(hub_.mutex);
  return hub_.sources.end();
}

std::vector<std::pair<std::string, bool>> LockstepGate::vehicle_states() {
  const Lock lock(hub_.mutex);
  std::vector<std::pair<std::string, bool>> result;
  for (const VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    result.emplace_back(vehicle->name(), vehicle->lockstep.enrolled());
  }
  return result;
}

std::vector<std::string> LockstepGate::take_news() {
  const Lock lock(hub_.mutex);
  std::vector<std::string> news;
  news.swap(hub_.news);
  return news;
}

}  // namespace trident::sim
