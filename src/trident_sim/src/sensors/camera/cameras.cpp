// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "camera_sensor.h"
#include "core/plugins/model_params.h"
#include "sensors/camera/example_camera.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

constexpr double kFarthest = 1e6;  ///< [m] or [pixels]

/// The plugin's coefficients; the `<distortion>` of the camera where it has none, or must not.
Distortion read_distortion(const PluginParams& params, const Distortion& of_camera) {
  Distortion distortion;
  distortion.k1 = params.number("distortionK1", 0.0);
  distortion.k2 = params.number("distortionK2", 0.0);
  distortion.k3 = params.number("distortionK3", 0.0);
  distortion.t1 = params.number("distortionT1", 0.0);
  distortion.t2 = params.number("distortionT2", 0.0);
  return params.flag("autoDistortion", false) || distortion.is_none() ? of_camera : distortion;
}

double number_or(const PluginParams& params, const char* key, double fallback) {
  const double value = params.number(key, 0.0, {0.0, kFarthest});
  return value == 0.0 ? fallback : value;  // upstream's "work it out"
}

/// Where the middle of the picture is taken to be.
enum class Center { kPixelMiddle, kGazebo };

/// `<intrinsics>` as they are given, or what the angle of view means.
CameraModel read_lens(const CameraSpec& spec, Center center) {
  CameraModel model =
      CameraModel::from_angle_of_view(spec.width, spec.height, spec.angle_of_view_rad);
  if (spec.intrinsics) {
    const Intrinsics& k = *spec.intrinsics;
    model.fx = k.fx;
    model.fy = k.fy;
    model.cx = k.cx;
    model.cy = k.cy;
    model.skew = k.s;
  } else if (center == Center::kGazebo) {
    // gazebo_plugins take (width + 1) / 2 for the center.
    model.cx += 1.0;
    model.cy += 1.0;
  }
  return model;
}

CameraSetup read_setup(const PluginContext& context, const CameraSpec& spec, Center center) {
  const PluginParams& params = context.params;
  CameraSetup setup;
  setup.owner = params.owner();
  setup.spec = spec;
  setup.model = read_lens(spec, center);
  setup.projection = spec.projection;
  CameraModel& model = setup.model;
  const double focal = number_or(params, "focalLength", model.fx);
  if (std::abs(focal - model.fx) > 1e-3 * model.fx) {
    context.world.report(Severity::kWarning, params.owner() + ": <focalLength> is " +
                                                 std::to_string(focal) + " pixels, <camera> says " +
                                                 std::to_string(model.fx) +
                                                 "; the picture is drawn with the former");
  }
  if (params.number("focalLength", 0.0) != 0.0) model.fx = model.fy = focal;
  model.cx = number_or(params, "Cx", model.cx);
  model.cy = number_or(params, "Cy", model.cy);
  // CxPrime is in P only, as for a rectified pair.
  setup.rectified_cx = number_or(params, "CxPrime", model.cx);
  model.distortion = read_distortion(params, spec.distortion);
  setup.depth_range = {spec.near_m, spec.far_m, std::numeric_limits<float>::infinity()};
  return setup;
}

/// What all cameras of gazebo_plugins have: colour and its CameraInfo.
CameraSetup read_gazebo_setup(const PluginContext& context, const CameraSpec& spec,
                              const std::string& camera, const char* image, const char* info) {
  const PluginParams& params = context.params;
  CameraSetup setup = read_setup(context, spec, Center::kGazebo);
  setup.frame = resolved_frame(context, params.text("frameName", "/world"), FramePrefix::kTfPrefix);
  const auto topic = [&](const char* key, const char* fallback) {
    return camera_topic(params, camera, params.text(key, fallback));
  };
  setup.topics.image = topic("imageTopicName", image);
  setup.topics.info = topic("cameraInfoTopicName", info);
  return setup;
}

CameraSpec only_camera(const PluginContext& context) {
  std::vector<CameraSpec> specs =
      read_camera_specs(required_sensor(context), context.params.owner());
  if (specs.size() == 1) return specs.front();
  throw Error(context.params.owner() + ": the sensor has " + std::to_string(specs.size()) +
              " cameras, this plugin takes one; several are for libgazebo_ros_multicamera.so");
}

std::unique_ptr<Plugin> make_camera(const PluginContext& context, Shutter shutter) {
  const PluginParams& params = context.params;
  const std::string camera = params.text("cameraName", "");
  CameraSetup setup =
      read_gazebo_setup(context, only_camera(context), camera, "image_raw", "camera_info");
  setup.baseline_m = params.number("hackBaseline", 0.0, {-kFarthest, kFarthest});
  return std::make_unique<CameraSensor>(context, camera, std::vector<CameraSetup>{setup}, shutter);
}

/// Colour, depth and points; they differ by the names of their topics alone.
std::unique_ptr<Plugin> make_depth_camera(const PluginContext& context, const char* image,
                                          const char* info) {
  const PluginParams& params = context.params;
  const std::string camera = params.text("cameraName", "");
  CameraSetup setup = read_gazebo_setup(context, only_camera(context), camera, image, info);
  const auto topic = [&](const char* key, const char* fallback) {
    return camera_topic(params, camera, params.text(key, fallback));
  };
  setup.baseline_m = params.number("hackBaseline", 0.0, {-kFarthest, kFarthest});
  setup.topics.depth = topic("depthImageTopicName", "depth/image_raw");
  setup.topics.depth_info = topic("depthImageCameraInfoTopicName", "depth/camera_info");
  setup.topics.cloud = topic("pointCloudTopicName", "points");
  setup.depth_range.min_m = params.number("pointCloudCutoff", 0.4, {0.0, kFarthest});
  setup.depth_range.max_m = params.number("pointCloudCutoffMax", 5.0, {0.0, kFarthest});
  setup.depth_range.beyond = std::numeric_limits<float>::quiet_NaN();
  if (!(setup.depth_range.min_m < setup.depth_range.max_m)) {
    params.refuse("pointCloudCutoff", params.text("pointCloudCutoff", "0.4"),
                  "less than <pointCloudCutoffMax>, " + params.text("pointCloudCutoffMax", "5.0"));
  }
  if (params.flag("useDepth16UC1Format", false)) setup.depth_format = DepthFormat::kMillimeters;
  return std::make_unique<CameraSensor>(context, camera, std::vector<CameraSetup>{setup});
}

/// `<depthNoiseModelName>`, in letters of either case, and what goes with it.
DepthNoise read_depth_noise(const PluginParams& params, const CameraModel& model,
                            const char* fallback) {
  static const std::map<std::string, DepthNoiseModel> models = {
      {"none", DepthNoiseModel::kNone},
      {"kinect", DepthNoiseModel::kKinect},
      {"d435", DepthNoiseModel::kD435}};
  const std::string text = params.text("depthNoiseModelName", fallback);
  std::string name = text;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = models.find(name);
  if (known == models.end()) params.refuse("depthNoiseModelName", text, "none, Kinect or D435");
  DepthNoise noise;
  noise.model = known->second;
  noise.min_m = params.number("depthNoiseMinDist", noise.min_m, {0.0, kFarthest});
  noise.max_m = params.number("depthNoiseMaxDist", noise.max_m, {0.0, kFarthest});
  if (!(noise.min_m < noise.max_m)) {
    params.refuse("depthNoiseMinDist", params.text("depthNoiseMinDist", "0.2"),
                  "less than <depthNoiseMaxDist>, " + params.text("depthNoiseMaxDist", "1000"));
  }
  noise.focal_px = model.fx;
  noise.baseline_m = params.number("baseline", noise.baseline_m, {1e-4, 10.0});
  noise.subpixel_error_px =
      params.number("D435NoiseSubpixelErr", noise.subpixel_error_px, {0.0, 100.0});
  noise.max_stddev_m = params.number("D435MaxStdev", noise.max_stddev_m, {0.0, kFarthest});
  return noise;
}

/// RotorS': a Kinect without points, whose depths are noisy.
std::unique_ptr<Plugin> make_noisy_depth_camera(const PluginContext& context) {
  const PluginParams& params = context.params;
  const std::string camera = params.text("cameraName", "");
  CameraSetup setup =
      read_gazebo_setup(context, only_camera(context), camera, "ir/image_raw", "ir/camera_info");
  setup.topics.depth =
      camera_topic(params, camera, params.text("depthImageTopicName", "depth/image_raw"));
  setup.topics.depth_info = camera_topic(
      params, camera, params.text("depthImageCameraInfoTopicName", "depth/camera_info"));
  setup.depth_noise = read_depth_noise(params, setup.model, "Kinect");
  // The noise has a range of its own.
  setup.depth_range = {0.0, std::numeric_limits<double>::infinity(),
                       std::numeric_limits<float>::quiet_NaN()};
  return std::make_unique<CameraSensor>(context, camera, std::vector<CameraSetup>{setup});
}

/// The first camera, or the one called left, is the left one of a pair.
std::unique_ptr<Plugin> make_multicamera(const PluginContext& context, Shutter shutter) {
  const PluginParams& params = context.params;
  const std::string prefix = params.text("cameraName", "");
  const double baseline_m = params.number("hackBaseline", 0.0, {-kFarthest, kFarthest});
  std::vector<CameraSetup> setups;
  for (const CameraSpec& spec : read_camera_specs(required_sensor(context), params.owner())) {
    const std::string camera = prefix.empty() ? spec.name : prefix + "/" + spec.name;
    setups.push_back(read_gazebo_setup(context, spec, camera, "image_raw", "camera_info"));
    // As upstream: the right camera has the baseline in its P.
    if (spec.name.find("right") != std::string::npos) setups.back().baseline_m = baseline_m;
  }
  return std::make_unique<CameraSensor>(context, prefix, setups, shutter);
}

LabelKind read_label_kind(const PluginParams& params) {
  return is_second_choice(params, "labels", "model", "link") ? LabelKind::kLink : LabelKind::kModel;
}

/// Ours: all that a camera can publish, with the true middle of the picture.
std::unique_ptr<Plugin> make_own_camera(const PluginContext& context) {
  const PluginParams& params = context.params;
  CameraSetup setup = read_setup(context, only_camera(context), Center::kPixelMiddle);
  setup.frame = resolved_frame(context, params.text("frameName", context.link->name),
                               FramePrefix::kTfPrefixOrNamespace);
  const std::string camera = params.text("cameraName", context.sensor->name);
  const auto topic = [&](const char* key, const char* fallback) {
    return camera_topic(params, camera, params.text(key, fallback));
  };
  setup.topics = {topic("imageTopicName", "image_raw"),
                  topic("cameraInfoTopicName", "camera_info"),
                  topic("depthImageTopicName", "depth/image_raw"),
                  topic("depthImageCameraInfoTopicName", "depth/camera_info"),
                  topic("pointCloudTopicName", "points"),
                  topic("labelImageTopicName", "segmentation/image_raw"),
                  topic("boundingBoxesTopicName", "segmentation/boxes")};
  if (params.flag("useDepth16UC1Format", false)) setup.depth_format = DepthFormat::kMillimeters;
  setup.label_kind = read_label_kind(params);
  setup.depth_noise = read_depth_noise(params, setup.model, "none");
  return std::make_unique<CameraSensor>(context, camera, std::vector<CameraSetup>{setup});
}

PluginFactory gazebo_camera(Shutter shutter) {
  return {[shutter](const PluginContext& context) { return make_camera(context, shutter); }, {}};
}

PluginFactory gazebo_depth_camera(const char* image, const char* info) {
  return {[=](const PluginContext& context) { return make_depth_camera(context, image, info); },
          {}};
}

PluginFactory gazebo_multicamera(Shutter shutter) {
  return {[shutter](const PluginContext& context) { return make_multicamera(context, shutter); },
          {}};
}

PluginExample camera_example(std::vector<std::string> numbers) {
  return {"<cameraName>eye</cameraName><updateRate>50</updateRate>",
          {},
          std::move(numbers),
          kExampleCamera};
}

/// Of a camera that takes the elements of the lens; `more` are further elements that are numbers.
PluginExample lens_example(const std::vector<std::string>& more = {}) {
  std::vector<std::string> numbers = {"updateRate", "focalLength",  "Cx",
                                      "CxPrime",    "distortionK1", "distortionT2"};
  numbers.insert(numbers.end(), more.begin(), more.end());
  return camera_example(std::move(numbers));
}

const PluginRegistrar kGazeboRosCamera("libgazebo_ros_camera.so", gazebo_camera(Shutter::kRate),
                                       lens_example());
const PluginRegistrar kGazeboRosTriggeredCamera("libgazebo_ros_triggered_camera.so",
                                                gazebo_camera(Shutter::kTrigger), lens_example());
const PluginRegistrar kGazeboRosDepthCamera("libgazebo_ros_depth_camera.so",
                                            gazebo_depth_camera("image_raw", "camera_info"),
                                            lens_example({"hackBaseline", "pointCloudCutoff"}));
const PluginRegistrar kGazeboRosOpenniKinect("libgazebo_ros_openni_kinect.so",
                                             gazebo_depth_camera("ir/image_raw", "ir/camera_info"),
                                             lens_example({"hackBaseline", "pointCloudCutoff"}));
const PluginRegistrar kGazeboRosMulticamera("libgazebo_ros_multicamera.so",
                                            gazebo_multicamera(Shutter::kRate), lens_example());
const PluginRegistrar kGazeboRosTriggeredMulticamera("libgazebo_ros_triggered_multicamera.so",
                                                     gazebo_multicamera(Shutter::kTrigger),
                                                     lens_example());
const PluginRegistrar kRotorsGazeboNoisydepthPlugin(
    "librotors_gazebo_noisydepth_plugin.so", {make_noisy_depth_camera, {}},
    camera_example({"updateRate", "depthNoiseMinDist", "baseline", "D435MaxStdev"}));
const PluginRegistrar kTridentCamera("libtrident_camera.so", {make_own_camera, {}}, lens_example());

}  // namespace

}  // namespace trident::sim
