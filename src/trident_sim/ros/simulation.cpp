// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "conversions.h"
#include "trident_base/error.h"

namespace trident {
namespace {

using std::chrono::duration;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr auto kScanPeriod = milliseconds(2);
constexpr std::size_t kRememberedComplaints = 50;
/// After every declared part is there, controllers get this long to announce that they confirm
/// set-points; those that do not are taken not to.
constexpr auto kConfirmationGrace = milliseconds(300);

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

std::string seconds_text(WallTime time) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f s", static_cast<double>(time) * 1e-9);
  return text;
}

}  // namespace

Simulation::Simulation(ros::NodeHandle& node, const ServerOptions& options)
    : node_(node), options_(options), paused_(options.paused), begin_(Clock::now()) {
  register_builtin_plugins(registry_);
  for (const std::string& library : options.plugin_libraries) registry_.load_shared_object(library);
  diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  const auto warn = [this](const std::string& text) { report(Severity::kWarning, text); };
  const WorldSpec spec = load_world_file(options.world_file, resources_, warn);
  world_ = std::make_unique<World>(
      spec, resources_, registry_,
      WorldOptions{options.seed, options.timing,
                   [this](Severity severity, const std::string& text) { report(severity, text); }});
  const double update_rate = spec.physics.real_time_update_rate_hz;
  real_time_factor_ = options.real_time_factor >= 0.0 ? options.real_time_factor
                                                      : update_rate * spec.physics.max_step_size_s;
  binder_ = std::make_unique<PortBinder>(node_, world_->ports());
  topics_ = std::make_unique<StateTopics>(node_, options.max_clock_rate_hz,
                                          options.pub_clock_frequency_hz);
  files_ = std::make_unique<RunFiles>(options.out_dir, options.seed);
  sync_topics();
  topics_->publish_clock(world_->time());
}

Simulation::~Simulation() {
  {
    const std::lock_guard lock(hub_.mutex);
    hub_.vehicles.clear();
  }
  vehicles_.clear();
}

void Simulation::report(Severity severity, const std::string& text) {
  if (severity == Severity::kError) {
    ROS_ERROR("%s", text.c_str());
  } else {
    ROS_WARN("%s", text.c_str());
  }
  complaints_.emplace_back(severity, text);
  if (complaints_.size() > kRememberedComplaints) complaints_.erase(complaints_.begin());
}

void Simulation::sync_topics() {
  binder_->sync();
  const std::string tail = "command/motor_speed";
  std::map<std::string, InPort<ActuatorCommand>*> commanded;
  world_->ports().for_each([&](PortBase& port) {
    auto* typed = dynamic_cast<InPort<ActuatorCommand>*>(&port);
    const std::string& name = port.name();
    if (typed == nullptr || name.size() < tail.size()) return;
    if (name.compare(name.size() - tail.size(), tail.size(), tail) != 0) return;
    // The controller interface writes this one; its outside is the port of the same name.
    if (world_->ports().find(name, PortDirection::kOut) == nullptr) commanded[name] = typed;
  });
  for (auto it = vehicles_.begin(); it != vehicles_.end();) {
    const auto now = commanded.find(it->first);
    const bool keep = now != commanded.end() && now->second == &it->second->port();
    if (!keep) {
      const std::lock_guard lock(hub_.mutex);
      hub_.vehicles.erase(
          std::remove(hub_.vehicles.begin(), hub_.vehicles.end(), it->second.get()),
          hub_.vehicles.end());
    }
    it = keep ? std::next(it) : vehicles_.erase(it);
  }
  for (const auto& [name, port] : commanded) {
    if (vehicles_.count(name) > 0) continue;
    const std::string prefix = name.substr(0, name.size() - tail.size());
    auto link = std::make_unique<VehicleLink>(node_, hub_, *port,
                                              binder_->hold_back_odometry(prefix), inline_queue_);
    const std::lock_guard lock(hub_.mutex);
    hub_.vehicles.push_back(link.get());
    vehicles_.emplace(name, std::move(link));
  }
  binder_->scan_subscribers();
}

std::string Simulation::run() {
  pace_wall_ = next_second_ = Clock::now();
  while (ros::ok() && run_once()) {
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  stepped_.notify_all();
  if (end_reason_.empty()) end_reason_ = "interrupted";
  publish_step(true);
  files_->finish(*world_, end_reason_, duration<double>(Clock::now() - first_step_).count(),
                 started_ ? world_->time() - first_step_time_ : SimTime{0});
  return end_reason_;
}

bool Simulation::run_once() {
  while (waiting_ > 0) std::this_thread::sleep_for(microseconds(20));
  const std::lock_guard lock(mutex_);
  if (Clock::now() >= next_scan_) every_so_often();
  if (finished()) return false;
  const bool stepping = steps_wanted_ > 0;
  if ((paused_ && !stepping) || !start_allowed()) {
    pace_wall_ = Clock::now();
    pace_sim_ = world_->time();
    wait(microseconds(1000));
    return true;
  }
  if (!stepping && !pace_allows()) return true;
  if (!lockstep_allows()) return true;
  if (!started_) {
    started_ = true;
    first_step_ = Clock::now();
    first_step_time_ = world_->time();
  }
  make_step();
  if (stepping && --steps_wanted_ == 0) {
    topics_->publish_clock(world_->time());
    stepped_.notify_all();
  }
  return true;
}

bool Simulation::finished() {
  const SimTime now = world_->time();
  SimTime sources_end;
  {
    const std::lock_guard lock(hub_.mutex);
    sources_end = hub_.sources.end();
  }
  if (options_.end_on_finish && sources_end.ns > 0 && now >= sources_end) {
    end_reason_ = "finished";
  } else if (options_.end_time_s > 0.0 && now >= SimTime::from_seconds(options_.end_time_s)) {
    end_reason_ = "end_time";
  } else if (options_.iterations > 0 && world_->step_count() >= options_.iterations) {
    end_reason_ = "iterations";
  }
  return !end_reason_.empty();
}

std::string Simulation::missing_for_start() {
  std::vector<std::string> missing;
  for (const std::string& name : options_.wait_for_models) {
    if (world_->find_model(name) == nullptr) missing.push_back("model " + name);
  }
  const int models = static_cast<int>(vehicles_.size());
  if (models < options_.wait_for) {
    missing.push_back(std::to_string(options_.wait_for - models) + " more vehicle(s)");
  }
  if (options_.wait_for > 0) {
    for (const auto& [name, vehicle] : vehicles_) {
      if (!vehicle->has_controller()) missing.push_back("the controller of " + vehicle->name());
    }
  }
  const std::lock_guard lock(hub_.mutex);
  const int sources = static_cast<int>(hub_.sources.all().size());
  if (sources < options_.wait_for_sources) {
    missing.push_back(std::to_string(options_.wait_for_sources - sources) +
                      " more set-point source(s)");
  }
  return join(missing);
}

bool Simulation::start_allowed() {
  if (started_ || (options_.wait_for == 0 && options_.wait_for_sources == 0)) return true;
  if (!missing_for_start().empty()) {
    ready_for_start_since_ = {};
    return false;
  }
  if (ready_for_start_since_ == Clock::time_point{}) ready_for_start_since_ = Clock::now();
  const bool all_confirm =
      std::all_of(vehicles_.begin(), vehicles_.end(),
                  [](const auto& entry) { return entry.second->confirms_setpoints(); });
  if (!all_confirm && Clock::now() - ready_for_start_since_ < kConfirmationGrace) return false;
  binder_->scan_subscribers();
  const std::lock_guard lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) vehicle->lockstep.enrol();
  ROS_INFO("%zu vehicles, their controllers and %zu set-point sources are there: time runs",
           vehicles_.size(), hub_.sources.all().size());
  return true;
}

bool Simulation::pace_allows() {
  if (real_time_factor_ <= 0.0) return true;
  const auto now = Clock::now();
  const double ahead = (world_->time() + world_->dt() - pace_sim_).seconds() / real_time_factor_ -
                       duration<double>(now - pace_wall_).count();
  if (ahead < -0.25) {  // not to be caught up with in a burst
    pace_wall_ = now;
    pace_sim_ = world_->time();
    return true;
  }
  if (ahead <= 0.0) return true;
  wait(microseconds(static_cast<int>(std::min(ahead, 0.005) * 1e6)));
  return false;
}

void Simulation::wait(microseconds time) {
  mutex_.unlock();
  std::this_thread::sleep_for(std::max(time, microseconds(1)));
  mutex_.lock();
}

bool Simulation::lockstep_allows() {
  const SimTime dt = world_->dt();
  std::unique_lock lock(hub_.mutex);
  hub_.required_stamp =
      options_.timing == LoopTiming::kRotors ? world_->time() - dt : world_->time();
  hub_.next_time = world_->time() + dt;
  if (!hub_.ready()) {
    const bool for_source = hub_.sources.blocking(hub_.next_time) != nullptr;
    lock.unlock();
    if (for_source) topics_->publish_clock(world_->time());
    lock.lock();
    if (!hub_.ready()) {
      mutex_.unlock();
      hub_.stepper_waits = true;
      hub_.changed.wait_for(lock, milliseconds(2));
      hub_.stepper_waits = false;
      const bool ready = hub_.ready();
      lock.unlock();
      mutex_.lock();
      if (!ready) check_losses();
      return false;  // the world may have changed meanwhile: look again
    }
  }
  for (VehicleLink* vehicle : hub_.vehicles) vehicle->deliver();
  return true;
}

void Simulation::check_losses() {
  const WallTime now = wall_now();
  const std::unique_lock lock(hub_.mutex);
  for (VehicleLink* vehicle : hub_.vehicles) check_vehicle(*vehicle, now);
  check_source(world_->time() + world_->dt(), now);
}

void Simulation::check_vehicle(VehicleLink& vehicle, WallTime now) {
  const WallTime waited = vehicle.lockstep.waiting_for(now);
  const bool disconnected = waited > 20'000'000 &&
                            vehicle.odometry_readers() < vehicle.readers_when_sent;
  if (!disconnected && static_cast<double>(waited) * 1e-9 < options_.lockstep_timeout_s) return;
  lose("the controller of " + vehicle.name(),
       disconnected ? "has disconnected" : "has not answered for " + seconds_text(waited));
  if (options_.loss_policy != LossPolicy::kWait) vehicle.release();
}

void Simulation::check_source(SimTime time, WallTime now) {
  const std::string* blocking = hub_.sources.blocking(time);
  for (auto& [node, source] : hub_.sources.all()) {
    if (blocking == nullptr || node != *blocking) source.since = 0;
  }
  if (blocking == nullptr) return;
  const std::string node = *blocking;
  auto& source = hub_.sources.all().at(node);
  if (source.since == 0) source.since = now;
  const WallTime waited = now - source.since;
  // A source may be a script that starts slowly; ten times a controller's patience.
  if (static_cast<double>(waited) * 1e-9 < 10.0 * options_.lockstep_timeout_s) return;
  source.since = now;
  lose("set-point source " + node,
       "has sent nothing for " + seconds_text(waited) + " for " +
           join(hub_.sources.missing(node, time)) + " at t = " + std::to_string(time.seconds()) +
           " s");
  if (options_.loss_policy != LossPolicy::kWait) hub_.sources.release(node);
}

void Simulation::lose(const std::string& who, const std::string& why) {
  const char* what = options_.loss_policy == LossPolicy::kWait    ? "the world waits"
                     : options_.loss_policy == LossPolicy::kPause ? "the world is paused"
                                                                  : "the world goes on without it";
  if (options_.loss_policy == LossPolicy::kPause) paused_ = true;
  report(Severity::kWarning, who + " " + why + "; " + what);
}

void Simulation::make_step() {
  world_->step();
  const SimTime stamp = world_->time();
  publish_step(false);
  const WallTime now = wall_now();
  for (VehicleLink* vehicle : hub_.vehicles) vehicle->send_state(stamp, now);
  files_->record(*world_);
}

void Simulation::publish_step(bool settled) {
  const bool slow = real_time_factor_ > 0.0;
  topics_->publish(*world_, settled || (slow && real_time_factor_ <= 2.0));
  binder_->publish_fresh();
}

void Simulation::every_so_often() {
  const auto now = Clock::now();
  next_scan_ = now + kScanPeriod;
  binder_->scan_subscribers();
  topics_->scan(*world_);
  tell_news();
  if (now < next_second_) return;
  next_second_ = now + std::chrono::seconds(1);
  publish_diagnostics();
  SimTime end;
  {
    const std::lock_guard lock(hub_.mutex);
    end = hub_.sources.end();
  }
  if (options_.end_time_s > 0.0) end = SimTime::from_seconds(options_.end_time_s);
  files_->progress(*world_, end, vehicles_.size(), describe_state());
}

std::string Simulation::describe_state() {
  if (!started_) {
    const std::string missing = missing_for_start();
    if (!missing.empty() && (options_.wait_for > 0 || options_.wait_for_sources > 0)) {
      return "waiting for " + missing;
    }
  }
  return paused_ ? "paused" : "running";
}

void Simulation::tell_news() {
  std::vector<std::string> news;
  {
    const std::lock_guard lock(hub_.mutex);
    news.swap(hub_.news);
  }
  for (const std::string& line : news) ROS_INFO("%s", line.c_str());
}

void Simulation::publish_diagnostics() {
  if (diagnostics_.getNumSubscribers() == 0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = to_ros(world_->time());
  diagnostic_msgs::DiagnosticStatus status;
  status.name = "gazebo: simulation";
  status.message = describe_state();
  array.status.push_back(status);
  {
    const std::lock_guard lock(hub_.mutex);
    for (const VehicleLink* vehicle : hub_.vehicles) {
      status.name = "gazebo: controller of " + vehicle->name();
      status.message = vehicle->lockstep.enrolled() ? "in lockstep" : "free-running or absent";
      array.status.push_back(status);
    }
  }
  for (std::size_t i = 0; i < complaints_.size(); ++i) {
    status.level = complaints_[i].first == Severity::kError
                       ? diagnostic_msgs::DiagnosticStatus::ERROR
                       : diagnostic_msgs::DiagnosticStatus::WARN;
    status.name = "gazebo: message " + std::to_string(i);
    status.message = complaints_[i].second;
    array.status.push_back(status);
  }
  diagnostics_.publish(array);
}

void Simulation::reset(bool with_time) {
  if (with_time) {
    world_->reset();
  } else {
    world_->reset_models();
  }
  {
    const std::lock_guard lock(hub_.mutex);
    for (VehicleLink* vehicle : hub_.vehicles) vehicle->clear();
    if (with_time) hub_.sources.clear();
  }
  pace_wall_ = Clock::now();
  pace_sim_ = world_->time();
  if (with_time) {
    first_step_ = Clock::now();
    first_step_time_ = world_->time();
    files_->restart();
  }
  topics_->restart();
  topics_->publish_clock(world_->time());
}

double Simulation::max_update_rate_hz() const {
  return real_time_factor_ / world_->physics().max_step_size_s;
}

void Simulation::set_max_update_rate_hz(double rate) {
  real_time_factor_ = rate * world_->physics().max_step_size_s;
  pace_wall_ = Clock::now();
  pace_sim_ = world_->time();
}

SimTime Simulation::step(std::uint64_t n) {
  ++waiting_;
  std::unique_lock lock(mutex_);
  --waiting_;
  if (ended_) throw Error("the run has ended");
  if (steps_wanted_ > 0) throw Error("another /gazebo/step call is in progress");
  steps_wanted_ = n;
  stepped_.wait(lock, [this] { return steps_wanted_ == 0 || ended_; });
  if (steps_wanted_ > 0) throw Error("the run ended before the steps were made");
  return world_->time();
}

SimTime Simulation::enrol_source(const std::string& node, const std::vector<std::string>& vehicles,
                                 SimTime period, SimTime end) {
  const std::lock_guard lock(hub_.mutex);
  std::vector<std::string> unknown;
  const SimTime start = hub_.sources.enrol(node, vehicles, period, end, world_->time());
  topics_->set_state_period(period);
  hub_.news.push_back("set-point source " + node + " enrolled for " + join(vehicles));
  return start;
}

void Simulation::release_source(const std::string& node) {
  const std::lock_guard lock(hub_.mutex);
  hub_.sources.release(node);
}

}  // namespace trident
