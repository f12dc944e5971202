// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugins/model_params.h"
#include "trident_base/se2.h"
#include "trident_sim/samples.h"

namespace trident::sim {

// What the drives of gazebo_plugins are made of.

/// Where and how fast the base of a vehicle is.
struct BaseState {
  SE3 T_odom_base;
  Eigen::Vector3d v_base = Eigen::Vector3d::Zero(), w_base = Eigen::Vector3d::Zero();
};
/// Of a model in the world. As upstream reports it: velocity along x and y of the heading, yaw
/// rate.
BaseState base_state_in_world(const Model& model);

/// The topic of the odometry and the transform odom -> base.
class OdometryOutput {
 public:
  OdometryOutput(const PluginContext& context, const OdometryNames& names, bool with_topic,
                 bool with_transform);
  void set_covariance(const Covariance6& pose, const Covariance6& twist);
  /// Of x, y and yaw, in place of those of the pose's.
  void set_planar_covariance(const Eigen::Matrix3d& covariance);
  bool wanted() const;
  void publish(SimTime stamp, const BaseState& state);

 private:
  OutHandle<OdometrySample> odometry_;
  OutHandle<FrameSample> frame_;
};

/// Diagonal of x, y and yaw; what does not happen in the plane is unknown (1e12).
Covariance6 planar_covariance(double x, double y, double yaw);

/// Transforms of wheels against the links that carry them.
class WheelFrames {
 public:
  WheelFrames(const PluginContext& context, const std::vector<Joint*>& joints, FramePrefix from);
  void publish(SimTime stamp);

 private:
  std::vector<std::pair<Joint*, OutHandle<FrameSample>>> frames_;
};

/// A wheel turned by a motor of limited torque, whose wanted rate follows a ramp.
class DrivenWheel {
 public:
  /// `acceleration` [m/s^2] at the rim; 0: at once.
  DrivenWheel(Joint& joint, double diameter_m, double torque_limit, double acceleration);

  const Joint& joint() const { return *joint_; }
  double radius_m() const { return radius_m_; }
  /// Of the rim, where the joint has a velocity limit, else infinite [m/s].
  double speed_limit() const;
  void set_speed(double rim_speed) { wanted_ = rim_speed; }
  /// Brakes as hard as the torque can, whatever the acceleration.
  void halt() { wanted_ = ramped_ = 0.0; }
  /// To be called before each step.
  void drive(double dt_s);
  void reset();
  void state(StateArchive& archive) { archive(wanted_, ramped_); }

 private:
  Joint* joint_;
  double radius_m_, torque_limit_, acceleration_;
  double wanted_ = 0.0, ramped_ = 0.0;  ///< of the rim [m/s]
};

/// Turns a steering joint to an angle: at most at `speed`, else as fast as its torque can.
struct Steering {
  Joint* joint;
  double torque_limit;
  double speed;          ///< [rad/s]; 0: no limit
  double tolerance_rad;  ///< within which it rests, where its speed is limited

  /// To be called before each step.
  void aim(double target_rad, double dt_s) const;
};

}  // namespace trident::sim
