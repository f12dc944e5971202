// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "cart.h"

#include <cmath>

namespace trident::sim {
namespace {

Surface surface_of(double mu) {
  Surface surface;
  surface.mu = surface.mu2 = mu;
  return surface;
}

std::string text(double value) { return std::to_string(value); }

void add_caster(LinkSpec& chassis, const std::string& name, double x) {
  CollisionSpec caster = make_collision(SphereShape{0.03}, surface_of(0.0));
  caster.name = name;
  caster.T_link_shape = at(x, 0, 0.03);
  chassis.collisions.push_back(caster);
}

void add_wheel(ModelSpec& model, const CartOptions& options, const std::string& name, double x,
               double y) {
  constexpr double kMass_kg = 0.5, kWidth_m = 0.03;
  const double r = options.wheel_radius_m;
  const double across = kMass_kg * (3.0 * r * r + kWidth_m * kWidth_m) / 12.0;
  LinkSpec wheel =
      make_link(name + "_wheel", kMass_kg, {across, 0.5 * kMass_kg * r * r, across}, at(x, y, r));
  // A ball touches the ground below its middle only, so the separation is what it says.
  wheel.collisions.push_back(make_collision(SphereShape{r}, surface_of(options.mu)));
  model.links.push_back(wheel);
  JointSpec joint =
      make_joint(name, JointType::kRevolute, "chassis", name + "_wheel", at(x, y, r), {0, 1, 0});
  if (options.velocity_limit_rad_s > 0.0) joint.velocity = options.velocity_limit_rad_s;
  model.joints.push_back(joint);
}

PluginSpec make_cart_drive(const CartOptions& options) {
  ParamList params = options.params;
  const auto add = [&params](const char* key, const std::string& value) {
    for (const auto& [known, given] : params) {
      if (known == key) return;
    }
    params.emplace_back(key, value);
  };
  add("wheelSeparation", text(options.separation_m));
  add("wheelDiameter", text(2.0 * options.wheel_radius_m));
  if (options.four_wheels) {
    add("leftFrontJoint", "left_front");
    add("leftRearJoint", "left_rear");
    add("rightFrontJoint", "right_front");
    add("rightRearJoint", "right_rear");
    return make_plugin("drive", "libgazebo_ros_skid_steer_drive.so", params);
  }
  add("leftJoint", "left");
  add("rightJoint", "right");
  add("legacyMode", "false");
  return make_plugin("drive", "libgazebo_ros_diff_drive.so", params);
}

}  // namespace

ModelSpec make_cart(const CartOptions& options) {
  ModelSpec model;
  model.name = "cart";
  model.T_world_model = options.T_world_model;
  LinkSpec chassis = make_link("chassis", options.mass_kg, {0.05, 0.08, 0.1});
  chassis.inertial.T_link_com = at(0, 0, options.wheel_radius_m);
  const double y = 0.5 * options.separation_m, x = 0.5 * options.wheelbase_m;
  if (!options.four_wheels) {
    add_caster(chassis, "front", x);
    add_caster(chassis, "rear", -x);
  }
  model.links.push_back(chassis);
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0.0 ? "left" : "right";
    if (options.four_wheels) {
      add_wheel(model, options, name + "_front", x, side * y);
      add_wheel(model, options, name + "_rear", -x, side * y);
    } else {
      add_wheel(model, options, name, 0.0, side * y);
    }
  }
  if (options.with_drive) model.plugins = {make_cart_drive(options)};
  for (const PluginSpec& plugin : options.more_plugins) model.plugins.push_back(plugin);
  return model;
}

CartWorld::CartWorld(const CartOptions& options, double dt_s, const SE3& T_world_ground)
    : world(world_spec(dt_s)), dt_s_(dt_s) {
  ModelSpec ground = make_ground(surface_of(100.0));
  ground.T_world_model = T_world_ground;
  world.add(std::move(ground));
  model = &world.add(make_cart(options));
  odometry = world->ports().find_out<OdometrySample>("odom");
  if (odometry != nullptr) odometry->add_listener();
}

void CartWorld::command(double v, double w) {
  world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {v, 0, 0}, {0, 0, w}});
}

void CartWorld::run(double seconds) {
  world->step(static_cast<std::uint64_t>(std::llround(seconds / dt_s_)));
}

double CartWorld::speed() const {
  const Link& link = *model->canonical_link();
  const Eigen::Vector3d ahead = link.T_world_link().R * Eigen::Vector3d::UnitX();
  return link.v_world_at(link.T_world_link().p).dot(ahead);
}

}  // namespace trident::sim
