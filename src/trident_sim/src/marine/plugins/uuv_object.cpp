// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "marine/environment/water.h"
#include "trident_base/angle.h"
#include "trident_base/string_util.h"
#include "trident_sim/plugin_registry.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

const Limits kSize{0.0, 1e6}, kLength{1e-6, 1e6};

/// `count` numbers, or none where the element is missing.
std::vector<double> numbers(const PluginParams& params, const char* key,
                            const std::vector<std::size_t>& counts) {
  std::vector<double> result;
  if (!params.has(key)) return result;
  const std::string text = params.required_text(key);
  std::istringstream words(text);
  double number = 0.0;
  while (words >> number) result.push_back(number);
  const bool is_legal = std::find(counts.begin(), counts.end(), result.size()) != counts.end();
  if (words.eof() && is_legal) return result;
  std::string legal;
  for (const std::size_t count : counts) {
    legal += (legal.empty() ? "" : " or ") + std::to_string(count);
  }
  params.refuse(key, text, legal + " numbers");
}

/// uuv_simulator's damping is negative for a real hull; `scale` and `offset` as upstream's.
Matrix6d read_damping(const PluginParams& params, const char* key, double scale, double offset) {
  Matrix6d D = Matrix6d::Zero();
  const std::vector<double> given = numbers(params, key, {6, 36});
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (given.size() == 6) {
      if (given[i] > 0.0) params.refuse(key, number_text(given[i]), "numbers <= 0");
      D(at, at) = given[i];
    } else {
      D(at / 6, at % 6) = given[i];
    }
  }
  return -scale * (D + offset * Matrix6d::Identity());
}

MatrixRows rows_of(const Matrix6d& matrix) {
  MatrixRows rows;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data()) = matrix;
  return rows;
}

/// Added mass and quadratic damping that upstream works out of a shape, in its axes x forward.
struct ObjectShape {
  Vector6d added_mass = Vector6d::Zero();
  Vector6d quadratic = Vector6d::Zero();  ///< positive
};

ObjectShape sphere(const PluginParams& params, double density) {
  const double r = params.number("radius", 0.1, kLength);
  ObjectShape shape;
  // Added mass is half of the displaced water; the drag coefficient is 0.5 on the sphere's section.
  shape.added_mass.head<3>().setConstant(2.0 / 3.0 * density * kPi * r * r * r);
  shape.quadratic.head<3>().setConstant(0.5 * density * 0.5 * kPi * r * r);
  return shape;
}

/// A drag coefficient, up to a slenderness.
struct DragStep {
  double last_slenderness, coefficient;
};

template <std::size_t N>
double drag_coefficient(const std::array<DragStep, N>& steps, double slenderness) {
  const auto found = std::find_if(steps.begin(), steps.end() - 1, [=](const DragStep& step) {
    return slenderness <= step.last_slenderness;
  });
  return found->coefficient;
}

// Of a circular face and of a side, as upstream's table has them.
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr std::array<DragStep, 4> kFaceDrag = {
    {{1.0, 0.91}, {2.0, 0.85}, {4.0, 0.87}, {kEndless, 0.99}}};
constexpr std::array<DragStep, 5> kSideDrag = {
    {{1.0, 0.63}, {2.0, 0.68}, {5.0, 0.74}, {10.0, 0.82}, {kEndless, 0.98}}};

ObjectShape cylinder(const PluginParams& params, double density) {
  const double r = params.number("radius", 0.1, kLength);
  const double length = params.number("length", 1.0, kLength);
  const std::string axis = params.text("axis", "i");
  const std::size_t along = std::string("ijk").find(axis);
  if (axis.size() != 1 || along == std::string::npos) params.refuse("axis", axis, "i, j or k");
  const double slender = length / (2.0 * r), face = kPi * r * r;
  const double cd_face = drag_coefficient(kFaceDrag, slender);
  const double cd_side = drag_coefficient(kSideDrag, slender);
  ObjectShape shape;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (i == along) {
      shape.added_mass[row] = density * face;
      shape.quadratic[row] = 0.5 * cd_face * face * density;
    } else {
      shape.added_mass[row] = density * face * length;
      shape.added_mass[row + 3] = density * face * std::pow(length, 3) / 12.0;
      shape.quadratic[row] = 0.5 * cd_side * r * length * density;
    }
  }
  return shape;
}

ObjectShape box(const PluginParams& params, double density) {
  const double cd = params.number("cd", 1.0, kSize), l = params.number("length", 1.0, kLength),
               w = params.number("width", 1.0, kLength), h = params.number("height", 1.0, kLength);
  ObjectShape shape;
  shape.quadratic.head<3>() = 0.5 * cd * density * Eigen::Vector3d(w * h, l * h, w * l);
  return shape;
}

/// What upstream's types give besides the numbers of <hydrodynamic_model>.
ObjectShape read_shape(const PluginParams& model, double density) {
  const std::string type = model.required_text("type");
  if (type == "fossen") return {};
  if (type == "sphere") return sphere(model, density);
  if (type == "cylinder") return cylinder(model, density);
  if (type == "box") return box(model, density);
  // Upstream's spheroid warns that it is not to be used.
  model.refuse("type", type, "fossen, sphere, cylinder or box");
}

void refuse_forward_damping(const PluginParams& model) {
  for (const double number : numbers(model, "linear_damping_forward_speed", {6, 36})) {
    if (number == 0.0) continue;
    model.refuse("linear_damping_forward_speed", number_text(number),
                 "0: damping that grows with the speed ahead is not offered");
  }
}

VesselParams read_hydrodynamics(const PluginParams& model, const std::string& name,
                                double density) {
  VesselParams vessel;
  vessel.name = name;
  vessel.axes = BodyAxes::kFrd;  // upstream's matrices are those of its north-east-down axes
  vessel.water_density = density;
  vessel.mass = 1.0;  // the link's counts
  vessel.inertia.setOnes();
  const ObjectShape shape = read_shape(model, density);
  Matrix6d M_a = shape.added_mass.asDiagonal();
  const std::vector<double> added = numbers(model, "added_mass", {36});
  for (std::size_t i = 0; i < added.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    // Upstream's order: a shape's own coefficients stand,
    // given ones fill the rest, then offset and scale.
    if (shape.added_mass[at / 6] == 0.0) M_a(at / 6, at % 6) = added[i];
  }
  M_a += model.number("offset_added_mass", 0.0) * Matrix6d::Identity();
  vessel.added_mass_matrix = rows_of(model.number("scaling_added_mass", 1.0, kSize) * M_a);
  const double scale = model.number("scaling_damping", 1.0, kSize);
  vessel.linear_damping_matrix = rows_of(read_damping(
      model, "linear_damping", scale, model.number("offset_linear_damping", 0.0, {-1e9, 0.0})));
  Matrix6d quadratic = read_damping(model, "quadratic_damping", scale,
                                    model.number("offset_nonlin_damping", 0.0, {-1e9, 0.0}));
  for (int i = 0; i < 6; ++i) {
    if (shape.quadratic[i] != 0.0) quadratic(i, i) = scale * shape.quadratic[i];
  }
  vessel.quadratic_damping_matrix = rows_of(quadratic);
  refuse_forward_damping(model);
  return in_flu(vessel);
}

/// What carries a link, by upstream's linear theory, in a sea whose surface is where the waves are.
class Buoyancy {
 public:
  Buoyancy(const PluginParams& params, double density, double mass_kg, double gravity)
      : density_(density),
        height_(params.has("box") ? box_height(params) : 0.0),
        center_(params.vector3("center_of_buoyancy", Eigen::Vector3d::Zero())) {
    const bool is_vessel = params.has("metacentric_width") && params.has("metacentric_length") &&
                           params.has("submerged_height");
    volume_ = params.number("volume", 0.0, kSize);
    volume_ = params.number("scaling_volume", 1.0, kSize) *
              (volume_ + params.number("offset_volume", 0.0, {-volume_, 1e9}));
    if (params.flag("neutrally_buoyant", false)) volume_ = mass_kg / density;
    if (is_vessel) {
      metacentric_ = {params.number("metacentric_width", 0.0, kSize),
                      params.number("metacentric_length", 0.0, kSize)};
      const double draft = params.number("submerged_height", 0.0, kLength);
      // At rest the box displaces the vessel's mass at this draft.
      waterplane_m2_ = mass_kg / (density * draft);
    }
    if (height_ <= 0.0) params.refuse("box", "", "its <width>, <length> and <height>");
    gravity_ = gravity;
  }

  /// About the link's origin, link axes, from the height of the link above the surface.
  Vector6d wrench(const SE3& T_world_link, double surface_m) const {
    const double z = T_world_link.p.z() - surface_m;
    // Of a box about the link's origin, upright whatever the attitude.
    const double immersed = std::clamp(0.5 * height_ - z, 0.0, height_);
    const double volume =
        waterplane_m2_ > 0.0 ? waterplane_m2_ * immersed : volume_ * immersed / height_;
    const Eigen::Vector3d up =
        T_world_link.R.conjugate() * Eigen::Vector3d(0.0, 0.0, density_ * gravity_ * volume);
    Vector6d result = Vector6d::Zero();
    result.head<3>() = up;
    if (waterplane_m2_ > 0.0) {
      const Eigen::Vector3d rpy = T_world_link.rpy();
      result.tail<3>() = -up.norm() * Eigen::Vector3d(metacentric_.x() * std::sin(rpy.x()),
                                                      metacentric_.y() * std::sin(rpy.y()), 0.0);
    } else {
      result.tail<3>() = center_.cross(up);
    }
    return result;
  }

 private:
  static double box_height(const PluginParams& params) {
    const PluginParams size = params.below("box");
    for (const char* key : {"width", "length"}) size.number(key, 0.0, kLength);
    return size.number("height", 0.0, kLength);
  }

  double density_, height_, volume_ = 0.0, waterplane_m2_ = 0.0, gravity_ = 0.0;
  Eigen::Vector2d metacentric_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d center_;
};

/// One <link> of the plugin.
class UuvLink {
 public:
  /// `params` reads `node`.
  UuvLink(const PluginContext& context, const PluginParams& params, const ParamNode& node,
          double density)
      : UuvLink(context, params, named_link(context, params, node), density) {}

  void step(World& world, const StepInfo& info) {
    Afloat now = body_.sense(world, info);
    const SE3 T_world_link = link_.T_world_link();
    double surface = 0.0;
    if (const auto sea = find_sea(world)) {
      const double z = T_world_link.p.z();
      // The water's own motion where the link is, besides the current that body_ has seen.
      const Eigen::Vector2d place = T_world_link.p.head<2>();
      surface = sea->water().column(place, {0.0, 0.0}, info.begin.seconds()).elevation_m;
      const double depth = std::max(0.0, surface - z);
      const WaterColumn column = sea->water().column(place, {depth, depth}, info.begin.seconds());
      const Eigen::Matrix3d R = T_world_link.R.conjugate().toRotationMatrix();
      now.load.water.velocity.head<3>() += R * column.motion[0].velocity;
      now.load.water.acceleration.head<3>() += R * column.motion[0].acceleration;
    }
    body_.push(world, info, now, buoyancy_.wrench(T_world_link, surface));
  }

  void body_frames_moved() { body_.body_frames_moved(); }
  void reset() { body_.reset(); }
  void state(StateArchive& archive) { body_.state(archive); }

 private:
  UuvLink(const PluginContext& context, const PluginParams& params, Link& link, double density)
      : link_(link),
        body_(PluginContext{context.world, context.model, params, context.name}, link,
              hydrodynamics(context, params, density), {}),
        buoyancy_(params, density, link.body->mass(), -context.world.physics().gravity.z()) {
    name_unread(context.world, params);
  }

  static VesselParams hydrodynamics(const PluginContext& context, const PluginParams& params,
                                    double density) {
    const ParamNode* const node = params.node("hydrodynamic_model");
    if (node == nullptr) params.refuse("hydrodynamic_model", "", "an element with its <type>");
    const PluginParams model = params.below("hydrodynamic_model");
    VesselParams vessel = read_hydrodynamics(model, context.model->name, density);
    name_unread(context.world, model);
    return vessel;
  }

  static void name_unread(const World& world, const PluginParams& params) {
    for (const std::string& name : params.unread()) {
      world.report(Severity::kWarning,
                   params.owner() + " <" + name + "> is not known and has no effect");
    }
  }

  /// By the attribute `name`.
  static Link& named_link(const PluginContext& context, const PluginParams& params,
                          const ParamNode& node) {
    std::string name;
    for (const auto& [key, value] : node.attributes) {
      if (key == "name") name = value;
    }
    Link* const link = context.model->find_link(name);
    if (link == nullptr || link->body == nullptr || link->body->is_kinematic()) {
      params.refuse("link name", name, "a link of the model that forces move");
    }
    return *link;
  }

  Link& link_;
  VesselBody body_;
  Buoyancy buoyancy_;
};

/// libuuv_underwater_object_ros_plugin.so: upstream's elements under our equation of motion (added
/// mass is solved for, not fed back), with the world's sea. Lift of a surface vessel as upstream:
/// F = rho g A (height / 2 - z), A = m / (rho submerged_height), moments by the metacentric
/// heights; it acts upwards, where upstream lets it lean with the hull. Matrices are upstream's:
/// axes forward, right, down, damping negative.
class UuvObject : public Plugin {
 public:
  explicit UuvObject(const PluginContext& context) {
    const PluginParams& params = context.params;
    const double density = params.number("fluid_density", 1028.0, {1.0, 1e5});
    for (const char* key : {"flow_velocity_topic", "debug", "use_global_current"}) params.node(key);
    for (std::size_t number = 1;; ++number) {
      const std::string key = "link[" + std::to_string(number) + "]";
      const ParamNode* const node = params.node(key);
      if (node == nullptr) break;
      links_.push_back(std::make_unique<UuvLink>(context, params.below(key), *node, density));
    }
    if (links_.empty()) params.refuse("link", "", "at least one");
    if (params.has("flow_velocity_topic")) {
      context.world.report(Severity::kWarning,
                           params.owner() +
                               " <flow_velocity_topic> has no effect: the current is "
                               "that of the world's sea (libtrident_sea.so)");
    }
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }
  void pre_step(Phase, World& world, const StepInfo& info) override {
    for (const auto& link : links_) link->step(world, info);
  }
  void body_frames_moved() override {
    for (const auto& link : links_) link->body_frames_moved();
  }
  void reset() override {
    for (const auto& link : links_) link->reset();
  }
  void state(StateArchive& archive) override {
    for (const auto& link : links_) link->state(archive);
  }

 private:
  std::vector<std::unique_ptr<UuvLink>> links_;
};

const PluginRegistrar kUuvUnderwaterObjectRosPlugin("libuuv_underwater_object_ros_plugin.so",
                                                    factory_of<UuvObject>());

}  // namespace

}  // namespace trident::sim
