// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle_link.h"

#include <geometry_msgs/PoseStamped.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <algorithm>
#include <cstring>

#include "conversions/conversions.h"
#include "trident_base/string_util.h"
#include "trident_ros/schedule_fuzz.h"
#include "trident_ros/subscriptions.h"
#include "trident_ros/topic_peers.h"

namespace trident::sim {
namespace {

/// A controller that has come back is asked this often until it answers: it reads the odometry
/// before this process reads its commands, and what it publishes in between is lost [ns].
constexpr WallTime kAskAgainPeriod = 100'000'000;

/// False for a torn message, which has nothing to say; its type roscpp has checked.
template <class Message>
bool read(const std::uint8_t* bytes, std::size_t size, Message& message) {
  try {
    ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes),
                                       static_cast<std::uint32_t>(size));
    ros::serialization::deserialize(stream, message);
  } catch (const ros::serialization::StreamOverrunException&) {
    return false;
  }
  return true;
}

/// Stamp of a serialised message that begins with a header; zero when it is too short.
SimTime header_stamp(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t fields[3] = {0, 0, 0};  // seq, sec, nsec
  if (size < sizeof(fields)) return {};
  // ROS serializes numbers with their lowest byte first.
  std::memcpy(fields, bytes, sizeof(fields));
  return {static_cast<std::int64_t>(fields[1]) * 1'000'000'000 + fields[2]};
}

}  // namespace

bool LockstepHub::ready() const {
  for (const VehicleLink* vehicle : vehicles) {
    vehicle->assert_hub_is_locked();
    if (!vehicle->lockstep.answered_up_to(required_stamp)) return false;
  }
  return sources.blocking(next_time) == nullptr;
}

void LockstepHub::take_heard() {
  for (const HeardSetpoint& one : heard.take()) {
    one.vehicle->assert_hub_is_locked();
    one.vehicle->on_setpoint(one);
  }
}

void HeardSetpoints::add(const HeardSetpoint& heard) {
  const Lock lock(mutex_);
  waiting_.push_back(heard);
}

std::vector<HeardSetpoint> HeardSetpoints::take() {
  std::vector<HeardSetpoint> taken;
  const Lock lock(mutex_);
  taken.swap(waiting_);
  return taken;
}

void HeardSetpoints::forget(const VehicleLink* vehicle) {
  const Lock lock(mutex_);
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [&](const HeardSetpoint& one) { return one.vehicle == vehicle; }),
                 waiting_.end());
}

VehicleLink::VehicleLink(ros::NodeHandle& node, LockstepHub& hub, InPort<ActuatorCommand>& port,
                         std::vector<OutputBinding*> odometry,
                         ros_utils::InlineCallbackQueue& queue)
    : node_(node), hub_(hub), queue_(queue), port_(&port), odometry_(std::move(odometry)) {
  const std::string tail = "command/motor_speed";
  prefix_ = port.name().substr(0, port.name().size() - tail.size());
  name_ = prefix_.empty() ? "vehicle" : prefix_.substr(0, prefix_.size() - 1);
  for (OutputBinding* binding : odometry_) {
    direct_.push_back(std::make_unique<ros_utils::DirectPublication>(binding->publisher()));
  }
  commands_ = hub.commands.subscribe<mav_msgs::Actuators>(
      node, "/" + port.name(), 10,
      [this](Span<const std::uint8_t> bytes) TRIDENT_REQUIRES(hub_.mutex) { on_command(bytes); },
      [this](const mav_msgs::Actuators& message)
          TRIDENT_REQUIRES(hub_.mutex) { on_command(message); });
  auto accepted = ros_utils::raw_subscription<std_msgs::Header>(
      "/" + confirmation_topic(), 100,
      [this](const auto& bytes) { on_confirmation(bytes.data(), bytes.size()); }, &queue);
  accepted_ = node.subscribe(accepted);
}

void VehicleLink::watch_setpoints() {
  if (poses_ || confirms_setpoints()) return;
  const auto handler = [this](const auto& bytes) {
    hear_setpoint(header_stamp(bytes.data(), bytes.size()), false, false);
  };
  auto poses = ros_utils::raw_subscription<geometry_msgs::PoseStamped>(
      "/" + prefix_ + "command/pose", 100, handler, &queue_);
  poses_ = node_.subscribe(poses);
  auto trajectories = ros_utils::raw_subscription<trajectory_msgs::MultiDOFJointTrajectory>(
      "/" + prefix_ + "command/trajectory", 100, handler, &queue_);
  trajectories_ = node_.subscribe(trajectories);
}

void VehicleLink::on_confirmation(const std::uint8_t* bytes, std::size_t size) {
  std_msgs::Header header;
  if (!read(bytes, size, header)) return;
  // Sources guard their trajectories and send them again; a pose from elsewhere they do not see.
  const std::string& topic = header.frame_id;
  const auto ends_with_any = [&](const auto&... tails) { return (ends_with(topic, tails) || ...); };
  const bool replaces = ends_with_any("command/trajectory", "command/attitude_thrust",
                                      "command/rate_thrust", "command/stop");
  hear_setpoint(from_ros(header.stamp), true, replaces);
}

void VehicleLink::hear_setpoint(SimTime stamp, bool is_confirmation, bool replaces) {
  ros_utils::hand_over("confirmation received");
  // A confirmation says that the controller has it; without one, that it was sent must do.
  if (!is_confirmation && confirms_setpoints()) return;
  hub_.heard.add({this, stamp, is_confirmation, replaces, hub_.repeatability.running()});
  if (hub_.waits_for_source) hub_.commands.wake();
}

void VehicleLink::on_setpoint(const HeardSetpoint& heard) {
  if (!heard.is_confirmation && is_confirming_open_) {
    newest_sent_ = std::max(newest_sent_, heard.stamp);
    return;
  }
  note_outsider(heard);
  if (heard.stamp.ns == 0) return;
  const bool is_replaced = hub_.sources.on_setpoint(name_, heard.stamp, heard.replaces);
  if (is_replaced && heard.was_running) {
    hub_.repeatability.spoil("a publisher of commands to " + name_, hub_.next_time,
                             "has replaced set-points of its source");
  }
}

void VehicleLink::close_confirming() {
  is_confirming_open_ = false;
  if (!confirms_setpoints() && newest_sent_.ns > 0) hub_.sources.on_setpoint(name_, newest_sent_);
  newest_sent_ = {-1};
}

/// A set-point from outside of the lockstep that comes before it counts is as repeatable as one
/// from inside; one that counts at once is not.
void VehicleLink::note_outsider(const HeardSetpoint& heard) {
  if (!heard.was_running || heard.stamp >= hub_.next_time) return;
  if (heard.stamp.ns > 0 && hub_.sources.feeds(name_)) return;
  hub_.repeatability.spoil("a publisher of commands to " + name_, hub_.next_time,
                           "gives set-points outside of the lockstep");
}

VehicleLink::~VehicleLink() {
  // Ends the callbacks, which hold this, before the members go.
  commands_.reset();
  accepted_.shutdown();
  poses_.shutdown();
  trajectories_.shutdown();
  hub_.heard.forget(this);
}

// The stepping thread holds the hub's mutex as it reads.
void VehicleLink::on_command(Span<const std::uint8_t> bytes) {
  if (read(bytes.data(), bytes.size(), message_)) on_command(message_);
}

void VehicleLink::on_command(const mav_msgs::Actuators& message) {
  ActuatorCommand command;
  command.stamp = from_ros(message.header.stamp);
  const auto& speeds = message.angular_velocities;
  command.angular_velocities.size = std::min(speeds.size(), SmallVector::kCapacity);
  std::copy_n(speeds.begin(), command.angular_velocities.size,
              command.angular_velocities.data.begin());
  const auto answer = lockstep.on_answer(command.stamp, wall_now());
  // Of a vehicle in lockstep only answers to its states count.
  if (answer == LockstepVehicle::Answer::kForeign && lockstep.enrolled()) return;
  if (answer == LockstepVehicle::Answer::kForeign && hub_.repeatability.running()) {
    hub_.repeatability.spoil(join(command_writers()), hub_.next_time,
                             "writes /" + port_->name() + " outside of the lockstep");
  }
  if (answer == LockstepVehicle::Answer::kEnrolled) {
    note_enrollment(command.stamp);
    hub_.events.push_back(name_ + ": controller enrolled at state " +
                          std::to_string(command.stamp.seconds()) + " s; the world waits for it");
  }
  if (answer == LockstepVehicle::Answer::kExpected) answered_reader_ = newest_reader_;
  waiting.end();
  // Commands reach the world between steps, in deliver().
  inbox_.push_back(command);
  send_next();
}

void VehicleLink::note_enrollment(SimTime stamp) {
  const bool has_run_without = lockstep.first_sent() < hub_.required_stamp;
  if (!has_run_without || !hub_.repeatability.running()) return;
  hub_.repeatability.spoil("the controller of " + name_, stamp, "enrolled while time ran");
}

void VehicleLink::send_next() {
  if (lockstep.next_to_send(wall_now()).ns < 0 || outbox_.empty()) return;
  send(outbox_.front());
  in_flight_ = std::move(outbox_.front());
  outbox_.pop_front();
}

void VehicleLink::send(State& state) {
  for (const auto& [index, message] : state.messages) {
    newest_reader_ = std::max(newest_reader_, direct_[index]->send(*message));
  }
}

void VehicleLink::deliver() {
  for (const ActuatorCommand& command : inbox_) port_->write(command);
  inbox_.clear();
}

void VehicleLink::send_state(SimTime stamp, WallTime now) {
  State state{stamp, {}};
  for (std::size_t i = 0; i < odometry_.size(); ++i) {
    if (!odometry_[i]->wanted() || !odometry_[i]->take_fresh()) continue;
    state.messages.emplace_back(i, odometry_[i]->message());
  }
  if (state.messages.empty()) return;
  learn_controllers();
  // At least one, so that a reader that has just died is missed.
  readers_when_sent_ = std::max(1U, odometry_readers());
  if (!lockstep.on_state(stamp, now)) {
    outbox_.push_back(std::move(state));
    return;
  }
  send(state);
  in_flight_ = std::move(state);
  // Those that time zero was held for are connected in both directions.
  if (answered_reader_ == 0) answered_reader_ = newest_reader_;
}

bool VehicleLink::send_again_to_new_readers(WallTime now) {
  const int sent_to = newest_reader_;
  bool is_controller_back = false;
  for (const ros_utils::TopicPeer& reader : all_odometry_readers()) {
    if (reader.connection <= sent_to) continue;
    newest_reader_ = std::max(newest_reader_, reader.connection);
    is_controller_back = is_controller_back || controllers_.count(reader.node) > 0;
  }
  if (newest_reader_ > sent_to) {
    send_in_flight(sent_to, now);
    readers_when_sent_ = odometry_readers();
  } else if (now - asked_at_ > kAskAgainPeriod && has_unproven_controller()) {
    send_in_flight(answered_reader_, now);
  }
  return is_controller_back;
}

/// Whether a node that writes commands reads the odometry by a connection over which it has not
/// answered yet.
bool VehicleLink::has_unproven_controller() const {
  const std::vector<std::string> writers = command_writers();
  const auto readers = all_odometry_readers();
  return std::any_of(readers.begin(), readers.end(), [&](const ros_utils::TopicPeer& reader) {
    return reader.connection > answered_reader_ &&
           std::find(writers.begin(), writers.end(), reader.node) != writers.end();
  });
}

void VehicleLink::send_in_flight(int after, WallTime now) {
  for (const auto& [index, message] : in_flight_.messages) direct_[index]->send(*message, after);
  asked_at_ = now;
}

std::vector<ros_utils::TopicPeer> VehicleLink::all_odometry_readers() const {
  std::vector<ros_utils::TopicPeer> readers;
  for (const OutputBinding* binding : odometry_) {
    const auto found = ros_utils::topic_readers(binding->publisher().getTopic());
    readers.insert(readers.end(), found.begin(), found.end());
  }
  return readers;
}

void VehicleLink::learn_controllers() {
  const std::uint64_t newest = hub_.commands.newest_link();
  if (newest == newest_link_) return;
  newest_link_ = newest;
  // Writers can have changed only when the inbox has a new connection.
  for (const std::string& node : command_writers()) controllers_.insert(node);
}

bool VehicleLink::has_lost_controller() const {
  // In a nodelet manager all are one process.
  if (controllers_.empty()) return odometry_readers() < readers_when_sent_;
  for (const ros_utils::TopicPeer& reader : all_odometry_readers()) {
    if (controllers_.count(reader.node) > 0) return false;
  }
  return true;
}

void VehicleLink::announce_reset() {
  State state{{}, {}};
  for (std::size_t i = 0; i < odometry_.size(); ++i) {
    auto* port = dynamic_cast<OutPort<OdometrySample>*>(&odometry_[i]->port());
    if (port == nullptr || direct_[i]->subscribers() == 0) continue;
    port->value.stamp = {};
    port->value.v_child.setZero();
    port->value.w_child.setZero();
    state.messages.emplace_back(i, odometry_[i]->message());
  }
  send(state);
}

bool VehicleLink::is_connected() const {
  return odometry_readers() > 0 && !command_writers().empty();
}

bool VehicleLink::has_controller() const {
  if (!is_connected()) return false;
  const auto all_send = [&](const std::vector<std::string>& nodes, const std::string& topic) {
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](const std::string& node) { return hub_.probe.sends(node, topic); });
  };
  const std::string confirmations = "/" + confirmation_topic();
  return all_send(command_writers(), "/" + port_->name()) &&
         all_send(ros_utils::topic_writers(confirmations), confirmations);
}

std::vector<std::string> VehicleLink::command_writers() const {
  return ros_utils::topic_writers("/" + port_->name());
}

bool VehicleLink::hears_confirmations() const {
  return !ros_utils::topic_writers("/" + confirmation_topic()).empty();
}

std::uint32_t VehicleLink::odometry_readers() const {
  std::uint32_t count = 0;
  for (const auto& publication : direct_) count += publication->subscribers();
  return count;
}

void VehicleLink::clear() {
  lockstep.clear();
  outbox_.clear();
  inbox_.clear();
}

void VehicleLink::release() {
  lockstep.release();
  outbox_.clear();
}

}  // namespace trident::sim
