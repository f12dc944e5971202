// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_spec.h"

#include <map>
#include <sstream>

#include "../rays/ray_budget.h"
#include "trident_base/error.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {
namespace {

constexpr double kMaxPixels = 16384;  ///< a side
constexpr double kFarthest = 1e6;     ///< [m]

const ParamNode& child_or_empty(const ParamNode& node, const char* name) {
  static const ParamNode empty;
  const ParamNode* const child = node.find(name);
  return child != nullptr ? *child : empty;
}

/// SDF's names and the older ones of Gazebo.
PixelFormat read_format(const PluginParams& image) {
  static const std::map<std::string, PixelFormat> formats = {
      {"R8G8B8", PixelFormat::kRgb8}, {"RGB_INT8", PixelFormat::kRgb8},
      {"B8G8R8", PixelFormat::kBgr8}, {"BGR_INT8", PixelFormat::kBgr8},
      {"L8", PixelFormat::kMono8},    {"L_INT8", PixelFormat::kMono8},
  };
  const std::string text = image.text("format", "R8G8B8");
  const auto known = formats.find(text);
  if (known == formats.end()) image.refuse("format", text, "R8G8B8, B8G8R8 or L8");
  return known->second;
}

GaussianNoise read_noise(const ParamNode& camera, const std::string& owner) {
  GaussianNoise noise;
  const ParamNode* const node = camera.find("noise");
  if (node == nullptr) return noise;
  const PluginParams params(*node, owner + " <noise>");
  const std::string type = params.text("type", "none");
  if (type == "none") return noise;
  if (type != "gaussian") params.refuse("type", type, "none or gaussian");
  noise.mean = params.number("mean", 0.0, {-1.0, 1.0});
  noise.stddev = params.number("stddev", 0.0, {0.0, 1.0});
  return noise;
}

Distortion read_distortion(const ParamNode& camera, const std::string& owner) {
  const PluginParams params(child_or_empty(camera, "distortion"), owner + " <distortion>");
  Distortion distortion;
  distortion.k1 = params.number("k1", 0.0);
  distortion.k2 = params.number("k2", 0.0);
  distortion.k3 = params.number("k3", 0.0);
  distortion.t1 = params.number("p1", 0.0);
  distortion.t2 = params.number("p2", 0.0);
  return distortion;
}

constexpr Limits kFocal{1e-3, 1e6}, kOffset{-1e6, 1e6};  // [pixels]

std::optional<Intrinsics> read_intrinsics(const ParamNode& lens, const std::string& owner) {
  const ParamNode* const node = lens.find("intrinsics");
  if (node == nullptr) return std::nullopt;
  const PluginParams params(*node, owner + " <intrinsics>");
  Intrinsics k;
  // <intrinsics> says how the picture is drawn, <projection> only what CameraInfo's P has.
  k.fx = params.number("fx", k.fx, kFocal);
  k.fy = params.number("fy", k.fy, kFocal);
  k.cx = params.number("cx", k.cx, kOffset);
  k.cy = params.number("cy", k.cy, kOffset);
  k.s = params.number("s", k.s, kOffset);
  return k;
}

std::optional<Projection> read_projection(const ParamNode& lens, const std::string& owner) {
  const ParamNode* const node = lens.find("projection");
  if (node == nullptr) return std::nullopt;
  const PluginParams params(*node, owner + " <projection>");
  Projection p;
  p.fx = params.number("p_fx", p.fx, kFocal);
  p.fy = params.number("p_fy", p.fy, kFocal);
  p.cx = params.number("p_cx", p.cx, kOffset);
  p.cy = params.number("p_cy", p.cy, kOffset);
  p.tx = params.number("tx", p.tx, kOffset);
  p.ty = params.number("ty", p.ty, kOffset);
  return p;
}

SE3 read_pose(const PluginParams& params) {
  const std::string text = params.text("pose", "0 0 0 0 0 0");
  std::istringstream words(text);
  double values[6];
  for (double& value : values) {
    if (!(words >> value)) params.refuse("pose", text, "six finite numbers: x y z roll pitch yaw");
  }
  return SE3::from_xyz_rpy({values[0], values[1], values[2]}, values[3], values[4], values[5]);
}

/// Before the limits of a side, so that a picture that is too large is refused as such.
void check_pixels(const PluginParams& image, const ParamNode& sensor, const std::string& owner) {
  constexpr Limits kAny{1.0, 1e9};
  const CameraSpec usual;
  const RayCount count{image.number("width", usual.width, kAny),
                       image.number("height", usual.height, kAny), "pixels"};
  check_ray_count(count, sensor, owner);
}

CameraSpec read_camera(const ParamNode& element, const ParamNode& sensor,
                       const std::string& owner) {
  CameraSpec camera;
  for (const auto& [key, value] : element.attributes) {
    if (key == "name") camera.name = value;
  }
  const std::string whose = owner + " <camera>";
  const PluginParams params(element, whose);
  camera.T_sensor_camera = read_pose(params);
  camera.angle_of_view_rad =
      params.number("horizontal_fov", camera.angle_of_view_rad, {kMinAngleOfView, kMaxAngleOfView});
  const PluginParams image(child_or_empty(element, "image"), whose + " <image>");
  check_pixels(image, sensor, whose);
  camera.width = image.integer("width", camera.width, {1.0, kMaxPixels});
  camera.height = image.integer("height", camera.height, {1.0, kMaxPixels});
  camera.format = read_format(image);
  const PluginParams clip(child_or_empty(element, "clip"), whose + " <clip>");
  camera.near_m = clip.number("near", camera.near_m, {0.0, kFarthest});
  camera.far_m = clip.number("far", camera.far_m, {0.0, kFarthest});
  if (!(camera.near_m < camera.far_m)) {
    clip.refuse("near", clip.text("near", "0.1"), "less than <far>, " + clip.text("far", "100"));
  }
  camera.noise = read_noise(element, whose);
  camera.distortion = read_distortion(element, whose);
  const ParamNode& lens = child_or_empty(element, "lens");
  camera.intrinsics = read_intrinsics(lens, whose + " <lens>");
  camera.projection = read_projection(lens, whose + " <lens>");
  return camera;
}

}  // namespace

const char* encoding_name(PixelFormat format) {
  switch (format) {
    case PixelFormat::kBgr8:
      return "bgr8";
    case PixelFormat::kMono8:
      return "mono8";
    default:
      return "rgb8";
  }
}

int channel_count(PixelFormat format) { return format == PixelFormat::kMono8 ? 1 : 3; }

std::vector<CameraSpec> read_camera_specs(const SensorSpec& sensor, const std::string& owner) {
  std::vector<CameraSpec> cameras;
  for (const ParamNode& child : sensor.params.children) {
    if (child.name == "camera") cameras.push_back(read_camera(child, sensor.params, owner));
  }
  if (cameras.empty()) throw Error(owner + ": <camera> is missing");
  return cameras;
}

}  // namespace trident::sim
