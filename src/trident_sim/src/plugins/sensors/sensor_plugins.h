// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident {

/// gazebo_ros' laser: every scan a snapshot.
PluginFactory gazebo_laser_factory();
/// Our planar lidar: every beam at its own time, unless `<rolling>` says no.
PluginFactory lidar_factory();
/// gazebo_ros' IMUs: of a model (libgazebo_ros_imu.so) and of a sensor
/// (libgazebo_ros_imu_sensor.so).
PluginFactory gazebo_imu_factory();
PluginFactory gazebo_imu_sensor_factory();
/// RotorS' receiver, magnetometer and barometer.
PluginFactory gps_factory();
PluginFactory magnetometer_factory();
PluginFactory air_pressure_factory();

}  // namespace trident
