// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

#include "marine/environment/water.h"
#include "marine/vessel/submerged_shape.h"
#include "trident_sim/plugin_registry.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

const Limits kShapeLengths{1e-6, 1e6};

PluginParams required_element(const PluginParams& params, const char* key) {
  const ParamNode* const node = params.node(key);
  if (node == nullptr) params.refuse(key, "", "an element");
  return {*node, params.owner() + " <" + key + ">"};
}

FloatingShape read_box(const PluginParams& geometry) {
  const PluginParams box = required_element(geometry, "box");
  box.required_text("size");
  const Eigen::Vector3d size = box.vector3("size", Eigen::Vector3d::Zero());
  if (!(size.minCoeff() >= kShapeLengths.lo && size.maxCoeff() <= kShapeLengths.hi)) {
    box.refuse("size", box.text("size", ""), "three lengths of 1e-6 to 1e6 m");
  }
  return FloatingShape::box(size);
}

FloatingShape read_floating_shape(const PluginParams& params) {
  const PluginParams geometry = required_element(params, "geometry");
  if (geometry.has("box")) return read_box(geometry);
  const bool is_cylinder = geometry.has("cylinder");
  if (!is_cylinder && !geometry.has("sphere")) {
    params.refuse("geometry", "", "a <box>, <cylinder> or <sphere>");
  }
  const PluginParams round = required_element(geometry, is_cylinder ? "cylinder" : "sphere");
  round.required_text("radius");
  const double radius = round.number("radius", 0.0, kShapeLengths);
  if (!is_cylinder) return FloatingShape::sphere(radius);
  round.required_text("length");
  return FloatingShape::cylinder(radius, round.number("length", 0.0, kShapeLengths));
}

/// VRX' mean of a shape's lengths, the arm of its drag about the axes.
double mean_length(const PluginParams& params) {
  const PluginParams geometry = required_element(params, "geometry");
  if (geometry.has("box")) {
    return required_element(geometry, "box").vector3("size", Eigen::Vector3d::Zero()).mean();
  }
  if (geometry.has("sphere")) return 2.0 * required_element(geometry, "sphere").number("radius", 0);
  const PluginParams cylinder = required_element(geometry, "cylinder");
  return cylinder.number("radius", 0.0) + 0.5 * cylinder.number("length", 0.0);
}

SE3 read_float_pose(const PluginParams& params) {
  if (!params.has("pose")) return {};
  std::istringstream words(params.required_text("pose"));
  std::array<double, 6> n{};
  for (double& number : n) words >> number;
  if (!words) params.refuse("pose", params.required_text("pose"), "six numbers");
  return SE3::from_xyz_rpy({n[0], n[1], n[2]}, n[3], n[4], n[5]);
}

struct FloatDrag {
  double linear_1_s = 0.0, angular_1_s_m2 = 0.0;
};

/// One <buoyancy> of the plugin: a shape on a link.
class BuoyantLink {
 public:
  BuoyantLink(const PluginContext& context, const ParamNode& node)
      : BuoyantLink(context, PluginParams(node, context.params.owner() + " <buoyancy>")) {}

  /// `density` of the water [kg/m^3], `level` of its surface [m] and how fast that rises [m/s].
  void push(double density, double level, double rise, const FloatDrag& drag, const World& world,
            double dt) const {
    const SE3 T_world_shape = link_.T_world_link() * T_link_shape_;
    const Submerged wet = shape_.below(level, T_world_shape);
    if (wet.volume_m3 <= 1e-6) return;
    Body& body = *link_.body;
    // Drag grows with the immersed part of the mass.
    const double wet_kg = body.mass() * wet.volume_m3 / shape_.volume_m3();
    const double rate = drag.linear_1_s * wet_kg;
    const Eigen::Vector3d slip =
        Eigen::Vector3d(0.0, 0.0, rise) - link_.v_world_at(link_.T_world_link().p);
    // The drag is that of the velocity at the end of the
    // step, F = c v / (1 + c dt / m): stable for any c.
    Eigen::Vector3d force = -density * wet.volume_m3 * world.physics().gravity +
                            rate / (1.0 + rate * dt / body.mass()) * slip;
    force.z() = std::max(force.z(), 0.0);  // as VRX: the water does not pull
    body.add_force_at(force, wet.centroid);
    // Implicit, because the light axis of a mark has a time constant of about a step.
    const double turning = drag.angular_1_s_m2 * wet_kg * mean_length_m_ * mean_length_m_;
    const Eigen::Matrix3d R = body.rotation();
    const Eigen::Matrix3d slowed =
        Eigen::Matrix3d::Identity() + turning * dt * body.inverse_inertia_tensor();
    body.apply_torque(-turning *
                      (R * slowed.partialPivLu().solve(R.transpose() * body.angular_velocity())));
  }

  const Link& link() const { return link_; }

 private:
  BuoyantLink(const PluginContext& context, const PluginParams& params)
      : link_(moving_link({context.world, context.model, params, context.name}, "link_name")),
        T_link_shape_(read_float_pose(params)),
        shape_(read_floating_shape(params)),
        mean_length_m_(mean_length(params)) {}

  Link& link_;
  SE3 T_link_shape_;
  FloatingShape shape_;
  double mean_length_m_;
};

/// libbuoyancy_gazebo_plugin.so: what VRX' buoys and docks float by. Archimedes' lift of each
/// <buoyancy>'s shape below the surface at its link, and VRX' drag, in proportion to the immersed
/// part of the mass: <linear_drag> [1/s] against the rising surface, <angular_drag> [1/(s m^2)].
/// With <wave_model> the surface is that of the world's sea; <fluid_level> is added to it.
class BuoyancyPlugin : public Plugin {
 public:
  explicit BuoyancyPlugin(const PluginContext& context)
      : density_(context.params.number("fluid_density", 997.0, {0.0, 1e5})),
        level_m_(context.params.number("fluid_level", 0.0, {-1e4, 1e4})),
        has_waves_(!context.params.text("wave_model", "").empty()) {
    const PluginParams& params = context.params;
    drag_.linear_1_s = params.number("linear_drag", 0.0, {0.0, 1e6});
    drag_.angular_1_s_m2 = params.number("angular_drag", 0.0, {0.0, 1e6});
    for (std::size_t number = 1;; ++number) {
      const ParamNode* const node = params.node("buoyancy[" + std::to_string(number) + "]");
      if (node == nullptr) break;
      floats_.emplace_back(context, *node);
    }
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    if (has_waves_) around_.look(world);
    for (const BuoyantLink& part : floats_) {
      double level = level_m_, rise = 0.0;
      if (const Sea* const sea = around_.sea()) {
        const Eigen::Vector2d place = part.link().T_world_link().p.head<2>();
        const WaterColumn column = sea->water().column(place, {0.0, 0.0}, info.begin.seconds());
        level += column.elevation_m;
        rise = column.motion[0].velocity.z();
      }
      part.push(density_, level, rise, drag_, world, info.dt_s);
    }
  }

 private:
  double density_, level_m_;
  bool has_waves_;
  FloatDrag drag_;
  std::vector<BuoyantLink> floats_;
  Surroundings around_;
};

const PluginRegistrar kBuoyancyGazeboPlugin("libbuoyancy_gazebo_plugin.so",
                                            factory_of<BuoyancyPlugin>());

}  // namespace
}  // namespace trident::sim
