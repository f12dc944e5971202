// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/PointField.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

namespace trident::nav {

/// Collects points of which each field is a float, in one row without gaps.
class PointCloudWriter {
 public:
  explicit PointCloudWriter(std::initializer_list<const char*> fields) {
    for (const char* name : fields) {
      sensor_msgs::PointField field;
      field.name = name;
      field.offset = static_cast<std::uint32_t>(sizeof(float) * cloud_.fields.size());
      field.datatype = sensor_msgs::PointField::FLOAT32;
      field.count = 1;
      cloud_.fields.push_back(field);
    }
  }

  /// A point with a value for each field.
  void add(std::initializer_list<float> values) {
    values_.insert(values_.end(), values.begin(), values.end());
  }

  sensor_msgs::PointCloud2 message(const std_msgs::Header& header) {
    cloud_.header = header;
    cloud_.height = 1;
    cloud_.width = static_cast<std::uint32_t>(values_.size() / cloud_.fields.size());
    cloud_.point_step = static_cast<std::uint32_t>(sizeof(float) * cloud_.fields.size());
    cloud_.row_step = cloud_.point_step * cloud_.width;
    cloud_.is_dense = 1;
    cloud_.data.resize(sizeof(float) * values_.size());
    if (!values_.empty()) std::memcpy(cloud_.data.data(), values_.data(), cloud_.data.size());
    return cloud_;
  }

 private:
  sensor_msgs::PointCloud2 cloud_;
  std::vector<float> values_;
};

}  // namespace trident::nav
