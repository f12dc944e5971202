// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "core/physics/height_image.h"
#include "golden_data.h"
#include "models.h"
#include "scratch_folder.h"
#include "test_world.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

/// A PGM of `values`, row by row from the top.
std::string pgm(int columns, int rows, const std::vector<int>& values, int white = 255) {
  std::string text = "P2\n# a comment\n" + std::to_string(columns) + " " + std::to_string(rows) +
                     "\n" + std::to_string(white) + "\n";
  for (const int value : values) text += std::to_string(value) + "\n";
  return text;
}

/// The picture of a ramp, black at the left, white at the right.
std::string ramp(int columns, int rows) {
  std::vector<int> values;
  for (int i = 0; i < columns * rows; ++i) values.push_back(i % columns);
  return pgm(columns, rows, values, columns - 1);
}

ModelSpec terrain(const std::string& file, const Eigen::Vector3d& size, const SE3& T_world = {},
                  const Surface& surface = {}) {
  ModelSpec model = make_body("terrain", HeightmapShape{file, size}, T_world, 1.0, surface);
  model.is_static = true;
  return model;
}

Surface on_ground_with_mu(double mu) {
  Surface surface;
  surface.mu = surface.mu2 = mu;
  return surface;
}

/// Where a ball of radius 0.1 m comes to rest that is dropped over (x, y).
double rests_at(TestWorld& world, double x, double y) {
  Model& ball =
      world.add(make_body("ball", SphereShape{0.1}, at(x, y, 2.5), 1.0, on_ground_with_mu(1.0)));
  world->step(300);
  const double z = ball.T_world_model().p.z();
  EXPECT_LT(ball.bodies[0]->velocity().norm(), 5e-3);
  world->remove("ball");
  return z - 0.1;
}

TEST(Heightmap, TheTopOfThePictureLiesAtPlusYAndTheBrightestPixelAtTheFullHeight) {
  const ScratchFolder folder;
  // Four plateaus of 2 x 2 pixels, the brightest of them grey.
  const std::string file = folder.write("a.pgm", pgm(4, 4,
                                                     {200, 200, 0, 0, 200, 200, 0, 0,  //
                                                      50, 50, 100, 100, 50, 50, 100, 100}));
  TestWorld world;
  world.add(terrain(file, {6, 6, 2}, at(0, 0, 0.25)));
  EXPECT_NEAR(rests_at(world, -2, 2), 2.25, 2e-3);
  EXPECT_NEAR(rests_at(world, 2, 2), 0.25, 2e-3);
  EXPECT_NEAR(rests_at(world, -2, -2), 0.75, 2e-3);
  EXPECT_NEAR(rests_at(world, 2, -2), 1.25, 2e-3);
}

TEST(Heightmap, ItTurnsWithItsModel) {
  const ScratchFolder folder;
  const std::string file = folder.write("a.pgm", pgm(4, 2, {255, 255, 0, 0, 255, 255, 0, 0}));
  TestWorld world;
  world.add(terrain(file, {6, 2, 1}, SE3::from_xyz_rpy({0, 0, 0}, 0, 0, std::acos(0.0))));
  EXPECT_NEAR(rests_at(world, 0, -2), 1.0, 2e-3);
  EXPECT_NEAR(rests_at(world, 0, 2), 0.0, 2e-3);
}

TEST(Heightmap, NextToItThereIsNothing) {
  const ScratchFolder folder;
  TestWorld world;
  world.add(terrain(folder.write("a.pgm", ramp(3, 3)), {2, 2, 1}));
  Model& ball = world.add(make_body("ball", SphereShape{0.1}, at(1.5, 0, 2.0)));
  world->step(200);
  EXPECT_LT(ball.T_world_model().p.z(), -5.0);
}

struct Resting {
  const char* name;
  Shape shape;
  double half_height_m;
};
class RestsOnHeightmap : public testing::TestWithParam<Resting> {};

TEST_P(RestsOnHeightmap, AsOnAPlane) {
  const ScratchFolder folder;
  const std::string file = folder.write("a.pgm", pgm(7, 3, std::vector<int>(21, 9)));
  TestWorld world;
  world.add(terrain(file, {7, 3, 0.5}));
  Model& model = world.add(
      make_body("m", GetParam().shape, at(0.2, 0.1, 0.52 + GetParam().half_height_m), 1.0));
  world->step(300);
  EXPECT_TRUE(is_near(model.T_world_model().p, {0.2, 0.1, 0.5 + GetParam().half_height_m}, 3e-3));
  EXPECT_LT(model.bodies[0]->velocity().norm(), 5e-3);
}
INSTANTIATE_TEST_SUITE_P(Shapes, RestsOnHeightmap,
                         testing::Values(Resting{"box", BoxShape{{0.4, 0.4, 0.2}}, 0.1},
                                         Resting{"sphere", SphereShape{0.15}, 0.15},
                                         Resting{"cylinder", CylinderShape{0.2, 0.2}, 0.1},
                                         Resting{"big_box", BoxShape{{2.5, 1.5, 0.4}}, 0.2}),
                         [](const auto& info) { return std::string(info.param.name); });

/// On a ramp of slope 1/4, across 40 triangles, a box slides as on a plane.
TEST(Heightmap, ABoxSlidesDownARampAsOnAPlane) {
  const ScratchFolder folder;
  const double angle = std::atan(0.25), mu = 0.1;
  TestWorld world(world_spec(0.002));
  world.add(
      terrain(folder.write("a.pgm", ramp(41, 21)), {20, 10, 5}, {}, on_ground_with_mu(100.0)));
  const double above = 0.1 / std::cos(angle);
  Model& box = world.add(make_body("m", BoxShape{{0.4, 0.4, 0.2}},
                                   SE3::from_xyz_rpy({5, 0.3, 3.75 + above}, 0, -angle, 0), 1.0,
                                   on_ground_with_mu(mu)));
  world->step(500);
  const double expected = 9.8 * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(box.bodies[0]->velocity().norm(), expected, 0.03);
  const Eigen::Vector3d p = box.T_world_model().p;
  EXPECT_NEAR(p.z() - above, 0.25 * (p.x() + 10.0), 5e-3);
}

void write_png(const std::string& file, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 3;
  image.height = 2;
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr), 0);
}

TEST(HeightImage, PngAndPgmOfAnyDepthAreTheSame) {
  const ScratchFolder folder;
  const std::vector<float> expected{0.0F, 51 / 255.0F, 102 / 255.0F, 153 / 255.0F, 204 / 255.0F, 1};
  const std::uint8_t gray[6] = {0, 51, 102, 153, 204, 255};
  const std::uint16_t deep[6] = {0, 13107, 26214, 39321, 52428, 65535};
  std::uint8_t rgba[24];
  for (int i = 0; i < 24; ++i) rgba[i] = i % 4 == 3 ? 255 : gray[i / 4];
  write_png((folder.path() + "/8.png"), PNG_FORMAT_GRAY, gray);
  write_png((folder.path() + "/16.png"), PNG_FORMAT_LINEAR_Y, deep);
  write_png((folder.path() + "/rgba.png"), PNG_FORMAT_RGBA, rgba);
  folder.write("2.pgm", pgm(3, 2, {0, 51, 102, 153, 204, 255}));
  folder.write("5.pgm", "P5 3 2 255\n" + std::string(gray, gray + 6));
  std::string two_bytes = "P5\n3 2\n65535\n";
  for (const std::uint16_t value : deep) {
    two_bytes += {static_cast<char>(value >> 8), static_cast<char>(value & 255)};
  }
  folder.write("5_16.pgm", two_bytes);
  for (const char* name : {"8.png", "16.png", "rgba.png", "2.pgm", "5.pgm", "5_16.pgm"}) {
    const HeightImage image = read_height_image(folder.path() + "/" + name);
    EXPECT_EQ(image.columns, 3) << name;
    EXPECT_EQ(image.rows, 2) << name;
    ASSERT_EQ(image.brightness.size(), 6u) << name;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(image.brightness[i], expected[i], 1e-4) << name;
  }
}

TEST(HeightImage, BadFilesAreRefusedByName) {
  const ScratchFolder folder;
  const std::uint8_t gray[6] = {};
  write_png((folder.path() + "/whole.png"), PNG_FORMAT_GRAY, gray);
  std::string cut = read_file(folder.path() + "/whole.png");
  cut.resize(cut.size() - 20);
  const std::pair<std::string, std::string> cases[] = {
      {folder.write("cut.png", cut), "bad PNG"},
      {folder.write("a.jpg", "\xff\xd8\xff\xe0 not one of ours"), "neither a PNG nor a PGM"},
      {folder.write("empty.png", ""), "neither a PNG nor a PGM"},
      {folder.write("thin.pgm", pgm(1, 2, {0, 0})), "1 x 2 pixels, legal: 2 x 2 to"},
      {folder.write("huge.pgm", "P2 100000 100000 255\n0"), "100000 x 100000 pixels, legal"},
      {folder.write("short.pgm", pgm(2, 2, {0, 0, 0})), "ends after 3 of the 2 x 2 pixels"},
      {folder.write("bright.pgm", pgm(2, 2, {0, 300, 0, 0})),
       "has the value 300 in row 0, legal: 0 to 255"},
      {folder.write("header.pgm", "P5 2 x 255\n"), "its header has no"},
      {(folder.path() + "/gone.png"), "cannot be read"}};
  for (const auto& [file, fragment] : cases) {
    const std::string error = error_of([&, path = file] { read_height_image(path); });
    EXPECT_TRUE(contains(error, fragment));
    EXPECT_TRUE(contains(error, file));
  }
}

TEST(Heightmap, ABadPictureRefusesTheModelByTheNameOfItsCollision) {
  const ScratchFolder folder;
  TestWorld world;
  const std::string error = error_of([&] {
    world.add(terrain(folder.write("a.png", "no picture"), {1, 1, 1}));
  });
  EXPECT_TRUE(contains(error, "collision 'terrain::link::collision': heightmap: image '"));
  EXPECT_EQ(world->find_model("terrain"), nullptr);
}

TEST(Heightmap, OnALinkThatMovesItIsRefused) {
  const ScratchFolder folder;
  TestWorld world;
  ModelSpec spec = terrain(folder.write("a.pgm", ramp(3, 3)), {1, 1, 1});
  spec.is_static = false;
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "a heightmap must be static"));
}

std::string sdf_world(const std::string& heightmap) {
  return "<sdf version='1.6'><world name='w'><model name='m'><static>true</static><link name='l'>"
         "<collision name='c'><pose>1 0 0 0 0 0</pose><geometry><heightmap>" +
         heightmap + "</heightmap></geometry></collision></link></model></world></sdf>";
}

TEST(Heightmap, SdfSaysItsFileSizeAndPlace) {
  const ScratchFolder folder;
  const std::string file = folder.write("a.pgm", ramp(3, 3));
  const auto ignore = [](const std::string&) {};
  const WorldSpec world =
      load_world_string(sdf_world("<uri>file://a.pgm</uri><size>6 4 2</size><pos>0 1 0.5</pos>"),
                        "w", Resources({folder.path()}), ignore);
  const CollisionSpec& collision = world.models[0].links[0].collisions[0];
  const auto& shape = std::get<HeightmapShape>(collision.shape);
  EXPECT_EQ(shape.size, Eigen::Vector3d(6, 4, 2));
  EXPECT_TRUE(contains(shape.file, "a.pgm"));
  EXPECT_TRUE(is_near(collision.T_link_shape.p, {1, 1, 0.5}, 1e-12));
}

TEST(Heightmap, SdfErrorsNameFileAndField) {
  const ScratchFolder folder;
  folder.write("a.pgm", ramp(3, 3));
  const auto error = [&](const std::string& heightmap) {
    return error_of([&] {
      load_world_string(sdf_world(heightmap), "w.world", Resources({folder.path()}),
                        [](const std::string&) {});
    });
  };
  EXPECT_TRUE(
      contains(error("<uri>gone.png</uri>"),
               "w.world: link 'l' collision 'c': heightmap 'gone.png' not found; searched"));
  EXPECT_TRUE(contains(error("<uri>a.pgm</uri><size>1 1 -2</size>"),
                       "link 'l' collision 'c': heightmap size is -2"));
}

}  // namespace
}  // namespace trident::sim
