// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lockstep_gate.h"

namespace trident::sim {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// How long a wait lasts before losses are looked for.
constexpr auto kTimeoutCheckPeriod = milliseconds(2);

}  // namespace

LockstepGate::LockstepGate(ros::NodeHandle& node, const ServerOptions& options, LossWatch& losses,
                           NodeProbe& probe)
    : options_(options),
      losses_(losses),
      probe_(probe),
      vehicles_(node, options, losses.repeatability(), probe),
      hub_(vehicles_.hub()),
      start_(options, vehicles_, losses.repeatability()),
      timeouts_(hub_, losses, probe),
      cores_(hub_) {}

void LockstepGate::sync(World& world, PortBinder& binder) {
  vehicles_.sync(world, binder, start_.is_held());
}

void LockstepGate::check_losses_at_start() {
  if (!start_.is_released()) timeouts_.check_at_start();
}

bool LockstepGate::allows_step(const World& world, FairMutex& world_mutex,
                               const std::function<void()>& about_to_wait) {
  bool waits_for_source = false;
  {
    const Lock lock(hub_.mutex);
    hub_.take_heard();
    // With RotorS' timing a command acts a step later,
    // so that the newest state need not be answered yet.
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
    // Services may change the world meanwhile.
    const Unlock world_is_free(world_mutex);
    ready = wait_until_ready();
  }
  has_just_read_ = true;
  if (!ready) timeouts_.check(world);
  return false;  // the world may have changed meanwhile
}

bool LockstepGate::wait_until_ready() {
  const auto limit = Clock::now() + kTimeoutCheckPeriod;
  const Lock lock(hub_.mutex);
  bool is_over = false;
  while (!hub_.ready() && !is_over) {
    const bool waits_for_source = hub_.sources.blocking(hub_.next_time) != nullptr;
    if (waits_for_source != hub_.waits_for_source.exchange(waits_for_source)) {
      hub_.take_heard();  // what came before has woken nobody
      continue;
    }
    {
      const Unlock hub_is_free(hub_.mutex);
      is_over = !hub_.commands.wait(kTimeoutCheckPeriod) || Clock::now() > limit;
    }
    hub_.commands.read();
    hub_.take_heard();
  }
  hub_.waits_for_source = false;
  return hub_.ready();
}

void LockstepGate::read_commands(milliseconds limit) {
  if (hub_.commands.wait(limit)) hub_.commands.read();
}

void LockstepGate::poll_while_paused() {
  const Lock lock(hub_.mutex);
  hub_.take_heard();
  read_commands(milliseconds(0));
}

void LockstepGate::send_states(SimTime stamp) {
  const Lock lock(hub_.mutex);
  const WallTime now = wall_now();
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    vehicle->send_state(stamp, now);
  }
}

void LockstepGate::pin_controllers() {
  if (options_.pin_controllers) cores_.pin(vehicles_.size());
}

void LockstepGate::clear(bool with_time) {
  const Lock lock(hub_.mutex);
  hub_.take_heard();
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    vehicle->clear();
    if (with_time) vehicle->announce_reset();
  }
  if (with_time) hub_.sources.clear();
  timeouts_.clear();
}

SimTime LockstepGate::enroll_source(const std::string& node,
                                    const std::vector<std::string>& vehicles, SimTime period,
                                    SimTime end, bool waits_beyond_end, SimTime now) {
  vehicles_.watch_setpoints(vehicles);
  const Lock lock(hub_.mutex);
  hub_.take_heard();
  const bool is_new = hub_.sources.all().count(node) == 0;
  probe_.look(node);  // so that its end will be one
  if (is_new && losses_.repeatability().running()) {
    // When it enrolls decides from which step on it is waited for.
    losses_.repeatability().spoil("set-point source " + node, now, "enrolled while time ran");
  }
  const SimTime start = hub_.sources.enroll(node, vehicles, period, end, now, waits_beyond_end);
  if (is_new) {
    hub_.events.push_back("set-point source " + node + " enrolled for " + join(vehicles) +
                          " from t = " + seconds_text(start.seconds()));
  }
  return start;
}

void LockstepGate::release_source(const std::string& node) {
  const Lock lock(hub_.mutex);
  hub_.take_heard();
  hub_.sources.release(node);
}

SimTime LockstepGate::sources_end() {
  const Lock lock(hub_.mutex);
  return hub_.sources.end();
}

std::vector<std::string> LockstepGate::drain_events() {
  const Lock lock(hub_.mutex);
  std::vector<std::string> events;
  events.swap(hub_.events);
  return events;
}

}  // namespace trident::sim
