// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "bindings.h"
#include "sample_class.h"

namespace trident {
namespace {

Matrix6RowMajor to_matrix(const Covariance6& values) {
  return Eigen::Map<const Matrix6RowMajor>(values.data());
}

Matrix3RowMajor to_matrix(const std::array<double, 9>& values) {
  return Eigen::Map<const Matrix3RowMajor>(values.data());
}

void bind_odometry(py::module_& module) {
  auto odometry = stamped<OdometrySample>(
      module, "OdometrySample",
      "Pose of child_frame in parent_frame, twist in child_frame, as nav_msgs/Odometry has them.");
  add_pose(odometry, &OdometrySample::T_parent_child);
  odometry.def_readonly("parent_frame", &OdometrySample::parent_frame, "Frame of the pose.")
      .def_readonly("child_frame", &OdometrySample::child_frame, "Frame of the twist.")
      .def_property_readonly(
          "linear_velocity", [](const OdometrySample& s) { return s.v_child; },
          "In child_frame [m/s], shape (3,).")
      .def_property_readonly(
          "angular_velocity", [](const OdometrySample& s) { return s.w_child; },
          "In child_frame [rad/s], shape (3,).")
      .def_property_readonly(
          "pose_covariance", [](const OdometrySample& s) { return to_matrix(s.pose_covariance); },
          "x y z, rotation x y z [m, rad], shape (6, 6).")
      .def_property_readonly(
          "twist_covariance", [](const OdometrySample& s) { return to_matrix(s.twist_covariance); },
          "Linear x y z, angular x y z [m/s, rad/s], shape (6, 6).");
}

template <class Sample>
void bind_transform(py::module_& module, const char* name, const char* doc) {
  auto transform = stamped<Sample>(module, name, doc);
  transform.def_property_readonly(
      "position", [](const Sample& s) { return s.T_parent_child.p; },
      "Origin of child_frame in parent_frame [m], shape (3,).");
  transform.def_property_readonly(
      "orientation", [](const Sample& s) { return xyzw(s.T_parent_child.R); },
      "Of child_frame in parent_frame, quaternion x y z w, shape (4,).");
  transform.def_readonly("parent_frame", &Sample::parent_frame, "Frame that the values are in.")
      .def_readonly("child_frame", &Sample::child_frame, "Frame whose pose it is.");
}

void bind_poses(py::module_& module) {
  auto pose = stamped<PoseSample>(module, "PoseSample", "Pose of a body in frame.");
  add_pose(pose, &PoseSample::T_frame_body);
  pose.def_readonly("frame", &PoseSample::frame, "Frame that the values are in.");
  auto covered = stamped<PoseWithCovarianceSample>(module, "PoseWithCovarianceSample",
                                                   "Pose of a body in frame, with covariance.");
  add_pose(covered, &PoseWithCovarianceSample::T_frame_body);
  covered.def_readonly("frame", &PoseWithCovarianceSample::frame, "Frame that the values are in.")
      .def_property_readonly(
          "covariance", [](const PoseWithCovarianceSample& s) { return to_matrix(s.covariance); },
          "x y z, rotation x y z [m, rad], shape (6, 6).");
  stamped<PointSample>(module, "PointSample", "Position of a body in frame.")
      .def_readonly("frame", &PointSample::frame, "Frame that the values are in.")
      .def_property_readonly(
          "position", [](const PointSample& s) { return s.p_frame; },
          "Of the body in frame [m], shape (3,).");
  bind_transform<TransformSample>(module, "TransformSample",
                                  "Pose of child_frame in parent_frame.");
  bind_transform<FrameSample>(module, "FrameSample",
                              "Pose of child_frame in parent_frame, for the tree of frames.");
}

void bind_imu(py::module_& module) {
  stamped<ImuSample>(module, "ImuSample", "What an inertial measurement unit measures.")
      .def_readonly("frame", &ImuSample::frame, "Frame of the IMU.")
      .def_property_readonly(
          "orientation", [](const ImuSample& s) { return xyzw(s.R_world_imu); },
          "Of the IMU in the world, quaternion x y z w, shape (4,).")
      .def_property_readonly(
          "angular_velocity", [](const ImuSample& s) { return s.w_imu; },
          "In frame [rad/s], shape (3,).")
      .def_property_readonly(
          "linear_acceleration", [](const ImuSample& s) { return s.a_imu; },
          "Specific force in frame [m/s^2], shape (3,).")
      .def_property_readonly(
          "orientation_covariance",
          [](const ImuSample& s) { return to_matrix(s.orientation_covariance); },
          "Rotation x y z [rad], shape (3, 3).")
      .def_property_readonly(
          "angular_velocity_covariance",
          [](const ImuSample& s) { return to_matrix(s.gyro_covariance); },
          "x y z in frame [rad/s], shape (3, 3).")
      .def_property_readonly(
          "linear_acceleration_covariance",
          [](const ImuSample& s) { return to_matrix(s.accel_covariance); },
          "x y z in frame [m/s^2], shape (3, 3).");
}

void bind_others(py::module_& module) {
  stamped<JointStateSample>(module, "JointStateSample", "Joint angles and rates.")
      .def_readonly("frame", &JointStateSample::frame, "Of the header; joint angles have none.")
      .def_readonly("names", &JointStateSample::names, "Joint names, n of them.")
      .def_property_readonly(
          "positions", [](const JointStateSample& s) { return to_numpy(s.positions); },
          "Angles [rad] or lengths [m], shape (n,).")
      .def_property_readonly(
          "velocities", [](const JointStateSample& s) { return to_numpy(s.velocities); },
          "Rates [rad/s] or [m/s], shape (n,); shape (0,) where they are not told.");
  stamped<ScalarSample>(module, "ScalarSample", "One number.")
      .def_readonly("value", &ScalarSample::value, "SI unit of the quantity.");
  stamped<WrenchSample>(module, "WrenchSample", "Force and torque in frame.")
      .def_readonly("frame", &WrenchSample::frame, "Frame that the values are in.")
      .def_property_readonly(
          "force", [](const WrenchSample& s) { return s.force; }, "In frame [N], shape (3,).")
      .def_property_readonly(
          "torque", [](const WrenchSample& s) { return s.torque; }, "In frame [N m], shape (3,).");
}

}  // namespace

void bind_measurements(py::module_& module) {
  bind_odometry(module);
  bind_poses(module);
  bind_imu(module);
  bind_others(module);
}

}  // namespace trident
