// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "models.h"
#include "test_world.h"
#include "trident_base/se2.h"

namespace trident::sim {

/// A car with steered front wheels. Its model frame lies on the ground, `front_of_axle_m` ahead of
/// the middle of its rear axle.
struct CarOptions {
  double wheelbase_m = 0.6, track_m = 0.4, wheel_radius_m = 0.1;
  double front_of_axle_m = 0.2;
  double mu = 1.0;
  double steering_stop_rad = 0.9;
  double velocity_limit_rad_s = 0.0;  ///< of the rear wheels' joints; 0: none
  /// One universal joint a front wheel, in place of two revolute ones
  bool universal = false;
  ParamList params;  ///< of the drive, besides its joints
  SE3 T_world_model;
};

/// Joints: front_left, front_right, rear_left, rear_right, and steer_left, steer_right.
ModelSpec make_car(const CarOptions& options = {});

/// A car on a plane, driven through its ports "cmd_vel" and "odom".
class CarWorld {
 public:
  explicit CarWorld(const CarOptions& options = {}, double dt_s = 0.001);

  void command(double v, double w);
  void run(double seconds);
  SE2 truth() const { return SE2::projected(model->T_world_model()); }
  SE2 reported_pose() const { return SE2::projected(odometry->value.T_parent_child); }
  /// Where the middle of the rear axle is.
  Eigen::Vector2d axle() const;
  /// Angles of the left and the right front wheel.
  Eigen::Vector2d wheel_angles() const;
  /// Of the circle about which the middle of the rear axle turns, from three points `seconds`
  /// apart.
  double radius(double seconds);

  TestWorld world;
  Model* model;
  OutPort<OdometrySample>* odometry;

 private:
  CarOptions options_;
  double dt_s_;
};

}  // namespace trident::sim
