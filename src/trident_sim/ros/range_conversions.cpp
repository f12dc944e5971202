// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "range_conversions.h"

#include <cstddef>
#include <cstring>

#include "conversions.h"

namespace trident {
namespace {

sensor_msgs::PointField make_field(const char* name, std::size_t offset, std::uint8_t datatype) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = static_cast<std::uint32_t>(offset);
  field.datatype = datatype;
  field.count = 1;
  return field;
}

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

}  // namespace trident
