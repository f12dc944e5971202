// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/plugins/marine_plugins.h"
#include "sensors/sensor_plugins.h"
#include "trident_sim/world.h"
#include "vehicles/drives/gazebo_ros_plugins.h"
#include "vehicles/joints/joint_plugins.h"
#include "vehicles/rotors/rotors_plugins.h"

namespace trident::sim {
namespace {

/// A name that is known but has nothing to do here.
PluginFactory nothing_to_do() {
  return {[](const PluginContext&) -> std::unique_ptr<Plugin> { return nullptr; }, {}};
}

PluginFactory told_once(std::string what) {
  return {[what = std::move(what)](const PluginContext& context) -> std::unique_ptr<Plugin> {
            context.world.report(Severity::kWarning, context.params.owner() + ": " + what);
            return nullptr;
          },
          {}};
}

}  // namespace

void register_builtin_plugins(PluginRegistry& registry) {
  registry.add("libtrident_joint_drive.so", joint_drive_factory());
  registry.add("libgazebo_ros_diff_drive.so", diff_drive_factory());
  registry.add("libgazebo_ros_skid_steer_drive.so", skid_steer_drive_factory());
  registry.add("libgazebo_ros_kobuki.so", kobuki_factory());
  registry.add("libgazebo_ros_tricycle_drive.so", tricycle_drive_factory());
  registry.add("libgazebo_ros_ackermann_drive.so", ackermann_drive_factory());
  registry.add("libgazebo_ros_planar_move.so", planar_move_factory());
  registry.add("libgazebo_ros_joint_state_publisher.so", joint_state_publisher_factory());
  registry.add("libgazebo_ros_p3d.so", p3d_factory());
  registry.add("librotors_gazebo_motor_model.so", motor_model_factory());
  registry.add("librotors_gazebo_multirotor_base_plugin.so", multirotor_base_factory());
  registry.add("librotors_gazebo_controller_interface.so", controller_interface_factory());
  registry.add("librotors_gazebo_odometry_plugin.so", odometry_factory());
  registry.add("librotors_gazebo_imu_plugin.so", imu_factory());
  registry.add("librotors_gazebo_wind_plugin.so", wind_factory());
  registry.add("librotors_gazebo_gps_plugin.so", gps_factory());
  registry.add("librotors_gazebo_magnetometer_plugin.so", magnetometer_factory());
  registry.add("librotors_gazebo_pressure_plugin.so", air_pressure_factory());
  registry.add("libgazebo_ros_laser.so", gazebo_laser_factory());
  registry.add("libgazebo_ros_gpu_laser.so", gazebo_laser_factory());
  registry.add("libtrident_lidar.so", lidar_factory());
  registry.add("libgazebo_ros_camera.so", gazebo_camera_factory(Shutter::kRate));
  registry.add("libgazebo_ros_triggered_camera.so", gazebo_camera_factory(Shutter::kTrigger));
  registry.add("libgazebo_ros_depth_camera.so", gazebo_depth_camera_factory());
  registry.add("libgazebo_ros_openni_kinect.so", gazebo_kinect_factory());
  registry.add("libgazebo_ros_multicamera.so", gazebo_multicamera_factory(Shutter::kRate));
  registry.add("libgazebo_ros_triggered_multicamera.so",
               gazebo_multicamera_factory(Shutter::kTrigger));
  registry.add("librotors_gazebo_noisydepth_plugin.so", noisy_depth_camera_factory());
  registry.add("libtrident_camera.so", camera_factory());
  registry.add("libtrident_follow.so", follow_factory());
  registry.add("libtrident_lidar3d.so", point_lidar_factory());
  registry.add("libgazebo_ros_velodyne_laser.so", velodyne_laser_factory());
  registry.add("libgazebo_ros_velodyne_gpu_laser.so", velodyne_laser_factory());
  registry.add("libgazebo_ros_range.so", range_factory());
  registry.add("libgazebo_ros_block_laser.so", block_laser_factory());
  registry.add("libgazebo_ros_bumper.so", bumper_factory());
  registry.add("libtrident_gnss.so", gnss_factory());
  registry.add("libtrident_anemometer.so", anemometer_factory());
  registry.add("libtrident_wheel_encoder.so", wheel_encoder_factory());
  registry.add("libgazebo_ros_imu.so", gazebo_imu_factory());
  registry.add("libgazebo_ros_imu_sensor.so", gazebo_imu_sensor_factory());
  registry.add("libhector_gazebo_ros_imu.so", hector_imu_factory());
  registry.add("libhector_gazebo_ros_gps.so", hector_gps_factory());
  registry.add("libhector_gazebo_ros_magnetic.so", hector_magnetic_factory());
  registry.add("libhector_gazebo_ros_baro.so", hector_baro_factory());
  registry.add("libhector_gazebo_ros_sonar.so", hector_sonar_factory());
  registry.add("libtrident_sea.so", sea_factory());
  registry.add("libtrident_environment.so", sea_factory());
  registry.add("libWavefieldModelPlugin.so", vrx_wave_field_factory());
  registry.add("libwavefield_model_plugin.so", vrx_wave_field_factory());
  registry.add("libtrident_vessel.so", vessel_factory());
  registry.add("libtrident_mooring.so", mooring_factory());
  registry.add("libtrident_propeller.so", propeller_factory());
  registry.add("libfreefloating_gazebo_control.so", freefloating_control_factory());
  registry.add("libfreefloating_gazebo_fluid.so", freefloating_fluid_factory());
  registry.add("libusv_gazebo_dynamics_plugin.so", usv_dynamics_factory());
  registry.add("libusv_gazebo_thrust_plugin.so", usv_thrust_factory());
  registry.add("libusv_gazebo_wind_plugin.so", usv_wind_factory());
  registry.add("libbuoyancy_gazebo_plugin.so", buoyancy_factory());
  registry.add("libuuv_thruster_ros_plugin.so", uuv_thruster_factory());
  registry.add("libuuv_underwater_object_ros_plugin.so", uuv_object_factory());
  registry.add("librotors_gazebo_ros_interface_plugin.so", nothing_to_do());
  registry.add(
      "librotors_gazebo_bag_plugin.so",
      told_once("bags are recorded by 'rosbag record' (launch argument record), not by the "
                "simulator; enable_logging has no effect"));
}

}  // namespace trident::sim
