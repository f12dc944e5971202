// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_estimation/filter/model.h"

namespace trident::estimation {

/// What is believed of one robot. `world` is the common frame, ENU; `map` the robot's own, in which
/// its SLAM or odometry says where it is. Maps are level: they differ from the world by a position
/// and a heading.
struct RobotState {
  SE3 T_world_base;
  Eigen::Vector3d v_base = Eigen::Vector3d::Zero();       ///< of the base's origin [m/s]
  Eigen::Vector3d w_base = Eigen::Vector3d::Zero();       ///< angular velocity [rad/s]
  Eigen::Vector3d p_world_map = Eigen::Vector3d::Zero();  ///< [m]
  double yaw_world_map = 0.0;                             ///< [rad]

  SE3 T_world_map() const;  ///< as a transform
};

/// How a robot may move. Velocities along the base's axes come and go: each is an
/// Ornstein-Uhlenbeck process with this standard deviation and time constant, and roll and pitch
/// are drawn back to level.
struct RobotMotion {
  Eigen::Vector3d speed = {2.0, 2.0, 1.0};  ///< standard deviation of v_base [m/s]
  Eigen::Vector3d turn = {0.2, 0.2, 0.5};   ///< of w_base, about x, y, z [rad/s]
  double speed_time = 4.0;                  ///< in which a velocity is forgotten [s]
  double turn_time = 0.5;                   ///< the same of an angular velocity [s]
  double leveling = 2.0;    ///< natural frequency of roll and pitch; 0: nothing levels [rad/s]
  double map_drift = 0.05;  ///< of the map's position, in each direction [m/sqrt(s)]
  double map_turn = 0.002;  ///< of the map's heading [rad/sqrt(s)]

  /// Throws Error for what is not positive (`leveling`, drifts: negative), or not finite.
  void validate() const;
};

/// A robot before anything was measured.
struct RobotStart {
  RobotMotion motion;
  Eigen::Vector3d p_world_map = Eigen::Vector3d::Zero();  ///< [m]
  double yaw_world_map = 0.0;                             ///< [rad]
  double map_sigma = 1.0;                                 ///< of p_world_map [m]
  double map_yaw_sigma = 0.1;                             ///< [rad]
  SE3 T_map_base;                                         ///< where it is in its map
  double base_sigma = 0.5;                                ///< of that position [m]
  double base_turn_sigma = 0.1;                           ///< of that rotation [rad]
};

/// The motion of a team: robots move and their maps drift without regard to one another. State of
/// each robot: position [m], quaternion (w, x, y, z), v_base [m/s], w_base [rad/s], position [m]
/// and heading [rad] of its map. Its degrees of freedom: position (world), rotation (base, at the
/// right), v_base, w_base, position and heading of its map.
class TeamModel : public Model {
 public:
  static constexpr Eigen::Index kNumbers = 17;  ///< of a robot in a state
  static constexpr Eigen::Index kDofs = 16;     ///< of a robot
  /// First degree of freedom of each part of a robot.
  enum Dof : int { kPosition = 0, kRotation = 3, kVelocity = 6, kTurn = 9, kMap = 12, kYaw = 15 };

  /// Throws Error for no robots, or motions that are out of range.
  explicit TeamModel(std::vector<RobotMotion> robots);

  std::size_t robots() const { return robots_.size(); }                  ///< how many
  const RobotMotion& motion(std::size_t i) const { return robots_[i]; }  ///< of robot i
  static RobotState robot(const Eigen::VectorXd& x, std::size_t i);      ///< of a team's state
  static void set_robot(const RobotState& robot, std::size_t i, Eigen::VectorXd& x);  ///< the same

  int dim() const override;
  Eigen::VectorXd predict(const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                          double dt) const override;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                           double dt) const override;
  Eigen::MatrixXd noise(const Eigen::VectorXd& x, double dt) const override;
  std::vector<DofRange> groups() const override;
  Eigen::VectorXd boxplus(const Eigen::VectorXd& x, const Eigen::VectorXd& d) const override;
  Eigen::VectorXd boxminus(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const override;

 private:
  std::vector<RobotMotion> robots_;
};

/// A belief to start from, with what a robot's pose and its map's have in common.
struct TeamStart {
  Eigen::VectorXd state;       ///< of a TeamModel of these robots
  Eigen::MatrixXd covariance;  ///< of its degrees of freedom
};

/// Robots at their places in their maps, with velocities that their motions allow.
TeamStart team_start(const std::vector<RobotStart>& robots);

}  // namespace trident::estimation
