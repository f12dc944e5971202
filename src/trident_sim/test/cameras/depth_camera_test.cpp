// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Cameras of depth, their noise, and pairs of cameras.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "camera_robot.h"

namespace trident::sim {
namespace {

TEST(KinectPlugin, HasTheNamesAndTheLimitsOfGazeboPlugins) {
  TestWorld world(sunny());
  add_things(world);
  CameraOptions options;
  options.file = "libgazebo_ros_openni_kinect.so";
  options.type = "depth";
  options.params = {
      {"cameraName", "kinect"}, {"pointCloudCutoff", "2.0"}, {"pointCloudCutoffMax", "3.0"}};
  world.add(robot_with_camera(options));
  auto& color = listen_to<ImageSample>(world, "r/kinect/ir/image_raw");
  auto& depth = listen_to<ImageSample>(world, "r/kinect/depth/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/kinect/depth/camera_info");
  auto& cloud = listen_to<ImageCloudSample>(world, "r/kinect/points");
  listen_to<CameraInfoSample>(world, "r/kinect/ir/camera_info");
  world->step(100);
  ASSERT_EQ(cloud.value.points.size(), 160u * 120u);
  EXPECT_FALSE(cloud.value.is_dense);
  EXPECT_DOUBLE_EQ(info.value.K[2], 80.5) << "Gazebo's (w + 1) / 2";
  int seen = 0, unseen = 0;
  for (std::size_t i = 0; i < cloud.value.points.size(); ++i) {
    float z = 0.0F;
    std::memcpy(&z, &depth.value.data[4 * i], 4);
    const ImageCloudSample::Point& point = cloud.value.points[i];
    if (std::isnan(z)) {
      EXPECT_TRUE(std::isnan(point.x) && std::isnan(point.y) && std::isnan(point.z));
      ++unseen;
      continue;
    }
    ++seen;
    EXPECT_GT(z, 2.0F);
    EXPECT_LT(z, 3.0F);
    EXPECT_EQ(point.z, z);
    const double u = static_cast<double>(i % 160), v = static_cast<double>(i / 160);
    EXPECT_NEAR(point.x, z * (u - info.value.K[2]) / info.value.K[0], 1e-5);
    EXPECT_NEAR(point.y, z * (v - info.value.K[5]) / info.value.K[4], 1e-5);
    const std::uint8_t* const c = &color.value.data[3 * i];
    EXPECT_EQ(point.rgb, static_cast<std::uint32_t>(c[0] << 16 | c[1] << 8 | c[2]));
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(unseen, 1000);
}

TEST(KinectPlugin, MillimetersOnRequest) {
  TestWorld world(weightless());
  world.add(make_visual("wall", BoxShape{{1, 5, 1}}, at(2.7344, 0, 0)));
  CameraOptions options;
  options.file = "libgazebo_ros_openni_kinect.so";
  options.params = {{"cameraName", "eye"}, {"useDepth16UC1Format", "true"}};
  world.add(robot_with_camera(options));
  auto& depth = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  world->step(100);
  EXPECT_EQ(depth.value.encoding, "16UC1");
  EXPECT_EQ(depth.value.bytes_per_row, 320u);
  const auto millimeters = [&](std::size_t i) {
    return depth.value.data[2 * i] + 256 * depth.value.data[2 * i + 1];
  };
  EXPECT_EQ(millimeters(60 * 160 + 80), 2234);
  EXPECT_EQ(millimeters(0), 0) << "nothing is there";
}

TEST(DepthCameraPlugin, HasTheNamesOfGazeboPlugins) {
  TestWorld world(weightless());
  CameraOptions options;
  options.file = "libgazebo_ros_depth_camera.so";
  options.params = {{"cameraName", "eye"}};
  world.add(robot_with_camera(options));
  for (const char* name : {"image_raw", "depth/image_raw"}) {
    EXPECT_NE(world->ports().find_out<ImageSample>("r/eye/" + std::string(name)), nullptr) << name;
  }
  for (const char* name : {"camera_info", "depth/camera_info"}) {
    EXPECT_NE(world->ports().find_out<CameraInfoSample>("r/eye/" + std::string(name)), nullptr)
        << name;
  }
  EXPECT_NE(world->ports().find_out<ImageCloudSample>("r/eye/points"), nullptr);
}

/// Mean and standard deviation of what a noisy depth camera says of a wall.
std::pair<double, double> measured_wall(double wall_m, const ParamList& params) {
  TestWorld world(weightless());
  world.add(make_visual("wall", BoxShape{{1, 40, 40}}, at(wall_m + 0.5, 0, 0)));
  CameraOptions options;
  options.file = "librotors_gazebo_noisydepth_plugin.so";
  options.params = params;
  options.params.emplace_back("cameraName", "eye");
  world.add(robot_with_camera(options));
  auto& depth = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  world->step(100);
  const std::size_t count = depth.value.data.size() / sizeof(float);
  std::vector<float> depths(count);
  std::memcpy(depths.data(), depth.value.data.data(), depth.value.data.size());
  double sum = 0.0, squares = 0.0;
  for (const float z : depths) {
    sum += z - wall_m;
    squares += (z - wall_m) * (z - wall_m);
  }
  const double n = static_cast<double>(count);
  return {sum / n, std::sqrt(squares / n)};
}

TEST(NoisyDepthPlugin, SpreadsAsTheModelsOfRealCamerasSay) {
  constexpr double kPixels = 160.0 * 120.0;
  const double focal = 80.0 / std::tan(0.6);
  struct Case {
    ParamList params;
    double wall_m, sigma_m;
  };
  const std::vector<Case> cases = {
      {{}, 1.0, 0.0012 + 0.0019 * 0.36},
      {{{"depthNoiseModelName", "kinect"}}, 4.0, 0.0012 + 0.0019 * 12.96},
      {{{"depthNoiseModelName", "D435"}}, 3.0, 9.0 * 0.1 / (focal * 0.05)},
      {{{"depthNoiseModelName", "D435"}, {"baseline", "0.1"}, {"D435NoiseSubpixelErr", "0.2"}},
       2.0,
       4.0 * 0.2 / (focal * 0.1)},
      {{{"depthNoiseModelName", "D435"}, {"D435MaxStdev", "0.05"}}, 3.0, 0.05}};
  for (const Case& c : cases) {
    const auto [mean, sigma] = measured_wall(c.wall_m, c.params);
    EXPECT_NEAR(mean, 0.0, 5.0 * c.sigma_m / std::sqrt(kPixels));
    EXPECT_NEAR(sigma, c.sigma_m, 5.0 * c.sigma_m / std::sqrt(2.0 * kPixels));
  }
  EXPECT_TRUE(std::isnan(measured_wall(3.0, {{"depthNoiseMaxDist", "2.5"}}).first));
}

TEST(MulticameraPlugin, ThePairSeesWithTheBaselineThatItPublishes) {
  TestWorld world(dark_world());
  world.add(make_visual("ball", SphereShape{0.03}, at(2.0, 0.1, 0.05), glowing(1, 1, 1)));
  CameraOptions options;
  options.file = "libgazebo_ros_multicamera.so";
  options.width = 640;
  options.height = 480;
  options.places = {{"left", at(0, 0.06, 0)}, {"right", at(0, -0.06, 0)}};
  options.params = {{"cameraName", "pair"}, {"hackBaseline", "0.12"}, {"frameName", "optical"}};
  world.add(robot_with_camera(options));
  std::vector<double> columns;
  std::vector<CameraInfoSample> infos;
  std::vector<OutPort<ImageSample>*> images;
  std::vector<OutPort<CameraInfoSample>*> info_ports;
  for (const std::string side : {"left", "right"}) {
    images.push_back(&listen_to<ImageSample>(world, "r/pair/" + side + "/image_raw"));
    info_ports.push_back(&listen_to<CameraInfoSample>(world, "r/pair/" + side + "/camera_info"));
  }
  world->step(100);
  for (const OutPort<ImageSample>* image : images) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < image->value.data.size() / 3; ++i) {
      if (image->value.data[3 * i] == 0) continue;
      sum += static_cast<double>(i % 640);
      count += 1.0;
    }
    columns.push_back(sum / count);
  }
  const CameraInfoSample &left = info_ports[0]->value, &right = info_ports[1]->value;
  EXPECT_EQ(left.P[3], 0.0);
  EXPECT_NEAR(right.P[3], -0.12 * right.K[0], 1e-9);
  EXPECT_NEAR(columns[0] - columns[1], -right.P[3] / 2.0, 0.1) << "disparity = f b / z";
}

}  // namespace
}  // namespace trident::sim
