// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "controller_cores.h"
#include "loss_watch.h"
#include "node_probe.h"
#include "run/server_options.h"
#include "start_gate.h"
#include "timeout_check.h"
#include "topics/port_binder.h"
#include "trident_base/mutex.h"
#include "trident_sim/world.h"
#include "vehicle_link.h"
#include "vehicle_table.h"

namespace trident::sim {

/// Decides when the world may make its next step: when everything that was declared is there, when
/// each enrolled controller has answered the states that the step needs, and when each set-point
/// source has sent what the step requires. Called by the stepping thread and by services, with the
/// world's mutex held. Its parts: the vehicles and their links, the hold of time zero, the check of
/// those that do not answer, and the cores of controllers.
class LockstepGate {
 public:
  LockstepGate(ros::NodeHandle& node, const ServerOptions& options, LossWatch& losses,
               NodeProbe& probe);

  /// Follows the vehicles that came or went.
  void sync(World& world, PortBinder& binder);

  /// Everything that time zero is held for is there.
  bool start_allowed(const World& world, PortBinder& binder) {
    return start_.allows_start(world, binder);
  }
  /// What it is held for, in words; "" when nothing is missing.
  std::string missing_for_start(const World& world) { return start_.missing(world); }
  /// One that was there while time zero is held, and has died, will not come by waiting.
  void check_losses_at_start();

  /// True: the step may be made, and the commands for it are in the ports. False: something was
  /// waited for, up to milliseconds, with `world_mutex` released; look again. `about_to_wait` is
  /// called before the wait for a set-point source, which lives by /clock.
  bool allows_step(const World& world, FairMutex& world_mutex,
                   const std::function<void()>& about_to_wait) TRIDENT_REQUIRES(world_mutex);
  /// Takes the commands that come while no step is to be made.
  void poll_while_paused();
  /// Sends, or lines up, the odometry of the step that was just made.
  void send_states(SimTime stamp);

  /// Keeps controllers that have come on one core each, where there is not a core for each of them
  /// and the option does not forbid it.
  void pin_controllers();

  /// The states in flight are void; after a reset of time the set-points too.
  void clear(bool with_time);

  SimTime enroll_source(const std::string& node, const std::vector<std::string>& vehicles,
                        SimTime period, SimTime end, bool waits_beyond_end, SimTime now);
  void release_source(const std::string& node);
  /// End of the last source; 0 while one has none.
  SimTime sources_end();

  std::size_t vehicle_count() const { return vehicles_.size(); }
  /// Name of each vehicle and whether its controller is in lockstep.
  std::vector<std::pair<std::string, bool>> vehicle_states() { return vehicles_.states(); }
  /// What happened since the last call, a line each.
  std::vector<std::string> drain_events();

 private:
  bool wait_until_ready() TRIDENT_EXCLUDES(hub_.mutex);
  void read_commands(std::chrono::milliseconds limit) TRIDENT_REQUIRES(hub_.mutex);

  const ServerOptions& options_;
  LossWatch& losses_;
  NodeProbe& probe_;
  VehicleTable vehicles_;
  LockstepHub& hub_;  ///< That of `vehicles_`.
  StartGate start_;
  TimeoutCheck timeouts_;
  ControllerCores cores_;
  bool has_just_read_ = false;
};

}  // namespace trident::sim
