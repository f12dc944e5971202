// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_sim/world.h"

namespace trident::sim {

// What a service names, or an Error that begins with the words of gazebo_ros, which scripts look
// for, and ends with the name.

Model& required_model(const World& world, const std::string& name);
/// "model::link", or a link name that is unique in the world.
Link& required_link(const World& world, const std::string& name);
Link& required_body(const World& world, const std::string& name);
/// A joint's name, or "model::joint" where more than one model has it.
Joint& required_joint(const World& world, const std::string& name);

/// Pose of a reference frame in the world: "", "world", "map" and "/map" are the world; else a
/// model, or a link as "model::link". Throws Error for an unknown name.
struct ReferenceFrame {
  SE3 T_world_frame;
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_world = Eigen::Vector3d::Zero();
};
ReferenceFrame find_reference_frame(const World& world, const std::string& name);

}  // namespace trident::sim
