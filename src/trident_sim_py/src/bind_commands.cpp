// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "sample_class.h"
#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/commands.h"

namespace trident::sim {
namespace {

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

void bind_actuators(py::module_& module) {
  const auto speeds = [](const auto& s) { return to_numpy(s.angular_velocities.view()); };
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

void bind_wind(py::module_& module) {
  const auto make_wind = [](const py::object& velocity, double stamp, const std::string& frame) {
    return WindSample{to_time(stamp, "stamp"), frame, to_vector3(velocity, "velocity")};
  };
  stamped<WindSample>(module, "WindSample", "Wind at a vehicle.")
      .def(py::init(make_wind), py::arg("velocity"), py::arg("stamp") = 0.0,
           py::arg("frame") = "world", "velocity: in the world frame [m/s], shape (3,).")
      .def_readonly("frame", &WindSample::frame,
                    "Of the header; the velocity is in the world frame.")
      .def_property_readonly(
          "velocity", [](const WindSample& s) { return s.v_world; },
          "In the world frame [m/s], shape (3,).");
}

void bind_twist(py::module_& module) {
  const auto make = [](const py::object& linear, const py::object& angular, double stamp) {
    return TwistCommand{to_time(stamp, "stamp"), to_vector3(linear, "linear_velocity"),
                        to_vector3(angular, "angular_velocity")};
  };
  stamped<TwistCommand>(module, "TwistCommand", "Wanted velocity of a vehicle in its own frame.")
      .def(py::init(make), py::arg("linear_velocity"), py::arg("angular_velocity"),
           py::arg("stamp") = 0.0,
           "linear_velocity: [m/s], shape (3,).\n"
           "angular_velocity: [rad/s], shape (3,).\n"
           "stamp: [s], not looked at: it acts from the next step on.")
      .def_property_readonly(
          "linear_velocity", [](const TwistCommand& s) { return s.v_base; },
          "In the vehicle's frame [m/s], shape (3,).")
      .def_property_readonly(
          "angular_velocity", [](const TwistCommand& s) { return s.w_base; },
          "In the vehicle's frame [rad/s], shape (3,).");
}

/// Copies: the array may be changed or freed by Python before the command acts.
PathCommand make_path(const py::object& positions, double stamp) {
  const NumpyArray array = to_array(positions, "positions", 2);
  if (array.shape(1) != 3) {
    throw Error("positions has shape (" + std::to_string(array.shape(0)) + ", " +
                std::to_string(array.shape(1)) + "), legal: (n, 3)");
  }
  PathCommand path{to_time(stamp, "stamp"), {}};
  for (py::ssize_t i = 0; i < array.shape(0); ++i) path.p_world.emplace_back(array.data() + 3 * i);
  return path;
}

void bind_path(py::module_& module) {
  stamped<PathCommand>(module, "PathCommand", "Waypoints to follow, in the world frame.")
      .def(py::init(&make_path), py::arg("positions"), py::arg("stamp") = 0.0,
           "positions: [m], shape (n, 3).\n"
           "stamp: simulated time of the start [s]; 0: at once.")
      .def("__len__", [](const PathCommand& s) { return s.p_world.size(); });
}

template <class Command>
void bind_request(py::module_& module, const char* name, const char* doc) {
  stamped<Command>(module, name, doc)
      .def(py::init([](double stamp) { return Command{to_time(stamp, "stamp")}; }),
           py::arg("stamp") = 0.0, "stamp: [s], not looked at: it acts in the next step.");
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

  /// Time of point i of `times`.
  static SimTime time(const double* times, py::ssize_t i) {
    // NaN fails the comparisons, too.
    const double least = i > 0 ? times[i - 1] : 0.0;
    if (times[i] >= least && times[i] <= kMaxSeconds) return SimTime::from_seconds(times[i]);
    throw Error("times[" + std::to_string(i) + "] is " + std::to_string(times[i]) + " s, legal: " +
                std::to_string(least) + (i > 0 ? " s, the one before it," : " s") + " to 9e9 s");
  }
  /// nullptr when absent. The array lives as long as this.
  const double* vectors(const py::object& value, const char* what) {
    if (value.is_none()) return nullptr;
    NumpyArray array = to_array(value, what, 2);
    check_columns(array, what);
    return keep(array, what);
  }
  // One number stands for all points.
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
    // The array may be a converted copy, which nobody else holds.
    kept_.push_back(array);
    return array.data();
  }

  NumpyArray positions_;
  py::ssize_t n_;
  std::vector<NumpyArray> kept_;
};

/// What is not given is zero, as in a trajectory message without velocities; times may be left out
/// for a single point only.
control::TrajectorySample make_trajectory(const py::object& positions, const py::object& times,
                                          const py::object& velocities,
                                          const py::object& accelerations, const py::object& yaw,
                                          const py::object& yaw_rate, double stamp) {
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
  control::TrajectorySample sample{to_time(stamp, "stamp"), {}};
  sample.points.resize(static_cast<std::size_t>(fields.count()));
  for (py::ssize_t i = 0; i < fields.count(); ++i) {
    control::TimedSetpoint& timed = sample.points[static_cast<std::size_t>(i)];
    if (t != nullptr) timed.time_from_start = fields.time(t, i);
    timed.point.p_world = Eigen::Vector3d(fields.positions() + 3 * i);
    if (v != nullptr) timed.point.v_world = Eigen::Vector3d(v + 3 * i);
    if (a != nullptr) timed.point.a_world = Eigen::Vector3d(a + 3 * i);
    if (heading != nullptr) timed.point.yaw = heading[i];
    if (heading_rate != nullptr) timed.point.yaw_rate = heading_rate[i];
  }
  return sample;
}

void bind_trajectory(py::module_& module) {
  stamped<control::TrajectorySample>(module, "TrajectorySample",
                                     "Set-points of a position controller, in the world frame.")
      .def(py::init(&make_trajectory), py::arg("positions"), py::arg("times") = py::none(),
           py::arg("velocities") = py::none(), py::arg("accelerations") = py::none(),
           py::arg("yaw") = py::none(), py::arg("yaw_rate") = py::none(), py::arg("stamp") = 0.0,
           "positions: [m], shape (n, 3).\n"
           "times: of each point after the stamp [s], shape (n,); may be left out for one point.\n"
           "velocities, accelerations: [m/s], [m/s^2], shape (n, 3), else 0.\n"
           "yaw, yaw_rate: [rad], [rad/s], a number or shape (n,), else 0.\n"
           "stamp: simulated time of the start [s]; 0: with the next state.")
      .def("__len__", [](const control::TrajectorySample& s) { return s.points.size(); });
}

/// Classes of one number.
template <class Number>
void bind_number(py::module_& module, const char* name, const char* text) {
  stamped<Number>(module, name, text)
      .def(py::init([](double value, double stamp) {
             return Number{to_time(stamp, "stamp"), value};
           }),
           py::arg("value"), py::arg("stamp") = 0.0, "value: SI unit of the quantity.\nstamp: [s].")
      .def_readonly("value", &Number::value, "SI unit of the quantity.");
}

void bind_drive(py::module_& module) {
  stamped<DriveCommand>(module, "DriveCommand", "Thrusts of a boat with two propellers.")
      .def(py::init([](double left, double right, double stamp) {
             return DriveCommand{to_time(stamp, "stamp"), left, right};
           }),
           py::arg("left"), py::arg("right"), py::arg("stamp") = 0.0,
           "left, right: parts of full thrust, -1 to 1.\nstamp: [s].")
      .def_readonly("left", &DriveCommand::left, "Part of full thrust, -1 to 1.")
      .def_readonly("right", &DriveCommand::right, "Part of full thrust, -1 to 1.");
}

void bind_joint_command(py::module_& module) {
  using Numbers = std::vector<double>;
  stamped<JointCommand>(module, "JointCommand", "Commands of joints or thrusters by name.")
      .def(py::init([](const std::vector<std::string>& names, const Numbers& positions,
                       const Numbers& velocities, const Numbers& efforts, double stamp) {
             return JointCommand{to_time(stamp, "stamp"), names, positions, velocities, efforts};
           }),
           py::arg("names"), py::arg("positions") = Numbers{}, py::arg("velocities") = Numbers{},
           py::arg("efforts") = Numbers{}, py::arg("stamp") = 0.0,
           "names: n of them.\n"
           "positions, velocities, efforts: [rad, m], [rad/s, m/s], [N m, N], shape (n,), or none."
           "\nstamp: [s].")
      .def_readonly("names", &JointCommand::names, "Of joints or thrusters, n of them.");
}

}  // namespace

void bind_commands(py::module_& module) {
  bind_actuators(module);
  bind_wind(module);
  bind_twist(module);
  bind_path(module);
  bind_request<ServiceCommand>(module, "ServiceCommand",
                               "A request without arguments, as a service of ROS takes it.");
  bind_request<TriggerCommand>(module, "TriggerCommand",
                               "A request without arguments, as a topic of ROS takes it.");
  bind_number<StampedNumber>(module, "StampedNumber", "One number of uuv_simulator.");
  bind_drive(module);
  bind_joint_command(module);
  bind_trajectory(module);
}

}  // namespace trident::sim
