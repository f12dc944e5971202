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

namespace trident {
namespace {

SE3 at(double x, double y, double z) { return SE3::from_xyz_rpy({x, y, z}, 0, 0, 0); }

const std::vector<std::string> kImages = {"r/eye/image_raw", "r/eye/depth/image_raw",
                                          "r/eye/segmentation/image_raw"};

/// Something of each kind in view, lit.
void add_things(TestWorld& world) {
  world.add(make_visual("ball", SphereShape{0.5}, at(3, 0.7, 0.2)));
  world.add(make_visual("box", BoxShape{{1, 1, 1}}, SE3::from_xyz_rpy({4, -1, 0}, 0.3, 0.2, 0.1)));
  world.add(make_visual("can", CylinderShape{0.3, 1.0}, at(2, -0.4, -0.5)));
  ModelSpec ground = make_visual("ground", PlaneShape{Eigen::Vector3d::UnitZ()}, at(0, 0, -1));
  ground.is_static = true;
  world.add(ground);
}

WorldSpec sunny() {
  WorldSpec spec = weightless();
  LightSpec sun;
  sun.type = LightType::kDirectional;
  sun.direction_light = Eigen::Vector3d(1, 0.3, -1).normalized();
  sun.casts_shadows = true;
  spec.lights = {sun};
  return spec;
}

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
  EXPECT_EQ(world->rays(RayGeometry::kVisual).commits().fixed, 0u) << "the scene was not needed";
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

TEST(KinectPlugin, MillimetresOnRequest) {
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
  const auto millimetres = [&](std::size_t i) {
    return depth.value.data[2 * i] + 256 * depth.value.data[2 * i + 1];
  };
  EXPECT_EQ(millimetres(60 * 160 + 80), 2234);
  EXPECT_EQ(millimetres(0), 0) << "nothing is there";
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

TEST(MulticameraPlugin, ThePairSeesWithTheBaselineThatItTells) {
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

/// Distance at which a ray from the origin meets a level box; infinite: it does not.
double meets(const Eigen::Vector3d& d, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  const Eigen::Array3d low = (centre - 0.5 * size).array() / d.array();
  const Eigen::Array3d high = (centre + 0.5 * size).array() / d.array();
  const double enter = low.min(high).maxCoeff(), leave = low.max(high).minCoeff();
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

TEST(SegmentationCamera, LabelsAndBoxesAreExact) {
  TestWorld world(weightless());
  const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> things = {
      {{3.5, 0.3, 0.0}, {1, 2, 1}}, {{2.25, 0.5037, 0.1012}, {0.5, 0.4, 0.4}}};
  const char* const names[] = {"big", "small"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [p, size] = things[i];
    world.add(make_visual(names[i], BoxShape{size}, at(p.x(), p.y(), p.z())));
  }
  world.add(make_visual("hidden", BoxShape{{0.2, 0.2, 0.2}}, at(6, 0.3, 0)));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/segmentation/image_raw");
  auto& boxes = listen_to<BoundingBoxesSample>(world, "r/eye/segmentation/boxes");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  ASSERT_EQ(boxes.value.boxes.size(), 2u);
  EXPECT_EQ(image.value.encoding, "mono16");
  // Numbers of the models in name order, from 1: big, hidden, robot, small.
  const std::uint32_t labels[] = {1, 4};
  std::array<BoundingBoxesSample::Box, 2> expected;
  for (std::uint32_t row = 0; row < 120; ++row) {
    for (std::uint32_t column = 0; column < 160; ++column) {
      const Eigen::Vector3d d(1.0, -(column - info.value.K[2]) / info.value.K[0],
                              -(row - info.value.K[5]) / info.value.K[4]);
      const double big = meets(d, things[0].first, things[0].second);
      const double small = meets(d, things[1].first, things[1].second);
      const std::size_t pixel = 2 * (std::size_t{row} * 160 + column);
      const int label = image.value.data[pixel] + 256 * image.value.data[pixel + 1];
      if (std::isinf(big) && std::isinf(small)) {
        EXPECT_EQ(label, 0) << column << " " << row;
        continue;
      }
      const std::size_t nearest = big < small ? 0 : 1;
      EXPECT_EQ(label, static_cast<int>(labels[nearest])) << column << " " << row;
      BoundingBoxesSample::Box& box = expected[nearest];
      if (box.pixels++ == 0) box.x_min = column, box.y_min = row;
      box.x_min = std::min(box.x_min, column);
      box.x_max = std::max(box.x_max, column);
      box.y_max = row;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const BoundingBoxesSample::Box &told = boxes.value.boxes[i], &right = expected[i];
    EXPECT_EQ(told.name, names[i]);
    EXPECT_EQ(told.label, labels[i]);
    EXPECT_EQ(told.pixels, right.pixels);
    EXPECT_EQ(told.x_min, right.x_min);
    EXPECT_EQ(told.x_max, right.x_max);
    EXPECT_EQ(told.y_min, right.y_min);
    EXPECT_EQ(told.y_max, right.y_max);
  }
}

TEST(SegmentationCamera, LabelsLinksOnRequest) {
  TestWorld world(weightless());
  ModelSpec pair = make_visual("pair", BoxShape{{1, 1, 1}}, at(4, 0, 0));
  pair.links.push_back(pair.links[0]);
  pair.links[1].name = "other";
  pair.links[1].T_model_link = at(0, 2, 0);
  world.add(pair);
  CameraOptions options;
  options.params = {{"labels", "link"}};
  world.add(robot_with_camera(options));
  auto& boxes = listen_to<BoundingBoxesSample>(world, "r/eye/segmentation/boxes");
  world->step(100);
  ASSERT_EQ(boxes.value.boxes.size(), 2u);
  EXPECT_EQ(boxes.value.boxes[0].name, "pair::link");
  EXPECT_EQ(boxes.value.boxes[1].name, "pair::other");
  EXPECT_GT(boxes.value.boxes[0].x_min, boxes.value.boxes[1].x_max) << "+y is left";
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

TEST(CameraPlugins, AFocalLengthThatContradictsTheAngleOfViewIsTold) {
  TestWorld world(weightless());
  CameraOptions options;
  options.params = {{"focalLength", "200"}};
  world.add(robot_with_camera(options));
  EXPECT_EQ(world.told(Severity::kWarning, "<focalLength> is 200"), 1u);
}

}  // namespace
}  // namespace trident
