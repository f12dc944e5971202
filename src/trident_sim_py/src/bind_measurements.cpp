// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "bindings.h"
#include "sample_class.h"
#include "trident_sim/samples/vector_sample.h"

namespace trident::sim {
namespace {

Matrix6RowMajor to_covariance(const Covariance6& values) {
  return Eigen::Map<const Matrix6RowMajor>(values.data());
}

Matrix3RowMajor to_covariance(const std::array<double, 9>& values) {
  return Eigen::Map<const Matrix3RowMajor>(values.data());
}

/// Shape (n, 3).
template <class Scalar>
py::array_t<Scalar> to_rows(const std::vector<Eigen::Matrix<Scalar, 3, 1>>& points) {
  py::array_t<Scalar> result({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      result.mutable_at(static_cast<py::ssize_t>(i), axis) = points[i][axis];
    }
  }
  return result;
}

// Samples are values: properties return copies, which stay as they are while the world steps on.
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
          "pose_covariance",
          [](const OdometrySample& s) { return to_covariance(s.pose_covariance); },
          "x y z, rotation x y z [m, rad], shape (6, 6).")
      .def_property_readonly(
          "twist_covariance",
          [](const OdometrySample& s) { return to_covariance(s.twist_covariance); },
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
  pose.def(py::init([](const py::object& position, double yaw, double stamp) {
             const Eigen::Vector3d p = to_vector3(position, "position");
             return PoseSample{to_time(stamp, "stamp"), "", SE3::from_xyz_rpy(p, 0.0, 0.0, yaw)};
           }),
           py::arg("position"), py::arg("yaw") = 0.0, py::arg("stamp") = 0.0,
           "position: [m], shape (3,).\n"
           "yaw: [rad].\n"
           "stamp: simulated time of the start [s]; 0: at once.")
      .def_readonly("frame", &PoseSample::frame, "Frame that the values are in.");
  auto covered = stamped<PoseWithCovarianceSample>(module, "PoseWithCovarianceSample",
                                                   "Pose of a body in frame, with covariance.");
  add_pose(covered, &PoseWithCovarianceSample::T_frame_body);
  covered.def_readonly("frame", &PoseWithCovarianceSample::frame, "Frame that the values are in.")
      .def_property_readonly(
          "covariance",
          [](const PoseWithCovarianceSample& s) { return to_covariance(s.covariance); },
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
          [](const ImuSample& s) { return to_covariance(s.orientation_covariance); },
          "Rotation x y z [rad], shape (3, 3).")
      .def_property_readonly(
          "angular_velocity_covariance",
          [](const ImuSample& s) { return to_covariance(s.gyro_covariance); },
          "x y z in frame [rad/s], shape (3, 3).")
      .def_property_readonly(
          "linear_acceleration_covariance",
          [](const ImuSample& s) { return to_covariance(s.accel_covariance); },
          "x y z in frame [m/s^2], shape (3, 3).");
}

void bind_laser_scan(py::module_& module) {
  using Scan = LaserScanSample;
  stamped<Scan>(module, "LaserScanSample", "One sweep of a planar lidar; stamp: its first beam.")
      .def_readonly("frame", &Scan::frame, "Frame of the lidar; beams turn about its z.")
      .def_readonly("angle_min", &Scan::angle_min_rad, "Of the first beam [rad].")
      .def_readonly("angle_max", &Scan::angle_max_rad, "Of the last beam [rad].")
      .def_readonly("angle_increment", &Scan::angle_increment_rad, "From beam to beam [rad].")
      .def_readonly("time_increment", &Scan::time_increment_s, "From beam to beam [s].")
      .def_readonly("scan_time", &Scan::scan_time_s, "From scan to scan [s]; 0: not known.")
      .def_readonly("range_min", &Scan::range_min_m, "Smallest range [m].")
      .def_readonly("range_max", &Scan::range_max_m, "Largest range [m].")
      .def_property_readonly(
          "ranges",
          [](const Scan& s) {
            return py::array_t<float>(static_cast<py::ssize_t>(s.ranges.size()), s.ranges.data());
          },
          "[m], shape (n,), float32; inf: nothing in range, -inf: too near.")
      .def_property_readonly(
          "intensities",
          [](const Scan& s) {
            return py::array_t<float>(static_cast<py::ssize_t>(s.intensities.size()),
                                      s.intensities.data());
          },
          "Shape (n,), float32.");
}

/// One copy of the packed points, whose layout numpy's structured type repeats.
py::array_t<LidarPoint> to_structured(const std::vector<LidarPoint>& points) {
  return py::array_t<LidarPoint>(static_cast<py::ssize_t>(points.size()), points.data());
}

void bind_lidar_cloud(py::module_& module) {
  using Cloud = LidarCloudSample;
  // numpy's names are those of the fields of a PointCloud2.
  PYBIND11_NUMPY_DTYPE(LidarPoint, x, y, z, intensity, ring, time);
  stamped<Cloud>(module, "LidarCloudSample",
                 "One scan of a lidar with many rings; stamp: its first beam.")
      .def_readonly("frame", &Cloud::frame, "Frame of the lidar.")
      .def_property_readonly(
          "points", [](const Cloud& s) { return to_structured(s.points); },
          "Shape (n,), structured: x y z [m] in frame, intensity, ring, time since stamp [s].");
}

void bind_ranges(py::module_& module) {
  using Points = PointListSample;
  stamped<Points>(module, "PointListSample", "A point per beam of a lidar.")
      .def_readonly("frame", &Points::frame, "Frame of the points.")
      .def_property_readonly(
          "points", [](const Points& s) { return to_rows(s.points); },
          "In frame [m], shape (n, 3), float32.")
      .def_property_readonly(
          "intensities",
          [](const Points& s) {
            return py::array_t<float>(static_cast<py::ssize_t>(s.intensities.size()),
                                      s.intensities.data());
          },
          "Shape (n,), float32.");
  stamped<RangeSample>(module, "RangeSample", "The nearest thing in a cone about x.")
      .def_readonly("frame", &RangeSample::frame, "Frame of the sensor.")
      .def_readonly("is_infrared", &RangeSample::is_infrared, "Else ultrasound.")
      .def_readonly("field_of_view", &RangeSample::field_of_view_rad, "Of the cone [rad].")
      .def_readonly("range_min", &RangeSample::range_min_m, "Smallest range [m].")
      .def_readonly("range_max", &RangeSample::range_max_m, "Largest range [m].")
      .def_readonly("range", &RangeSample::range_m, "[m]; the largest range: nothing hit.");
}

// Contacts are computed in the world frame, whatever the message's header says.
void bind_contacts(py::module_& module) {
  py::class_<TouchSample> touch(module, "TouchSample", "Contacts of two collisions.");
  touch.attr("__module__") = "trident_sim";
  touch.def_readonly("collision1", &TouchSample::collision1, "model::link::collision.")
      .def_readonly("collision2", &TouchSample::collision2, "model::link::collision.")
      .def_property_readonly(
          "positions", [](const TouchSample& s) { return to_rows(s.positions); },
          "In the world [m], shape (n, 3).")
      .def_property_readonly(
          "normals", [](const TouchSample& s) { return to_rows(s.normals); },
          "In the world, into collision 1, shape (n, 3).")
      .def_property_readonly(
          "forces", [](const TouchSample& s) { return to_rows(s.forces); },
          "On collision 1, in the world [N], shape (n, 3).")
      .def_property_readonly(
          "torques", [](const TouchSample& s) { return to_rows(s.torques); },
          "On collision 1, about its body's centre of mass [N m], shape (n, 3).")
      .def_property_readonly(
          "depths", [](const TouchSample& s) { return to_numpy(s.depths); }, "[m], shape (n,).");
  stamped<ContactsSample>(module, "ContactsSample", "What the collisions of a bumper touch.")
      .def_readonly("frame", &ContactsSample::frame, "Frame that a message is said to be in.")
      .def_readonly("touches", &ContactsSample::touches, "One for each pair of collisions.");
}

void bind_navigation(py::module_& module) {
  stamped<FluidPressureSample>(module, "FluidPressureSample", "What a barometer measures.")
      .def_readonly("frame", &FluidPressureSample::frame, "Frame of the barometer.")
      .def_readonly("pressure", &FluidPressureSample::pressure_pa, "Static pressure [Pa].")
      .def_readonly("variance", &FluidPressureSample::variance, "[Pa^2].");
  stamped<MagneticFieldSample>(module, "MagneticFieldSample", "What a magnetometer measures.")
      .def_readonly("frame", &MagneticFieldSample::frame, "Frame that the field is in.")
      .def_property_readonly(
          "field", [](const MagneticFieldSample& s) { return s.field_t; },
          "In frame [T], shape (3,).")
      .def_property_readonly(
          "covariance", [](const MagneticFieldSample& s) { return to_covariance(s.covariance); },
          "x y z in frame [T^2], shape (3, 3).");
  stamped<GnssFixSample>(module, "GnssFixSample", "A satellite receiver's position fix, WGS84.")
      .def_readonly("frame", &GnssFixSample::frame, "Frame of the antenna.")
      .def_readonly("latitude", &GnssFixSample::latitude_deg, "[deg], north positive.")
      .def_readonly("longitude", &GnssFixSample::longitude_deg, "[deg], east positive.")
      .def_readonly("altitude", &GnssFixSample::altitude_m, "Above the ellipsoid [m].")
      .def_property_readonly(
          "covariance", [](const GnssFixSample& s) { return to_covariance(s.covariance_enu); },
          "East, north, up [m^2], shape (3, 3).");
  stamped<GnssStatusSample>(module, "GnssStatusSample", "How good a satellite receiver's fix is.")
      .def_readonly("frame", &GnssStatusSample::frame, "Frame of the antenna.")
      .def_property_readonly(
          "fix_type", [](const GnssStatusSample& s) { return static_cast<int>(s.fix_type); },
          "0: none, 1: single, 2: float, 3: fixed.")
      .def_readonly("horizontal_stddev", &GnssStatusSample::stddev_horizontal_m,
                    "Per axis, one sigma [m].")
      .def_readonly("vertical_stddev", &GnssStatusSample::stddev_vertical_m, "One sigma [m].")
      .def_readonly("satellites", &GnssStatusSample::satellites, "In view.")
      .def_readonly("geoid_separation", &GnssStatusSample::geoid_separation_m,
                    "Height of the geoid above the ellipsoid [m]; NaN: not known.");
  stamped<TwistSample>(module, "TwistSample", "Linear and angular velocity.")
      .def_readonly("frame", &TwistSample::frame, "Frame of what moves.")
      .def_property_readonly(
          "linear", [](const TwistSample& s) { return s.v; }, "[m/s], shape (3,).")
      .def_property_readonly(
          "angular", [](const TwistSample& s) { return s.w; }, "[rad/s], shape (3,).");
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
          "Rates [rad/s] or [m/s], shape (n,); shape (0,) where they are not known.");
  stamped<ScalarSample>(module, "ScalarSample", "One number.")
      .def(py::init([](double value, double stamp) {
             return ScalarSample{to_time(stamp, "stamp"), value};
           }),
           py::arg("value"), py::arg("stamp") = 0.0, "value: SI unit of the quantity.\nstamp: [s].")
      .def_readonly("value", &ScalarSample::value, "SI unit of the quantity.");
  stamped<VectorSample>(module, "VectorSample", "A vector in frame.")
      .def_readonly("frame", &VectorSample::frame, "Frame that the vector is in.")
      .def_property_readonly(
          "value", [](const VectorSample& s) { return s.value; },
          "SI unit of the quantity, shape (3,).");
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
  bind_laser_scan(module);
  bind_lidar_cloud(module);
  bind_ranges(module);
  bind_contacts(module);
  bind_navigation(module);
  bind_others(module);
}

}  // namespace trident::sim
