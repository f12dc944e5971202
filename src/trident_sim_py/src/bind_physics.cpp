// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Drives of joints, and snapshots.
#include "bindings.h"
#include "session.h"
#include "trident_base/error.h"
#include "trident_sim/world/joint_drive.h"
#include "trident_sim/world/snapshot.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

DriveMode parse_mode(const std::string& mode) {
  if (mode == "effort") return DriveMode::kEffort;
  if (mode == "velocity") return DriveMode::kVelocity;
  if (mode == "position") return DriveMode::kPosition;
  throw Error("mode is '" + mode + "', legal: effort, velocity, position");
}

/// A drive by the name of its joint, looked up each time.
class DriveView {
 public:
  DriveView(std::shared_ptr<Session> session, std::string model, std::string joint,
            const std::string& mode, double target, const py::dict& gains, std::size_t axis)
      : session_(std::move(session)),
        model_(std::move(model)),
        joint_(std::move(joint)),
        axis_(axis) {
    DriveSpec spec;
    spec.mode = parse_mode(mode);
    spec.target = target;
    spec.gains.p = gains["p"].cast<double>();
    spec.gains.i = gains["i"].cast<double>();
    spec.gains.d = gains["d"].cast<double>();
    spec.gains.integral_limit = gains["integral_limit"].cast<double>();
    spec.gains.output_limit = gains["effort_limit"].cast<double>();
    session_->world().add_drive(session_->joint(model_, joint_), spec, axis_);
  }
  JointDrive& drive() const {
    JointDrive* found = session_->world().find_drive(session_->joint(model_, joint_), axis_);
    if (found == nullptr) {
      throw Error("joint '" + joint_ + "' of model '" + model_ + "' has no drive any more");
    }
    return *found;
  }
  void remove() { session_->world().remove_drive(session_->joint(model_, joint_), axis_); }

 private:
  std::shared_ptr<Session> session_;
  std::string model_, joint_;
  std::size_t axis_;
};

}  // namespace

void bind_physics(py::module_& module) {
  py::class_<DriveView>(module, "Drive", "What drives an axis of a joint towards a target.")
      .def(py::init<std::shared_ptr<Session>, std::string, std::string, const std::string&, double,
                    const py::dict&, std::size_t>())
      .def_property(
          "target", [](const DriveView& v) { return v.drive().target(); },
          [](DriveView& v, double target) { v.drive().set_target(target); },
          "Position [rad] or [m], velocity [rad/s] or [m/s], or effort [N m] or [N].")
      .def_property_readonly(
          "effort", [](const DriveView& v) { return v.drive().effort(); },
          "Asked for in the last step [N m] or [N].")
      .def("remove", &DriveView::remove, "Drive the axis no longer.");
  py::class_<Snapshot>(module, "Snapshot", "The state of a world between two steps.")
      .def_property_readonly(
          "time", [](const Snapshot& s) { return s.time().seconds(); }, "Simulated time [s].")
      .def_property_readonly("step_count", &Snapshot::step_count, "Steps since time zero.");
  for (const char* name : {"Drive", "Snapshot"}) {
    module.attr(name).attr("__module__") = "trident_sim";
  }
  module.def("save_snapshot", [](Session& session) { return session.world().save_snapshot(); });
  module.def("restore_snapshot",
             [](Session& session, const Snapshot& snapshot) { session.restore(snapshot); });
}

}  // namespace trident::sim
