// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "planning/curves/lattice_set.h"
#include "trident_base/error.h"

namespace trident::nav {
namespace {

using Json = nlohmann::json;

/// An object of the file with its place in errors.
class LatticeField {
 public:
  LatticeField(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) fail("", "an object");
  }

  [[noreturn]] void fail(const std::string& key, const std::string& legal) const {
    const std::string value = key.empty() || !json_.contains(key) ? "" : json_[key].dump();
    throw Error(place_ + (key.empty() ? "" : "." + key) + ": " +
                (value.empty() ? "missing" : value.substr(0, 60)) + ", legal: " + legal);
  }
  const Json& get(const std::string& key, const std::string& legal) const {
    if (!json_.contains(key)) fail(key, legal);
    return json_[key];
  }
  double number(const std::string& key, double low, const std::string& legal) const {
    const Json& value = get(key, legal);
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < low) {
      fail(key, legal);
    }
    return value.get<double>();
  }
  int index(const std::string& key, std::size_t count) const {
    const std::string legal = "a whole number in [0, " + std::to_string(count - 1) + "]";
    const Json& value = get(key, legal);
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0 ||
        value.get<std::int64_t>() >= static_cast<std::int64_t>(count)) {
      fail(key, legal);
    }
    return value.get<int>();
  }
  const Json& list(const std::string& key) const {
    const Json& value = get(key, "a list");
    if (!value.is_array() || value.empty()) fail(key, "a list that is not empty");
    return value;
  }
  const std::string& place() const { return place_; }

 private:
  const Json& json_;
  std::string place_;
};

std::string read_motion_model(const LatticeField& data) {
  const std::string models = "diff, ackermann or omni";
  const Json& given = data.get("motion_model", models);
  std::string model = given.is_string() ? given.get<std::string>() : "";
  if (model != "diff" && model != "ackermann" && model != "omni") data.fail("motion_model", models);
  return model;
}

void read_metadata(const LatticeField& data, LatticeSet& set) {
  set.motion_model = read_motion_model(data);
  set.turning_radius_m = data.number("turning_radius", 0.0, "a number >= 0 [m]");
  set.resolution_m = data.number("grid_resolution", 1e-6, "a number > 0 [m]");
  for (const Json& angle : data.list("heading_angles")) {
    if (!angle.is_number()) data.fail("heading_angles", "a list of numbers [rad]");
    set.heading_angles.push_back(angle.get<double>());
  }
  if (set.heading_angles.size() > 4096) data.fail("heading_angles", "up to 4096 angles");
}

bool is_triple(const Json& value) {
  return value.is_array() && value.size() == 3 &&
         std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_number(); });
}

std::vector<Pose2> read_poses(const LatticeField& data) {
  std::vector<Pose2> poses;
  for (const Json& pose : data.list("poses")) {
    if (!is_triple(pose)) data.fail("poses", "a list of [x [m], y [m], yaw [rad]]");
    poses.push_back({pose[0].get<double>(), pose[1].get<double>(), pose[2].get<double>()});
  }
  return poses;
}

LatticeTrajectory read_trajectory(const LatticeField& data, const LatticeSet& set) {
  LatticeTrajectory t;
  t.start_angle_index = data.index("start_angle_index", set.heading_angles.size());
  t.end_angle_index = data.index("end_angle_index", set.heading_angles.size());
  const Json& left = data.get("left_turn", "true or false");
  if (!left.is_boolean()) data.fail("left_turn", "true or false");
  t.left_turn = left.get<bool>();
  t.radius_m = data.number("trajectory_radius", 0.0, "a number >= 0 [m]");
  t.length_m = data.number("trajectory_length", 0.0, "a number >= 0 [m]");
  t.arc_length_m = data.number("arc_length", 0.0, "a number >= 0 [m]");
  t.straight_length_m = data.number("straight_length", 0.0, "a number >= 0 [m]");
  t.poses = read_poses(data);
  const double end_yaw = set.heading_angles[static_cast<std::size_t>(t.end_angle_index)];
  if (std::abs(wrap_angle(t.poses.back().yaw - end_yaw)) > 0.01) {
    data.fail("poses", "a list that ends at the heading of end_angle_index");
  }
  return t;
}

Json parse_json(const std::string& text, const std::string& label) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto line =
        1 +
        std::count(text.begin(),
                   text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())),
                   '\n');
    throw Error(label + ":" + std::to_string(line) + ": is not JSON");
  }
}

}  // namespace

LatticeSet parse_lattice(const std::string& text, const std::string& label) {
  const Json json = parse_json(text, label);
  const LatticeField root(json, label);
  LatticeSet set;
  read_metadata(
      LatticeField(root.get("lattice_metadata", "an object"), label + ": lattice_metadata"), set);
  int number = 0;
  for (const Json& primitive : root.list("primitives")) {
    const std::string place = label + ": primitives[" + std::to_string(number++) + "]";
    set.trajectories.push_back(read_trajectory(LatticeField(primitive, place), set));
  }
  if (set.trajectories.size() > 65000) root.fail("primitives", "up to 65000 motions");
  return set;
}

LatticeSet load_lattice(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw Error(path + ": cannot be read");
  return parse_lattice(text.str(), path);
}

std::string lattice_json(const LatticeSet& set) {
  nlohmann::ordered_json json;
  json["version"] = 1.0;
  auto& data = json["lattice_metadata"];
  data["motion_model"] = set.motion_model;
  data["turning_radius"] = set.turning_radius_m;
  data["grid_resolution"] = set.resolution_m;
  data["num_of_headings"] = set.heading_angles.size();
  data["heading_angles"] = set.heading_angles;
  data["number_of_trajectories"] = set.trajectories.size();
  int number = 0;
  for (const LatticeTrajectory& t : set.trajectories) {
    nlohmann::ordered_json primitive;
    primitive["trajectory_id"] = number++;
    primitive["start_angle_index"] = t.start_angle_index;
    primitive["end_angle_index"] = t.end_angle_index;
    primitive["left_turn"] = t.left_turn;
    primitive["trajectory_radius"] = t.radius_m;
    primitive["trajectory_length"] = t.length_m;
    primitive["arc_length"] = t.arc_length_m;
    primitive["straight_length"] = t.straight_length_m;
    for (const Pose2& p : t.poses) primitive["poses"].push_back({p.x, p.y, p.yaw});
    json["primitives"].push_back(primitive);
  }
  return json.dump(1, '\t') + "\n";
}

}  // namespace trident::nav
