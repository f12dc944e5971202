// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Float64.h>
#include <trident_msgs/AisTarget.h>
#include <trident_msgs/WindReading.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges_ros/nmea/navsat_output.h"

namespace trident::bridges {

/// What nmea_node does with what route planners say.
struct AutopilotHooks {
  std::function<void(const nmea::SteeringEvent&)> steer;             ///< may be empty
  std::function<void(const std::vector<nmea::RoutePlace>&)> follow;  ///< may be empty
};

/// Publishes all that sentences say: NavsatOutput's topics, `imu` (heading, tilt, rate of turn),
/// `water_velocity`, `depth`, `wind_reading`, `ais`, `cross_track_error`, and one std_msgs/Float64
/// for each other number, such as `water_temperature`, `rudder_angle` and `rpm/shaft_1`.
class InstrumentOutput : public NavsatOutput {
 public:
  /// Advertises the topics below `node`'s namespace.
  InstrumentOutput(const ros::NodeHandle& node, const NavsatOutputParams& params);

  /// Who steers; set before anything is read.
  void set_autopilot(AutopilotHooks hooks) { autopilot_ = std::move(hooks); }

  void on_heading(double heading_rad) override;
  void on_turn_rate(double rad_s) override;
  void on_tilt(const nmea::Tilt& tilt) override;
  void on_water_velocity(const nmea::WaterVelocity& velocity) override;
  void on_depth(const nmea::DepthReading& depth) override;
  void on_wind(const nmea::WindEvent& wind) override;
  void on_number(const nmea::NamedNumber& number) override;
  void on_steering(const nmea::SteeringEvent& steering) override;
  void on_route(const std::vector<nmea::RoutePlace>& places) override;
  void on_ais(const nmea::AisVessel& vessel, bool is_own) override;

  static constexpr std::size_t kMaxNumbers = 64;  ///< topics of numbers; more are counted only

 private:
  void publish_imu();

  ros::NodeHandle node_;
  NodePublisher<sensor_msgs::Imu> imu_;
  NodePublisher<geometry_msgs::TwistStamped> water_;
  NodePublisher<sensor_msgs::Range> depth_;
  NodePublisher<trident_msgs::WindReading> wind_;
  NodePublisher<trident_msgs::AisTarget> ais_;
  NodePublisher<std_msgs::Float64> cross_track_;
  std::map<std::string, ros::Publisher, std::less<>> numbers_;
  AutopilotHooks autopilot_;
  std::optional<double> heading_rad_;
  nmea::Tilt tilt_;
  std::optional<double> turn_rad_s_;
};

}  // namespace trident::bridges
