// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "models.h"
#include "test_world.h"

namespace trident::sim {

/// A quadrotor high above nothing.
class QuadWorld {
 public:
  explicit QuadWorld(const QuadOptions& quad_options = {}, LoopTiming timing = LoopTiming::kRotors);

  World* operator->() { return &*world; }
  Body& body() { return *quad->bodies[0]; }
  /// Writes rotor speeds [rad/s] stamped `stamp` (0: unstamped) to command/motor_speed.
  void command(const std::vector<double>& speeds_rad_s, SimTime stamp = {});
  void command_all(double speed_rad_s) { command(std::vector<double>(4, speed_rad_s)); }
  /// Commands all motors, holds the quad until their filters have settled, commands them again.
  void settle(const std::vector<double>& speeds_rad_s);
  /// Signed speed of a rotor [rad/s].
  double rotor(int number) const;

  QuadOptions options;
  TestWorld world;
  Model* quad;
};

}  // namespace trident::sim
