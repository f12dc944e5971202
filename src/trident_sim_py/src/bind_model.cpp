// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "bindings.h"
#include "convert.h"
#include "session.h"
#include "trident_base/error.h"
#include "trident_sim/world/mass_scale.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

// Views look their object up by name each time, so that none outlives it.

class LinkView {
 public:
  LinkView(std::shared_ptr<Session> session, std::string model, std::string name)
      : session_(std::move(session)), model_(std::move(model)), name_(std::move(name)) {
    link();
  }
  const std::string& name() const { return name_; }
  Link& link() const { return session_->link(model_, name_); }
  SE3 T_world_link() const { return link().T_world_link(); }
  Eigen::Vector3d v_world() const { return link().v_world_at(link().T_world_link().p); }

  void apply_wrench(const py::object& force, const py::object& torque, double duration_s,
                    const py::object& point) {
    World& world = session_->world();
    // As in the services of Gazebo, a negative duration has no end.
    const SimTime duration = duration_s < 0.0 ? SimTime{-1} : to_time(duration_s, "duration");
    world.apply_wrench({&link(), to_vector3(force, "force"), to_vector3(torque, "torque"),
                        to_vector3(point, "point"), world.time(), duration});
  }
  void clear_wrenches() { session_->world().clear_wrenches(link()); }

 private:
  std::shared_ptr<Session> session_;
  std::string model_, name_;
};

class JointView {
 public:
  JointView(std::shared_ptr<Session> session, std::string model, std::string name)
      : session_(std::move(session)), model_(std::move(model)), name_(std::move(name)) {
    joint();
  }
  const std::string& name() const { return name_; }
  Joint& joint() const { return session_->joint(model_, name_); }

  void apply_effort(double effort, double duration_s) {
    World& world = session_->world();
    const SimTime duration = duration_s < 0.0 ? SimTime{-1} : to_time(duration_s, "duration");
    world.apply_effort({&joint(), effort, world.time(), duration});
  }
  void clear_efforts() { session_->world().clear_efforts(joint()); }

 private:
  std::shared_ptr<Session> session_;
  std::string model_, name_;
};

class ModelView {
 public:
  ModelView(std::shared_ptr<Session> session, std::string name)
      : session_(std::move(session)), name_(std::move(name)) {
    model();
  }
  const std::string& name() const { return name_; }
  Model& model() const { return session_->model(name_); }
  Eigen::Vector3d v_world() const {
    const Link* link = model().canonical_link();
    return link == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                           : link->v_world_at(model().T_world_model().p);
  }
  Eigen::Vector3d w_world() const {
    const Link* link = model().canonical_link();
    return link == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : link->w_world();
  }
  double mass_kg() const {
    double sum = 0.0;
    for (const auto& link : model().links) sum += link->inertial.mass_kg;
    return sum;
  }
  void set_pose(const py::object& pose) {
    session_->world().set_model_pose(model(), to_pose(pose, "pose of model '" + name_ + "'"));
  }
  void scale_mass(double factor) { trident::sim::scale_mass(model(), factor); }
  void set_velocity(const py::object& linear, const py::object& angular) {
    session_->world().set_model_twist(model(), to_vector3(linear, "linear"),
                                      to_vector3(angular, "angular"));
  }
  std::vector<std::string> links() const {
    std::vector<std::string> names;
    for (const auto& link : model().links) names.push_back(link->name);
    return names;
  }
  std::vector<std::string> joints() const {
    std::vector<std::string> names;
    for (const auto& joint : model().joints) names.push_back(joint->spec.name);
    return names;
  }
  LinkView link(const std::string& link_name) const { return {session_, name_, link_name}; }
  JointView joint(const std::string& joint_name) const { return {session_, name_, joint_name}; }

 private:
  std::shared_ptr<Session> session_;
  std::string name_;
};

void bind_links(py::module_& module) {
  py::class_<LinkView>(module, "Link", "A link of a model, by name.")
      .def_property_readonly("name", &LinkView::name, "Of the link in its model.")
      .def_property_readonly(
          "position", [](const LinkView& v) { return v.T_world_link().p; },
          "Origin of the link in the world [m], shape (3,).")
      .def_property_readonly(
          "orientation", [](const LinkView& v) { return xyzw(v.T_world_link().R); },
          "Of the link in the world, quaternion x y z w, shape (4,).")
      .def_property_readonly("linear_velocity", &LinkView::v_world,
                             "Of the link's origin, in the world frame [m/s], shape (3,).")
      .def_property_readonly(
          "angular_velocity", [](const LinkView& v) { return v.link().w_world(); },
          "In the world frame [rad/s], shape (3,).")
      .def_property_readonly(
          "mass", [](const LinkView& v) { return v.link().inertial.mass_kg; }, "Of the link [kg].")
      .def("apply_wrench", &LinkView::apply_wrench, py::arg("force"),
           py::arg("torque") = py::make_tuple(0, 0, 0), py::arg("duration") = -1.0,
           py::arg("point") = py::make_tuple(0, 0, 0),
           "Push from now on. force [N], torque [N m]: world frame, shape (3,). point: where the\n"
           "force acts, link frame [m], shape (3,). duration [s]; negative: until cleared.")
      .def("clear_wrenches", &LinkView::clear_wrenches, "End all pushes on this link.");
}

void bind_joints(py::module_& module) {
  py::class_<JointView>(module, "Joint", "A joint of a model, by name.")
      .def_property_readonly("name", &JointView::name, "Of the joint in its model.")
      .def_property_readonly(
          "position", [](const JointView& v) { return v.joint().position(); },
          "Angle [rad] or displacement [m] along its axis; 0: as its description has it.")
      .def_property_readonly(
          "velocity", [](const JointView& v) { return v.joint().velocity(); },
          "Rate of its position [rad/s] or [m/s].")
      .def("apply_effort", &JointView::apply_effort, py::arg("effort"), py::arg("duration") = -1.0,
           "Drive it from now on. effort [N m] or [N]; duration [s]; negative: until cleared.")
      .def("clear_efforts", &JointView::clear_efforts, "End all efforts on this joint.");
}

}  // namespace

void bind_model(py::module_& module) {
  bind_links(module);
  bind_joints(module);
  py::class_<ModelView>(module, "Model", "A model of the world, by name.")
      .def(py::init<std::shared_ptr<Session>, std::string>())
      .def_property_readonly("name", &ModelView::name, "Of the model in the world.")
      .def_property_readonly(
          "namespace", [](const ModelView& v) { return v.model().robot_namespace; },
          "Prefix of its ports where the model does not say one.")
      .def_property_readonly(
          "is_static", [](const ModelView& v) { return v.model().is_static; },
          "Whether it never moves.")
      .def_property_readonly(
          "position", [](const ModelView& v) { return v.model().T_world_model().p; },
          "Origin of the model in the world [m], shape (3,).")
      .def_property_readonly(
          "orientation", [](const ModelView& v) { return xyzw(v.model().T_world_model().R); },
          "Of the model in the world, quaternion x y z w, shape (4,).")
      .def_property_readonly("linear_velocity", &ModelView::v_world,
                             "Of the model's origin, in the world frame [m/s], shape (3,).")
      .def_property_readonly("angular_velocity", &ModelView::w_world,
                             "In the world frame [rad/s], shape (3,).")
      .def_property_readonly("mass", &ModelView::mass_kg, "Of all its links [kg].")
      .def("set_pose", &ModelView::set_pose, py::arg("pose"),
           "Put it there. pose in the world: x y z, x y z roll pitch yaw, or x y z qx qy qz qw\n"
           "[m, rad], shape (3,), (6,) or (7,).")
      .def("set_velocity", &ModelView::set_velocity, py::arg("linear"),
           py::arg("angular") = py::make_tuple(0, 0, 0),
           "Of the whole model, in the world frame [m/s], [rad/s], shape (3,).")
      .def("scale_mass", &ModelView::scale_mass, py::arg("factor"),
           "Mass and inertia of all its links become factor, 0.01 to 100, times what they were "
           "when\n"
           "it was spawned. Snapshots from before fit.")
      .def_property_readonly("links", &ModelView::links, "Names of its links.")
      .def_property_readonly("joints", &ModelView::joints, "Names of its joints.")
      .def("link", &ModelView::link, py::arg("name"),
           "One of its links; Error if it has no such link.")
      .def("joint", &ModelView::joint, py::arg("name"),
           "One of its joints; Error if it has no such joint.")
      .def("__repr__", [](const ModelView& v) { return "<trident_sim.Model '" + v.name() + "'>"; });
  for (const char* name : {"Link", "Joint", "Model"}) {
    module.attr(name).attr("__module__") = "trident_sim";
  }
}

}  // namespace trident::sim
