// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What cameras need of a hit: materials, texture coordinates and smooth normals.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "ray_check.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kZ = Eigen::Vector3d::UnitZ();

RayHit look(const RayScene& scene, const Eigen::Vector3d& p, const Eigen::Vector3d& along) {
  return cast_one(scene, ray_along(p, along));
}

testing::AssertionResult uv_is(const RayHit& hit, double u, double v) {
  if ((hit.uv - Eigen::Vector2f(u, v)).norm() < 1e-5) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "uv " << hit.uv.transpose() << ", not " << u << " " << v;
}

TEST(RayLook, AVisualsMaterialIsReported) {
  TestWorld world;
  Material red;
  red.is_given = true;
  red.diffuse = {1, 0, 0, 1};
  world.add(make_visual("red", BoxShape{{1, 1, 1}}, at(3, 0, 0), red));
  world.add(make_visual("grey", SphereShape{0.5}, at(-3, 0, 0)));
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  EXPECT_EQ(scene.materials().at(look(scene, {0, 0, 0}, kX).material).diffuse, red.diffuse);
  EXPECT_EQ(scene.materials().at(look(scene, {0, 0, 0}, -kX).material).diffuse, Material().diffuse);
  EXPECT_EQ(look(fresh_rays(world), {0, 0, 0}, kX).material, RayHit::kNothing);
}

/// Two unit squares side by side along x, green and blue, with normals that lean to +y and picture
/// coordinates.
std::string write_squares(const ScratchFolder& folder) {
  folder.write("two.mtl", "newmtl green\nKd 0 1 0\nnewmtl blue\nKd 0 0 1\n");
  return folder.write("two.obj",
                      "mtllib two.mtl\n"
                      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                      "vn 0 0 1\nvn 0 0.6 0.8\n"
                      "usemtl green\nf 1/1/1 2/2/1 3/3/2 4/4/2\n"
                      "usemtl blue\nf 2/1/1 5/2/1 6/3/2 3/4/2\n");
}

TEST(RayLook, AMeshHasItsOwnMaterialsUnlessTheVisualGivesOne) {
  const ScratchFolder folder;
  const MeshShape mesh{write_squares(folder), {1, 1, 1}};
  TestWorld world;
  world.add(make_visual("own", mesh, at(0, 0, 0)));
  Material red;
  red.is_given = true;
  red.diffuse = {1, 0, 0, 1};
  world.add(make_visual("painted", mesh, at(0, 5, 0), red));
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  const auto color = [&](double x, double y) -> Eigen::Vector3d {
    return scene.materials().at(look(scene, {x, y, 2}, -kZ).material).diffuse.head<3>();
  };
  EXPECT_TRUE(is_near(color(0.3, 0.2), {0, 1, 0}, 1e-6));
  EXPECT_TRUE(is_near(color(1.3, 0.7), {0, 0, 1}, 1e-6));
  EXPECT_TRUE(is_near(color(0.3, 5.2), {1, 0, 0}, 1e-6));
}

TEST(RayLook, AMeshHasItsOwnTextureCoordinatesAndNormals) {
  const ScratchFolder folder;
  TestWorld world;
  world.add(make_visual("own", MeshShape{write_squares(folder), {1, 1, 1}}, at(0, 0, 0)));
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  for (const double x : {0.2, 0.7, 1.1, 1.9}) {
    for (const double y : {0.1, 0.5, 0.8}) {
      const RayHit hit = look(scene, {x, y, 2}, -kZ);
      EXPECT_TRUE(uv_is(hit, x - std::floor(x), y));
      const Eigen::Vector3d normal = (1.0 - y) * kZ + y * Eigen::Vector3d(0, 0.6, 0.8);
      EXPECT_TRUE(is_near(hit.normal_world, normal.normalized(), 1e-6));
    }
  }
}

TEST(RayLook, ShapesHaveTextureCoordinates) {
  TestWorld world;
  world.add(make_visual("box", BoxShape{{2, 2, 2}}, at(0, 0, 0)));
  world.add(make_visual("ball", SphereShape{1.0}, at(10, 0, 0)));
  world.add(make_visual("drum", CylinderShape{1.0, 2.0}, at(20, 0, 0)));
  world.add(make_visual("pill", CapsuleShape{1.0, 2.0}, at(30, 0, 0)));
  ModelSpec floor = make_visual("floor", PlaneShape{kZ}, at(0, 0, -5));
  floor.is_static = true;
  world.add(floor);
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  EXPECT_TRUE(uv_is(look(scene, {-5, -0.5, 0.5}, kX), 0.75, 0.75)) << "-y is right of -x";
  EXPECT_TRUE(uv_is(look(scene, {5, -0.5, 0.5}, -kX), 0.25, 0.75));
  EXPECT_TRUE(uv_is(look(scene, {0.5, 0.2, 5}, -kZ), 0.75, 0.6));
  EXPECT_TRUE(uv_is(look(scene, {15, 0, 0}, -kX), 0.5, 0.5));
  EXPECT_TRUE(uv_is(look(scene, {10, 0.0, 5}, -kZ), 0.5, 1.0));
  EXPECT_TRUE(uv_is(look(scene, {25, 0, 0.5}, -kX), 0.5, 0.75));
  EXPECT_TRUE(uv_is(look(scene, {20.5, 0, 5}, -kZ), 0.75, 0.5));
  EXPECT_TRUE(uv_is(look(scene, {35, 0, 1}, -kX), 0.5, 0.75));
  EXPECT_TRUE(uv_is(look(scene, {5, 3, 0}, -kZ), 5.0, 3.0));
}

/// 2 x 2 pixels: red, green above blue, white.
std::string write_picture(const ScratchFolder& folder) {
  const std::string file = folder.path() + "/four.png";
  const std::vector<std::uint8_t> rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png.height = 2;
  png.format = PNG_FORMAT_RGB;
  EXPECT_NE(png_image_write_to_file(&png, file.c_str(), 0, rgb.data(), 0, nullptr), 0);
  return file;
}

Material with_picture(const std::string& file) {
  Material material;
  material.is_given = true;
  material.texture_file = file;
  return material;
}

TEST(RayLook, APictureCoversABoxUpright) {
  const ScratchFolder folder;
  TestWorld world;
  world.add(
      make_visual("box", BoxShape{{2, 2, 2}}, at(0, 0, 0), with_picture(write_picture(folder))));
  RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  // Seen from -x, +y is on the left.
  const RayHit top_left = look(scene, {-5, 0.5, 0.5}, kX);
  EXPECT_TRUE(is_near(scene.albedo(top_left), Material().diffuse.head<3>(), 1e-12));
  scene.use_textures();
  const auto color = [&](double y, double z) { return scene.albedo(look(scene, {-5, y, z}, kX)); };
  EXPECT_TRUE(is_near(color(0.5, 0.5), {1, 0, 0}, 1e-6));
  EXPECT_TRUE(is_near(color(-0.5, 0.5), {0, 1, 0}, 1e-6));
  EXPECT_TRUE(is_near(color(0.5, -0.5), {0, 0, 1}, 1e-6));
  EXPECT_TRUE(is_near(color(-0.5, -0.5), {1, 1, 1}, 1e-6));
  EXPECT_TRUE(is_near(color(0.0, 0.5), {0.5, 0.5, 0}, 1e-6)) << "midway between";
  EXPECT_TRUE(is_near(scene.albedo(look(scene, {-5, 5, 0}, kX)), {0, 0, 0}, 0.0));
}

TEST(RayLook, APictureRepeatsOnAPlane) {
  const ScratchFolder folder;
  TestWorld world;
  ModelSpec floor = make_visual("floor", PlaneShape{kZ}, {}, with_picture(write_picture(folder)));
  floor.is_static = true;
  world.add(floor);
  RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  scene.use_textures();
  for (const double x : {-7.0, 0.0, 12.0}) {
    const RayHit hit = look(scene, {x + 0.25, x + 0.75, 3}, -kZ);
    EXPECT_TRUE(is_near(scene.albedo(hit), {1, 0, 0}, 1e-5)) << x;
  }
}

TEST(RayLook, APictureThatCannotBeReadIsReportedOnce) {
  const ScratchFolder folder;
  const std::string file = folder.write("photo.jpg", "no PNG");
  TestWorld world;
  world.add(make_visual("a", BoxShape{{1, 1, 1}}, at(3, 0, 0), with_picture(file)));
  RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  EXPECT_TRUE(world.reports.empty()) << "nobody needs it";
  scene.use_textures();
  world.add(make_visual("b", BoxShape{{1, 1, 1}}, at(-3, 0, 0), with_picture(file)));
  scene.refresh();
  EXPECT_EQ(
      world.report_count(Severity::kWarning, "texture '" + file + "' cannot be read as a PNG"), 1u);
  EXPECT_TRUE(is_near(scene.albedo(look(scene, {0, 0, 0}, -kX)), {0.7, 0.7, 0.7}, 1e-12));
}

}  // namespace
}  // namespace trident::sim
