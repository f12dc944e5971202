// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugins/plugins.h"

#include <fnmatch.h>
#include <ros/console.h>

#include <algorithm>
#include <initializer_list>

#include "trident_base/string_util.h"

namespace trident::mavros {
namespace {

/// Names that lists of upstream have; their messages alone exist here, or they are older names.
constexpr std::initializer_list<const char*> kMessagesAlone = {"adsb",
                                                               "cam_imu_sync",
                                                               "camera",
                                                               "cellular_status",
                                                               "dummy",
                                                               "esc_telemetry",
                                                               "guided_target",
                                                               "image_pub",
                                                               "imu_pub",
                                                               "landing_target",
                                                               "mag_calibration_status",
                                                               "mount_control",
                                                               "play_tune",
                                                               "terrain",
                                                               "tunnel"};

bool fits_any(const std::string& name, const std::vector<std::string>& globs) {
  return std::any_of(globs.begin(), globs.end(),
                     [&](const std::string& glob) { return fits_glob(name, glob); });
}

void warn_of_unknown(const std::vector<std::string>& globs) {
  std::vector<std::string> known(kMessagesAlone.begin(), kMessagesAlone.end());
  for (const PluginEntry& entry : all_plugins()) known.emplace_back(entry.name);
  for (const std::string& glob : globs) {
    const bool fits = std::any_of(known.begin(), known.end(),
                                  [&](const std::string& name) { return fits_glob(name, glob); });
    if (fits) continue;
    const std::string nearest = closest_match(glob, known);
    ROS_WARN("plugin list: '%s' fits no plugin%s", glob.c_str(),
             nearest.empty() ? "" : ("; did you mean '" + nearest + "'?").c_str());
  }
}

}  // namespace

const std::vector<PluginEntry>& all_plugins() {
  static const std::vector<PluginEntry> kPlugins = {
      {"sys_status", make_sys_status},
      {"sys_time", make_sys_time},
      {"command", make_command},
      {"param", make_param},
      {"waypoint", make_waypoint},
      {"geofence", make_geofence},
      {"rallypoint", make_rallypoint},
      {"local_position", make_local_position},
      {"global_position", make_global_position},
      {"home_position", make_home_position},
      {"imu", make_imu},
      {"setpoint_position", make_setpoint_position},
      {"setpoint_velocity", make_setpoint_velocity},
      {"setpoint_accel", make_setpoint_accel},
      {"setpoint_attitude", make_setpoint_attitude},
      {"setpoint_raw", make_setpoint_raw},
      {"manual_control", make_manual_control},
      {"rc_io", make_rc_io},
      {"actuator_control", make_actuator_control},
      {"vfr_hud", make_vfr_hud},
      {"altitude", make_altitude},
      {"wind_estimation", make_wind_estimation},
      {"nav_controller_output", make_nav_controller_output},
      {"3dr_radio", make_3dr_radio},
      {"hil", make_hil},
      {"ftp", make_ftp},
      {"gps_status", make_gps_status},
      {"odom", make_odom},
      {"vision_pose_estimate", make_vision_pose_estimate},
      {"vision_speed_estimate", make_vision_speed_estimate},
      {"mocap_pose_estimate", make_mocap_pose_estimate},
      {"distance_sensor", make_distance_sensor},
      {"vibration", make_vibration},
      {"debug_value", make_debug_value},
      {"setpoint_trajectory", make_setpoint_trajectory},
      {"trajectory", make_trajectory},
      {"companion_process_status", make_companion_process_status},
      {"onboard_computer_status", make_onboard_computer_status},
      {"obstacle_distance", make_obstacle_distance},
      {"gps_input", make_gps_input},
      {"gps_rtk", make_gps_rtk},
      {"safety_area", make_safety_area},
      {"esc_status", make_esc_status},
      {"log_transfer", make_log_transfer},
      {"px4flow", make_px4flow},
      {"rangefinder", make_rangefinder},
      {"fake_gps", make_fake_gps},
      {"wheel_odometry", make_wheel_odometry},
  };
  return kPlugins;
}

bool fits_glob(const std::string& name, const std::string& glob) {
  return fnmatch(glob.c_str(), name.c_str(), 0) == 0;
}

bool is_wanted(const std::string& name, const MavrosParams& params) {
  const bool is_denied =
      fits_any(name, params.plugin_blacklist) || fits_any(name, params.plugin_denylist);
  return !is_denied || fits_any(name, params.plugin_whitelist) ||
         fits_any(name, params.plugin_allowlist);
}

std::vector<std::unique_ptr<Plugin>> make_plugins(Hub& hub) {
  const MavrosParams& params = hub.params;
  for (const auto* list : {&params.plugin_blacklist, &params.plugin_whitelist,
                           &params.plugin_denylist, &params.plugin_allowlist}) {
    warn_of_unknown(*list);
  }
  std::vector<std::unique_ptr<Plugin>> plugins;
  for (const PluginEntry& entry : all_plugins()) {
    if (is_wanted(entry.name, params)) plugins.push_back(entry.make(hub));
  }
  return plugins;
}

}  // namespace trident::mavros
