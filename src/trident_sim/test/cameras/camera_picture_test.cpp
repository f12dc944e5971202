// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What is in the pictures: where things appear, how far they are, what covers them.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "camera_robot.h"
#include "ray_check.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

/// Middle of what is not black in a square around a pixel.
Eigen::Vector2d centroid(const ImageSample& image, const Eigen::Vector2d& near) {
  constexpr int kReach = 15;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  const int u = static_cast<int>(std::lround(near.x())),
            v = static_cast<int>(std::lround(near.y()));
  for (int row = v - kReach; row <= v + kReach; ++row) {
    for (int column = u - kReach; column <= u + kReach; ++column) {
      if (pixel(image, column, row)[0] == 0) continue;
      sum += Eigen::Vector2d(column, row);
      count += 1.0;
    }
  }
  return sum / count;
}

class ProjectionCase : public testing::TestWithParam<CameraOptions> {};

TEST_P(ProjectionCase, ThingsAppearWhereCameraInfoSaysSo) {
  CameraOptions options = GetParam();
  options.width = 640;
  options.height = 480;
  TestWorld world(dark_world());
  std::vector<Eigen::Vector3d> points;
  for (const double y : {-1.0, -0.3, 0.05, 0.9}) {
    for (const double z : {-0.7, 0.1, 0.62}) points.emplace_back(2.0 + 0.3 * y, y, z);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    world.add(make_visual("ball" + std::to_string(i), SphereShape{0.025},
                          at(points[i].x(), points[i].y(), points[i].z()), glowing(1, 1, 1)));
  }
  world.add(robot_with_camera(options));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  ASSERT_EQ(image.count(), 1u);
  double squares = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d expected = projected(info.value, optical(p));
    const Eigen::Vector2d error = centroid(image.value, expected) - expected;
    EXPECT_LT(error.norm(), 0.25) << p.transpose();
    squares += error.squaredNorm();
    sum += error;
  }
  // A ball of a dozen pixels gives its middle to about a tenth; all of them together better.
  EXPECT_LT(sum.norm() / static_cast<double>(points.size()), 0.1);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(points.size())), 0.12);
}

CameraOptions projection_case(const std::string& file, const ParamList& params) {
  CameraOptions options;
  options.file = file;
  options.params = params;
  options.params.emplace_back("cameraName", "eye");
  return options;
}
const ParamList kDistorted = {{"distortionK1", "-0.25"},
                              {"distortionK2", "0.06"},
                              {"distortionK3", "-0.004"},
                              {"distortionT1", "0.002"},
                              {"distortionT2", "-0.003"}};
/// With `<lens><intrinsics>`, skewed and with pixels that are not square.
CameraOptions with_lens(CameraOptions options) {
  const ParamNode intrinsics{
      "intrinsics",
      "",
      {},
      {text_node("fx", "500"), text_node("fy", "450.5"), text_node("cx", "310.25"),
       text_node("cy", "251"), text_node("s", "12")}};
  options.extra.push_back({"lens", "", {}, {intrinsics}});
  return options;
}
INSTANTIATE_TEST_SUITE_P(
    All, ProjectionCase,
    testing::Values(projection_case("libtrident_camera.so", {}),
                    projection_case("libgazebo_ros_camera.so", {}),
                    projection_case("libtrident_camera.so", kDistorted),
                    projection_case("libgazebo_ros_camera.so", kDistorted),
                    projection_case("libgazebo_ros_camera.so", {{"Cx", "300.25"}, {"Cy", "250.5"}}),
                    with_lens(projection_case("libtrident_camera.so", {})),
                    with_lens(projection_case("libgazebo_ros_camera.so", kDistorted))));

TEST(CameraPicture, DepthIsThatOfTheSurfaceAlongTheAxis) {
  TestWorld world(weightless());
  world.add(make_visual("ball", SphereShape{0.5}, at(3, 0.4, 0.2)));
  world.add(
      make_visual("wall", BoxShape{{0.2, 20, 20}}, SE3::from_xyz_rpy({6, 0, 0}, 0.0, 0.0, 0.4)));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/depth/camera_info");
  world->step(100);
  EXPECT_EQ(image.value.encoding, "32FC1");
  // The wall's near face: normal (-cos 0.4, -sin 0.4, 0).
  const Eigen::Vector3d normal(std::cos(0.4), std::sin(0.4), 0.0), center(3, 0.4, 0.2);
  const double wall = normal.x() * 6.0 - 0.1;
  int on_ball = 0, near_rim = 0;
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Eigen::Vector3d d(1.0, -(column - info.value.K[2]) / info.value.K[0],
                              -(row - info.value.K[5]) / info.value.K[4]);
      double expected = wall / normal.dot(d);
      const double a = d.squaredNorm(), b = d.dot(center);
      const double root = b * b - a * (center.squaredNorm() - 0.25);
      near_rim += std::abs(root) < 1e-5 ? 1 : 0;
      if (std::abs(root) < 1e-5) continue;
      if (root > 0.0) expected = (b - std::sqrt(root)) / a;
      on_ball += root > 0.0 ? 1 : 0;
      EXPECT_NEAR(depth_at(image.value, column, row), expected, 1e-4) << column << " " << row;
    }
  }
  EXPECT_GT(on_ball, 500);
  EXPECT_LT(near_rim, 10);
}

TEST(CameraPicture, WhatIsOutsideOfTheClippingPlanesIsNotSeen) {
  TestWorld world(weightless());
  world.add(make_visual("near", BoxShape{{0.1, 10, 1}}, at(0.4, 0, 0)));
  world.add(make_visual("far", BoxShape{{0.1, 10, 10}}, at(4, 0, 0)));
  CameraOptions options;
  options.near_m = 0.5;
  options.far_m = 3.0;
  world.add(robot_with_camera(options));
  auto& image = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  world->step(100);
  for (int row = 0; row < 120; ++row) {
    EXPECT_EQ(depth_at(image.value, 80, row), std::numeric_limits<float>::infinity());
  }
}

TEST(CameraPicture, ACameraLooksOutOfItsHousing) {
  TestWorld world(dark_world());
  world.add(make_visual("thing", BoxShape{{1, 20, 20}}, at(5, 0, 0), glowing(0, 1, 0)));
  CameraOptions options;
  options.near_m = 0.02;
  ModelSpec robot = robot_with_camera(options);
  for (const Shape& shape : {Shape(BoxShape{{0.3, 0.3, 0.3}}), Shape(SphereShape{0.4}),
                             Shape(CylinderShape{0.5, 1.0})}) {
    VisualSpec housing;
    housing.name = "housing" + std::to_string(robot.links[0].visuals.size());
    housing.shape = shape;
    housing.material = glowing(1, 0, 0);
    robot.links[0].visuals.push_back(housing);
  }
  world.add(robot);
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  world->step(100);
  for (int row = 0; row < 120; row += 7) {
    for (int column = 0; column < 160; column += 7) {
      EXPECT_EQ(pixel(image.value, column, row), (std::array<int, 3>{0, 255, 0}));
    }
  }
}

/// A square picture.
std::string write_picture(const ScratchFolder& folder, const std::vector<std::uint8_t>& rgb) {
  const std::string file = folder.path() + "/picture.png";
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png.height = static_cast<png_uint_32>(std::lround(std::sqrt(rgb.size() / 3)));
  png.format = PNG_FORMAT_RGB;
  EXPECT_NE(png_image_write_to_file(&png, file.c_str(), 0, rgb.data(), 0, nullptr), 0);
  return file;
}

TEST(CameraPicture, TexturesAreUprightAndNotMirrored) {
  const ScratchFolder folder;
  WorldSpec spec = dark_world();
  spec.scene.ambient = {1, 1, 1, 1};
  TestWorld world(spec);
  Material material;
  material.is_given = true;
  material.texture_file = write_picture(folder, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
  world.add(make_visual("poster", BoxShape{{0.1, 2, 2}}, at(3, 0, 0), material));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  const auto seen = [&](double y, double z) {
    const Eigen::Vector2d where = projected(info.value, optical({2.95, y, z}));
    return pixel(image.value, static_cast<int>(std::lround(where.x())),
                 static_cast<int>(std::lround(where.y())));
  };
  // Pure where the picture's four pixels have their middles; +y is left.
  const std::array<int, 3> top_left = seen(0.5, 0.5), top_right = seen(-0.5, 0.5);
  const std::array<int, 3> low_left = seen(0.5, -0.5), low_right = seen(-0.5, -0.5);
  EXPECT_GT(top_left[0], 230);
  EXPECT_LT(top_left[1] + top_left[2], 40);
  EXPECT_GT(top_right[1], 230);
  EXPECT_LT(top_right[0] + top_right[2], 40);
  EXPECT_GT(low_left[2], 230);
  EXPECT_LT(low_left[0] + low_left[1], 40);
  for (const int channel : low_right) EXPECT_GT(channel, 230);
}

TEST(CameraPicture, ATextureFromAfarIsItsMean) {
  const ScratchFolder folder;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 64 * 64; ++i) {
    const std::uint8_t value = (i / 64 + i % 64) % 2 == 0 ? 255 : 0;
    rgb.insert(rgb.end(), 3, value);
  }
  WorldSpec spec = dark_world();
  spec.scene.ambient = {1, 1, 1, 1};
  TestWorld world(spec);
  Material material;
  material.is_given = true;
  material.texture_file = write_picture(folder, rgb);
  world.add(make_visual("board", BoxShape{{0.1, 2, 2}}, at(10, 0, 0), material));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  world->step(100);
  for (int row = 53; row < 67; ++row) {
    for (int column = 73; column < 87; ++column) {
      EXPECT_NEAR(pixel(image.value, column, row)[0], 128, 10) << column << " " << row;
    }
  }
}

TEST(CameraPicture, ATextureThatCannotBeReadIsReportedOnce) {
  TestWorld world(weightless());
  Material material;
  material.is_given = true;
  material.texture_file = "/nowhere/wall.png";
  world.add(make_visual("a", BoxShape{{1, 1, 1}}, at(3, 0, 0), material));
  world.add(make_visual("b", BoxShape{{1, 1, 1}}, at(3, 2, 0), material));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  world->step(300);
  EXPECT_EQ(image.count(), 3u);
  EXPECT_EQ(world.report_count(Severity::kWarning, "/nowhere/wall.png"), 1u);
}

TEST(CameraPicture, FormatsAreTheSamePicture) {
  std::vector<ImageSample> images;
  for (const char* format : {"R8G8B8", "B8G8R8", "L8"}) {
    TestWorld world(dark_world());
    world.add(make_visual("ball", SphereShape{0.5}, at(3, 0, 0), glowing(1.0, 0.5, 0.2)));
    CameraOptions options;
    options.format = format;
    world.add(robot_with_camera(options));
    auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
    world->step(100);
    images.push_back(image.value);
  }
  EXPECT_EQ(images[0].encoding, "rgb8");
  EXPECT_EQ(images[1].encoding, "bgr8");
  EXPECT_EQ(images[2].encoding, "mono8");
  EXPECT_EQ(pixel(images[0], 80, 60), (std::array<int, 3>{255, 128, 51}));
  EXPECT_EQ(pixel(images[1], 80, 60), (std::array<int, 3>{51, 128, 255}));
  ASSERT_EQ(images[2].data.size(), 160u * 120u);
  EXPECT_NEAR(images[2].data[60 * 160 + 80], 0.299 * 255 + 0.587 * 128 + 0.114 * 51, 0.51);
}

}  // namespace
}  // namespace trident::sim
