// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "models.h"
#include "ray_check.h"
#include "test_world.h"
#include "trident_sim/samples.h"

namespace trident::sim {

/// A `<camera>` element and the plugin that it is given.
struct CameraOptions {
  std::string file = "libtrident_camera.so", type = "camera";
  int width = 160, height = 120;
  double angle_of_view_rad = 1.2, near_m = 0.1, far_m = 50.0;
  std::string format = "R8G8B8";
  double stddev = 0.0;
  double rate_hz = 10.0;
  ParamList params;
  std::vector<ParamNode> extra;                     ///< further children of `<camera>`
  std::vector<std::pair<std::string, SE3>> places;  ///< of several cameras; none: one at the origin
  SE3 T_link_sensor;
};

inline ParamNode text_node(const std::string& name, const std::string& text) {
  return {name, text, {}, {}};
}

inline ParamNode camera_node(const CameraOptions& options) {
  const auto number = [](const char* name, double value) {
    return text_node(name, std::to_string(value));
  };
  const ParamNode image{
      "image",
      "",
      {},
      {text_node("width", std::to_string(options.width)),
       text_node("height", std::to_string(options.height)), text_node("format", options.format)}};
  const ParamNode clip{
      "clip", "", {}, {number("near", options.near_m), number("far", options.far_m)}};
  const ParamNode noise{
      "noise", "", {}, {text_node("type", "gaussian"), number("stddev", options.stddev)}};
  ParamNode camera{
      "camera", "", {}, {number("horizontal_fov", options.angle_of_view_rad), image, clip, noise}};
  camera.children.insert(camera.children.end(), options.extra.begin(), options.extra.end());
  return camera;
}

inline SensorSpec make_camera_sensor(const CameraOptions& options) {
  SensorSpec sensor;
  sensor.name = "eye";
  sensor.type = options.type;
  sensor.update_rate_hz = options.rate_hz;
  sensor.T_link_sensor = options.T_link_sensor;
  sensor.params.name = "sensor";
  if (options.places.empty()) sensor.params.children.push_back(camera_node(options));
  for (const auto& [name, T] : options.places) {
    ParamNode camera = camera_node(options);
    camera.attributes.emplace_back("name", name);
    camera.children.push_back(text_node("pose", std::to_string(T.p.x()) + " " +
                                                    std::to_string(T.p.y()) + " " +
                                                    std::to_string(T.p.z()) + " 0 0 0"));
    sensor.params.children.push_back(camera);
  }
  ParamList params = options.params;
  params.insert(params.begin(), {"robotNamespace", "r"});
  sensor.plugins.push_back(make_plugin("p", options.file, params));
  return sensor;
}

/// A weightless body without a look that carries the camera, at the origin by default.
inline ModelSpec robot_with_camera(const CameraOptions& options, const SE3& T_world_model = {}) {
  ModelSpec model = make_body("robot", SphereShape{0.05}, T_world_model);
  model.links[0].gravity = false;
  model.links[0].collisions.clear();
  model.links[0].sensors.push_back(make_camera_sensor(options));
  return model;
}

/// The port of a sample, from now on listened to.
template <class Sample>
OutPort<Sample>& listen_to(TestWorld& world, const std::string& name) {
  auto* port = world->ports().find_out<Sample>(name);
  if (port == nullptr) throw Error("there is no port '" + name + "'");
  port->add_listener();
  return *port;
}

/// A surface that shines by itself, whatever the light.
inline Material glowing(double red, double green, double blue) {
  Material material;
  material.is_given = true;
  material.ambient = material.diffuse = {0, 0, 0, 1};
  material.emissive = {red, green, blue, 1};
  return material;
}

/// Nothing shines but what glows.
inline WorldSpec dark_world() {
  WorldSpec spec = weightless();
  spec.scene.background = {0, 0, 0, 1};
  return spec;
}

/// Point of a world seen by a camera at the origin that looks along x, in its optical frame.
inline Eigen::Vector3d optical(const Eigen::Vector3d& p_world) {
  return {-p_world.y(), -p_world.z(), p_world.x()};
}

/// By CameraInfo, as ROS defines it.
inline Eigen::Vector2d projected(const CameraInfoSample& info, const Eigen::Vector3d& p) {
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const auto& [k1, k2, t1, t2, k3] = info.D;
  const double radial = 1.0 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  const double u = x * radial + 2.0 * t1 * x * y + t2 * (r2 + 2.0 * x * x);
  const double v = y * radial + t1 * (r2 + 2.0 * y * y) + 2.0 * t2 * x * y;
  return {info.K[0] * u + info.K[1] * v + info.K[2], info.K[4] * v + info.K[5]};
}

/// Three bytes of a pixel.
inline std::array<int, 3> pixel(const ImageSample& image, int column, int row) {
  const std::uint8_t* const p = &image.data[static_cast<std::size_t>(row) * image.bytes_per_row +
                                            3 * static_cast<std::size_t>(column)];
  return {p[0], p[1], p[2]};
}

/// Of a 32FC1 picture [m].
inline float depth_at(const ImageSample& image, int column, int row) {
  float depth = 0.0F;
  std::memcpy(&depth,
              &image.data[static_cast<std::size_t>(row) * image.bytes_per_row +
                          4 * static_cast<std::size_t>(column)],
              4);
  return depth;
}

/// Something of each kind in view, lit.
inline void add_things(TestWorld& world) {
  world.add(make_visual("ball", SphereShape{0.5}, at(3, 0.7, 0.2)));
  world.add(make_visual("box", BoxShape{{1, 1, 1}}, SE3::from_xyz_rpy({4, -1, 0}, 0.3, 0.2, 0.1)));
  world.add(make_visual("can", CylinderShape{0.3, 1.0}, at(2, -0.4, -0.5)));
  ModelSpec ground = make_visual("ground", PlaneShape{Eigen::Vector3d::UnitZ()}, at(0, 0, -1));
  ground.is_static = true;
  world.add(ground);
}

inline WorldSpec sunny() {
  WorldSpec spec = weightless();
  LightSpec sun;
  sun.type = LightType::kDirectional;
  sun.direction_light = Eigen::Vector3d(1, 0.3, -1).normalized();
  sun.casts_shadows = true;
  spec.lights = {sun};
  return spec;
}

}  // namespace trident::sim
