// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <iterator>
#include <string>

namespace trident::sim {

/// Whether no report is needed that a plugin does not read an element: it means nothing here,
/// or Gazebo's plugin of that name does not read it either though published vehicles have it.
/// Of any plugin: every plugin here is always on, logs go to one place, libsdformat marks what it
/// has changed, and a namespace is given to all.
inline bool is_ignored_everywhere(const std::string& element) {
  return element == "robotNamespace" || element == "alwaysOn" || element == "rosDebugLevel" ||
         element.find("::") != std::string::npos;
}

/// Whether `filename` names the library of `plugin`, with or without what a file's name adds.
inline bool is_library_of(const std::string& filename, const std::string& plugin) {
  return filename == plugin || filename == "lib" + plugin + ".so";
}

inline bool is_ignored_element(const std::string& filename, const std::string& element) {
  if (is_ignored_everywhere(element)) return true;
  struct Ignored {
    const char *plugin, *element;
  };
  // Neither is read by gazebo_plugins (Noetic); as found on TurtleBot3, Husky, RotorS' sensors and
  // the robots that copied them.
  static constexpr Ignored kIgnored[] = {
      {"gazebo_ros_camera", "baseline"},
      {"gazebo_ros_depth_camera", "baseline"},
      {"gazebo_ros_openni_kinect", "baseline"},
      {"gazebo_ros_diff_drive", "publishOdom"},
      {"gazebo_ros_diff_drive", "torque"},
      {"gazebo_ros_imu", "imu"},
      {"gazebo_ros_imu_sensor", "bodyName"},
      {"gazebo_ros_imu_sensor", "imu"},
      {"gazebo_ros_skid_steer_drive", "MaxForce"},
      {"gazebo_ros_skid_steer_drive", "topicName"},
      {"hector_gazebo_ros_imu", "imu"},
  };
  constexpr char kDistortion[] = "distortion_";  // they read distortionK1
  if (filename.find("gazebo_ros_openni_kinect") != std::string::npos &&
      element.rfind(kDistortion, 0) == 0) {
    return true;
  }
  return std::any_of(std::begin(kIgnored), std::end(kIgnored), [&](const Ignored& ignored) {
    return element == ignored.element && is_library_of(filename, ignored.plugin);
  });
}

}  // namespace trident::sim
