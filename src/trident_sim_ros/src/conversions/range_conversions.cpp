// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "range_conversions.h"

#include <cstddef>
#include <cstring>

#include "conversions.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {
namespace {

sensor_msgs::PointField make_field(const char* name, std::size_t offset, std::uint8_t datatype) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = static_cast<std::uint32_t>(offset);
  field.datatype = datatype;
  field.count = 1;
  return field;
}

// The fields of velodyne_pointcloud's PointXYZIRT, which LIO packages look for by name.
std::vector<sensor_msgs::PointField> lidar_fields() {
  using Field = sensor_msgs::PointField;
  return {make_field("x", offsetof(LidarPoint, x), Field::FLOAT32),
          make_field("y", offsetof(LidarPoint, y), Field::FLOAT32),
          make_field("z", offsetof(LidarPoint, z), Field::FLOAT32),
          make_field("intensity", offsetof(LidarPoint, intensity), Field::FLOAT32),
          make_field("ring", offsetof(LidarPoint, ring), Field::UINT16),
          make_field("time", offsetof(LidarPoint, time), Field::FLOAT32)};
}

}  // namespace

void convert(const LidarCloudSample& sample, sensor_msgs::PointCloud2& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(sample.points.size());
  if (message.fields.empty()) message.fields = lidar_fields();
  message.is_bigendian = 0;
  message.point_step = sizeof(LidarPoint);
  message.row_step = message.point_step * message.width;
  message.is_dense = 1;
  message.data.resize(message.row_step);
  if (message.width > 0) std::memcpy(message.data.data(), sample.points.data(), message.row_step);
}

void convert(const PointListSample& sample, sensor_msgs::PointCloud& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.points.resize(sample.points.size());
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    message.points[i].x = sample.points[i].x();
    message.points[i].y = sample.points[i].y();
    message.points[i].z = sample.points[i].z();
  }
  message.channels.resize(1);
  message.channels[0].name = "intensity";
  message.channels[0].values = sample.intensities;
}

void convert(const RangeSample& sample, sensor_msgs::Range& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.radiation_type =
      sample.is_infrared ? sensor_msgs::Range::INFRARED : sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = static_cast<float>(sample.field_of_view_rad);
  message.min_range = static_cast<float>(sample.range_min_m);
  message.max_range = static_cast<float>(sample.range_max_m);
  message.range = static_cast<float>(sample.range_m);
}

void convert(const ContactsSample& sample, gazebo_msgs::ContactsState& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.states.clear();
  for (const TouchSample& touch : sample.touches) {
    message.states.emplace_back();
    gazebo_msgs::ContactState& state = message.states.back();
    // All contacts of one pair of collisions are one state, with the sum of their wrenches.
    state.info = touch.collision1 + " touches " + touch.collision2;
    state.collision1_name = touch.collision1;
    state.collision2_name = touch.collision2;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < touch.depths.size(); ++i) {
      state.wrenches.emplace_back();
      state.wrenches.back().force = to_vector(touch.forces[i]);
      state.wrenches.back().torque = to_vector(touch.torques[i]);
      force += touch.forces[i];
      torque += touch.torques[i];
      state.contact_positions.push_back(to_vector(touch.positions[i]));
      state.contact_normals.push_back(to_vector(touch.normals[i]));
    }
    state.depths = touch.depths;
    state.total_wrench.force = to_vector(force);
    state.total_wrench.torque = to_vector(torque);
  }
}

void convert(const GnssStatusSample& sample, trident_msgs::GnssStatus& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.fix_type = static_cast<std::uint8_t>(sample.fix_type);
  message.horizontal_stddev = sample.stddev_horizontal_m;
  message.vertical_stddev = sample.stddev_vertical_m;
  message.satellites = static_cast<std::uint8_t>(sample.satellites);
  message.geoid_separation = sample.geoid_separation_m;
}

namespace {

const OutputTopicRegistrar<LidarCloudSample, sensor_msgs::PointCloud2> kLidarCloudTopic(
    large_topic());
const OutputTopicRegistrar<PointListSample, sensor_msgs::PointCloud> kPointListTopic;
const OutputTopicRegistrar<RangeSample, sensor_msgs::Range> kRangeTopic;
const OutputTopicRegistrar<ContactsSample, gazebo_msgs::ContactsState> kContactsTopic;
const OutputTopicRegistrar<GnssStatusSample, trident_msgs::GnssStatus> kGnssStatusTopic;

}  // namespace
}  // namespace trident::sim
