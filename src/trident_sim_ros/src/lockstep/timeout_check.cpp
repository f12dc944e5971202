// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "timeout_check.h"

namespace trident::sim {
namespace {

/// A set-point source may be a script that starts slowly: it gets this many times a controller's
/// patience.
constexpr double kSourcePatience = 10.0;
/// A source that sees another node's trajectory sends its own again; if it has not by then, it will
/// not.
constexpr WallTime kReplacementPatience = 1'000'000'000;  // [ns]

}  // namespace

void TimeoutCheck::check_at_start() {
  const WallTime now = wall_now();
  const Lock lock(hub_.mutex);
  check_controllers_at_start(now);
  check_sources_at_start(now);
}

void TimeoutCheck::check_controllers_at_start(WallTime now) {
  for (VehicleLink* vehicle : hub_.vehicles) {
    vehicle->assert_hub_is_locked();
    vehicle->had_controller = vehicle->had_controller || vehicle->has_controller();
    // A link that was found after the others, and is not known from both ends yet, is no loss.
    if (!vehicle->had_controller || vehicle->is_connected()) {
      vehicle->waiting.end();
      continue;
    }
    if (vehicle->waiting.since == 0) vehicle->waiting.since = now;
    losses_.gives_up({"the controller of " + vehicle->name(), "", true, 1.0, {}}, vehicle->waiting,
                     now);
  }
}

void TimeoutCheck::check_sources_at_start(WallTime now) {
  for (auto& [node, source] : hub_.sources.all()) {
    Waiting& waiting = sources_[node];
    const bool is_gone = probe_.look(node) == NodeProbe::State::kGone;
    if (!is_gone) waiting.end();
    if (!is_gone) continue;
    if (waiting.since == 0) waiting.since = now;
    losses_.gives_up({"set-point source " + node, "", true, 1.0, {}}, waiting, now);
  }
}

void TimeoutCheck::check(const World& world) {
  const WallTime now = wall_now();
  const Lock lock(hub_.mutex);
  losses_.clear();
  for (VehicleLink* vehicle : hub_.vehicles) check_vehicle(*vehicle, now);
  check_source(world.time() + world.dt(), now);
}

void TimeoutCheck::check_vehicle(VehicleLink& vehicle, WallTime now) {
  vehicle.assert_hub_is_locked();
  const WallTime waited = vehicle.lockstep.waiting_for(now);
  if (waited == 0) return;
  const SimTime time = hub_.next_time;
  const std::string who = "the controller of " + vehicle.name();
  // A node that began to read its odometry after the state was sent has not received it.
  if (vehicle.send_again_to_new_readers(now)) {
    losses_.repeatability().spoil(who, time, "was started again");
  }
  vehicle.waiting.since = now - waited;
  const bool gives_up =
      losses_.gives_up({who, "has not answered", vehicle.has_lost_controller(), 1.0, time,
                        [&vehicle] { return vehicle.command_writers(); }},
                       vehicle.waiting, now);
  if (gives_up) vehicle.release();
}

void TimeoutCheck::check_source(SimTime time, WallTime now) {
  const std::string* blocking = hub_.sources.blocking(time);
  const std::string node = blocking == nullptr ? "" : *blocking;
  for (auto& [name, waiting] : sources_) {
    if (name != node) waiting.end();
  }
  if (blocking == nullptr) return;
  Waiting& waiting = sources_[node];
  if (waiting.since == 0) waiting.since = now;
  if (now - waiting.since > kReplacementPatience && hub_.sources.forget_replacements()) {
    losses_.repeatability().spoil(
        "another node than " + node, time,
        "has replaced set-points, and " + node + " has not sent its own again");
  }
  const bool is_gone = probe_.look(node) == NodeProbe::State::kGone;
  const std::string who = "set-point source " + node;
  const auto own_name = [&node] { return std::vector<std::string>{node}; };
  const std::string what = "has sent nothing for " + join(hub_.sources.missing(node, time)) +
                           " at t = " + seconds_text(time.seconds());
  if (losses_.gives_up({who, what, is_gone, kSourcePatience, time, own_name}, waiting, now)) {
    hub_.sources.release(node);
  }
}

}  // namespace trident::sim
