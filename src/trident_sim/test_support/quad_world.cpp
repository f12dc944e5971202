// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "quad_world.h"

namespace trident::sim {
QuadWorld::QuadWorld(const QuadOptions& quad_options, LoopTiming timing)
    : options(quad_options),
      world(world_spec(), with_timing(timing)),
      quad(&world.add(make_quad(options))) {}

void QuadWorld::command(const std::vector<double>& speeds_rad_s, SimTime stamp) {
  ActuatorCommand command;
  command.stamp = stamp;
  command.angular_velocities.assign({speeds_rad_s.data(), speeds_rad_s.size()});
  world->ports()
      .find_in<ActuatorCommand>(options.robot_namespace + "/command/motor_speed")
      ->write(command);
}

void QuadWorld::settle(const std::vector<double>& speeds_rad_s) {
  command(speeds_rad_s);
  for (int i = 0; i < 200; ++i) {
    world->step();
    world->set_model_pose(*quad, SE3::identity());
    world->set_model_twist(*quad, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  }
  command(speeds_rad_s);
}

double QuadWorld::rotor(int number) const {
  return options.slowdown *
         quad->find_joint("rotor_" + std::to_string(number) + "_joint")->velocity();
}

}  // namespace trident::sim
