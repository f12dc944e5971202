// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Eigen>
#include <Eigen/StdVector>
#include <cstdint>
#include <deque>
#include <sstream>
#include <string>
#include <vector>

#include "mav_msgs/common.h"

/// Eigen counterparts of the vehicle messages. Suffixes name the frame a vector is expressed in:
/// _W world (ENU), _B body (x forward, z up); orientation_W_B rotates body vectors into the world.
/// Units are SI; times are integer nanoseconds.
namespace mav_msgs {

/// Degrees of freedom that a vehicle can follow: position and yaw, or the full pose.
enum MavActuation { DOF4 = 4, DOF6 = 6 };

/// mav_msgs/AttitudeThrust.
struct EigenAttitudeThrust {
  EigenAttitudeThrust() = default;
  /// In the order of the members.
  EigenAttitudeThrust(const Eigen::Quaterniond& _attitude, const Eigen::Vector3d& _thrust)
      : attitude(_attitude), thrust(_thrust) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< R_world_body
  Eigen::Vector3d thrust = Eigen::Vector3d::Zero();              ///< [N], body
};

/// mav_msgs/Actuators; each vector has one entry per actuator, or none.
struct EigenActuators {
  EigenActuators() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): users pass a plain vector.
  EigenActuators(const Eigen::VectorXd& _angular_velocities)
      : angular_velocities(_angular_velocities) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  Eigen::VectorXd angles;              ///< [rad]
  Eigen::VectorXd angular_velocities;  ///< [rad/s]
  Eigen::VectorXd normalized;          ///< -1 .. 1
};

/// mav_msgs/RateThrust.
struct EigenRateThrust {
  EigenRateThrust() = default;
  /// In the order of the members.
  EigenRateThrust(const Eigen::Vector3d& _angular_rates, const Eigen::Vector3d& _thrust)
      : angular_rates(_angular_rates), thrust(_thrust) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  Eigen::Vector3d angular_rates = Eigen::Vector3d::Zero();  ///< [rad/s], body
  Eigen::Vector3d thrust = Eigen::Vector3d::Zero();         ///< [N], body
};

/// mav_msgs/TorqueThrust.
struct EigenTorqueThrust {
  EigenTorqueThrust() = default;
  /// In the order of the members.
  EigenTorqueThrust(const Eigen::Vector3d& _torque, const Eigen::Vector3d& _thrust)
      : torque(_torque), thrust(_thrust) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m], body
  Eigen::Vector3d thrust = Eigen::Vector3d::Zero();  ///< [N], body
};

/// mav_msgs/RollPitchYawrateThrust.
struct EigenRollPitchYawrateThrust {
  EigenRollPitchYawrateThrust() = default;
  /// In the order of the members.
  EigenRollPitchYawrateThrust(double _roll, double _pitch, double _yaw_rate,
                              const Eigen::Vector3d& _thrust)
      : roll(_roll), pitch(_pitch), yaw_rate(_yaw_rate), thrust(_thrust) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  double roll = 0.0;                                 ///< [rad]
  double pitch = 0.0;                                ///< [rad]
  double yaw_rate = 0.0;                             ///< [rad/s]
  Eigen::Vector3d thrust = Eigen::Vector3d::Zero();  ///< [N], body
};

/// State of a vehicle with the specific force that its accelerometer would read.
class EigenMavState {
 public:
  /// Allocated as Eigen's fixed-size members require.
  using Vector = std::vector<EigenMavState, Eigen::aligned_allocator<EigenMavState>>;
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

  EigenMavState() = default;
  /// In the order of the members.
  EigenMavState(const Eigen::Vector3d& _position_W, const Eigen::Vector3d& _velocity_W,
                const Eigen::Vector3d& _acceleration_B, const Eigen::Quaterniond& _orientation_W_B,
                const Eigen::Vector3d& _angular_velocity_B,
                const Eigen::Vector3d& _angular_acceleration_B)
      : position_W(_position_W),
        velocity_W(_velocity_W),
        acceleration_B(_acceleration_B),
        orientation_W_B(_orientation_W_B),
        angular_velocity_B(_angular_velocity_B),
        angular_acceleration_B(_angular_acceleration_B) {}

  /// One line per member, for logs.
  std::string toString() const {
    const Eigen::Quaterniond& q = orientation_W_B;
    std::ostringstream out;
    out << "position_W: " << position_W.transpose() << "\nvelocity_W: " << velocity_W.transpose()
        << "\nacceleration_B: " << acceleration_B.transpose()
        << "\norientation_W_B (w x y z): " << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z()
        << "\nangular_velocity_B: " << angular_velocity_B.transpose()
        << "\nangular_acceleration_B: " << angular_acceleration_B.transpose() << '\n';
    return out.str();
  }

  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();      ///< of the body's origin [m]
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d acceleration_B = Eigen::Vector3d::Zero();  ///< specific force [m/s^2]
  Eigen::Quaterniond orientation_W_B = Eigen::Quaterniond::Identity();  ///< R_world_body
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();         ///< [rad/s]
  Eigen::Vector3d angular_acceleration_B = Eigen::Vector3d::Zero();     ///< [rad/s^2]
};

/// One point of a reference trajectory.
struct EigenTrajectoryPoint {
  /// Allocated as Eigen's fixed-size members require.
  using Vector = std::vector<EigenTrajectoryPoint, Eigen::aligned_allocator<EigenTrajectoryPoint>>;

  EigenTrajectoryPoint() = default;
  /// In the order of the members; timestamp_ns stays unknown.
  EigenTrajectoryPoint(int64_t _time_from_start_ns, const Eigen::Vector3d& _position,
                       const Eigen::Vector3d& _velocity, const Eigen::Vector3d& _acceleration,
                       const Eigen::Vector3d& _jerk, const Eigen::Vector3d& _snap,
                       const Eigen::Quaterniond& _orientation,
                       const Eigen::Vector3d& _angular_velocity,
                       const Eigen::Vector3d& _angular_acceleration,
                       const MavActuation& _degrees_of_freedom = MavActuation::DOF4)
      : time_from_start_ns(_time_from_start_ns),
        position_W(_position),
        velocity_W(_velocity),
        acceleration_W(_acceleration),
        jerk_W(_jerk),
        snap_W(_snap),
        orientation_W_B(_orientation),
        angular_velocity_W(_angular_velocity),
        angular_acceleration_W(_angular_acceleration),
        degrees_of_freedom(_degrees_of_freedom) {}
  /// The same without an angular acceleration.
  EigenTrajectoryPoint(int64_t _time_from_start_ns, const Eigen::Vector3d& _position,
                       const Eigen::Vector3d& _velocity, const Eigen::Vector3d& _acceleration,
                       const Eigen::Vector3d& _jerk, const Eigen::Vector3d& _snap,
                       const Eigen::Quaterniond& _orientation,
                       const Eigen::Vector3d& _angular_velocity,
                       const MavActuation& _degrees_of_freedom = MavActuation::DOF4)
      : EigenTrajectoryPoint(_time_from_start_ns, _position, _velocity, _acceleration, _jerk, _snap,
                             _orientation, _angular_velocity, Eigen::Vector3d::Zero(),
                             _degrees_of_freedom) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  int64_t timestamp_ns = -1;                                 ///< since the epoch; negative: unknown
  int64_t time_from_start_ns = 0;                            ///< of the trajectory
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();      ///< [m]
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d acceleration_W = Eigen::Vector3d::Zero();  ///< without gravity [m/s^2]
  Eigen::Vector3d jerk_W = Eigen::Vector3d::Zero();          ///< [m/s^3]
  Eigen::Vector3d snap_W = Eigen::Vector3d::Zero();          ///< [m/s^4]
  /// Of DOF4 only the yaw counts.
  Eigen::Quaterniond orientation_W_B = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_W = Eigen::Vector3d::Zero();      ///< [rad/s]
  Eigen::Vector3d angular_acceleration_W = Eigen::Vector3d::Zero();  ///< [rad/s^2]
  MavActuation degrees_of_freedom = MavActuation::DOF4;  ///< what of the point a vehicle can follow

  double getYaw() const { return yawFromQuaternion(orientation_W_B); }  ///< [rad]
  double getYawRate() const { return angular_velocity_W.z(); }          ///< [rad/s]
  double getYawAcc() const { return angular_acceleration_W.z(); }       ///< [rad/s^2]
  /// The setters leave no roll, no pitch and no rotation about x and y.
  void setFromYaw(double yaw) { orientation_W_B = quaternionFromYaw(yaw); }
  void setFromYawRate(double yaw_rate) { angular_velocity_W << 0.0, 0.0, yaw_rate; }  ///< [rad/s]
  /// [rad/s^2]
  void setFromYawAcc(double yaw_acc) { angular_acceleration_W << 0.0, 0.0, yaw_acc; }

  /// One line per member, for logs.
  std::string toString() const {
    std::ostringstream out;
    out << "position_W: " << position_W.transpose() << "\nvelocity_W: " << velocity_W.transpose()
        << "\nacceleration_W: " << acceleration_W.transpose() << "\njerk_W: " << jerk_W.transpose()
        << "\nsnap_W: " << snap_W.transpose() << "\nyaw: " << getYaw()
        << "\nyaw_rate: " << getYawRate() << "\nyaw_acc: " << getYawAcc() << '\n';
    return out.str();
  }
};

/// The point seen from another fixed frame: lhs maps the point's world into that frame.
inline EigenTrajectoryPoint operator*(const Eigen::Affine3d& lhs, const EigenTrajectoryPoint& rhs) {
  const Eigen::Matrix3d R = lhs.rotation();
  EigenTrajectoryPoint out(rhs);
  out.position_W = lhs * rhs.position_W;
  out.orientation_W_B = Eigen::Quaterniond(R) * rhs.orientation_W_B;
  for (auto member :
       {&EigenTrajectoryPoint::velocity_W, &EigenTrajectoryPoint::acceleration_W,
        &EigenTrajectoryPoint::jerk_W, &EigenTrajectoryPoint::snap_W,
        &EigenTrajectoryPoint::angular_velocity_W, &EigenTrajectoryPoint::angular_acceleration_W}) {
    out.*member = R * rhs.*member;
  }
  return out;
}

/// Odometry: the pose in the world, the twist in the body frame.
struct EigenOdometry {
  EigenOdometry() = default;
  /// In the order of the members; covariances zero, timestamp_ns unknown.
  EigenOdometry(const Eigen::Vector3d& _position, const Eigen::Quaterniond& _orientation,
                const Eigen::Vector3d& _velocity_body, const Eigen::Vector3d& _angular_velocity)
      : position_W(_position),
        orientation_W_B(_orientation),
        velocity_B(_velocity_body),
        angular_velocity_B(_angular_velocity) {}

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  int64_t timestamp_ns = -1;                             ///< since the epoch; negative: unknown
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond orientation_W_B = Eigen::Quaterniond::Identity();  ///< R_world_body
  Eigen::Vector3d velocity_B = Eigen::Vector3d::Zero();                 ///< [m/s]
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();         ///< [rad/s]
  /// Position, then rotation [m^2, rad^2]
  Eigen::Matrix<double, 6, 6> pose_covariance_ = Eigen::Matrix<double, 6, 6>::Zero();
  /// Linear, then angular.
  Eigen::Matrix<double, 6, 6> twist_covariance_ = Eigen::Matrix<double, 6, 6>::Zero();

  double getYaw() const { return yawFromQuaternion(orientation_W_B); }  ///< [rad]
  /// Roll, pitch, yaw [rad], see getEulerAnglesFromQuaternion().
  void getEulerAngles(Eigen::Vector3d* euler_angles) const {
    getEulerAnglesFromQuaternion(orientation_W_B, euler_angles);
  }
  double getYawRate() const { return angular_velocity_B.z(); }  ///< about body z [rad/s]
  /// The setters leave no roll, no pitch and no rotation about x and y.
  void setFromYaw(double yaw) { orientation_W_B = quaternionFromYaw(yaw); }
  void setFromYawRate(double yaw_rate) { angular_velocity_B << 0.0, 0.0, yaw_rate; }  ///< [rad/s]

  Eigen::Vector3d getVelocityWorld() const { return orientation_W_B * velocity_B; }  ///< [m/s]
  /// Sets velocity_B by the present orientation, which must be set before.
  void setVelocityWorld(const Eigen::Vector3d& velocity_world) {
    velocity_B = orientation_W_B.conjugate() * velocity_world;
  }
};

// <Type>Vector and <Type>Deque, allocated as Eigen's fixed-size members require.
#define MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EIGEN_TYPE)                                        \
  using EIGEN_TYPE##Vector = std::vector<EIGEN_TYPE, Eigen::aligned_allocator<EIGEN_TYPE>>; \
  using EIGEN_TYPE##Deque = std::deque<EIGEN_TYPE, Eigen::aligned_allocator<EIGEN_TYPE>>;

MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenAttitudeThrust)
MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenActuators)
MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenRateThrust)
MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenTrajectoryPoint)
MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenRollPitchYawrateThrust)
MAV_MSGS_MAKE_ALIGNED_CONTAINERS(EigenOdometry)

}  // namespace mav_msgs
