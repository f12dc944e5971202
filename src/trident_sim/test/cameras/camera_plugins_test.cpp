// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Ports, formats and parameters of the camera plugins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "camera_robot.h"
#include "ray_check.h"

namespace trident::sim {
namespace {

const std::vector<std::string> kImages = {"r/eye/image_raw", "r/eye/depth/image_raw",
                                          "r/eye/segmentation/image_raw"};

TEST(CameraPlugins, WhoElseListensChangesNothing) {
  CameraOptions options;
  options.stddev = 0.05;
  std::vector<std::vector<std::uint8_t>> first;
  // All at once, one at a time, and one that came late.
  for (int turn = 0; turn < 5; ++turn) {
    TestWorld world(sunny());
    add_things(world);
    Model& robot = world.add(robot_with_camera(options));
    world->set_model_twist(robot, {0, 0, 0}, {0, 0, 0.3});
    if (turn == 4) world->step(250);
    std::vector<OutPort<ImageSample>*> images(3, nullptr);
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_wanted = turn == 0 || turn == 4 || static_cast<int>(i) == turn - 1;
      if (is_wanted) images[i] = &listen_to<ImageSample>(world, kImages[i]);
    }
    if (turn == 0) listen_to<ImageCloudSample>(world, "r/eye/points");
    world->step(turn == 4 ? 50 : 300);
    for (std::size_t i = 0; i < 3; ++i) {
      if (turn == 0) first.push_back(images[i]->value.data);
      if (images[i] != nullptr) EXPECT_EQ(images[i]->value.data, first[i]) << turn << " " << i;
    }
  }
}

TEST(CameraPlugins, WithoutListenersNothingIsDrawn) {
  TestWorld world(sunny());
  add_things(world);
  world.add(robot_with_camera({}));
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(300);
  EXPECT_EQ(info.count(), 3u);
  EXPECT_EQ(rays(*world, RayGeometry::kVisual).commits().fixed, 0u) << "the scene was not needed";
  for (const std::string& name : kImages) {
    EXPECT_EQ(world->ports().find_out<ImageSample>(name)->count(), 0u);
  }
}

TEST(CameraPlugins, PicturesComeAtTheirRateStampedWithTheEndOfTheStep) {
  TestWorld world(sunny());
  CameraOptions options;
  options.file = "libgazebo_ros_camera.so";
  options.rate_hz = 40.0;
  options.params = {{"cameraName", "eye"}, {"updateRate", "20"}, {"frameName", "eye_optical"}};
  world.add(robot_with_camera(options));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(1000);
  EXPECT_EQ(image.count(), 20u) << "the slower of both rates";
  EXPECT_EQ(image.value.stamp, SimTime{1'000'000'000});
  EXPECT_EQ(info.value.stamp, image.value.stamp);
  EXPECT_EQ(image.value.frame, "eye_optical");
  EXPECT_EQ(info.value.frame, "eye_optical");
}

TEST(CameraPlugins, NoiseHasItsSpreadAndIsNewEveryTime) {
  TestWorld world(weightless());
  CameraOptions options;
  options.stddev = 0.04;
  world.add(robot_with_camera(options));  // an empty world: the background of 0.7
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  world->step(100);
  const std::vector<std::uint8_t> first = image.value.data;
  world->step(100);
  double sum = 0.0, squares = 0.0, product = 0.0;
  const double n = static_cast<double>(first.size()) / 3.0;
  for (std::size_t i = 0; i < first.size(); i += 3) {
    const double a = first[i] - 0.7 * 255.0, b = image.value.data[i] - 0.7 * 255.0;
    EXPECT_EQ(first[i], first[i + 1]) << "as Gazebo's: one number for a pixel";
    sum += a;
    squares += a * a;
    product += a * b;
  }
  const double sigma = 0.04 * 255.0;
  EXPECT_NEAR(sum / n, 0.0, 5.0 * sigma / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), sigma, 5.0 * sigma / std::sqrt(2.0 * n));
  EXPECT_NEAR(product / n, 0.0, 5.0 * sigma * sigma / std::sqrt(n));
}

struct BadCase {
  std::string expected;
  CameraOptions options;
};

std::vector<BadCase> bad_cases() {
  std::vector<BadCase> cases;
  const auto add = [&](const std::string& expected, auto&& change) {
    CameraOptions options;
    change(options);
    cases.push_back({expected, options});
  };
  add("<width> is '0'", [](CameraOptions& o) { o.width = 0; });
  add("<height> is '-3'", [](CameraOptions& o) { o.height = -3; });
  add("<width> is '20000', expected", [](CameraOptions& o) { o.width = 20000; });
  add("1e+05 x 1e+05 pixels are 1e+10 rays, must be at most 2e+07 (<trident:max_rays>",
      [](CameraOptions& o) { o.width = o.height = 100000; });
  add("<horizontal_fov> is '0.000000', expected",
      [](CameraOptions& o) { o.angle_of_view_rad = 0; });
  add("<horizontal_fov> is '3.200000', expected",
      [](CameraOptions& o) { o.angle_of_view_rad = 3.2; });
  add("less than <far>", [](CameraOptions& o) { o.near_m = o.far_m = 2.0; });
  add("<format> is 'BAYER_RGGB8', expected R8G8B8",
      [](CameraOptions& o) { o.format = "BAYER_RGGB8"; });
  add("<distortionK1> is 'nan'", [](CameraOptions& o) { o.params = {{"distortionK1", "nan"}}; });
  add("the distortion is too strong", [](CameraOptions& o) {
    o.params = {{"distortionK1", "-3"}};
  });
  add("<labels> is 'pixel', expected", [](CameraOptions& o) { o.params = {{"labels", "pixel"}}; });
  add("<depthNoiseModelName> is 'PMD', expected none, Kinect or D435", [](CameraOptions& o) {
    o.params = {{"depthNoiseModelName", "PMD"}};
  });
  add("less than <pointCloudCutoffMax>", [](CameraOptions& o) {
    o.file = "libgazebo_ros_openni_kinect.so";
    o.params = {{"pointCloudCutoff", "6"}};
  });
  add("the sensor has 2 cameras", [](CameraOptions& o) { o.places = {{"a", {}}, {"b", {}}}; });
  add("six finite numbers", [](CameraOptions& o) { o.extra = {text_node("pose", "1 2 3")}; });
  return cases;
}

TEST(CameraPlugins, BadInputIsRefusedWithOneClearError) {
  for (const BadCase& bad : bad_cases()) {
    TestWorld world(weightless());
    const std::string error = error_of([&] { world.add(robot_with_camera(bad.options)); });
    EXPECT_TRUE(contains(error, bad.expected));
    EXPECT_TRUE(contains(error, "model 'robot'"));
    EXPECT_TRUE(world->models().empty());
  }
}

TEST(CameraPlugins, AFocalLengthThatContradictsTheAngleOfViewIsReported) {
  TestWorld world(weightless());
  CameraOptions options;
  options.params = {{"focalLength", "200"}};
  world.add(robot_with_camera(options));
  EXPECT_EQ(world.report_count(Severity::kWarning, "<focalLength> is 200"), 1u);
}

}  // namespace
}  // namespace trident::sim
