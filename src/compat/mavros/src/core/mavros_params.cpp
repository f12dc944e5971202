// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mavros_params.h"

#include <algorithm>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::mavros {
namespace {

/// "0.0003490659 // 0.02 degrees" is text for YAML, and a number for those who wrote it.
void drop_comment(ConfigNode& node) {
  const std::size_t at = node.scalar.find(" //");
  if (node.kind != ConfigNode::Kind::kScalar || at == std::string::npos) return;
  node.scalar.erase(at);
  node.quoted = false;
}

/// One voltage becomes a list of one.
void make_list(ConfigNode& node) {
  if (node.kind != ConfigNode::Kind::kScalar) return;
  ConfigNode list;
  list.kind = ConfigNode::Kind::kSequence;
  list.items.push_back(node);
  node = list;
}

/// ~time: sim is ~time/source: sim.
void accept_source_alone(ros_utils::NodeParams& params) {
  const std::optional<ConfigNode> time = params.take("time");
  if (!time) return;
  ConfigNode map = *time;
  if (time->kind == ConfigNode::Kind::kScalar) {
    map = ConfigNode();
    map.kind = ConfigNode::Kind::kMap;
    map.keys = {"source"};
    map.key_lines = {0};
    map.items = {*time};
  }
  params.set("time", map);
}

/// Changes items of a section, if it is set.
template <class Change>
void change_section(ros_utils::NodeParams& params, const std::string& name, const Change& change) {
  std::optional<ConfigNode> section = params.take(name);
  if (!section) return;
  for (std::size_t i = 0; i < section->keys.size(); ++i) {
    change(section->keys[i], section->items[i]);
  }
  params.set(name, *section);
}

/// A sensor with a wrong value is left out: the others, and the vehicle, do not need it.
void read_distance_sensors(ros_utils::NodeParams& params, MavrosParams& result) {
  const std::optional<ConfigNode> section = params.take("distance_sensor");
  if (!section) return;
  for (std::size_t i = 0; i < section->keys.size(); ++i) {
    const std::string& name = section->keys[i];
    if (name == "base_frame_id") continue;  // kept for files: of the transforms that are not sent
    const std::string path = params.name_space() + "/distance_sensor/" + name;
    try {
      ros_utils::NodeParams own(section->items[i], path);
      auto sensor = own.read<DistanceSensorParams>();
      sensor.frame_id.insert(0, result.frame_prefix);
      result.distance_sensor.emplace(name, sensor);
      for (const std::string& warning : own.warnings()) params.add_warning(warning);
    } catch (const ConfigError& error) {
      result.problems.push_back(std::string("distance_sensor: this sensor is left out: ") +
                                error.what());
    }
  }
}

bool is_wheel(const std::string& key) {
  return key.rfind("wheel", 0) == 0 && key.size() > 5 &&
         key.find_first_not_of("0123456789", 5) == std::string::npos;
}

/// The odometry is that of wheel0 and wheel1; files have those of all wheels. One without a value
/// is left out: a parameter server keeps a section whose last parameter was deleted.
bool is_needed(const std::string& key, const ConfigNode& value) {
  if (!is_wheel(key)) return true;
  const bool has_value = value.kind != ConfigNode::Kind::kMap || !value.keys.empty();
  return has_value && (key == "wheel0" || key == "wheel1");
}

void drop_more_wheels(ros_utils::NodeParams& params) {
  std::optional<ConfigNode> section = params.take("wheel_odometry");
  if (!section) return;
  ConfigNode kept = *section;
  kept.keys.clear();
  kept.key_lines.clear();
  kept.items.clear();
  for (std::size_t i = 0; i < section->keys.size(); ++i) {
    const std::string& key = section->keys[i];
    const ConfigNode& value = section->items[i];
    if (!is_needed(key, value)) continue;
    kept.keys.push_back(key);
    kept.key_lines.push_back(section->key_lines[i]);
    kept.items.push_back(value);
  }
  params.set("wheel_odometry", kept);
}

void check_time(const std::string& time) {
  const std::vector<std::string> legal{"auto", "sim", "fcu", "wall"};
  if (std::find(legal.begin(), legal.end(), time) != legal.end()) return;
  throw Error("parameter ~time/source is '" + time + "', legal: auto, sim, fcu, wall");
}

/// "uav1/" of /uav1/mavros; empty where the node's name is all there is.
std::string prefix_of(const std::string& node_name) {
  const std::size_t end = node_name.rfind('/');
  if (end == std::string::npos || end == 0) return "";
  return node_name.substr(1, end);
}

void prefix_frames(MavrosParams& params) {
  const std::string& prefix = params.frame_prefix;
  WheelOdometryParams& wheels = params.wheel_odometry;
  for (std::string* const frame :
       {&params.imu.frame_id, &wheels.frame_id, &wheels.child_frame_id}) {
    frame->insert(0, prefix);
  }
  for (TfParams* const tf : {&params.setpoint_position.tf, &params.setpoint_attitude.tf,
                             &params.vision_pose.tf, &params.fake_gps.tf, &wheels.tf}) {
    tf->frame_id.insert(0, prefix);
    tf->child_frame_id.insert(0, prefix);
  }
  for (PositionParams* const position : {&params.global_position, &params.local_position}) {
    for (std::string* const frame : {&position->frame_id, &position->child_frame_id,
                                     &position->tf.frame_id, &position->tf.child_frame_id}) {
      frame->insert(0, prefix);
    }
  }
}

}  // namespace

MavrosParams read_mavros_params(ros_utils::NodeParams& params, const std::string& node_name) {
  const bool has_prefix = params.find("frame_prefix") != nullptr;
  change_section(params, "imu",
                 [](const std::string& /*key*/, ConfigNode& node) { drop_comment(node); });
  change_section(params, "sys", [](const std::string& key, ConfigNode& node) {
    if (key == "min_voltage") make_list(node);
  });
  accept_source_alone(params);
  drop_more_wheels(params);
  auto result = params.read<MavrosParams>();
  if (!has_prefix) result.frame_prefix = prefix_of(node_name);
  prefix_frames(result);
  check_time(result.time.source);
  read_distance_sensors(params, result);
  // Sections of plugins that need no parameters here, or that are messages alone.
  params.accept({"param", "safety_area", "image", "gps_input", "landing_target", "mocap", "mount",
                 "odometry", "px4flow", "vision_speed", "vibration", "camera", "guided_target",
                 "obstacle", "gcs_bridge", "hil", "gps_rtk", "trajectory"});
  return result;
}

}  // namespace trident::mavros
