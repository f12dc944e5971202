// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_convert.h"

#include <Eigen/Eigenvalues>
#include <ignition/math/eigen3/Conversions.hh>

#include "trident_base/error.h"

namespace trident {
namespace {

SE3 to_se3(const ignition::math::Pose3d& pose) {
  return {ignition::math::eigen3::convert(pose.Rot()).normalized(),
          ignition::math::eigen3::convert(pose.Pos())};
}

Eigen::Vector3d to_eigen(const ignition::math::Vector3d& v) {
  return ignition::math::eigen3::convert(v);
}

SE3 resolve(const sdf::SemanticPose& pose, const std::string& frame, const std::string& what) {
  ignition::math::Pose3d result;
  const sdf::Errors errors = pose.Resolve(result, frame);
  if (!errors.empty()) throw Error(what + ": " + errors.front().Message());
  return to_se3(result);
}

sdf::ElementPtr descend(sdf::ElementPtr element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    if (!element || !element->HasElement(name)) return nullptr;
    element = element->GetElement(name);
  }
  return element;
}

template <class T>
T value_or(const sdf::ElementPtr& root, std::initializer_list<const char*> path, T fallback) {
  const sdf::ElementPtr element = descend(root, path);
  return element ? element->Get<T>() : fallback;
}

ParamNode to_param_node(const sdf::ElementPtr& element) {
  ParamNode node;
  node.name = element->GetName();
  if (element->GetValue()) node.text = element->GetValue()->GetAsString();
  for (std::size_t i = 0; i < element->GetAttributeCount(); ++i) {
    const auto attribute = element->GetAttribute(static_cast<unsigned>(i));
    node.attributes.emplace_back(attribute->GetKey(), attribute->GetAsString());
  }
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    node.children.push_back(to_param_node(child));
  }
  return node;
}

std::vector<PluginSpec> convert_plugins(const sdf::ElementPtr& owner) {
  std::vector<PluginSpec> plugins;
  if (!owner || !owner->HasElement("plugin")) return plugins;
  for (auto element = owner->GetElement("plugin"); element;
       element = element->GetNextElement("plugin")) {
    plugins.push_back({element->Get<std::string>("name"), element->Get<std::string>("filename"),
                       to_param_node(element)});
  }
  return plugins;
}

/// The shape, or nothing for one that is not simulated (said once). A missing mesh file throws
/// when `mesh_required`.
std::optional<Shape> convert_shape(const sdf::Geometry& geometry, const std::string& what,
                                   bool mesh_required, const ConvertContext& context) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return BoxShape{to_eigen(geometry.BoxShape()->Size())};
    case sdf::GeometryType::SPHERE:
      return SphereShape{geometry.SphereShape()->Radius()};
    case sdf::GeometryType::CYLINDER:
      return CylinderShape{geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length()};
    case sdf::GeometryType::CAPSULE:
      return CapsuleShape{geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length()};
    case sdf::GeometryType::PLANE:
      return PlaneShape{to_eigen(geometry.PlaneShape()->Normal())};
    case sdf::GeometryType::MESH: {
      const std::string uri = geometry.MeshShape()->Uri();
      const std::string file = context.resources.find(uri, context.base_folder);
      if (file.empty()) {
        const std::string text = context.label + ": " + what + ": mesh '" + uri + "' not found";
        if (mesh_required) throw Error(text + "; searched: " + context.resources.searched());
        context.warn(text + "; shown without it");
        return std::nullopt;
      }
      return MeshShape{file, to_eigen(geometry.MeshShape()->Scale())};
    }
    case sdf::GeometryType::EMPTY:
      return std::nullopt;
    default:
      context.warn(context.label + ": " + what +
                   ": geometry type is not simulated (known: box, sphere, cylinder, capsule, "
                   "plane, mesh)");
      return std::nullopt;
  }
}

void check_positive(const Shape& shape, const std::string& what, const ConvertContext& context) {
  const auto check = [&](const char* field, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw Error(context.label + ": " + what + ": " + field + " is " + std::to_string(value) +
                  " m, must be finite and > 0");
    }
  };
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    for (int i = 0; i < 3; ++i) check("box size", box->size[i]);
  } else if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
    check("sphere radius", sphere->radius);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    check("cylinder radius", cylinder->radius);
    check("cylinder length", cylinder->length);
  } else if (const auto* capsule = std::get_if<CapsuleShape>(&shape)) {
    check("capsule radius", capsule->radius);
    check("capsule length", capsule->length);
  }
}

std::optional<double> number_if_given(const sdf::ElementPtr& element, const char* name,
                                      const std::string& what, const ConvertContext& context) {
  if (!element->HasElement(name)) return std::nullopt;
  const double value = element->Get<double>(name);
  if (std::isfinite(value)) return value;
  throw Error(context.label + ": " + what + ": <" + name + "> is " + std::to_string(value) +
              ", must be a finite number");
}

Surface convert_surface(const sdf::Collision& collision, const std::string& what,
                        const ConvertContext& context) {
  Surface surface;
  if (const sdf::Surface* from = collision.Surface()) {
    if (from->Contact()) surface.collide_bitmask = from->Contact()->CollideBitmask();
  }
  const auto element = descend(collision.Element(), {"surface"});
  if (const auto ode = descend(element, {"friction", "ode"})) {
    surface.mu = value_or(ode, {"mu"}, surface.mu);
    surface.mu2 = value_or(ode, {"mu2"}, surface.mu2);
    surface.slip1 = value_or(ode, {"slip1"}, surface.slip1);
    surface.slip2 = value_or(ode, {"slip2"}, surface.slip2);
    surface.fdir1 = to_eigen(value_or(ode, {"fdir1"}, ignition::math::Vector3d::Zero));
  }
  surface.restitution =
      value_or(element, {"bounce", "restitution_coefficient"}, surface.restitution);
  surface.bounce_threshold_m_s = value_or(element, {"bounce", "threshold"}, 1e5);
  if (const auto ode = descend(element, {"contact", "ode"})) {
    surface.kp_n_m = value_or(ode, {"kp"}, surface.kp_n_m);
    surface.kd_ns_m = value_or(ode, {"kd"}, surface.kd_ns_m);
    surface.min_depth_m = number_if_given(ode, "min_depth", what, context);
    surface.max_vel_m_s = number_if_given(ode, "max_vel", what, context);
    // Gazebo's way to ask for the world's.
    if (surface.max_vel_m_s.value_or(0.0) < 0.0) surface.max_vel_m_s.reset();
  }
  return surface;
}

Inertial convert_inertial(const sdf::Link& link, const std::string& what,
                          const ConvertContext& context) {
  const auto& from = link.Inertial();
  Inertial inertial;
  inertial.mass_kg = from.MassMatrix().Mass();
  inertial.T_link_com = to_se3(from.Pose());
  inertial.inertia_com = ignition::math::eigen3::convert(from.MassMatrix().Moi());
  const double smallest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertial.inertia_com, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .minCoeff();
  if (!(inertial.mass_kg > 0.0) || !(smallest > 0.0)) {
    throw Error(context.label + ": " + what + ": mass " + std::to_string(inertial.mass_kg) +
                " kg, smallest principal inertia " + std::to_string(smallest) +
                " kg m^2; both must be > 0");
  }
  return inertial;
}

LinkSpec convert_link(const sdf::Link& from, const std::string& prefix, const SE3& T_root_model,
                      bool is_static, const ConvertContext& context) {
  LinkSpec link;
  link.name = prefix + from.Name();
  const std::string what = "link '" + link.name + "'";
  link.T_model_link = T_root_model * resolve(from.SemanticPose(), "__model__", what);
  if (!is_static) link.inertial = convert_inertial(from, what, context);
  const auto element = from.Element();
  link.gravity = value_or(element, {"gravity"}, true);
  link.kinematic = value_or(element, {"kinematic"}, false);
  link.linear_damping = value_or(element, {"velocity_decay", "linear"}, 0.0);
  link.angular_damping = value_or(element, {"velocity_decay", "angular"}, 0.0);
  for (std::size_t i = 0; i < from.CollisionCount(); ++i) {
    const sdf::Collision& collision = *from.CollisionByIndex(i);
    const std::string name = what + " collision '" + collision.Name() + "'";
    auto shape = convert_shape(*collision.Geom(), name, true, context);
    if (!shape) continue;
    check_positive(*shape, name, context);
    link.collisions.push_back({collision.Name(),
                               resolve(collision.SemanticPose(), from.Name(), name), *shape,
                               convert_surface(collision, name, context)});
  }
  for (std::size_t i = 0; i < from.VisualCount(); ++i) {
    const sdf::Visual& visual = *from.VisualByIndex(i);
    const std::string name = what + " visual '" + visual.Name() + "'";
    auto shape = convert_shape(*visual.Geom(), name, false, context);
    if (!shape) continue;
    link.visuals.push_back(
        {visual.Name(), resolve(visual.SemanticPose(), from.Name(), name), *shape});
  }
  return link;
}

void convert_axis(const sdf::Joint& from, const std::string& what, JointSpec& joint) {
  const sdf::JointAxis* axis = from.Axis(0);
  if (axis == nullptr) throw Error(what + ": has no <axis>");
  ignition::math::Vector3d direction;
  const sdf::Errors errors = axis->ResolveXyz(direction, "__model__");
  if (!errors.empty()) throw Error(what + ": " + errors.front().Message());
  joint.axis_model = to_eigen(direction).normalized();
  joint.lower = axis->Lower();
  joint.upper = axis->Upper();
  if (joint.lower <= -1e16) joint.lower = -std::numeric_limits<double>::infinity();
  if (joint.upper >= 1e16) joint.upper = std::numeric_limits<double>::infinity();
  if (joint.lower > joint.upper) {
    throw Error(what + ": lower limit " + std::to_string(joint.lower) + " is above upper limit " +
                std::to_string(joint.upper));
  }
  joint.effort = axis->Effort();
  joint.velocity = axis->MaxVelocity();
  joint.damping = axis->Damping();
  joint.friction = axis->Friction();
}

JointSpec convert_joint(const sdf::Joint& from, const std::string& prefix, const SE3& T_root_model,
                        const ConvertContext& context) {
  JointSpec joint;
  joint.name = prefix + from.Name();
  const std::string what = context.label + ": joint '" + joint.name + "'";
  switch (from.Type()) {
    case sdf::JointType::FIXED:
      joint.type = JointType::kFixed;
      break;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS:
      joint.type = JointType::kRevolute;
      break;
    case sdf::JointType::PRISMATIC:
      joint.type = JointType::kPrismatic;
      break;
    default:
      throw Error(what + ": type is not supported (legal: fixed, revolute, continuous, prismatic)");
  }
  std::string parent, child;
  if (!from.ResolveParentLink(parent).empty() || !from.ResolveChildLink(child).empty()) {
    throw Error(what + ": parent '" + from.ParentLinkName() + "' or child '" +
                from.ChildLinkName() + "' is not a link of the model");
  }
  joint.parent = parent == "world" ? parent : prefix + parent;
  joint.child = prefix + child;
  joint.T_model_joint = T_root_model * resolve(from.SemanticPose(), "__model__", what);
  if (joint.type != JointType::kFixed) {
    convert_axis(from, what, joint);
    joint.axis_model = T_root_model.R * joint.axis_model;
    if (from.Type() == sdf::JointType::CONTINUOUS) {
      joint.lower = -std::numeric_limits<double>::infinity();
      joint.upper = std::numeric_limits<double>::infinity();
    }
  }
  return joint;
}

/// Nested models become part of the outermost one, their names joined by "::".
void append_model(const sdf::Model& from, const std::string& prefix, const SE3& T_root_model,
                  ModelSpec& spec, const ConvertContext& context) {
  for (std::size_t i = 0; i < from.LinkCount(); ++i) {
    spec.links.push_back(
        convert_link(*from.LinkByIndex(i), prefix, T_root_model, spec.is_static, context));
  }
  for (std::size_t i = 0; i < from.JointCount(); ++i) {
    spec.joints.push_back(convert_joint(*from.JointByIndex(i), prefix, T_root_model, context));
  }
  for (PluginSpec& plugin : convert_plugins(from.Element())) {
    spec.plugins.push_back(std::move(plugin));
  }
  for (std::size_t i = 0; i < from.ModelCount(); ++i) {
    const sdf::Model& nested = *from.ModelByIndex(i);
    const SE3 T_model_nested =
        resolve(nested.SemanticPose(), "__model__", "model '" + nested.Name() + "'");
    append_model(nested, prefix + nested.Name() + "::", T_root_model * T_model_nested, spec,
                 context);
  }
}

PhysicsSpec convert_physics(const sdf::World& world, const std::string& label) {
  PhysicsSpec spec;
  spec.gravity = to_eigen(world.Gravity());
  const auto world_element = world.Element();
  if (!world_element || !world_element->HasElement("physics")) return spec;
  const auto element = world_element->GetElement("physics");
  spec.max_step_size_s = value_or(element, {"max_step_size"}, spec.max_step_size_s);
  spec.real_time_factor = value_or(element, {"real_time_factor"}, spec.real_time_factor);
  spec.real_time_update_rate_hz =
      value_or(element, {"real_time_update_rate"}, spec.real_time_update_rate_hz);
  spec.max_contacts = value_or(element, {"max_contacts"}, spec.max_contacts);
  if (element->HasElement("gravity")) {
    spec.gravity = to_eigen(element->Get<ignition::math::Vector3d>("gravity"));
  }
  if (!(spec.max_step_size_s > 0.0) || spec.max_step_size_s > 1.0) {
    throw Error(label + ": <max_step_size> is " + std::to_string(spec.max_step_size_s) +
                " s, must be in (0, 1]");
  }
  const auto ode = descend(element, {"ode"});
  spec.solver = value_or(ode, {"solver", "type"}, spec.solver);
  spec.iterations = value_or(ode, {"solver", "iters"}, spec.iterations);
  spec.precon_iterations = value_or(ode, {"solver", "precon_iters"}, spec.precon_iterations);
  spec.sor = value_or(ode, {"solver", "sor"}, spec.sor);
  spec.cfm = value_or(ode, {"constraints", "cfm"}, spec.cfm);
  spec.erp = value_or(ode, {"constraints", "erp"}, spec.erp);
  spec.contact_max_correcting_vel =
      value_or(ode, {"constraints", "contact_max_correcting_vel"}, spec.contact_max_correcting_vel);
  spec.contact_surface_layer =
      value_or(ode, {"constraints", "contact_surface_layer"}, spec.contact_surface_layer);
  return spec;
}

SphericalCoordinates convert_spherical(const sdf::World& world) {
  SphericalCoordinates spherical;
  if (const auto* from = world.SphericalCoordinates()) {
    spherical.latitude_deg = from->LatitudeReference().Degree();
    spherical.longitude_deg = from->LongitudeReference().Degree();
    spherical.elevation_m = from->ElevationReference();
    spherical.heading_deg = from->HeadingOffset().Degree();
  }
  return spherical;
}

}  // namespace

ModelSpec convert_model(const sdf::Model& from, const ConvertContext& context) {
  ModelSpec spec;
  spec.name = from.Name();
  spec.is_static = from.Static();
  spec.self_collide = from.SelfCollide();
  spec.T_world_model = to_se3(from.RawPose());
  append_model(from, "", SE3::identity(), spec, context);
  if (spec.links.empty()) {
    throw Error(context.label + ": model '" + spec.name + "' has no link that can be simulated");
  }
  return spec;
}

WorldSpec convert_world(const sdf::World& from, const ConvertContext& context) {
  WorldSpec spec;
  spec.name = from.Name();
  spec.physics = convert_physics(from, context.label);
  spec.spherical = convert_spherical(from);
  for (std::size_t i = 0; i < from.ModelCount(); ++i) {
    ModelSpec model = convert_model(*from.ModelByIndex(i), context);
    model.T_world_model =
        resolve(from.ModelByIndex(i)->SemanticPose(), "world", "model '" + model.name + "'");
    spec.models.push_back(std::move(model));
  }
  spec.plugins = convert_plugins(from.Element());
  return spec;
}

}  // namespace trident
