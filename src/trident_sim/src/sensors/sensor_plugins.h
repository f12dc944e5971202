// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

/// gazebo_ros' laser: every scan a snapshot.
PluginFactory gazebo_laser_factory();
/// Our planar lidar: every beam at its own time, unless `<rolling>` says no.
PluginFactory lidar_factory();
/// Velodyne's snapshots as points, of velodyne_gazebo_plugins, and our rolling lidar of many rings.
PluginFactory velodyne_laser_factory();
PluginFactory point_lidar_factory();
/// gazebo_ros' cone of rays that tells the nearest, and its cloud of one point per beam.
PluginFactory range_factory();
PluginFactory block_laser_factory();
/// gazebo_ros' bumper.
PluginFactory bumper_factory();
/// Our receiver with RTK.
PluginFactory gnss_factory();
/// Our encoders on joints.
PluginFactory wheel_encoder_factory();
/// gazebo_ros' IMUs: of a model (libgazebo_ros_imu.so) and of a sensor
/// (libgazebo_ros_imu_sensor.so).
PluginFactory gazebo_imu_factory();
PluginFactory gazebo_imu_sensor_factory();
/// hector_gazebo_plugins' sensors.
PluginFactory hector_imu_factory();
PluginFactory hector_gps_factory();
PluginFactory hector_magnetic_factory();
PluginFactory hector_baro_factory();
PluginFactory hector_sonar_factory();
/// RotorS' receiver, magnetometer and barometer.
PluginFactory gps_factory();
PluginFactory magnetometer_factory();
PluginFactory air_pressure_factory();

/// When a camera takes pictures: at the sensor's rate, or one for each std_msgs/Empty on
/// `<triggerTopicName>` (image_trigger), at the end of the next step.
enum class Shutter { kRate, kTrigger };

/// gazebo_plugins' cameras: colour; depth (libgazebo_ros_depth_camera.so); colour and depth from
/// one place (libgazebo_ros_openni_kinect.so); several side by side.
/// The first and last also wait for triggers (libgazebo_ros_triggered_camera.so).
PluginFactory gazebo_camera_factory(Shutter shutter);
PluginFactory gazebo_depth_camera_factory();
PluginFactory gazebo_kinect_factory();
PluginFactory gazebo_multicamera_factory(Shutter shutter);
/// RotorS' depth camera with the noise of a real one.
PluginFactory noisy_depth_camera_factory();
/// Our camera: colour, depth, labels and bounding boxes, whichever are asked for.
PluginFactory camera_factory();
/// A vane and anemometer in the world's wind.
PluginFactory anemometer_factory();

}  // namespace trident::sim
