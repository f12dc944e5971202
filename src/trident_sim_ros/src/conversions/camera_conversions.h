// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <trident_msgs/BoundingBoxes.h>

#include "trident_sim/samples.h"

namespace trident::sim {

// Sample -> message, as in conversions.h.
void convert(const ImageSample& sample, sensor_msgs::Image& message);
void convert(const CameraInfoSample& sample, sensor_msgs::CameraInfo& message);
/// Fields x, y, z and rgb, as PCL names and packs them.
void convert(const ImageCloudSample& sample, sensor_msgs::PointCloud2& message);
void convert(const BoundingBoxesSample& sample, trident_msgs::BoundingBoxes& message);

}  // namespace trident::sim
