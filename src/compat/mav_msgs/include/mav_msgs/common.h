// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>

/// Conversions between geometry_msgs and Eigen, and the rotation algebra they need.
/// Quaternions are Hamilton and rotate from the second frame of their name to the first.
namespace mav_msgs {

/// Within which a matrix counts as a rotation or as skew-symmetric.
const double kSmallValueCheck = 1e-6;
const double kNumNanosecondsPerSecond = 1e9;  ///< a double, so that quotients keep fractions

/// Gravity [m/s^2] at a height [m] and latitude [rad]: the 1967 international gravity formula
/// with the free-air correction.
inline double MagnitudeOfGravity(const double height, const double latitude_radians) {
  const double s1 = std::sin(latitude_radians);
  const double s2 = std::sin(2.0 * latitude_radians);
  return 9.780327 * (1.0 + 0.0053024 * s1 * s1 - 0.0000058 * s2 * s2 - 3.155e-7 * height);
}

/// In the order x, y, z; nothing is checked.
inline Eigen::Vector3d vector3FromMsg(const geometry_msgs::Vector3& msg) {
  return {msg.x, msg.y, msg.z};
}

/// The same of a point.
inline Eigen::Vector3d vector3FromPointMsg(const geometry_msgs::Point& msg) {
  return {msg.x, msg.y, msg.z};
}

/// Unit quaternion of a message; identity when the message was never filled in (all zero).
inline Eigen::Quaterniond quaternionFromMsg(const geometry_msgs::Quaternion& msg) {
  const Eigen::Quaterniond q(msg.w, msg.x, msg.y, msg.z);
  if (q.norm() < std::numeric_limits<double>::epsilon()) return Eigen::Quaterniond::Identity();
  return q.normalized();
}

/// `msg` must not be nullptr, here and below.
inline void vectorEigenToMsg(const Eigen::Vector3d& eigen, geometry_msgs::Vector3* msg) {
  assert(msg != nullptr);
  msg->x = eigen.x();
  msg->y = eigen.y();
  msg->z = eigen.z();
}

/// The same into a point.
inline void pointEigenToMsg(const Eigen::Vector3d& eigen, geometry_msgs::Point* msg) {
  assert(msg != nullptr);
  msg->x = eigen.x();
  msg->y = eigen.y();
  msg->z = eigen.z();
}

/// As it is, without normalizing it.
inline void quaternionEigenToMsg(const Eigen::Quaterniond& eigen, geometry_msgs::Quaternion* msg) {
  assert(msg != nullptr);
  msg->w = eigen.w();
  msg->x = eigen.x();
  msg->y = eigen.y();
  msg->z = eigen.z();
}

/// Yaw [rad] of R = Rz(yaw) Ry(pitch) Rx(roll).
inline double yawFromQuaternion(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

/// A rotation by `yaw` [rad] about z.
inline Eigen::Quaterniond quaternionFromYaw(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

/// Roll, pitch, yaw [rad] of R = Rz(yaw) Ry(pitch) Rx(roll); pitch in [-pi/2, pi/2].
inline void getEulerAnglesFromQuaternion(const Eigen::Quaternion<double>& q,
                                         Eigen::Vector3d* euler_angles) {
  assert(euler_angles != nullptr);
  // Rounding may push the sine of a vertical pitch a hair past one.
  const double sin_pitch = std::fmin(1.0, std::fmax(-1.0, 2.0 * (q.w() * q.y() - q.z() * q.x())));
  euler_angles->x() = std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()),
                                 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()));
  euler_angles->y() = std::asin(sin_pitch);
  euler_angles->z() = yawFromQuaternion(q);
}

/// The same into a message.
inline void setQuaternionMsgFromYaw(double yaw, geometry_msgs::Quaternion* msg) {
  quaternionEigenToMsg(quaternionFromYaw(yaw), msg);
}

/// `yaw_rate` [rad/s] about z; x and y become zero.
inline void setAngularVelocityMsgFromYawRate(double yaw_rate, geometry_msgs::Vector3* msg) {
  vectorEigenToMsg(yaw_rate * Eigen::Vector3d::UnitZ(), msg);
}

/// Matrix [v] with [v] u = v x u.
inline void skewMatrixFromVector(const Eigen::Vector3d& vec, Eigen::Matrix3d* vec_skew) {
  assert(vec_skew != nullptr);
  *vec_skew << 0.0, -vec.z(), vec.y(), vec.z(), 0.0, -vec.x(), -vec.y(), vec.x(), 0.0;
}

/// Inverse of skewMatrixFromVector; false and zero when the matrix is not skew-symmetric.
inline bool vectorFromSkewMatrix(const Eigen::Matrix3d& vec_skew, Eigen::Vector3d* vec) {
  assert(vec != nullptr);
  const bool is_skew = (vec_skew + vec_skew.transpose()).norm() < kSmallValueCheck;
  if (is_skew) {
    *vec << vec_skew(2, 1), vec_skew(0, 2), vec_skew(1, 0);
  } else {
    std::cerr << "[mav_msgs] vectorFromSkewMatrix: the matrix is not skew-symmetric\n";
    vec->setZero();
  }
  return is_skew;
}

/// True for a proper rotation: orthonormal, determinant +1.
inline bool isRotationMatrix(const Eigen::Matrix3d& mat) {
  return (mat.transpose() * mat - Eigen::Matrix3d::Identity()).norm() <= kSmallValueCheck &&
         std::abs(mat.determinant() - 1.0) <= kSmallValueCheck;
}

/// Rodrigues' formula: rotation by |vec| [rad] about vec.
inline void matrixFromRotationVector(const Eigen::Vector3d& vec, Eigen::Matrix3d* mat) {
  assert(mat != nullptr);
  const double angle = vec.norm();
  const Eigen::Vector3d axis =
      angle > 0.0 ? Eigen::Vector3d(vec / angle) : Eigen::Vector3d::UnitX();
  *mat = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Rotation vector [rad] with an angle in [0, pi]; false when mat is not a rotation.
inline bool vectorFromRotationMatrix(const Eigen::Matrix3d& mat, Eigen::Vector3d* vec) {
  assert(vec != nullptr);
  if (!isRotationMatrix(mat)) {
    std::cerr << "[mav_msgs] vectorFromRotationMatrix: not a rotation matrix\n";
    return false;
  }
  const Eigen::AngleAxisd angle_axis(mat);
  *vec = angle_axis.angle() * angle_axis.axis();
  return true;
}

/// Angular velocity [rad/s] in the fixed frame of a rotation vector r(t): the left Jacobian of
/// SO(3) applied to r'. With a = |r|: J = I + (1-cos a)/a^2 [r] + (a-sin a)/a^3 [r]^2.
inline Eigen::Vector3d omegaFromRotationVector(const Eigen::Vector3d& rot_vec,
                                               const Eigen::Vector3d& rot_vec_vel) {
  const double a = rot_vec.norm();
  if (a < 1e-3) return rot_vec_vel;
  const double b = (1.0 - std::cos(a)) / (a * a);
  const double c = (a - std::sin(a)) / (a * a * a);
  const Eigen::Vector3d r_x_v = rot_vec.cross(rot_vec_vel);
  return rot_vec_vel + b * r_x_v + c * rot_vec.cross(r_x_v);
}

/// Angular acceleration [rad/s^2] in the fixed frame of r(t): the time derivative of
/// omegaFromRotationVector.
inline Eigen::Vector3d omegaDotFromRotationVector(const Eigen::Vector3d& rot_vec,
                                                  const Eigen::Vector3d& rot_vec_vel,
                                                  const Eigen::Vector3d& rot_vec_acc) {
  const double a = rot_vec.norm();
  if (a < 1e-3) return rot_vec_acc;
  const double a_dot = rot_vec.dot(rot_vec_vel) / a;
  const double b = (1.0 - std::cos(a)) / (a * a);
  const double c = (a - std::sin(a)) / (a * a * a);
  const double b_dot = a_dot * (std::sin(a) / (a * a) - 2.0 * b / a);
  const double c_dot = a_dot * (b / a - 3.0 * c / a);
  const Eigen::Vector3d r_x_v = rot_vec.cross(rot_vec_vel);
  const Eigen::Vector3d r_x_acc = rot_vec.cross(rot_vec_acc);
  return rot_vec_acc + b_dot * r_x_v + b * r_x_acc + c_dot * rot_vec.cross(r_x_v) +
         c * (rot_vec_vel.cross(r_x_v) + rot_vec.cross(r_x_acc));
}

/// Squared rotor speeds [rad^2/s^2] = A^-1 [J w' + w x J w; m |a|], the wrench that a state of
/// motion needs.
/// @param allocation_inv n x 4 pseudo-inverse of the map from squared speeds to torque and thrust.
/// @param inertia diagonal of J [kg m^2]; mass [kg]; the other vectors in the body frame, SI.
inline void getSquaredRotorSpeedsFromAllocationAndState(
    const Eigen::MatrixXd& allocation_inv, const Eigen::Vector3d& inertia, double mass,
    const Eigen::Vector3d& angular_velocity_B, const Eigen::Vector3d& angular_acceleration_B,
    const Eigen::Vector3d& acceleration_B, Eigen::VectorXd* rotor_rates_squared) {
  assert(rotor_rates_squared != nullptr);
  const Eigen::Vector3d momentum_B = inertia.cwiseProduct(angular_velocity_B);
  Eigen::Vector4d wrench;
  wrench << inertia.cwiseProduct(angular_acceleration_B) + angular_velocity_B.cross(momentum_B),
      mass * acceleration_B.norm();
  *rotor_rates_squared = allocation_inv * wrench;
}

/// Exact up to 2^53 ns, about 104 days; epochs are rounded.
inline double nanosecondsToSeconds(int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNumNanosecondsPerSecond;
}

/// Cuts fractions of a nanosecond off towards zero, as upstream does.
inline int64_t secondsToNanoseconds(double seconds) {
  return static_cast<int64_t>(seconds * kNumNanosecondsPerSecond);
}

}  // namespace mav_msgs
