// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <sensor_msgs/Range.h>

#include <cmath>
#include <map>

#include "core/conversions.h"
#include "core/recent_variance.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "trident_base/angle.h"

namespace trident::mavros {
namespace {

std::uint16_t range_cm(float meters) {
  constexpr double kPerMeter = 100.0, kMax = UINT16_MAX;
  return to_whole<std::uint16_t>(std::isfinite(meters) ? meters * kPerMeter : kMax);
}

/// The sensors of ~distance_sensor: one topic for each, from or to the vehicle.
class DistanceSensors : public Plugin {
 public:
  explicit DistanceSensors(Hub& hub) : hub_(hub) {
    for (const auto& [name, sensor] : hub.params.distance_sensor) add(name, sensor);
    on<mavlink_distance_sensor_t>(hub.vehicle, [this](const auto& p) { publish(p); });
  }

 private:
  struct Output {
    DistanceSensorParams sensor;
    std::unique_ptr<bridges::NodePublisher<sensor_msgs::Range>> topic;
  };
  struct Input {
    DistanceSensorParams sensor;
    RecentVariance recent;
  };

  void add(const std::string& name, const DistanceSensorParams& sensor) {
    const std::string topic = "distance_sensor/" + name;
    if (!sensor.subscriber) {
      outputs_[sensor.id] = {sensor, hub_.ros.advertise<sensor_msgs::Range>(topic)};
      return;
    }
    Input& input = inputs_[name];
    input.sensor = sensor;
    hub_.ros.subscribe<sensor_msgs::Range>(
        topic, [this, &input](const auto& message) { send_range(message, input); });
  }

  void publish(const mavlink_distance_sensor_t& p) {
    const auto found = outputs_.find(p.id);
    if (found == outputs_.end()) return;
    const DistanceSensorParams& sensor = found->second.sensor;
    if (sensor.orientation && *sensor.orientation != SensorOrientation{p.orientation}) {
      return hub_.ros.refusals().note(
          "ranges refused", "DISTANCE_SENSOR " + std::to_string(p.id) + ": orientation is " +
                                std::to_string(p.orientation) + ", its section has another one");
    }
    constexpr float kCentimeter = 0.01F;
    sensor_msgs::Range range;
    range.header.stamp = hub_.vehicle.stamp_ms(p.time_boot_ms);
    range.header.frame_id = sensor.frame_id;
    range.radiation_type = p.type == MAV_DISTANCE_SENSOR_ULTRASOUND ? sensor_msgs::Range::ULTRASOUND
                                                                    : sensor_msgs::Range::INFRARED;
    range.field_of_view = static_cast<float>(sensor.field_of_view);
    range.min_range = static_cast<float>(p.min_distance) * kCentimeter;
    range.max_range = static_cast<float>(p.max_distance) * kCentimeter;
    range.range = static_cast<float>(p.current_distance) * kCentimeter;
    found->second.topic->publish(range);
  }

  void send_range(const sensor_msgs::Range& m, Input& input) {
    const DistanceSensorParams& sensor = input.sensor;
    mavlink_distance_sensor_t payload{};
    payload.time_boot_ms = hub_.vehicle.boot_ms(m.header.stamp);
    payload.min_distance = range_cm(m.min_range);
    payload.max_distance = range_cm(m.max_range);
    payload.current_distance = range_cm(m.range);
    payload.type = m.radiation_type == sensor_msgs::Range::INFRARED
                       ? MAV_DISTANCE_SENSOR_LASER
                       : MAV_DISTANCE_SENSOR_ULTRASOUND;
    payload.id = static_cast<std::uint8_t>(sensor.id);
    payload.orientation = static_cast<std::uint8_t>(sensor.orientation.value_or(kDownward));
    payload.covariance = variance_cm2(m.range, input);
    payload.horizontal_fov = static_cast<float>(m.field_of_view * sensor.horizontal_fov_ratio);
    payload.vertical_fov = static_cast<float>(m.field_of_view * sensor.vertical_fov_ratio);
    if (sensor.orientation == kCustomOrientation) {
      const SensorAngleParams& angles = sensor.custom_orientation;
      const Eigen::Quaterniond q =
          from_euler(deg_to_rad(angles.roll), deg_to_rad(angles.pitch), deg_to_rad(angles.yaw));
      payload.quaternion[0] = static_cast<float>(q.w());
      payload.quaternion[1] = static_cast<float>(q.x());
      payload.quaternion[2] = static_cast<float>(q.y());
      payload.quaternion[3] = static_cast<float>(q.z());
    }
    send(hub_.vehicle, payload);
  }
  /// UINT8_MAX: not known.
  static std::uint8_t variance_cm2(float range_m, Input& input) {
    if (input.sensor.covariance > 0) return static_cast<std::uint8_t>(input.sensor.covariance);
    if (!std::isfinite(range_m)) return UINT8_MAX;
    constexpr double kPerSquareMeter = 1e4;
    return to_whole<std::uint8_t>(input.recent.add(range_m) * kPerSquareMeter);
  }

  Hub& hub_;
  std::map<int, Output> outputs_;
  std::map<std::string, Input> inputs_;
};

}  // namespace

std::unique_ptr<Plugin> make_distance_sensor(Hub& hub) {
  return std::make_unique<DistanceSensors>(hub);
}

}  // namespace trident::mavros
