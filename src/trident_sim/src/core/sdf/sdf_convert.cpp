// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_convert.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "core/materials/sdf_look.h"
#include "principal_moments.h"
#include "sdf_joint.h"
#include "sdf_params.h"
#include "sdf_sensor.h"
#include "sdf_values.h"
#include "trident_base/error.h"

namespace trident::sim {

std::string placed(const std::string& fault, const sdf::ElementPtr& element,
                   const ConvertContext& context) {
  if (!element || !context.has_places) return fault;
  const std::string prefix = context.label + ": ";
  const std::string text = fault.rfind(prefix, 0) == 0 ? fault.substr(prefix.size()) : fault;
  std::string place = element->FilePath();
  if (place.empty() || place.front() != '/') place = context.label;
  if (context.original) place = context.original(place);
  if (const auto line = element->LineNumber()) place += ":" + std::to_string(*line);
  return place + ": " + text;
}

namespace {

/// Who has a shape.
struct ShapeOwner {
  sdf::ElementPtr element;
  std::string name;
  bool is_collision;
};

/// The path of a shape's file. A collision's missing one throws where odd elements are refused.
std::optional<std::string> find_file(const char* kind, const std::string& uri,
                                     const ShapeOwner& owner, const ConvertContext& context) {
  std::string found = context.resources.find(uri, context.base_folder);
  if (!found.empty()) return found;
  const std::string file = std::string(kind) + " '" + uri + "'";
  const std::string text = context.label + ": " + owner.name + ": " + file + " not found";
  if (!owner.is_collision) {
    context.missing.add_visual(file, placed(text, owner.element, context));
  } else if (context.odd.policy == OddElements::kRefuse) {
    throw Error(text + "; searched: " + context.resources.searched());
  } else {
    context.missing.add_collision(file, placed(text, owner.element, context),
                                  context.resources.searched());
  }
  return std::nullopt;
}

/// Of a shape that is not simulated: the element's name; empty for one that wants no shape.
std::string shape_element(const sdf::ElementPtr& owner) {
  const auto geometry = descend(owner, {"geometry"});
  const auto shape = geometry ? geometry->GetFirstElement() : nullptr;
  return shape && shape->GetName() != "empty" ? shape->GetName() : "";
}

/// Says it of a visual; throws for a collision, through which bodies would fall.
void refuse_shape(const ShapeOwner& owner, const ConvertContext& context) {
  const std::string shape = shape_element(owner.element);
  if (shape.empty()) return;
  const std::string text =
      context.label + ": " + owner.name + ": <geometry> has <" + shape +
      ">, simulated are box, sphere, cylinder, capsule, plane, mesh and heightmap";
  if (owner.is_collision) throw Error(text);
  context.warn(placed(text, owner.element, context));
}

/// The shape, or nothing for one that is not simulated or whose file is missing.
std::optional<Shape> convert_shape(const sdf::Geometry& geometry, const ShapeOwner& owner,
                                   const ConvertContext& context) {
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
      const auto file = find_file("mesh", geometry.MeshShape()->Uri(), owner, context);
      if (!file) return std::nullopt;
      return MeshShape{*file, to_eigen(geometry.MeshShape()->Scale())};
    }
    case sdf::GeometryType::HEIGHTMAP: {
      const sdf::Heightmap& heightmap = *geometry.HeightmapShape();
      const auto file = find_file("heightmap", heightmap.Uri(), owner, context);
      if (!file) return std::nullopt;
      return HeightmapShape{*file, to_eigen(heightmap.Size())};
    }
    default:
      refuse_shape(owner, context);
      return std::nullopt;
  }
}

/// Of a shape [m]: as far as bodies may go. Contacts of larger ones overflow.
constexpr double kLargest = 1e7;

/// Refuses lengths of a shape that are not positive; a visitor of `Shape`.
class LengthCheck {
 public:
  LengthCheck(const std::string& what, const ConvertContext& context)
      : what_(what), context_(context) {}

  void operator()(const BoxShape& box) const { check("box size", box.size); }
  void operator()(const SphereShape& sphere) const { check("sphere radius", sphere.radius); }
  void operator()(const CylinderShape& cylinder) const {
    check("cylinder radius", cylinder.radius);
    check("cylinder length", cylinder.length);
  }
  void operator()(const CapsuleShape& capsule) const {
    check("capsule radius", capsule.radius);
    check("capsule length", capsule.length);
  }
  void operator()(const HeightmapShape& heightmap) const {
    check("heightmap size", heightmap.size);
  }
  void operator()(const PlaneShape& /*endless*/) const {}
  void operator()(const MeshShape& /*has a scale only*/) const {}

 private:
  void check(const char* field, double value) const {
    if (value > 0.0 && value <= kLargest) return;
    throw Error(context_.label + ": " + what_ + ": " + field + " is " + std::to_string(value) +
                " m, must be finite, > 0 and at most 1e7");
  }
  void check(const char* field, const Eigen::Vector3d& size) const {
    for (const double length : size) check(field, length);
  }

  const std::string& what_;
  const ConvertContext& context_;
};

void check_positive(const Shape& shape, const std::string& what, const ConvertContext& context) {
  std::visit(LengthCheck(what, context), shape);
}

/// Where the shape is in its collision or visual: only a heightmap says so.
SE3 shape_offset(const sdf::Geometry& geometry) {
  if (geometry.Type() != sdf::GeometryType::HEIGHTMAP) return {};
  return {Eigen::Quaterniond::Identity(), to_eigen(geometry.HeightmapShape()->Position())};
}

/// Elements that are absent keep Surface's defaults.
Surface convert_surface(const sdf::Collision& collision, const std::string& what) {
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
    surface.min_depth_m = number_if_given(ode, "min_depth", what).value_or(surface.min_depth_m);
    surface.max_vel_m_s = number_if_given(ode, "max_vel", what).value_or(surface.max_vel_m_s);
    // This asks for the world's in Gazebo, which bounds them all.
    if (surface.max_vel_m_s < 0.0) surface.max_vel_m_s = std::numeric_limits<double>::infinity();
  }
  return surface;
}

/// Of a mass [kg] and of an inertia [kg m^2]; numbers beyond overflow where they are multiplied.
constexpr double kHeaviest = 1e12;

struct PrincipalRange {
  double least, most;
};

/// By eigenvalues, as products of inertia may make a tensor with positive diagonal indefinite.
PrincipalRange principal_inertia(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  return {principal.minCoeff(), principal.maxCoeff()};
}

/// A mass or an inertia that cannot be is 1 kg, or 1 kg m^2 about each axis: Gazebo's defaults, and
/// what its ODE turns by where it cannot invert an inertia. `note` takes the texts.
template <class Note>
Inertial convert_inertial(const sdf::Link& link, const Note& note) {
  const auto& from = link.Inertial();
  Inertial inertial;
  inertial.T_link_com = to_se3(from.Pose());
  const double mass = from.MassMatrix().Mass();
  if (mass > 0.0 && mass <= kHeaviest) {
    inertial.mass_kg = mass;
  } else {
    note("mass is " + std::to_string(mass) + " kg, must be > 0 and <= 1e12", "1 kg is used");
  }
  const Eigen::Matrix3d inertia = ignition::math::eigen3::convert(from.MassMatrix().Moi());
  const auto [least, most] = principal_inertia(inertia);
  if (least > 0.0 && most <= kHeaviest) {
    inertial.inertia_com = inertia;
    const std::string fault = uneven_moments(inertia);
    if (!fault.empty()) note(fault, kUsedAsItIs);
  } else {
    note("principal inertia is " + std::to_string(least) + " to " + std::to_string(most) +
             " kg m^2, all must be > 0 and <= 1e12",
         "1 kg m^2 about each axis is used");
  }
  return inertial;
}

/// A link may have been left out.
void check_ends(const JointSpec& joint, const ModelSpec& spec, const ConvertContext& context) {
  if (context.odd.policy == OddElements::kRefuse) return;
  for (const std::string& end : {joint.parent, joint.child}) {
    const bool is_there =
        end == "world" || std::any_of(spec.links.begin(), spec.links.end(),
                                      [&end](const LinkSpec& link) { return link.name == end; });
    if (!is_there) {
      throw Error(context.label + ": joint '" + joint.name + "': link '" + end +
                  "' is not simulated");
    }
  }
}

/// Runs `convert`; where odd elements are left out a fault of it is noted with the element's place.
template <class Convert>
void guard(const sdf::ElementPtr& element, const ConvertContext& context, const Convert& convert) {
  context.odd.guard(convert,
                    [&](const std::string& fault) { return placed(fault, element, context); });
}

/// Of a URDF check_urdf() has noted it, with its place.
void note_inertial(const sdf::Link& link, const std::string& fault, const std::string& instead,
                   const ConvertContext& context) {
  if (!context.has_places) return;
  const auto inertial = descend(link.Element(), {"inertial"});
  const std::string text = context.label + ": " + fault;
  if (context.odd.policy == OddElements::kRefuse) throw Error(text);
  context.odd.texts.push_back(placed(text, inertial ? inertial : link.Element(), context) + "; " +
                              instead);
}

/// A collision whose shape is left out is no error: it was reported where the shape was read.
void convert_collision(const sdf::Collision& collision, const std::string& link_name,
                       const std::string& what, const ConvertContext& context, LinkSpec& link) {
  const std::string name = what + " collision '" + collision.Name() + "'";
  auto shape = convert_shape(*collision.Geom(), {collision.Element(), name, true}, context);
  if (!shape) return;
  check_positive(*shape, name, context);
  const SE3 T_link_shape =
      resolve(collision.SemanticPose(), link_name, name) * shape_offset(*collision.Geom());
  link.collisions.push_back(
      {collision.Name(), T_link_shape, *shape,
       convert_surface(collision, context.label + ": " + name),
       number_if_given(collision.Element(), "laser_retro", context.label + ": " + name)});
}

void convert_visual(const sdf::Visual& visual, const std::string& link_name,
                    const std::string& what, const ConvertContext& context, LinkSpec& link) {
  const std::string name = what + " visual '" + visual.Name() + "'";
  auto shape = convert_shape(*visual.Geom(), {visual.Element(), name, false}, context);
  if (!shape) return;
  VisualSpec result;
  result.name = visual.Name();
  result.T_link_shape =
      resolve(visual.SemanticPose(), link_name, name) * shape_offset(*visual.Geom());
  result.shape = *shape;
  convert_look(visual, name, context, result);
  result.laser_retro =
      number_if_given(visual.Element(), "laser_retro", context.label + ": " + name);
  link.visuals.push_back(std::move(result));
}

/// A static model's links have no use for masses, which files often leave out or get wrong.
LinkSpec convert_link(const sdf::Link& from, const std::string& prefix, const SE3& T_root_model,
                      bool is_static, const ConvertContext& context) {
  LinkSpec link;
  link.name = prefix + from.Name();
  const std::string what = "link '" + link.name + "'";
  link.T_model_link = T_root_model * resolve(from.SemanticPose(), "__model__", what);
  if (!is_static) {
    link.inertial = convert_inertial(from, [&](const std::string& fault, const char* instead) {
      note_inertial(from, what + " <inertial>: " + fault, instead, context);
    });
  }
  const auto element = from.Element();
  link.gravity = value_or(element, {"gravity"}, true);
  link.kinematic = value_or(element, {"kinematic"}, false);
  link.linear_damping = value_or(element, {"velocity_decay", "linear"}, 0.0);
  link.angular_damping = value_or(element, {"velocity_decay", "angular"}, 0.0);
  for (std::size_t i = 0; i < from.CollisionCount(); ++i) {
    const sdf::Collision& collision = *from.CollisionByIndex(i);
    guard(collision.Element(), context,
          [&] { convert_collision(collision, from.Name(), what, context, link); });
  }
  for (std::size_t i = 0; i < from.VisualCount(); ++i) {
    const sdf::Visual& visual = *from.VisualByIndex(i);
    guard(visual.Element(), context,
          [&] { convert_visual(visual, from.Name(), what, context, link); });
  }
  for (std::size_t i = 0; i < from.SensorCount(); ++i) {
    const sdf::Sensor& sensor = *from.SensorByIndex(i);
    guard(sensor.Element(), context,
          [&] { link.sensors.push_back(convert_sensor(sensor, from.Name(), what, context)); });
  }
  return link;
}

/// Nested models become part of the outermost one, their names joined by "::".
void append_model(const sdf::Model& from, const std::string& prefix, const SE3& T_root_model,
                  ModelSpec& spec, const ConvertContext& context) {
  for (std::size_t i = 0; i < from.LinkCount(); ++i) {
    const sdf::Link& link = *from.LinkByIndex(i);
    guard(link.Element(), context, [&] {
      spec.links.push_back(convert_link(link, prefix, T_root_model, spec.is_static, context));
    });
  }
  for (std::size_t i = 0; i < from.JointCount(); ++i) {
    const sdf::Joint& joint = *from.JointByIndex(i);
    guard(joint.Element(), context, [&] {
      JointSpec converted = convert_joint(joint, prefix, T_root_model, context);
      check_ends(converted, spec, context);
      spec.joints.push_back(std::move(converted));
    });
  }
  for (PluginSpec& plugin : convert_plugins(from.Element())) {
    spec.plugins.push_back(std::move(plugin));
  }
  for (std::size_t i = 0; i < from.ModelCount(); ++i) {
    const sdf::Model& nested = *from.ModelByIndex(i);
    guard(nested.Element(), context, [&] {
      const SE3 T_model_nested =
          resolve(nested.SemanticPose(), "__model__", "model '" + nested.Name() + "'");
      append_model(nested, prefix + nested.Name() + "::", T_root_model * T_model_nested, spec,
                   context);
    });
  }
}

namespace {

void require_step(const PhysicsSpec& spec, const std::string& label, OddElements policy) {
  if (policy != OddElements::kRefuse) return;  // the world takes its default
  if (spec.max_step_size_s > 0.0 && spec.max_step_size_s <= 1.0) return;
  throw Error(label + ": <max_step_size> is " + std::to_string(spec.max_step_size_s) +
              " s, must be in (0, 1]");
}

}  // namespace

/// Read from the elements: libsdformat's own class has no solver, constraints or extension.
PhysicsSpec convert_physics(const sdf::World& world, const std::string& label, OddElements policy) {
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
  require_step(spec, label, policy);
  spec.exact_solver_rows = value_or(element, {"trident:exact_solver_rows"}, spec.exact_solver_rows);
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

/// Poses of SDF 1.7 and later may be relative to other frames; links and joints are resolved to the
/// outermost model.
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

/// A part that cannot be converted is refused or left out by itself: the rest of the world is kept.
WorldSpec convert_world(const sdf::World& from, const ConvertContext& context) {
  WorldSpec spec;
  spec.name = from.Name();
  spec.physics = convert_physics(from, context.label, context.odd.policy);
  spec.spherical = convert_spherical(from);
  for (std::size_t i = 0; i < from.ModelCount(); ++i) {
    const sdf::Model& one = *from.ModelByIndex(i);
    guard(one.Element(), context, [&] {
      ModelSpec model = convert_model(one, context);
      model.T_world_model = resolve(one.SemanticPose(), "world", "model '" + model.name + "'");
      spec.models.push_back(std::move(model));
    });
  }
  for (std::size_t i = 0; i < from.LightCount(); ++i) {
    const sdf::Light& light = *from.LightByIndex(i);
    guard(light.Element(), context, [&] { spec.lights.push_back(convert_light(light, context)); });
  }
  spec.scene = convert_scene(from);
  spec.plugins = convert_plugins(from.Element());
  return spec;
}

}  // namespace trident::sim
