// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include "trident_sim/samples.h"

namespace trident {

// Samples of lidars with many rings -> message. The message is reused from call to call.

/// Unorganised, with the fields x y z intensity ring time of the velodyne driver, packed.
void convert(const LidarCloudSample& sample, sensor_msgs::PointCloud2& message);

}  // namespace trident
