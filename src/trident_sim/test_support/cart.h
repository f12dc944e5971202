// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "models.h"
#include "test_world.h"
#include "trident_base/se2.h"

namespace trident::sim {

/// A small cart. Its model frame lies on the ground between the wheels.
struct CartOptions {
  bool four_wheels = false;  ///< skid-steered; else two wheels, and two casters without friction
  double mass_kg = 5.0;      ///< of the chassis
  double wheel_radius_m = 0.1, separation_m = 0.4;
  double wheelbase_m = 0.3;
  double mu = 1.0;
  double velocity_limit_rad_s = 0.0;  ///< of the wheels' joints; 0: none
  ParamList params;                   ///< of the drive, besides what fits the cart
  bool with_drive = true;
  std::vector<PluginSpec> more_plugins;
  SE3 T_world_model;
};

/// Joints: "left", "right", or "left_front", "left_rear", "right_front", "right_rear".
ModelSpec make_cart(const CartOptions& options = {});

/// A cart on a plane, driven through its ports "cmd_vel" and "odom".
class CartWorld {
 public:
  explicit CartWorld(const CartOptions& options = {}, double dt_s = 0.001,
                     const SE3& T_world_ground = {});

  void command(double v, double w);
  void run(double seconds);
  SE2 truth() const { return SE2::projected(model->T_world_model()); }
  /// As the drive reported it last.
  SE2 reported_pose() const { return SE2::projected(odometry->value.T_parent_child); }
  /// Velocity along the heading [m/s].
  double speed() const;

  TestWorld world;
  Model* model;
  OutPort<OdometrySample>* odometry;

 private:
  double dt_s_;
};

}  // namespace trident::sim
