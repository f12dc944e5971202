// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/fleet_vehicle.h"

#include <algorithm>
#include <utility>

#include "trident_bridges/vehicle/commands.h"

namespace trident::bridges {
namespace {

mavlink::MavlinkVehicleOptions options_of(const mavlink::VehicleLinks& links,
                                          const FleetParts& parts) {
  mavlink::MavlinkVehicleOptions options;
  options.kind = links.kind;
  options.flavour = links.autopilot;
  options.system_id = links.system_id;
  options.origin = parts.params.origin.place();
  options.utc_start = parts.utc_start;
  options.accept_mavlink1 = links.accept_mavlink1;
  return options;
}

/// As the shipped descriptions have it.
const char* imu_topic(mavlink::VehicleKind kind) {
  return kind == mavlink::VehicleKind::kBoat ? "imu/data" : "imu";
}

}  // namespace

FleetVehicle::FleetVehicle(const mavlink::VehicleLinks& links, const FleetParts& parts)
    : name_(links.vehicle),
      parts_(parts),
      key_(links.signing_key_file),
      vehicle_(options_of(links, parts), [this](const mavlink::Message& m) { send(m); }) {
  ros::NodeHandle node("/" + links.ros_namespace);
  const auto received = [this](const mavlink::Message& message, const std::string& from) {
    receive(message, from);
  };
  ports_ = std::make_unique<VehiclePorts>(
      links,
      VehiclePorts::Setup{parts.params.allow_remote, parts.gcs_remote_port, received,
                          [this](const std::string& kind, const std::string& text) {
                            parts_.refusals.note(name_ + ": " + kind, text);
                          }},
      key_, parts.loop.loop());
  router_number_ = parts.router.add_vehicle(links.vehicle, links.accept_mavlink1, key_, received);
  output_ = make_setpoint_output(node, links.kind, links.max_thrust_N);
  sensors_ = std::make_unique<VehicleSensors>(
      node, parts.loop,
      VehicleSensors::Setup{links.odometry, imu_topic(links.kind), parts.frames, parts.refusals,
                            [this](SimTime stamp) { on_moved(stamp); }});
}

mavlink::BothTimes FleetVehicle::both(SimTime now) const {
  return {now, SimTime::from_seconds(parts_.loop.loop().now_s())};
}

void FleetVehicle::send(const mavlink::Message& message) {
  ports_->send(message);
  parts_.router.send(router_number_, message);
}

void FleetVehicle::receive(const mavlink::Message& message, const std::string& from) {
  const bool is_taken = vehicle_.handle(message, both(times_.now));
  ports_->flush();
  if (!is_taken) return;
  if (was_commanded_ || !mavlink::changes_behavior(message)) return;
  was_commanded_ = true;
  parts_.commanded("MAVLink system " + std::to_string(message.source.system) + " at " + from +
                   " commands " + name_);
}

void FleetVehicle::update(SimTime now) {
  times_.now = std::max(times_.now, now);
  vehicle_.update(both(times_.now));
  ports_->flush();
}

/// A vehicle whose set-points have stamps gets one for the next multiple of the period as soon as
/// it has passed one; any other gets an answer to each odometry.
void FleetVehicle::on_moved(SimTime stamp) {
  if (stamp < times_.moved) times_.now = times_.given = {};  // time was set back
  times_.moved = stamp;
  times_.now = std::max(times_.now, stamp);
  const auto period_ns = SimTime::from_seconds(parts_.params.period_s).ns;
  const SimTime next{(stamp.ns / period_ns + 1) * period_ns};
  if (output_->is_stamped() && next <= times_.given) return;
  vehicle_.update(both(times_.now));
  vehicle_.set_readings(sensors_->readings());
  setpoint_ = vehicle_.step(stamp, sensors_->state());
  publish(next);
  ports_->flush();
}

void FleetVehicle::publish(SimTime stamp) {
  times_.given = stamp;
  output_->publish(setpoint_,
                   {sensors_->state(), stamp, sensors_->frame(), sensors_->T_world_frame()});
}

void FleetVehicle::begin_lockstep(SimTime start) {
  if (!output_->is_stamped()) return;
  is_lockstep_ = true;
  if (times_.given < start) publish(start);
}

/// A world that began before it was heard stands still until the next set-point is there: at rest.
void FleetVehicle::repeat() {
  if (!is_lockstep_ || times_.given <= times_.moved) return;
  constexpr int kPatience = 20;
  const bool was_missed = times_.moved.ns == 0 && ++silent_looks_ % kPatience == 0;
  publish(was_missed ? times_.given + SimTime::from_seconds(parts_.params.period_s) : times_.given);
}

}  // namespace trident::bridges
