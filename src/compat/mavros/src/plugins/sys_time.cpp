// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/TimesyncStatus.h>
#include <sensor_msgs/TimeReference.h>

#include <cmath>

#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

std::int64_t ros_now_ns() { return static_cast<std::int64_t>(ros::Time::now().toNSec()); }

/// Clocks: TIMESYNC and SYSTEM_TIME, from and to the vehicle.
class SysTime : public Plugin {
 public:
  explicit SysTime(Hub& hub) : hub_(hub), vehicle_(hub.vehicle) {
    status_ = hub.ros.advertise<mavros_msgs::TimesyncStatus>("timesync_status");
    reference_ = hub.ros.advertise<sensor_msgs::TimeReference>("time_reference");
    vehicle_.on(MAVLINK_MSG_ID_TIMESYNC, [this](const Message& message) { on_timesync(message); });
    on<mavlink_system_time_t>(vehicle_, [this](const auto& p) { on_system_time(p); });
    const auto& conn = hub.params.conn;
    if (conn.timesync_rate > 0.0 && hub.params.time.timesync_mode != "NONE") {
      hub.ros.every(1.0 / conn.timesync_rate, [this] {
        if (vehicle_.is_connected()) vehicle_.send(vehicle_.timesync().request(ros_now_ns()));
      });
    }
    if (conn.system_time_rate > 0.0) {
      hub.ros.every(1.0 / conn.system_time_rate, [this] { send_system_time(); });
    }
  }

 private:
  void on_timesync(const Message& message) {
    const std::int64_t now_ns = ros_now_ns();
    if (const auto answer = bridges::mavlink::timesync_answer(message, vehicle_.self(), now_ns)) {
      vehicle_.send(*answer);
      return;
    }
    const auto offset = vehicle_.timesync().handle(message, now_ns);
    if (!offset) return;
    mavros_msgs::TimesyncStatus status;
    status.header.stamp = ros::Time::now();
    status.remote_timestamp_ns =
        static_cast<std::uint64_t>(bridges::mavlink::unpack<mavlink_timesync_t>(message).tc1);
    status.observed_offset_ns = offset->offset_ns;
    const auto& best = vehicle_.timesync().best();
    status.estimated_offset_ns = best ? best->offset_ns : offset->offset_ns;
    constexpr double kPerMillisecond = 1e6;
    status.round_trip_time_ms =
        static_cast<float>(static_cast<double>(offset->round_trip_ns) / kPerMillisecond);
    status_->publish(status);
  }

  void on_system_time(const mavlink_system_time_t& p) {
    constexpr std::uint64_t kPerSecond_us = 1'000'000;
    if (p.time_unix_usec == 0) return;                          // the vehicle does not know it
    if (p.time_unix_usec / kPerSecond_us > UINT32_MAX) return;  // beyond ros::Time
    sensor_msgs::TimeReference message;
    message.header.stamp = ros::Time::now();
    message.time_ref.fromNSec(p.time_unix_usec * 1000);
    message.source = hub_.params.time.time_ref_source;
    reference_->publish(message);
  }

  /// Wall time: simulated time is no UTC.
  void send_system_time() {
    mavlink_system_time_t payload{};
    payload.time_unix_usec = ros::WallTime::now().toNSec() / 1000;
    send(vehicle_, payload);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::TimesyncStatus>> status_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::TimeReference>> reference_;
};

}  // namespace

std::unique_ptr<Plugin> make_sys_time(Hub& hub) { return std::make_unique<SysTime>(hub); }

}  // namespace trident::mavros
