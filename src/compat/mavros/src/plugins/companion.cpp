// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/PolygonStamped.h>
#include <mavros_msgs/CompanionProcessStatus.h>
#include <mavros_msgs/GPSINPUT.h>
#include <mavros_msgs/OnboardComputerStatus.h>
#include <mavros_msgs/RTCM.h>
#include <sensor_msgs/LaserScan.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "plugins/rtk_baseline.h"

namespace trident::mavros {
namespace {

/// Copies an array of a message into a field of the same length.
template <class Array, class Field>
void copy_all(const Array& from, Field& to) {
  std::copy(from.begin(), from.end(), std::begin(to));
}

/// Sends a payload as a message of another component of this node's system.
template <class Payload>
void send_as(VehicleSide& vehicle, const Payload& payload, std::uint8_t component) {
  Address sender = vehicle.self();
  sender.component = component;
  vehicle.send(bridges::mavlink::pack(payload, sender));
}

/// companion_process/status becomes the HEARTBEAT of that component.
class CompanionProcess : public Plugin {
 public:
  explicit CompanionProcess(Hub& hub) {
    VehicleSide& vehicle = hub.vehicle;
    hub.ros.subscribe<mavros_msgs::CompanionProcessStatus>(
        "companion_process/status", [&vehicle](const auto& m) {
          mavlink_heartbeat_t payload{};
          payload.type = MAV_TYPE_ONBOARD_CONTROLLER;
          payload.autopilot = MAV_AUTOPILOT_INVALID;
          payload.base_mode = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
          payload.system_status = m.state;
          send_as(vehicle, payload, m.component);
        });
  }
};

/// onboard_computer/status becomes ONBOARD_COMPUTER_STATUS of that component.
class OnboardComputer : public Plugin {
 public:
  explicit OnboardComputer(Hub& hub) {
    VehicleSide& vehicle = hub.vehicle;
    hub.ros.subscribe<mavros_msgs::OnboardComputerStatus>(
        "onboard_computer/status", [&vehicle](const auto& m) {
          mavlink_onboard_computer_status_t payload{};
          payload.time_usec = m.header.stamp.toNSec() / 1000;
          payload.uptime = m.uptime;
          payload.type = m.type;
          copy_all(m.cpu_cores, payload.cpu_cores);
          copy_all(m.cpu_combined, payload.cpu_combined);
          copy_all(m.gpu_cores, payload.gpu_cores);
          copy_all(m.gpu_combined, payload.gpu_combined);
          payload.temperature_board = m.temperature_board;
          copy_all(m.temperature_core, payload.temperature_core);
          copy_all(m.fan_speed, payload.fan_speed);
          payload.ram_usage = m.ram_usage;
          payload.ram_total = m.ram_total;
          copy_all(m.storage_type, payload.storage_type);
          copy_all(m.storage_usage, payload.storage_usage);
          copy_all(m.storage_total, payload.storage_total);
          copy_all(m.link_type, payload.link_type);
          copy_all(m.link_tx_rate, payload.link_tx_rate);
          copy_all(m.link_rx_rate, payload.link_rx_rate);
          copy_all(m.link_tx_max, payload.link_tx_max);
          copy_all(m.link_rx_max, payload.link_rx_max);
          send_as(vehicle, payload, m.component);
        });
  }
};

/// obstacle/send becomes OBSTACLE_DISTANCE: clockwise from ahead, where a scan is counterclockwise.
class ObstacleDistance : public Plugin {
 public:
  explicit ObstacleDistance(Hub& hub) : hub_(hub) {
    hub.ros.subscribe<sensor_msgs::LaserScan>("obstacle/send",
                                              [this](const auto& scan) { send_scan(scan); });
  }

 private:
  static constexpr std::size_t kSectors = 72;
  static constexpr double kPerMeter = 100.0, kDegrees = 180.0 / kPi;

  static std::uint16_t centimeters(float distance_m) {
    constexpr double kMax = UINT16_MAX - 1;
    return to_whole<std::uint16_t>(std::min(kMax, kPerMeter * distance_m));
  }
  static bool has_angles(const sensor_msgs::LaserScan& scan) {
    return std::abs(scan.angle_increment) > 0.0F && std::isfinite(scan.angle_increment) &&
           std::isfinite(scan.angle_min);
  }
  void send_scan(const sensor_msgs::LaserScan& scan) {
    const std::size_t rays = scan.ranges.size();
    if (rays == 0 || !has_angles(scan)) {
      hub_.ros.refusals().note("scans refused", "obstacle/send: it has no rays, or no angles");
      return;
    }
    const std::size_t per_sector = (rays + kSectors - 1) / kSectors;
    mavlink_obstacle_distance_t payload{};
    payload.time_usec = scan.header.stamp.toNSec() / 1000;
    payload.sensor_type = MAV_DISTANCE_SENSOR_LASER;
    payload.frame = MAV_FRAME_BODY_FRD;
    payload.min_distance = centimeters(scan.range_min);
    payload.max_distance = centimeters(scan.range_max);
    payload.increment_f =
        static_cast<float>(-kDegrees * scan.angle_increment * static_cast<double>(per_sector));
    // Of the middle of the first sector.
    payload.angle_offset = static_cast<float>(
        -kDegrees *
        (scan.angle_min + 0.5 * scan.angle_increment * (static_cast<double>(per_sector) - 1.0)));
    std::array<std::uint16_t, kSectors> nearest{};
    nearest.fill(UINT16_MAX);
    for (std::size_t i = 0; i < rays; ++i) {
      std::uint16_t& here = nearest[i / per_sector];
      here = std::min(here, distance_of(scan, scan.ranges[i]));
    }
    for (std::size_t i = 0; i < kSectors; ++i) payload.distances[i] = nearest[i];
    send(hub_.vehicle, payload);
  }
  /// Beyond the range nothing is there: max + 1; NaN or below the range: not known.
  static std::uint16_t distance_of(const sensor_msgs::LaserScan& scan, float range_m) {
    if (std::isnan(range_m) || range_m < scan.range_min) return UINT16_MAX;
    const std::uint16_t most = centimeters(scan.range_max);
    if (range_m > scan.range_max) return static_cast<std::uint16_t>(most + 1);
    return centimeters(range_m);
  }

  Hub& hub_;
};

/// gps_input/gps_input becomes GPS_INPUT: a receiver that the vehicle does not have itself.
class GpsInput : public Plugin {
 public:
  explicit GpsInput(Hub& hub) {
    VehicleSide& vehicle = hub.vehicle;
    hub.ros.subscribe<mavros_msgs::GPSINPUT>("gps_input/gps_input", [&vehicle](const auto& m) {
      mavlink_gps_input_t payload{};
      payload.time_usec = m.header.stamp.toNSec() / 1000;
      payload.fix_type = m.fix_type;
      payload.gps_id = m.gps_id;
      payload.ignore_flags = m.ignore_flags;
      payload.time_week_ms = m.time_week_ms;
      payload.time_week = m.time_week;
      payload.lat = m.lat;
      payload.lon = m.lon;
      payload.alt = m.alt;
      payload.hdop = m.hdop;
      payload.vdop = m.vdop;
      payload.vn = m.vn;
      payload.ve = m.ve;
      payload.vd = m.vd;
      payload.speed_accuracy = m.speed_accuracy;
      payload.horiz_accuracy = m.horiz_accuracy;
      payload.vert_accuracy = m.vert_accuracy;
      payload.satellites_visible = m.satellites_visible;
      payload.yaw = m.yaw;
      send(vehicle, payload);
    });
  }
};

/// gps_rtk/send_rtcm becomes GPS_RTCM_DATA, in up to four fragments; GPS_RTK comes as rtk_baseline.
class GpsRtk : public Plugin {
 public:
  explicit GpsRtk(Hub& hub) : hub_(hub) {
    baseline_ = hub.ros.advertise<mavros_msgs::RTKBaseline>("gps_rtk/rtk_baseline");
    on<mavlink_gps_rtk_t>(hub.vehicle, [this](const auto& p) { baseline_->publish(to_rtk(p)); });
    hub.ros.subscribe<mavros_msgs::RTCM>("gps_rtk/send_rtcm",
                                         [this](const auto& m) { send_corrections(m.data); });
  }

 private:
  static constexpr std::size_t kFragment = 180, kFragments = 4;

  void send_corrections(const std::vector<std::uint8_t>& data) {
    if (data.empty() || data.size() > kFragment * kFragments) {
      hub_.ros.refusals().note(
          "corrections refused",
          "gps_rtk/send_rtcm: " + std::to_string(data.size()) + " bytes, legal: 1 to 720");
      return;
    }
    const bool is_fragmented = data.size() > kFragment;
    // A fragment that is not full ends the message, or the fourth: an empty one, if need be.
    const std::size_t count = is_fragmented ? data.size() / kFragment + 1 : 1;
    for (std::size_t i = 0; i < std::min(count, kFragments); ++i) {
      mavlink_gps_rtcm_data_t payload{};
      const std::size_t size = std::min(kFragment, data.size() - i * kFragment);
      payload.flags = static_cast<std::uint8_t>((is_fragmented ? 1U : 0U) | i << 1U |
                                                (sequence_ & 0x1FU) << 3U);
      payload.len = static_cast<std::uint8_t>(size);
      std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(i * kFragment), size,
                  std::begin(payload.data));
      send(hub_.vehicle, payload);
    }
    ++sequence_;
  }

  Hub& hub_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::RTKBaseline>> baseline_;
  unsigned sequence_ = 0;
};

/// safety_area/set becomes SAFETY_SET_ALLOWED_AREA: two corners of a box.
class SafetyArea : public Plugin {
 public:
  explicit SafetyArea(Hub& hub) : hub_(hub) {
    hub.ros.subscribe<geometry_msgs::PolygonStamped>("safety_area/set",
                                                     [this](const auto& m) { send_area(m); });
  }

 private:
  void send_area(const geometry_msgs::PolygonStamped& message) {
    constexpr std::size_t kCorners = 2;
    const auto& points = message.polygon.points;
    if (points.size() != kCorners) {
      hub_.ros.refusals().note("areas refused",
                               "safety_area/set: " + std::to_string(points.size()) +
                                   " points, legal: 2, corners of a box");
      return;
    }
    const Eigen::Vector3d p1 = bridges::mavlink::swap_world(to_eigen(points[0]));
    const Eigen::Vector3d p2 = bridges::mavlink::swap_world(to_eigen(points[1]));
    mavlink_safety_set_allowed_area_t payload{};
    payload.frame = MAV_FRAME_LOCAL_NED;
    payload.p1x = static_cast<float>(p1.x());
    payload.p1y = static_cast<float>(p1.y());
    payload.p1z = static_cast<float>(p1.z());
    payload.p2x = static_cast<float>(p2.x());
    payload.p2y = static_cast<float>(p2.y());
    payload.p2z = static_cast<float>(p2.z());
    send_to_target(hub_.vehicle, payload);
  }

  Hub& hub_;
};

}  // namespace

std::unique_ptr<Plugin> make_companion_process_status(Hub& hub) {
  return std::make_unique<CompanionProcess>(hub);
}
std::unique_ptr<Plugin> make_onboard_computer_status(Hub& hub) {
  return std::make_unique<OnboardComputer>(hub);
}
std::unique_ptr<Plugin> make_obstacle_distance(Hub& hub) {
  return std::make_unique<ObstacleDistance>(hub);
}
std::unique_ptr<Plugin> make_gps_input(Hub& hub) { return std::make_unique<GpsInput>(hub); }
std::unique_ptr<Plugin> make_gps_rtk(Hub& hub) { return std::make_unique<GpsRtk>(hub); }
std::unique_ptr<Plugin> make_safety_area(Hub& hub) { return std::make_unique<SafetyArea>(hub); }

}  // namespace trident::mavros
