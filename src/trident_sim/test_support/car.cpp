// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "car.h"

#include <cmath>

namespace trident::sim {
namespace {

LinkSpec make_wheel(const std::string& name, const CarOptions& options, const SE3& T_model_wheel) {
  constexpr double kMass_kg = 0.5;
  const double r = options.wheel_radius_m, across = 0.26 * kMass_kg * r * r;
  LinkSpec wheel =
      make_link(name + "_wheel", kMass_kg, {across, 0.5 * kMass_kg * r * r, across}, T_model_wheel);
  Surface surface;
  surface.mu = surface.mu2 = options.mu;
  // A ball touches the ground below its middle only, so lengths are what they say.
  wheel.collisions.push_back(make_collision(SphereShape{r}, surface));
  return wheel;
}

void limit(AxisSpec& axis, double stop_rad) {
  axis.lower = -stop_rad;
  axis.upper = stop_rad;
}

void add_front(ModelSpec& model, const CarOptions& options, const std::string& side, const SE3& T) {
  const std::string wheel = "front_" + side + "_wheel";
  model.links.push_back(make_wheel("front_" + side, options, T));
  if (options.universal) {
    JointSpec both = make_joint("front_" + side, JointType::kUniversal, "chassis", wheel, T,
                                Eigen::Vector3d::UnitZ());
    both.axis2.axis_model = Eigen::Vector3d::UnitY();
    limit(both, options.steering_stop_rad);
    model.joints.push_back(both);
    return;
  }
  model.links.push_back(make_link(side + "_knuckle", 0.2, {2e-4, 2e-4, 2e-4}, T));
  JointSpec steer = make_joint("steer_" + side, JointType::kRevolute, "chassis", side + "_knuckle",
                               T, Eigen::Vector3d::UnitZ());
  limit(steer, options.steering_stop_rad);
  model.joints.push_back(steer);
  model.joints.push_back(make_joint("front_" + side, JointType::kRevolute, side + "_knuckle", wheel,
                                    T, Eigen::Vector3d::UnitY()));
}

void add_rear(ModelSpec& model, const CarOptions& options, const std::string& side, const SE3& T) {
  model.links.push_back(make_wheel("rear_" + side, options, T));
  JointSpec joint = make_joint("rear_" + side, JointType::kRevolute, "chassis",
                               "rear_" + side + "_wheel", T, Eigen::Vector3d::UnitY());
  if (options.velocity_limit_rad_s > 0.0) joint.velocity = options.velocity_limit_rad_s;
  model.joints.push_back(joint);
}

PluginSpec make_car_drive(const CarOptions& options) {
  ParamList params = options.params;
  const std::string steer = options.universal ? "front_" : "steer_";
  const ParamList own{{"front_left_joint", "front_left"},
                      {"front_right_joint", "front_right"},
                      {"rear_left_joint", "rear_left"},
                      {"rear_right_joint", "rear_right"},
                      {"left_steering_joint", steer + "left"},
                      {"right_steering_joint", steer + "right"},
                      {"publish_odom", "true"}};
  for (const auto& [key, value] : own) {
    bool is_given = false;
    for (const auto& [given, text] : options.params) is_given = is_given || given == key;
    if (!is_given) params.emplace_back(key, value);
  }
  return make_plugin("drive", "libgazebo_ros_ackermann_drive.so", params);
}

}  // namespace

ModelSpec make_car(const CarOptions& options) {
  ModelSpec model;
  model.name = "car";
  model.T_world_model = options.T_world_model;
  const double rear = -options.front_of_axle_m, r = options.wheel_radius_m;
  LinkSpec chassis = make_link("chassis", 10.0, {0.1, 0.4, 0.45});
  chassis.inertial.T_link_com = at(rear + 0.5 * options.wheelbase_m, 0, r);
  model.links.push_back(chassis);
  for (const double sign : {1.0, -1.0}) {
    const std::string side = sign > 0.0 ? "left" : "right";
    const double y = 0.5 * sign * options.track_m;
    add_front(model, options, side, at(rear + options.wheelbase_m, y, r));
    add_rear(model, options, side, at(rear, y, r));
  }
  model.plugins = {make_car_drive(options)};
  return model;
}

CarWorld::CarWorld(const CarOptions& options, double dt_s)
    : world(world_spec(dt_s)), options_(options), dt_s_(dt_s) {
  Surface rough;
  rough.mu = rough.mu2 = 100.0;
  world.add(make_ground(rough));
  model = &world.add(make_car(options));
  odometry = world->ports().find_out<OdometrySample>("odom");
  if (odometry != nullptr) odometry->add_listener();
}

void CarWorld::command(double v, double w) {
  world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {v, 0, 0}, {0, 0, w}});
}

void CarWorld::run(double seconds) {
  world->step(static_cast<std::uint64_t>(std::llround(seconds / dt_s_)));
}

Eigen::Vector2d CarWorld::axle() const {
  return truth() * Eigen::Vector2d(-options_.front_of_axle_m, 0.0);
}

Eigen::Vector2d CarWorld::wheel_angles() const {
  const std::string steer = options_.universal ? "front_" : "steer_";
  return {model->find_joint(steer + "left")->position(),
          model->find_joint(steer + "right")->position()};
}

double CarWorld::radius(double seconds) {
  const Eigen::Vector2d a = axle();
  run(seconds);
  const Eigen::Vector2d b = axle();
  run(seconds);
  const Eigen::Vector2d c = axle();
  const Eigen::Vector2d ab = b - a, ac = c - a;
  const double twice_area = std::abs(ab.x() * ac.y() - ab.y() * ac.x());
  return ab.norm() * ac.norm() * (c - b).norm() / (2.0 * twice_area);
}

}  // namespace trident::sim
