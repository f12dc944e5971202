// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo_msgs/ContactsState.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/Range.h>
#include <trident_msgs/GnssStatus.h>

#include "trident_sim/samples.h"

namespace trident::sim {

// Samples of what is seen, touched or received -> message. The message is reused from call to call.

/// Unorganised, with the fields x y z intensity ring time of the velodyne driver, packed.
void convert(const LidarCloudSample& sample, sensor_msgs::PointCloud2& message);
void convert(const PointListSample& sample, sensor_msgs::PointCloud& message);
void convert(const RangeSample& sample, sensor_msgs::Range& message);
void convert(const ContactsSample& sample, gazebo_msgs::ContactsState& message);
void convert(const GnssStatusSample& sample, trident_msgs::GnssStatus& message);

}  // namespace trident::sim
