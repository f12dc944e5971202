// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "convert.h"
#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/samples.h"

namespace py = pybind11;

namespace trident {
namespace {

py::array_t<double> to_numpy(const SmallVector& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size), values.data.data());
}

Matrix6RowMajor to_matrix(const Covariance6& values) {
  return Eigen::Map<const Matrix6RowMajor>(values.data());
}

Matrix3RowMajor to_matrix(const std::array<double, 9>& values) {
  return Eigen::Map<const Matrix3RowMajor>(values.data());
}

SmallVector to_small_vector(const py::handle& value, const std::string& what) {
  const NumpyArray array = to_array(value, what, 1);
  const auto size = static_cast<std::size_t>(array.size());
  if (size == 0 || size > SmallVector::kCapacity) {
    throw Error(what + " has " + std::to_string(size) + " values, legal: 1 to " +
                std::to_string(SmallVector::kCapacity));
  }
  SmallVector result;
  result.assign({array.data(), size});
  return result;
}

/// A class with the time of the sample, as seconds and as exact nanoseconds.
template <class Sample>
py::class_<Sample> stamped(py::module_& module, const char* name, const char* doc) {
  py::class_<Sample> result(module, name, doc);
  result.attr("__module__") = "trident_sim";
  result.def_property_readonly(
      "stamp", [](const Sample& s) { return static_cast<double>(s.stamp.ns) / 1e9; },
      "Simulated time of the sample [s].");
  result.def_property_readonly(
      "stamp_ns", [](const Sample& s) { return s.stamp.ns; },
      "Simulated time of the sample, exact [ns].");
  return result;
}

/// Position and orientation of `T`, a member.
template <class Sample>
void add_pose(py::class_<Sample>& sample, SE3 Sample::*T) {
  sample.def_property_readonly(
      "position", [T](const Sample& s) { return (s.*T).p; }, "Position [m], shape (3,).");
  sample.def_property_readonly(
      "orientation", [T](const Sample& s) { return xyzw((s.*T).R); },
      "Unit quaternion x y z w, shape (4,).");
}

void bind_actuators(py::module_& module) {
  const auto speeds = [](const auto& s) { return to_numpy(s.angular_velocities); };
  const auto make = [](const py::object& values, double stamp) {
    return ActuatorCommand{to_time(stamp, "stamp"), to_small_vector(values, "angular_velocities")};
  };
  stamped<ActuatorCommand>(module, "ActuatorCommand", "Commanded rotor speeds.")
      .def(py::init(make), py::arg("angular_velocities"), py::arg("stamp") = 0.0,
           "angular_velocities: rotor speeds [rad/s], shape (n,).\n"
           "stamp: that of the odometry it answers [s]; 0: it acts in the next step.")
      .def_property_readonly(
          "angular_velocities", [speeds](const ActuatorCommand& s) { return speeds(s); },
          "Rotor speeds [rad/s], shape (n,).");
  stamped<ActuatorState>(module, "ActuatorState", "Rotor speeds.")
      .def_property_readonly(
          "angular_velocities", [speeds](const ActuatorState& s) { return speeds(s); },
          "Rotor speeds, signed [rad/s], shape (n,).");
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
  transform.def_readonly("parent_frame", &Sample::parent_frame)
      .def_readonly("child_frame", &Sample::child_frame);
}

void bind_poses(py::module_& module) {
  auto pose = stamped<PoseSample>(module, "PoseSample", "Pose of a body in frame.");
  add_pose(pose, &PoseSample::T_frame_body);
  pose.def_readonly("frame", &PoseSample::frame);
  auto covered = stamped<PoseWithCovarianceSample>(module, "PoseWithCovarianceSample",
                                                   "Pose of a body in frame, with covariance.");
  add_pose(covered, &PoseWithCovarianceSample::T_frame_body);
  covered.def_readonly("frame", &PoseWithCovarianceSample::frame)
      .def_property_readonly(
          "covariance", [](const PoseWithCovarianceSample& s) { return to_matrix(s.covariance); },
          "x y z, rotation x y z [m, rad], shape (6, 6).");
  stamped<PointSample>(module, "PointSample", "Position of a body in frame.")
      .def_readonly("frame", &PointSample::frame)
      .def_property_readonly(
          "position", [](const PointSample& s) { return s.p_frame; }, "[m], shape (3,).");
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
      .def_property_readonly("orientation_covariance",
                             [](const ImuSample& s) { return to_matrix(s.orientation_covariance); })
      .def_property_readonly("angular_velocity_covariance",
                             [](const ImuSample& s) { return to_matrix(s.gyro_covariance); })
      .def_property_readonly("linear_acceleration_covariance",
                             [](const ImuSample& s) { return to_matrix(s.accel_covariance); });
}

void bind_others(py::module_& module) {
  stamped<JointStateSample>(module, "JointStateSample", "Joint angles.")
      .def_readonly("frame", &JointStateSample::frame)
      .def_readonly("names", &JointStateSample::names, "Joint names, n of them.")
      .def_property_readonly(
          "positions",
          [](const JointStateSample& s) {
            return py::array_t<double>(static_cast<py::ssize_t>(s.positions.size()),
                                       s.positions.data());
          },
          "Angles [rad], shape (n,).");
  stamped<ScalarSample>(module, "ScalarSample", "One number.")
      .def_readonly("value", &ScalarSample::value, "SI unit of the quantity.");
  const auto make_wind = [](const py::object& velocity, double stamp, const std::string& frame) {
    return WindSample{to_time(stamp, "stamp"), frame, to_vector3(velocity, "velocity")};
  };
  stamped<WindSample>(module, "WindSample", "Wind at a vehicle.")
      .def(py::init(make_wind), py::arg("velocity"), py::arg("stamp") = 0.0,
           py::arg("frame") = "world", "velocity: in the world frame [m/s], shape (3,).")
      .def_readonly("frame", &WindSample::frame)
      .def_property_readonly(
          "velocity", [](const WindSample& s) { return s.v_world; },
          "In the world frame [m/s], shape (3,).");
  stamped<WrenchSample>(module, "WrenchSample", "Force and torque in frame.")
      .def_readonly("frame", &WrenchSample::frame)
      .def_property_readonly(
          "force", [](const WrenchSample& s) { return s.force; }, "[N], shape (3,).")
      .def_property_readonly(
          "torque", [](const WrenchSample& s) { return s.torque; }, "[N m], shape (3,).");
}

/// Numbers of one trajectory, checked against the count of its positions.
class TrajectoryFields {
 public:
  explicit TrajectoryFields(const py::object& positions)
      : positions_(to_array(positions, "positions", 2)), n_(positions_.shape(0)) {
    check_columns(positions_, "positions");
    if (n_ == 0) throw Error("positions has no points, legal: 1 or more");
  }
  py::ssize_t count() const { return n_; }
  const double* positions() const { return positions_.data(); }

  /// nullptr when absent. The array lives as long as this.
  const double* vectors(const py::object& value, const char* what) {
    if (value.is_none()) return nullptr;
    NumpyArray array = to_array(value, what, 2);
    check_columns(array, what);
    return keep(array, what);
  }
  const double* scalars(const py::object& value, const char* what) {
    if (value.is_none()) return nullptr;
    if (!py::isinstance<py::float_>(value) && !py::isinstance<py::int_>(value)) {
      return keep(to_array(value, what, 1), what);
    }
    NumpyArray same(n_);
    std::fill_n(same.mutable_data(), n_, value.cast<double>());
    return keep(to_array(same, what, 1), what);
  }

 private:
  static void check_columns(const NumpyArray& array, const std::string& what) {
    if (array.shape(1) == 3) return;
    throw Error(what + " has shape (" + std::to_string(array.shape(0)) + ", " +
                std::to_string(array.shape(1)) + "), legal: (n, 3)");
  }
  const double* keep(const NumpyArray& array, const std::string& what) {
    if (array.shape(0) != n_) {
      throw Error(what + " has " + std::to_string(array.shape(0)) +
                  " rows, legal: " + std::to_string(n_) + " as in positions");
    }
    kept_.push_back(array);
    return array.data();
  }

  NumpyArray positions_;
  py::ssize_t n_;
  std::vector<NumpyArray> kept_;
};

TrajectorySample make_trajectory(const py::object& positions, const py::object& times,
                                 const py::object& velocities, const py::object& accelerations,
                                 const py::object& yaw, const py::object& yaw_rate, double stamp) {
  TrajectoryFields fields(positions);
  const double* t = fields.scalars(times, "times");
  const double* v = fields.vectors(velocities, "velocities");
  const double* a = fields.vectors(accelerations, "accelerations");
  const double* heading = fields.scalars(yaw, "yaw");
  const double* heading_rate = fields.scalars(yaw_rate, "yaw_rate");
  if (t == nullptr && fields.count() > 1) {
    throw Error("times is missing, legal: one for each of the " + std::to_string(fields.count()) +
                " positions");
  }
  TrajectorySample sample{to_time(stamp, "stamp"), {}};
  sample.points.resize(static_cast<std::size_t>(fields.count()));
  for (py::ssize_t i = 0; i < fields.count(); ++i) {
    TimedSetpoint& timed = sample.points[static_cast<std::size_t>(i)];
    if (t != nullptr) timed.time_from_start = to_time(t[i], "times[" + std::to_string(i) + "]");
    if (i > 0 && t[i] < t[i - 1]) {
      throw Error("times[" + std::to_string(i) + "] is " + std::to_string(t[i]) +
                  " s, legal: not before the one before it, " + std::to_string(t[i - 1]) + " s");
    }
    timed.point.p_world = Eigen::Vector3d(fields.positions() + 3 * i);
    if (v != nullptr) timed.point.v_world = Eigen::Vector3d(v + 3 * i);
    if (a != nullptr) timed.point.a_world = Eigen::Vector3d(a + 3 * i);
    if (heading != nullptr) timed.point.yaw = heading[i];
    if (heading_rate != nullptr) timed.point.yaw_rate = heading_rate[i];
  }
  return sample;
}

void bind_trajectory(py::module_& module) {
  stamped<TrajectorySample>(module, "TrajectorySample",
                            "Set-points of a position controller, in the world frame.")
      .def(py::init(&make_trajectory), py::arg("positions"), py::arg("times") = py::none(),
           py::arg("velocities") = py::none(), py::arg("accelerations") = py::none(),
           py::arg("yaw") = py::none(), py::arg("yaw_rate") = py::none(), py::arg("stamp") = 0.0,
           "positions: [m], shape (n, 3).\n"
           "times: of each point after the stamp [s], shape (n,); may be left out for one point.\n"
           "velocities, accelerations: [m/s], [m/s^2], shape (n, 3), else 0.\n"
           "yaw, yaw_rate: [rad], [rad/s], a number or shape (n,), else 0.\n"
           "stamp: simulated time of the start [s]; 0: with the next state.")
      .def("__len__", [](const TrajectorySample& s) { return s.points.size(); });
}

}  // namespace

void bind_samples(py::module_& module) {
  bind_actuators(module);
  bind_odometry(module);
  bind_poses(module);
  bind_imu(module);
  bind_others(module);
  bind_trajectory(module);
}

}  // namespace trident
