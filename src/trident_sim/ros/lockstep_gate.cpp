// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lockstep_gate.h"

#include <algorithm>
#include <cstdio>

namespace trident {
namespace {

using std::chrono::milliseconds;

/// After every declared part is there, controllers get this long to announce that they confirm
/// set-points; those that do not are taken not to.
constexpr auto kConfirmationGrace = milliseconds(300);
constexpr auto kLookAtLossesEvery = milliseconds(2);
/// A broken connection counts after this time without an answer, which may have been under way.
constexpr WallTime kDisconnectedAfter = 20'000'000;
/// A set-point source may be a script that starts slowly: it gets this many times a controller's
/// patience.
constexpr double kSourcePatience = 10.0;
/// A source that sees another node's trajectory sends its own again; if it has not by then, it will
/// not.
constexpr double kReplacementPatience_s = 1.0;
const std::string kCommandTopic = "command/motor_speed";

WallTime wall_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", seconds);
  return text;
}

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

LockstepGate::LockstepGate(ros::NodeHandle& node, const ServerOptions& options, ReportSink report,
                           std::function<void()> pause)
    : node_(node),
      options_(options),
      report_(std::move(report)),
      pause_(std::move(pause)),
      hub_(options.shares_process ? DirectInbox::Sockets::kReadByRoscpp
                                  : DirectInbox::Sockets::kReadHere) {}

LockstepGate::~LockstepGate() {
  {
    const std::lock_guard<std::mutex> lock(hub_.mutex);
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
      const std::lock_guard<std::mutex> lock(hub_.mutex);
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
    const std::lock_guard<std::mutex> lock(hub_.mutex);
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
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  const int silent = options_.wait_for_sources - static_cast<int>(hub_.sources.all().size());
  if (silent > 0) missing.push_back(std::to_string(silent) + " more set-point source(s)");
  return join(missing);
}

bool LockstepGate::is_to_be_controlled(const std::string& port) const {
  const auto& topics = options_.wait_for_controllers;
  return std::find(topics.begin(), topics.end(), "/" + port) != topics.end();
}

bool LockstepGate::start_allowed(const World& world, PortBinder& binder) {
  if (released_ || !options_.holds_time_zero()) return true;
  if (!missing_for_start(world).empty()) {
    complete_since_ = {};
    return false;
  }
  if (complete_since_ == Clock::time_point{}) complete_since_ = Clock::now();
  const bool all_confirm = std::all_of(vehicles_.begin(), vehicles_.end(), [](const auto& entry) {
    return entry.second->confirms_setpoints();
  });
  if (!all_confirm && Clock::now() - complete_since_ < kConfirmationGrace) return false;
  released_ = true;
  binder.scan_subscribers();
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  for (const auto& [name, vehicle] : vehicles_) {
    // A controller of an unknown kind may not answer each state; it enrols by its first answer.
    if (options_.wait_for_spawned.empty() || is_to_be_controlled(name)) vehicle->lockstep.enrol();
  }
  hub_.news.push_back(std::to_string(vehicles_.size()) + " vehicle(s) with controllers and " +
                      std::to_string(hub_.sources.all().size()) +
                      " set-point source(s) are there: time runs");
  return true;
}

bool LockstepGate::allows_step(const World& world, std::mutex& world_mutex,
                               const std::function<void()>& about_to_wait) {
  std::unique_lock<std::mutex> lock(hub_.mutex);
  const bool delayed = options_.timing == LoopTiming::kRotors;
  hub_.required_stamp = delayed ? world.time() - world.dt() : world.time();
  hub_.next_time = world.time() + world.dt();
  if (!has_just_read_) read_commands(milliseconds(0));
  has_just_read_ = false;
  if (hub_.ready()) {
    for (VehicleLink* vehicle : hub_.vehicles) vehicle->deliver();
    return true;
  }
  if (hub_.sources.blocking(hub_.next_time) != nullptr) {
    lock.unlock();
    about_to_wait();
    lock.lock();
  }
  world_mutex.unlock();
  const bool ready = wait_until_ready(lock);
  has_just_read_ = true;
  lock.unlock();
  world_mutex.lock();
  if (!ready) check_losses(world);
  return false;  // the world may have changed meanwhile
}

bool LockstepGate::wait_until_ready(std::unique_lock<std::mutex>& lock) {
  const auto limit = Clock::now() + kLookAtLossesEvery;
  bool is_over = false;
  while (!hub_.ready() && !is_over) {
    hub_.stepper_waits = true;
    lock.unlock();
    is_over = !hub_.commands.wait(kLookAtLossesEvery) || Clock::now() > limit;
    lock.lock();
    hub_.stepper_waits = false;
    hub_.commands.read();
  }
  return hub_.ready();
}

void LockstepGate::read_commands(milliseconds limit) {
  if (hub_.commands.wait(limit)) hub_.commands.read();
}

void LockstepGate::read_while_standing() {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  read_commands(milliseconds(0));
}

void LockstepGate::check_losses(const World& world) {
  const WallTime now = wall_now();
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) check_vehicle(*vehicle, now);
  check_source(world.time() + world.dt(), now);
}

void LockstepGate::check_vehicle(VehicleLink& vehicle, WallTime now) {
  const WallTime waited = vehicle.lockstep.waiting_for(now);
  const double waited_s = static_cast<double>(waited) * 1e-9;
  const bool disconnected =
      waited > kDisconnectedAfter && vehicle.odometry_readers() < vehicle.readers_when_sent;
  const bool is_silent = waited_s >= options_.lockstep_timeout_s;
  if (disconnected || is_silent) vehicle.connection_lost = true;
  send_again_if_back(vehicle, now);
  if (!disconnected && !is_silent) return;
  if (options_.loss_policy == LossPolicy::kWait && vehicle.loss_told) return;
  vehicle.loss_told = true;
  lose("the controller of " + vehicle.name(),
       disconnected ? "has disconnected" : "has not answered for " + seconds_text(waited_s));
  if (options_.loss_policy != LossPolicy::kWait) vehicle.release();
}

void LockstepGate::send_again_if_back(VehicleLink& vehicle, WallTime now) {
  // A new reader is the controller that came back. One that was back before its loss was noticed,
  // or is just slow, gets the state again once per timeout.
  const std::uint32_t readers = vehicle.odometry_readers();
  const bool is_new = readers > vehicle.readers_seen;
  const double since_s = static_cast<double>(now - vehicle.sent_again_at) * 1e-9;
  vehicle.readers_seen = readers;
  if (!vehicle.connection_lost || readers == 0) return;
  if (is_new || since_s > options_.lockstep_timeout_s) {
    vehicle.sent_again_at = now;
    vehicle.send_again();
  }
}

void LockstepGate::check_source(SimTime time, WallTime now) {
  const std::string* blocking = hub_.sources.blocking(time);
  for (auto& [node, source] : hub_.sources.all()) {
    if (blocking == nullptr || node != *blocking) source.since = 0;
  }
  if (blocking == nullptr) return;
  const std::string node = *blocking;
  auto& source = hub_.sources.all().at(node);
  if (source.since == 0) source.since = now;
  const double waited_s = static_cast<double>(now - source.since) * 1e-9;
  if (waited_s > kReplacementPatience_s) hub_.sources.forget_replacements();
  if (waited_s < kSourcePatience * options_.lockstep_timeout_s) return;
  source.since = now;
  lose("set-point source " + node, "has sent nothing for " + seconds_text(waited_s) + " for " +
                                       join(hub_.sources.missing(node, time)) +
                                       " at t = " + seconds_text(time.seconds()));
  if (options_.loss_policy != LossPolicy::kWait) hub_.sources.release(node);
}

void LockstepGate::lose(const std::string& who, const std::string& why) {
  const char* what = options_.loss_policy == LossPolicy::kWait    ? "the world waits"
                     : options_.loss_policy == LossPolicy::kPause ? "the world is paused"
                                                                  : "the world goes on without it";
  if (options_.loss_policy == LossPolicy::kPause) pause_();
  report_(Severity::kWarning, who + " " + why + "; " + what);
}

void LockstepGate::send_states(SimTime stamp) {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  const WallTime now = wall_now();
  for (VehicleLink* vehicle : hub_.vehicles) vehicle->send_state(stamp, now);
}

void LockstepGate::keep_on_cores() {
  const std::uint64_t newest = hub_.commands.newest_link();
  // Fewer vehicles than cores leave a controller room for threads that work side by side.
  const bool is_crowded = vehicles_.size() >= cores_.count();
  if (!options_.pin_controllers || newest == newest_link_ || !is_crowded) return;
  newest_link_ = newest;
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  for (std::size_t i = 0; i < hub_.vehicles.size(); ++i) {
    const VehicleLink& vehicle = *hub_.vehicles[i];
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
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->clear();
    if (with_time) vehicle->announce_reset();
  }
  if (with_time) hub_.sources.clear();
}

SimTime LockstepGate::enrol_source(const std::string& node,
                                   const std::vector<std::string>& vehicles, SimTime period,
                                   SimTime end, SimTime now) {
  for (const auto& [topic, vehicle] : vehicles_) {
    const bool is_fed =
        std::find(vehicles.begin(), vehicles.end(), vehicle->name()) != vehicles.end();
    if (is_fed) vehicle->watch_setpoints();
  }
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  const bool is_new = hub_.sources.all().count(node) == 0;
  const SimTime start = hub_.sources.enrol(node, vehicles, period, end, now);
  if (is_new) {
    hub_.news.push_back("set-point source " + node + " enrolled for " + join(vehicles) +
                        " from t = " + seconds_text(start.seconds()));
  }
  return start;
}

void LockstepGate::release_source(const std::string& node) {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  hub_.sources.release(node);
}

SimTime LockstepGate::sources_end() {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  return hub_.sources.end();
}

std::vector<std::pair<std::string, bool>> LockstepGate::vehicle_states() {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  std::vector<std::pair<std::string, bool>> result;
  for (const VehicleLink* vehicle : hub_.vehicles) {
    result.emplace_back(vehicle->name(), vehicle->lockstep.enrolled());
  }
  return result;
}

std::vector<std::string> LockstepGate::take_news() {
  const std::lock_guard<std::mutex> lock(hub_.mutex);
  std::vector<std::string> news;
  news.swap(hub_.news);
  return news;
}

}  // namespace trident
