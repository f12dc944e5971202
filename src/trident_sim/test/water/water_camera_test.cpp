// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The sea in pictures: where it is, how far, what it is called and what colour it has.
#include <gtest/gtest.h>

#include <cmath>

#include "camera_robot.h"
#include "cameras/water_slopes.h"
#include "sea_view.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kPitch = 0.2;  ///< downward [rad]

/// 3 m above the level 0.5 m, along x, a little down.
SE3 lookout() { return SE3::from_xyz_rpy({0, 0, 3.5}, 0.0, kPitch, 0.0); }

WorldSpec sunny_sea(const ParamList& waves) {
  WorldSpec spec = sea_spec(waves, "0.5");
  spec.lights = sunny().lights;
  spec.scene.background = {0.7, 0.8, 0.9, 1.0};
  return spec;
}

/// Sine of how far a row looks below the horizon, and the range's part along the axis.
struct Look {
  double down, axis_part;
};
Look look_of(const CameraInfoSample& info, int column, int row) {
  const Eigen::Vector3d d((column - info.K[2]) / info.K[0], (row - info.K[5]) / info.K[4], 1.0);
  const double down = std::sin(kPitch) * d.z() + std::cos(kPitch) * d.y();
  return {down / d.norm(), 1.0 / d.norm()};
}

TEST(WaterCamera, DepthsOfStillWaterAreExactAndEndAtTheFarClip) {
  TestWorld world(sunny_sea({{"spectrum", "none"}}));
  world.add(robot_with_camera({}, lookout()));
  auto& depth = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  auto& labels = listen_to<ImageSample>(world, "r/eye/segmentation/image_raw");
  auto& boxes = listen_to<BoundingBoxesSample>(world, "r/eye/segmentation/boxes");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(10);
  int seen = 0;
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Look look = look_of(info.value, column, row);
      const double expected = look.down > 0.0 ? 3.0 / look.down * look.axis_part : 1e9;
      const float measured = depth_at(depth.value, column, row);
      const int label = labels.value.data[2 * static_cast<std::size_t>(row * 160 + column)];
      if (expected > 50.0) {
        EXPECT_FALSE(std::isfinite(measured));
        EXPECT_EQ(label, 0);
        continue;
      }
      ++seen;
      EXPECT_NEAR(measured, expected, 1e-3) << column << " " << row;
      EXPECT_EQ(label, 2) << "after the robot";
    }
  }
  EXPECT_GT(seen, 10000);
  ASSERT_EQ(boxes.value.boxes.size(), 1u);
  EXPECT_EQ(boxes.value.boxes[0].name, "water");
}

TEST(WaterCamera, DepthsOfWavesAreThoseOfTheTile) {
  TestWorld world(sunny_sea(jonswap("0.8", "4")), with_timing(LoopTiming::kDirect));
  world.add(robot_with_camera({}, lookout()));
  auto& depth = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(10);
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow(lookout().p));
  for (int row = 40; row < 120; row += 3) {
    for (int column = 0; column < 160; column += 7) {
      const Eigen::Vector3d d_camera(1.0, -(column - info.value.K[2]) / info.value.K[0],
                                     -(row - info.value.K[5]) / info.value.K[4]);
      const float t = depth_at(depth.value, column, row);
      if (!std::isfinite(t)) continue;
      const Eigen::Vector3d p = lookout().p + t * (lookout().R * d_camera);
      EXPECT_NEAR(p.z(), water.height_m(p.head<2>()), 1e-4) << column << " " << row;
    }
  }
}

TEST(WaterCamera, TheHorizonIsWhereItBelongsHoweverNearTheFarClip) {
  TestWorld world(sunny_sea(jonswap("0.3", "4")));
  CameraOptions options;
  options.far_m = 20.0;
  world.add(robot_with_camera(options, lookout()));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(10);
  const std::array<int, 3> sky = {179, 204, 230};
  for (int column = 0; column < 160; column += 10) {
    for (int row = 0; row < 120; ++row) {
      const double down = look_of(info.value, column, row).down;
      if (std::abs(down) < 0.005) continue;
      EXPECT_EQ(pixel(image.value, column, row) == sky, down < 0.0) << column << " " << row;
    }
  }
}

TEST(WaterCamera, ABottomShowsThroughShallowWaterOnly) {
  const auto color_over = [](double bottom_m) {
    TestWorld world(sunny_sea({{"spectrum", "none"}}));
    ModelSpec floor = make_visual("floor", PlaneShape{Eigen::Vector3d::UnitZ()},
                                  at(0, 0, 0.5 - bottom_m), glowing(1, 0, 0));
    floor.is_static = true;
    world.add(floor);
    world.add(robot_with_camera({}, SE3::from_xyz_rpy({0, 0, 3.5}, 0.0, kPi / 2.0, 0.0)));
    auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
    world->step(10);
    return pixel(image.value, 80, 60);
  };
  const auto shallow = color_over(0.2), deeper = color_over(2.0), deep = color_over(60.0);
  EXPECT_GT(shallow[0], 200);
  EXPECT_GT(shallow[0], deeper[0] + 50);
  EXPECT_GT(deeper[0], deep[0] + 20);
  EXPECT_GT(deep[2], deep[0]) << "deep water is blue";
}

TEST(WaterCamera, UnderWaterSeesThroughItsColor) {
  TestWorld world(sunny_sea(jonswap("0.3", "4")));
  world.add(make_visual("near", BoxShape{{0.2, 2, 2}}, at(1.5, 1.1, -4), glowing(1, 1, 1)));
  world.add(make_visual("far", BoxShape{{0.2, 9, 9}}, at(20, -5, -4), glowing(1, 1, 1)));
  world.add(robot_with_camera({}, at(0, 0, -4)));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& depth = listen_to<ImageSample>(world, "r/eye/depth/image_raw");
  world->step(10);
  const auto near = pixel(image.value, 20, 60), far = pixel(image.value, 120, 60);
  EXPECT_GT(near[2], far[2]);
  EXPECT_GT(near[0], far[0] + 50) << "red fades first";
  EXPECT_NEAR(depth_at(depth.value, 20, 60), 1.4, 1e-3);
}

TEST(WaterCamera, PicturesDependOnNeitherThreadsNorOtherSensors) {
  const auto picture = [](std::size_t threads, bool with_depth) {
    WorldOptions options;
    options.sensor_threads = threads;
    TestWorld world(sunny_sea(jonswap("0.5", "4")), options);
    add_things(world);
    world.add(robot_with_camera({}, lookout()));
    auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
    if (with_depth) listen_to<ImageSample>(world, "r/eye/depth/image_raw");
    world->step(25);
    return image.value.data;
  };
  const auto alone = picture(1, false);
  EXPECT_EQ(alone, picture(3, false));
  EXPECT_EQ(alone, picture(1, true));
}

TEST(WaterSlopes, AreThoseOfTheSurfaceAndFadeWithTheWidth) {
  TestWorld world(sea_spec(regular("0.8", "5")));
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow({0, 0, 1}));
  WaterSlopes slopes;
  slopes.follow(water);
  Draw draw("slopes");
  double error = 0.0, square = 0.0, wide = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(draw.uniform(-90, 90), draw.uniform(-90, 90));
    const Eigen::Vector2f exact = water.slope(p).cast<float>();
    error += (slopes.in_world(slopes.at(p, 0.01).slope) - exact).squaredNorm();
    square += exact.squaredNorm();
    wide += slopes.at(p, 200.0).slope.squaredNorm();
  }
  EXPECT_LT(std::sqrt(error / square), 0.1) << "cells are flat, slopes are not";
  EXPECT_LT(std::sqrt(wide / square), 0.1);
  EXPECT_NEAR(slopes.mean_square(), square / 500.0, 0.25 * slopes.mean_square());
}

}  // namespace
}  // namespace trident::sim
