// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "golden_world.h"

#include "golden_data.h"

namespace trident::sim {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t i = text.find(from); i != std::string::npos;
       i = text.find(from, i + to.size())) {
    text.replace(i, from.size(), to);
  }
  return text;
}

}  // namespace

GoldenWorld::GoldenWorld(const std::string& world_file) {
  register_builtin_plugins(registry_);
  control::register_control_plugins(registry_);
  const Resources resources({std::string(TRIDENT_REPOSITORY) + "/worlds/models"});
  world_ = std::make_unique<World>(load_world_file(world_file, resources, [](const auto&) {}),
                                   resources, registry_, WorldOptions{});
}

Model& GoldenWorld::add_firefly(const std::string& name, const SE3& T_world_model,
                                bool with_controller) {
  const std::string params = golden_folder() + "/params/";
  std::string urdf = replaced(read_file(params + "firefly.urdf"), "firefly", name);
  if (with_controller) {
    const std::string plugin =
        "<gazebo><plugin filename='libtrident_lee_position_controller.so' name='lee'>"
        "<robotNamespace>" +
        name + "</robotNamespace><parameterFiles>" + params + "lee_controller_firefly.yaml " +
        params + "firefly.yaml</parameterFiles></plugin></gazebo>";
    urdf.insert(urdf.rfind("</robot>"), plugin);
  }
  return world_->spawn({name, urdf, "", name, T_world_model});
}

void GoldenWorld::command(const std::string& name, const Eigen::Vector3d& p_world, double yaw_rad) {
  control::TimedSetpoint setpoint;
  setpoint.point.p_world = p_world;
  setpoint.point.yaw = yaw_rad;
  world_->ports()
      .find_in<control::TrajectorySample>(name + "/command/trajectory")
      ->write({{0}, {setpoint}});
}

}  // namespace trident::sim
