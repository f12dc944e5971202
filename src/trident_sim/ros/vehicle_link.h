// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mav_msgs/Actuators.h>
#include <ros/ros.h>

#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "loss_watch.h"
#include "node_probe.h"
#include "port_binder.h"
#include "repeatability.h"
#include "trident_ros/direct_inbox.h"
#include "trident_ros/direct_publication.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_sim/lockstep.h"
#include "trident_sim/samples.h"

namespace trident {

class VehicleLink;

/// What the stepping thread and roscpp's socket thread share. Everything below is under `mutex`,
/// which neither thread holds while it takes the world's.
struct LockstepHub {
  LockstepHub(DirectInbox::Sockets sockets, Repeatability& its_repeatability, NodeProbe& its_probe)
      : commands(sockets), repeatability(its_repeatability), probe(its_probe) {}

  std::mutex mutex;
  DirectInbox commands;  ///< of all vehicles; read by the stepping thread, under `mutex`
  Repeatability& repeatability;
  NodeProbe& probe;
  std::vector<VehicleLink*> vehicles;
  SetpointSources sources;
  bool stepper_waits = false;
  SimTime required_stamp{-1};     ///< of the states whose answers the next step needs
  SimTime next_time;              ///< to which the next step leads
  std::vector<std::string> news;  ///< one line per event, for the log

  bool ready() const;
  /// Wakes the stepping thread if what it waits for is there.
  void notify_if_ready() {
    if (stepper_waits && ready()) commands.wake();
  }
};

/// One vehicle that takes motor commands: its odometry goes out and its commands come in, in
/// lockstep when its controller answers stamps.
class VehicleLink {
 public:
  VehicleLink(ros::NodeHandle& node, LockstepHub& hub, InPort<ActuatorCommand>& port,
              std::vector<OutputBinding*> odometry, InlineCallbackQueue& queue);
  ~VehicleLink();

  const std::string& name() const { return name_; }
  InPort<ActuatorCommand>& port() const { return *port_; }

  // Stepping thread:
  /// Hands the commands that have come to the port. Under the hub's mutex.
  void deliver();
  /// Sends or queues the odometry of the step that was just made. Under the hub's mutex.
  void send_state(SimTime stamp, WallTime now);
  /// A node publishes commands and someone reads the odometry, and that node knows that its
  /// commands, and its confirmations if any, go to this process.
  bool has_controller() const;
  bool confirms_setpoints() const { return accepted_.getNumPublishers() > 0; }
  /// The same, and the connection is made.
  bool hears_confirmations() const;
  /// Reads the set-point topics themselves, for a controller that does not confirm. Only on
  /// request: many publishers send once, as soon as somebody listens, and mean the controller.
  void watch_setpoints();
  /// While time zero is held it is left open whether the controller will confirm set-points: what
  /// was only sent does not count before it is known that nobody will. Under the hub's mutex.
  void leave_confirming_open() { is_confirming_open_ = true; }
  void close_confirming();
  std::string confirmation_topic() const { return prefix_ + "command/accepted_setpoint"; }
  std::uint32_t odometry_readers() const;
  /// Who gave commands reads the odometry no more. Under the hub's mutex.
  bool has_lost_controller() const;
  /// Those that send its commands.
  std::vector<pid_t> controller_processes() const { return commands_->processes(); }
  void clear();
  /// Tells (under the hub's mutex) the readers of the odometry that time is back at zero: a state
  /// at rest, stamped zero.
  void announce_reset();
  /// Sends the state under way to those who have begun to read since. True: a controller that came
  /// back is among them. Under the hub's mutex.
  bool send_again_to_new_readers();
  /// Stops waiting for the controller; what was in line for it is dropped.
  void release();

  LockstepVehicle lockstep;     ///< under the hub's mutex
  Waiting waiting;              ///< for the controller; under the hub's mutex
  bool had_controller = false;  ///< while time zero was held; under the hub's mutex

 private:
  struct State {
    SimTime stamp;
    std::vector<std::pair<std::size_t, std::unique_ptr<DirectMessage>>> messages;
  };
  void on_command(Span<const std::uint8_t> bytes);
  void on_command(const mav_msgs::Actuators& message);
  void send_next();
  void send(State& state);
  void on_confirmation(const std::uint8_t* bytes, std::size_t size);
  void on_setpoint(SimTime stamp, bool is_confirmation, bool replaces);
  void note_outsider(SimTime stamp);
  void note_enrolment(SimTime stamp);
  void learn_controllers();

  std::string name_, prefix_;
  ros::NodeHandle& node_;
  LockstepHub& hub_;
  InlineCallbackQueue& queue_;
  InPort<ActuatorCommand>* port_;
  std::vector<OutputBinding*> odometry_;
  std::vector<std::unique_ptr<DirectPublication>> direct_;  ///< used under the hub's mutex
  State under_way_;                  ///< the last one sent, under the hub's mutex
  bool is_confirming_open_ = false;  ///< under the hub's mutex
  SimTime newest_sent_{-1};          ///< set-point that was sent meanwhile
  std::uint32_t readers_when_sent_ = 0;
  int newest_reader_ = 0;  ///< connection that the last state went to, under the hub's mutex
  std::set<std::string> controllers_;   ///< nodes that have given commands, under the hub's mutex
  std::uint64_t newest_link_ = 0;       ///< when these were found
  std::deque<State> outbox_;            ///< states in line, under the hub's mutex
  std::vector<ActuatorCommand> inbox_;  ///< under the hub's mutex
  mav_msgs::Actuators message_;         ///< reused, under the hub's mutex
  std::unique_ptr<DirectSubscription> commands_;
  ros::Subscriber accepted_, poses_, trajectories_;
};

}  // namespace trident
