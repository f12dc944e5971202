// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vessel_model.h"

#include <array>
#include <optional>

#include "trident_base/se3.h"
#include "trident_base/vehicle/thruster_curve.h"

namespace trident::control {
namespace {

using MatrixRows36 = std::array<double, 36>;

struct VesselFile {
  std::string name, axes = "flu";
  bool munk = true;
  double water_density = 1025.0, mass = 0.0;
  Eigen::Vector3d center_of_gravity = Eigen::Vector3d::Zero();
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
  Vector6d added_mass = Vector6d::Zero();
  Vector6d linear_damping = Vector6d::Zero(), quadratic_damping = Vector6d::Zero();
  std::optional<MatrixRows36> added_mass_matrix, linear_damping_matrix, quadratic_damping_matrix;
  std::vector<ThrusterParams> thrusters;
  std::vector<RudderParams> rudders;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name);
    ar.field("axes", axes);
    ar.field("munk", munk);
    ar.field("water_density", water_density, Range::positive());
    ar.required("mass", mass, Range::positive());
    ar.field("center_of_gravity", center_of_gravity);
    ar.required("inertia", inertia, Range::positive());
    ar.field("added_mass", added_mass);
    ar.field("added_mass_matrix", added_mass_matrix);
    ar.field("linear_damping", linear_damping, Range::non_negative());
    ar.field("linear_damping_matrix", linear_damping_matrix);
    ar.field("quadratic_damping", quadratic_damping, Range::non_negative());
    ar.field("quadratic_damping_matrix", quadratic_damping_matrix);
    ar.field("thrusters", thrusters);
    ar.field("rudders", rudders);
  }
  void validate() const {
    if (axes != "flu" && axes != "frd") {
      throw Error("axes = '" + axes + "', legal is flu, frd");
    }
  }
};

/// The names of VesselFile's fields.
struct KeyCollector {
  std::vector<std::string> keys;
  template <class... More>
  void field(const char* name, const More&...) {
    keys.emplace_back(name);
  }
  template <class... More>
  void required(const char* name, const More&...) {
    keys.emplace_back(name);
  }
};

/// The loader refuses unknown keys, but the simulator has keys of its own in the same file.
ConfigNode known_part(const ConfigNode& root) {
  KeyCollector collector;
  VesselFile().visit(collector);
  ConfigNode part = root;
  part.keys.clear(), part.key_lines.clear(), part.items.clear();
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    for (const std::string& key : collector.keys) {
      if (key != root.keys[i]) continue;
      part.keys.push_back(key);
      part.key_lines.push_back(root.key_lines[i]);
      part.items.push_back(root.items[i]);
    }
  }
  return part;
}

/// Surge, sway and yaw of a diagonal or of a matrix's diagonal, which no turn of the axes changes.
Eigen::Vector3d planar(const Vector6d& diagonal, const std::optional<MatrixRows36>& rows) {
  // Rows of 6: elements (0, 0), (1, 1) and (5, 5).
  if (rows) return {(*rows)[0], (*rows)[7], (*rows)[35]};
  return {diagonal[0], diagonal[1], diagonal[5]};
}

/// A half turn about x: y, z and angles about z change their sign.
void turn_into_flu(VesselModel& model) {
  for (ThrusterParams& thruster : model.thrusters) {
    thruster.position.tail<2>() *= -1.0;
    thruster.yaw = -thruster.yaw;
  }
  for (RudderParams& rudder : model.rudders) rudder.position.tail<2>() *= -1.0;
}

}  // namespace

VesselModel load_vessel_model(const std::string& path) {
  const ConfigNode root = parse_yaml(read_config_file(path), path);
  const auto file = load_config_node<VesselFile>(known_part(root), path);
  VesselModel model;
  model.name = file.name;
  // The file has the inertia about the center of gravity; Steiner's theorem moves it to CO.
  const double lever = file.center_of_gravity.head<2>().squaredNorm();
  const Eigen::Vector3d added = planar(file.added_mass, file.added_mass_matrix);
  model.mass = Eigen::Vector3d(file.mass, file.mass, file.inertia.z() + file.mass * lever) + added;
  // The Munk moment is (added mass of sway - added mass of surge) u v.
  model.munk_mass = file.munk ? added[1] - added[0] : 0.0;
  model.linear_damping = planar(file.linear_damping, file.linear_damping_matrix);
  model.quadratic_damping = planar(file.quadratic_damping, file.quadratic_damping_matrix);
  model.water_density = file.water_density;
  model.thrusters = file.thrusters;
  model.rudders = file.rudders;
  if (file.axes == "frd") turn_into_flu(model);
  if (model.thrusters.empty()) {
    throw Error(path + ": thrusters: none, legal, to be controlled, is at least 1");
  }
  for (const ThrusterParams& thruster : model.thrusters) {
    try {
      check_invertible(thruster);
    } catch (const Error& error) {
      throw Error(path + ": " + error.what());
    }
  }
  return model;
}

}  // namespace trident::control
