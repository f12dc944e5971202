// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mav_msgs/Actuators.h>
#include <ros/ros.h>

#include <atomic>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "loss_watch.h"
#include "node_probe.h"
#include "run/repeatability.h"
#include "topics/port_binder.h"
#include "trident_base/mutex.h"
#include "trident_ros/direct_inbox.h"
#include "trident_ros/direct_publication.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/topic_peers.h"
#include "trident_sim/lockstep.h"
#include "trident_sim/samples.h"

namespace trident::sim {

class VehicleLink;

/// A set-point of a vehicle that roscpp's socket thread has heard of.
struct HeardSetpoint {
  VehicleLink* vehicle;
  SimTime stamp;
  bool is_confirmation;
  bool replaces;     ///< those of another node
  bool was_running;  ///< the repeatable part of the run, as it came
};

/// What roscpp's socket thread has heard, until the stepping thread takes it. The socket thread may
/// hold locks of roscpp that the stepping thread waits for with the hub's mutex held, as in a
/// nodelet manager where a nodelet subscribes: it never takes that mutex.
class HeardSetpoints {
 public:
  void add(const HeardSetpoint& heard) TRIDENT_EXCLUDES(mutex_);
  std::vector<HeardSetpoint> take() TRIDENT_EXCLUDES(mutex_);
  /// The vehicle goes.
  void forget(const VehicleLink* vehicle) TRIDENT_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::vector<HeardSetpoint> waiting_ TRIDENT_GUARDED_BY(mutex_);
};

/// What the stepping thread and services share, and what they get from roscpp's socket thread.
/// Nobody holds `mutex` while it takes the world's.
struct LockstepHub {
  LockstepHub(ros_utils::DirectInbox::Sockets sockets, Repeatability& its_repeatability,
              NodeProbe& its_probe)
      : commands(sockets), repeatability(its_repeatability), probe(its_probe) {}

  Mutex mutex;
  ros_utils::DirectInbox
      commands;  ///< of all vehicles; read by the stepping thread with `mutex` held
  Repeatability& repeatability;
  NodeProbe& probe;
  std::vector<VehicleLink*> vehicles TRIDENT_GUARDED_BY(mutex);
  SetpointSources sources TRIDENT_GUARDED_BY(mutex);
  HeardSetpoints heard;
  std::atomic<bool> waits_for_source{false};  ///< the stepping thread; it is woken by set-points
  SimTime required_stamp TRIDENT_GUARDED_BY(mutex){
      -1};                                      ///< of the states whose answers the next step needs
  SimTime next_time TRIDENT_GUARDED_BY(mutex);  ///< to which the next step leads
  std::vector<std::string> events TRIDENT_GUARDED_BY(mutex);  ///< one line per event, for the log

  bool ready() const TRIDENT_REQUIRES(mutex);
  /// Hands what was heard to the sources. Before whatever looks at them, or changes them.
  void take_heard() TRIDENT_REQUIRES(mutex);
};

/// One vehicle that takes motor commands: its odometry goes out and its commands come in, in
/// lockstep when its controller answers stamps.
class VehicleLink {
 public:
  VehicleLink(ros::NodeHandle& node, LockstepHub& hub, InPort<ActuatorCommand>& port,
              std::vector<OutputBinding*> odometry, ros_utils::InlineCallbackQueue& queue);
  ~VehicleLink();

  const std::string& name() const { return name_; }
  InPort<ActuatorCommand>& port() const { return *port_; }

  /// Called where the hub's mutex is held, which the analysis cannot identify with this one.
  void assert_hub_is_locked() const TRIDENT_ASSERT_HELD(hub_.mutex) {}

  // Stepping thread:
  /// Hands the commands that have come to the port.
  void deliver() TRIDENT_REQUIRES(hub_.mutex);
  /// Sends or queues the odometry of the step that was just made.
  void send_state(SimTime stamp, WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  /// A node publishes commands and someone reads the odometry, as far as this process knows.
  bool is_connected() const;
  /// The same, and that node knows that its commands, and its confirmations if any, go to this
  /// process.
  bool has_controller() const;
  bool confirms_setpoints() const { return accepted_.getNumPublishers() > 0; }
  /// The same, and the connection is made.
  bool hears_confirmations() const;
  /// Reads the set-point topics themselves, for a controller that does not confirm. Only on
  /// request: many publishers send once, as soon as somebody listens, and mean the controller.
  void watch_setpoints();
  /// While time zero is held it is left open whether the controller will confirm set-points: what
  /// was only sent does not count before it is known that nobody will.
  void leave_confirming_open() TRIDENT_REQUIRES(hub_.mutex) { is_confirming_open_ = true; }
  void close_confirming() TRIDENT_REQUIRES(hub_.mutex);
  /// A set-point that the socket thread has heard of.
  void on_setpoint(const HeardSetpoint& heard) TRIDENT_REQUIRES(hub_.mutex);
  std::string confirmation_topic() const { return prefix_ + "command/accepted_setpoint"; }
  std::uint32_t odometry_readers() const;
  /// Who gave commands reads the odometry no more.
  bool has_lost_controller() const TRIDENT_REQUIRES(hub_.mutex);
  /// The nodes that publish motor speeds to this vehicle.
  std::vector<std::string> command_writers() const;
  /// Their processes.
  std::vector<pid_t> controller_processes() const { return commands_->processes(); }
  void clear() TRIDENT_REQUIRES(hub_.mutex);
  /// Announces to readers of the odometry that time is back at zero: a state at rest, stamped zero.
  void announce_reset() TRIDENT_REQUIRES(hub_.mutex);
  /// Sends the state in flight to those who have begun to read since, and again and again to a
  /// controller that came back, until it answers. True: one that came back just now.
  bool send_again_to_new_readers(WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  /// Stops waiting for the controller; what was in line for it is dropped.
  void release() TRIDENT_REQUIRES(hub_.mutex);

  LockstepVehicle lockstep TRIDENT_GUARDED_BY(hub_.mutex);
  Waiting waiting TRIDENT_GUARDED_BY(hub_.mutex);              ///< for the controller
  bool had_controller TRIDENT_GUARDED_BY(hub_.mutex) = false;  ///< while time zero was held

 private:
  struct State {
    SimTime stamp;
    std::vector<std::pair<std::size_t, std::unique_ptr<ros_utils::DirectMessage>>> messages;
  };
  void on_command(Span<const std::uint8_t> bytes) TRIDENT_REQUIRES(hub_.mutex);
  void on_command(const mav_msgs::Actuators& message) TRIDENT_REQUIRES(hub_.mutex);
  void send_next() TRIDENT_REQUIRES(hub_.mutex);
  void send(State& state) TRIDENT_REQUIRES(hub_.mutex);
  void on_confirmation(const std::uint8_t* bytes, std::size_t size);
  void hear_setpoint(SimTime stamp, bool is_confirmation, bool replaces);
  void note_outsider(const HeardSetpoint& heard) TRIDENT_REQUIRES(hub_.mutex);
  void note_enrollment(SimTime stamp) TRIDENT_REQUIRES(hub_.mutex);
  void learn_controllers() TRIDENT_REQUIRES(hub_.mutex);
  void send_in_flight(int after, WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  bool has_unproven_controller() const TRIDENT_REQUIRES(hub_.mutex);
  std::vector<ros_utils::TopicPeer> all_odometry_readers() const;

  std::string name_, prefix_;
  ros::NodeHandle& node_;
  LockstepHub& hub_;
  ros_utils::InlineCallbackQueue& queue_;
  InPort<ActuatorCommand>* port_;
  std::vector<OutputBinding*> odometry_;
  std::vector<std::unique_ptr<ros_utils::DirectPublication>>
      direct_;                                      ///< one for each of `odometry_`
  State in_flight_ TRIDENT_GUARDED_BY(hub_.mutex);  ///< the last one sent
  bool is_confirming_open_ TRIDENT_GUARDED_BY(hub_.mutex) = false;
  SimTime newest_sent_ TRIDENT_GUARDED_BY(hub_.mutex){-1};  ///< set-point that was sent meanwhile
  std::uint32_t readers_when_sent_ TRIDENT_GUARDED_BY(hub_.mutex) = 0;
  int newest_reader_ TRIDENT_GUARDED_BY(hub_.mutex) =
      0;  ///< connection that the last state went to
  int answered_reader_ TRIDENT_GUARDED_BY(hub_.mutex) =
      0;  ///< newest_reader_ when an answer came last: newer ones have not proven to be heard
  WallTime asked_at_ TRIDENT_GUARDED_BY(hub_.mutex) = 0;  ///< when the state was sent again
  std::set<std::string> controllers_
      TRIDENT_GUARDED_BY(hub_.mutex);  ///< nodes that have given commands
  std::uint64_t newest_link_ TRIDENT_GUARDED_BY(hub_.mutex) = 0;  ///< when these were found
  std::deque<State> outbox_ TRIDENT_GUARDED_BY(hub_.mutex);       ///< states in line
  std::vector<ActuatorCommand> inbox_ TRIDENT_GUARDED_BY(hub_.mutex);
  mav_msgs::Actuators message_ TRIDENT_GUARDED_BY(hub_.mutex);  ///< reused
  std::unique_ptr<ros_utils::DirectSubscription> commands_;
  ros::Subscriber accepted_, poses_, trajectories_;
};

}  // namespace trident::sim
