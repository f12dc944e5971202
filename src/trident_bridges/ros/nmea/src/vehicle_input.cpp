// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/vehicle_input.h"

#include <sensor_msgs/Range.h>
#include <std_msgs/Float64.h>
#include <trident_msgs/WindReading.h>

#include <Eigen/Geometry>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/se3.h"
#include "trident_ros/message_checks.h"

namespace trident::bridges {
namespace {

using nmea::GnssEpoch;
using sensor_msgs::NavSatStatus;

constexpr std::uint32_t kInputQueueSize = 1000;
constexpr double kAccurateM = 10.0;  ///< that AIS calls accurate

SimTime to_sim(const ros::Time& stamp) { return {static_cast<std::int64_t>(stamp.toNSec())}; }

GnssEpoch::Fix fix_of(std::int8_t status) {
  switch (status) {
    case NavSatStatus::STATUS_GBAS_FIX:
      return GnssEpoch::Fix::kFixed;
    case NavSatStatus::STATUS_SBAS_FIX:
    case NavSatStatus::STATUS_FIX:
      return GnssEpoch::Fix::kSingle;
    default:
      return GnssEpoch::Fix::kNone;
  }
}

std::string fix_problem(const sensor_msgs::NavSatFix& message) {
  if (message.status.status < 0) return "";
  std::string problem = ros_utils::number_problem(message.latitude, 90.0, "latitude");
  if (problem.empty()) problem = ros_utils::number_problem(message.longitude, 180.0, "longitude");
  if (problem.empty()) problem = ros_utils::number_problem(message.altitude, 1e7, "altitude");
  return problem;
}

/// Heading, tilt and turn.
nmea::Attitude attitude_of(const nav_msgs::Odometry& message,
                           const Eigen::Quaterniond& R_enu_frame) {
  const auto& q = message.pose.pose.orientation;
  const Eigen::Vector3d rpy =
      SE3{R_enu_frame * Eigen::Quaterniond(q.w, q.x, q.y, q.z), Eigen::Vector3d::Zero()}.rpy();
  nmea::Attitude attitude;
  attitude.heading_rad = 0.5 * kPi - rpy.z();
  attitude.roll_rad = rpy.x();
  attitude.pitch_rad = rpy.y();
  attitude.turn_rad_s = message.twist.twist.angular.z;
  return attitude;
}

nmea::GroundVelocity velocity_of(const nav_msgs::Odometry& message,
                                 const Eigen::Quaterniond& R_enu_frame) {
  const auto& q = message.pose.pose.orientation;
  const auto& v = message.twist.twist.linear;
  const Eigen::Vector3d v_enu =
      R_enu_frame * Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d(v.x, v.y, v.z);
  return {v_enu.x(), v_enu.y()};
}

}  // namespace

VehicleInput::VehicleInput(ros::NodeHandle& node, NodePollLoop& loop, const NmeaTopicParams& topics,
                           double frame_heading_rad, nmea::SentenceSender& sender,
                           const UtcClock& clock, ros_utils::Refusals& refusals, VehicleHooks hooks)
    : node_(node),
      loop_(loop),
      refusals_(refusals),
      hooks_(std::move(hooks)),
      R_enu_frame_(Eigen::AngleAxisd(frame_heading_rad, Eigen::Vector3d::UnitZ())),
      gnss_(sender, clock),
      instruments_(sender) {
  listen<trident_msgs::GnssStatus>(topics.gnss_status, [this](const auto& m) { on_status(m); });
  if (!topics.gnss_status.empty()) status_ = subscriptions_.back().get();
  listen<sensor_msgs::NavSatFix>(topics.fix, [this](const auto& m) { on_fix(m); });
  listen<nav_msgs::Odometry>(topics.odometry, [this](const auto& m) { on_odometry(m); });
  listen<trident_msgs::WindReading>(topics.wind, [this](const trident_msgs::WindReading& m) {
    std::string problem = ros_utils::number_problem(m.speed, 500.0, "speed");
    if (problem.empty()) problem = ros_utils::number_problem(m.angle, 2.0 * kPi, "angle");
    if (!accept("wind", problem)) return;
    const bool is_true = m.reference == trident_msgs::WindReading::TRUE;
    instruments_.on_wind(to_sim(m.header.stamp), {is_true, m.speed, m.angle});
  });
  listen_to_water(topics);
  listen_to_machinery(topics);
}

void VehicleInput::listen_to_water(const NmeaTopicParams& topics) {
  listen<std_msgs::Float64>(topics.speed_through_water, [this](const std_msgs::Float64& m) {
    if (!accept("speed_through_water", ros_utils::number_problem(m.data, 500.0, "data"))) return;
    instruments_.on_water_velocity(to_sim(ros::Time::now()), {m.data, 0.0});
  });
  listen<sensor_msgs::Range>(topics.depth, [this](const sensor_msgs::Range& m) {
    if (!accept("depth", ros_utils::number_problem(m.range, 1e5, "range"))) return;
    instruments_.on_depth(to_sim(m.header.stamp), {m.range, {}, m.max_range});
  });
}

void VehicleInput::listen_to_machinery(const NmeaTopicParams& topics) {
  listen<std_msgs::Float64>(topics.rudder, [this](const std_msgs::Float64& m) {
    if (!accept("rudder", ros_utils::number_problem(m.data, kPi, "data"))) return;
    instruments_.on_rudder(to_sim(ros::Time::now()), -m.data);
  });
  shaft_rpm_.resize(topics.shafts.size());
  for (std::size_t i = 0; i < topics.shafts.size(); ++i) {
    listen<std_msgs::Float64>(topics.shafts[i], [this, i](const std_msgs::Float64& m) {
      if (!accept("shafts", ros_utils::number_problem(m.data, 1e6, "data"))) return;
      shaft_rpm_[i] = m.data;
      if (i + 1 < shaft_rpm_.size()) return;  // the last one brings all of them
      instruments_.on_shafts(to_sim(ros::Time::now()), Span<const double>(shaft_rpm_));
    });
  }
}

template <class Message, class Handler>
void VehicleInput::listen(const std::string& topic, const Handler& handler) {
  if (topic.empty()) return;
  subscriptions_.push_back(loop_.subscribe<Message>(node_, topic, kInputQueueSize, handler));
}

bool VehicleInput::accept(const std::string& topic, const std::string& problem) {
  if (problem.empty()) return true;
  refusals_.note(topic + " refused", topic + " refused: " + problem);
  return false;
}

void VehicleInput::on_fix(const sensor_msgs::NavSatFix& message) {
  if (!accept("fix", fix_problem(message))) return;
  GnssEpoch epoch;
  epoch.stamp = to_sim(message.header.stamp);
  epoch.fix = fix_of(message.status.status);
  epoch.latitude_deg = message.latitude;
  epoch.longitude_deg = message.longitude;
  epoch.altitude_m = message.altitude;
  epoch.horizontal_stddev_m = std::sqrt(std::max(message.position_covariance[0], 0.0));
  epoch.vertical_stddev_m = std::sqrt(std::max(message.position_covariance[8], 0.0));
  const bool awaits_status = status_ != nullptr && status_->publishers() > 0;
  if (const auto complete = join_.add_fix(epoch, awaits_status)) on_epoch(*complete);
}

void VehicleInput::on_epoch(const GnssEpoch& epoch) {
  gnss_.on_epoch(epoch);
  if (!hooks_.fixed) return;
  nmea::AisState state;
  if (epoch.fix != GnssEpoch::Fix::kNone) {
    state.latitude_deg = epoch.latitude_deg;
    state.longitude_deg = epoch.longitude_deg;
    state.is_accurate = epoch.horizontal_stddev_m < kAccurateM;
  }
  if (velocity_) {
    state.speed_m_s = std::hypot(velocity_->east_m_s, velocity_->north_m_s);
    state.course_rad = std::atan2(velocity_->east_m_s, velocity_->north_m_s);
  }
  if (attitude_) {
    state.heading_rad = attitude_->heading_rad;
    if (attitude_->turn_rad_s) state.turn_rad_s = -*attitude_->turn_rad_s;
  }
  hooks_.fixed(epoch.stamp, state, epoch.altitude_m);
}

void VehicleInput::on_status(const trident_msgs::GnssStatus& message) {
  nmea::GnssJoin::Status status;
  status.stamp = to_sim(message.header.stamp);
  constexpr std::uint8_t kLast = trident_msgs::GnssStatus::FIXED;
  status.fix = static_cast<GnssEpoch::Fix>(std::min(message.fix_type, kLast));
  status.horizontal_stddev_m = message.horizontal_stddev;
  status.vertical_stddev_m = message.vertical_stddev;
  status.satellites = message.satellites;
  if (std::isfinite(message.geoid_separation)) {
    status.geoid_separation_m = message.geoid_separation;
  }
  if (const auto complete = join_.add_status(status)) on_epoch(*complete);
}

void VehicleInput::on_odometry(const nav_msgs::Odometry& message) {
  std::string problem = ros_utils::pose_problem(message.pose.pose);
  const auto& v = message.twist.twist.linear;
  if (problem.empty()) problem = ros_utils::point_problem(v.x, v.y, v.z, "twist.linear");
  if (problem.empty()) {
    problem = ros_utils::number_problem(message.twist.twist.angular.z, 1e3, "twist.angular.z");
  }
  if (!accept("odometry", problem)) return;
  velocity_ = velocity_of(message, R_enu_frame_);
  attitude_ = attitude_of(message, R_enu_frame_);
  gnss_.set_velocity(*velocity_);
  instruments_.set_ground_velocity(*velocity_);
  const SimTime stamp = to_sim(message.header.stamp);
  instruments_.on_attitude(stamp, *attitude_);
  const auto& p = message.pose.pose.position;
  if (hooks_.moved) hooks_.moved(stamp, message.header.frame_id, {p.x, p.y}, *velocity_);
}

}  // namespace trident::bridges
