// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_conversions.h"

#include <algorithm>
#include <cstddef>

#include "conversions.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {
namespace {

using Point = ImageCloudSample::Point;

sensor_msgs::PointField float_field(const char* name, std::size_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = static_cast<std::uint32_t>(offset);
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

}  // namespace

void convert(const ImageSample& sample, sensor_msgs::Image& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.height = sample.height;
  message.width = sample.width;
  message.encoding = sample.encoding;
  message.is_bigendian = 0;
  message.step = sample.bytes_per_row;
  message.data = sample.data;
}

void convert(const CameraInfoSample& sample, sensor_msgs::CameraInfo& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.height = sample.height;
  message.width = sample.width;
  message.distortion_model = "plumb_bob";
  message.D.assign(sample.D.begin(), sample.D.end());
  std::copy(sample.K.begin(), sample.K.end(), message.K.begin());
  std::copy(sample.R.begin(), sample.R.end(), message.R.begin());
  std::copy(sample.P.begin(), sample.P.end(), message.P.begin());
}

void convert(const ImageCloudSample& sample, sensor_msgs::PointCloud2& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.height = sample.height;
  message.width = sample.width;
  if (message.fields.empty()) {
    // The layout of the packed points themselves; "rgb"
    // is 0x00RRGGBB in the bits of a float, as in PCL.
    message.fields = {float_field("x", offsetof(Point, x)), float_field("y", offsetof(Point, y)),
                      float_field("z", offsetof(Point, z)),
                      float_field("rgb", offsetof(Point, rgb))};
  }
  message.is_bigendian = 0;
  message.point_step = sizeof(Point);
  message.row_step = message.point_step * sample.width;
  message.is_dense = sample.is_dense ? 1 : 0;
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(sample.points.data());
  message.data.assign(bytes, bytes + sample.points.size() * sizeof(Point));
}

void convert(const BoundingBoxesSample& sample, trident_msgs::BoundingBoxes& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.boxes.clear();
  for (const BoundingBoxesSample::Box& box : sample.boxes) {
    trident_msgs::BoundingBox& converted = message.boxes.emplace_back();
    converted.label = box.label;
    converted.name = box.name;
    converted.x_min = box.x_min;
    converted.y_min = box.y_min;
    converted.x_max = box.x_max;
    converted.y_max = box.y_max;
    converted.pixels = box.pixels;
  }
}

namespace {

const OutputTopicRegistrar<ImageSample, sensor_msgs::Image> kImageTopic(large_topic());
const OutputTopicRegistrar<CameraInfoSample, sensor_msgs::CameraInfo> kCameraInfoTopic;
const OutputTopicRegistrar<ImageCloudSample, sensor_msgs::PointCloud2> kImageCloudTopic(
    large_topic());
const OutputTopicRegistrar<BoundingBoxesSample, trident_msgs::BoundingBoxes> kBoundingBoxesTopic;

}  // namespace
}  // namespace trident::sim
