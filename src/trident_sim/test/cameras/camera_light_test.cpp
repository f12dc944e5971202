// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Light and shadow in the pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "camera_robot.h"
#include "ray_check.h"

namespace trident::sim {
namespace {

/// Fills the view with a wall at x = 4 of one material, its face towards the camera.
void add_wall(TestWorld& world, const Eigen::Vector4d& ambient, const Eigen::Vector4d& diffuse) {
  Material material;
  material.is_given = true;
  material.ambient = ambient;
  material.diffuse = diffuse;
  world.add(make_visual("wall", BoxShape{{1, 40, 40}}, at(4.5, 0, 0), material));
}

LightSpec sun(const Eigen::Vector3d& direction) {
  LightSpec light;
  light.name = "sun";
  light.type = LightType::kDirectional;
  light.direction_light = direction.normalized();
  light.diffuse = {0.8, 0.6, 1.0, 1};
  light.casts_shadows = true;
  return light;
}

TEST(CameraLight, ColorsAreAmbientPlusWhatFallsOnTheSurface) {
  WorldSpec spec = weightless();
  spec.scene.ambient = {0.5, 0.5, 0.2, 1};
  spec.lights = {sun({1, 0, -1})};
  TestWorld world(spec);
  add_wall(world, {0.2, 0.4, 0.5, 1}, {0.5, 0.6, 0.1, 1});
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  world->step(100);
  const double cosine = std::sqrt(0.5);
  const double expected[] = {0.5 * 0.2 + 0.8 * 0.5 * cosine, 0.5 * 0.4 + 0.6 * 0.6 * cosine,
                             0.2 * 0.5 + 1.0 * 0.1 * cosine};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(pixel(image.value, 80, 60)[i], 255.0 * expected[i], 0.51);
    EXPECT_EQ(pixel(image.value, 80, 60)[i], pixel(image.value, 3, 117)[i]);
  }
}

TEST(CameraLight, LampsFadeWithDistanceAndShineNoFartherThanTheirRange) {
  WorldSpec spec = weightless();
  spec.scene.ambient.setZero();
  LightSpec lamp;
  lamp.diffuse = {1, 1, 1, 1};
  lamp.T_world_light.p = {2, 0, 0};
  lamp.range_m = 3.0;
  lamp.attenuation_constant = 0.5;
  lamp.attenuation_quadratic = 0.25;
  spec.lights = {lamp};
  TestWorld world(spec);
  add_wall(world, {0, 0, 0, 1}, {0.6, 0.6, 0.6, 1});
  CameraOptions options;
  options.width = options.height = 161;  // with a middle pixel
  world.add(robot_with_camera(options));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  for (const int column : {80, 100, 110, 150}) {
    const double y = 4.0 * (column - 80) / info.value.K[0], distance = std::hypot(2.0, y);
    const double strength =
        distance > 3.0 ? 0.0 : 2.0 / distance / (0.5 + 0.25 * distance * distance);
    EXPECT_NEAR(pixel(image.value, column, 80)[0], 255.0 * 0.6 * strength, 0.6) << column;
  }
}

TEST(CameraLight, ShadowsFallWhereTheSunDoesNotAndOnlyOfWhatCastsThem) {
  for (const bool casts : {true, false}) {
    WorldSpec spec = weightless();
    spec.lights = {sun({1, 0, -1})};
    TestWorld world(spec);
    add_wall(world, {1, 1, 1, 1}, {1, 1, 1, 1});
    // Its shadow on the wall lies around z = -1.
    ModelSpec plate = make_visual("plate", BoxShape{{0.02, 0.6, 0.6}}, at(3, 0, 0));
    plate.links[0].visuals[0].casts_shadows = casts;
    plate.links[0].visuals[0].visibility_flags = 1;
    world.add(plate);
    world.add(robot_with_camera({}));
    auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
    auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
    world->step(100);
    const auto seen = [&](double y, double z) {
      const Eigen::Vector2d where = projected(info.value, optical({4, y, z}));
      return pixel(image.value, static_cast<int>(std::lround(where.x())),
                   static_cast<int>(std::lround(where.y())))[0];
    };
    const int shadow = static_cast<int>(std::lround(255.0 * 0.4));
    EXPECT_EQ(seen(0.0, -0.9), casts ? shadow : 246);
    EXPECT_EQ(seen(0.25, -1.25), casts ? shadow : 246);
    for (const double y : {-0.4, 0.4}) EXPECT_EQ(seen(y, -0.9), 246) << y;
    EXPECT_EQ(seen(0.0, -1.4), 246);
  }
}

}  // namespace
}  // namespace trident::sim
