// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lee_quad.h"

#include <sstream>

namespace trident::sim {

LeeQuad::LeeQuad(double controller_mass_kg, const QuadOptions& quad_options)
    : options(quad_options) {
  std::ostringstream vehicle;
  vehicle << "mass: " << controller_mass_kg
          << "\ninertia: {xx: 0.01, xy: 0, xz: 0, yy: 0.011, yz: 0, "
          << "zz: 0.018}\nrotor_configuration:\n";
  for (int i = 0; i < 4; ++i) {
    vehicle << "  '" << i << "': {angle: " << i * 1.5707963267948966
            << ", arm_length: " << options.arm_m
            << ", rotor_force_constant: " << options.motor_constant
            << ", rotor_moment_constant: " << options.moment_constant
            << ", direction: " << (i % 2 == 0 ? -1.0 : 1.0) << "}\n";
  }
  files_ = folder_.write("vehicle.yaml", vehicle.str()) + " " +
           folder_.write("gains.yaml",
                         "position_gain: {x: 4, y: 4, z: 4}\nvelocity_gain: {x: 3, y: 3, z: 3}\n"
                         "attitude_gain: {x: 0.7, y: 0.7, z: 0.035}\n"
                         "angular_rate_gain: {x: 0.1, y: 0.1, z: 0.025}\n");
}

ModelSpec LeeQuad::model() const {
  ModelSpec spec = make_quad(options);
  spec.plugins.push_back(make_plugin("lee", "libtrident_lee_position_controller.so",
                                     {{"robotNamespace", options.robot_namespace},
                                      {"odometryTopic", "odometry"},
                                      {"parameterFiles", files_}}));
  return spec;
}

}  // namespace trident::sim
