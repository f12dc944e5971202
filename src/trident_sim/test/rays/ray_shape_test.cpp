// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Ranges and normals of each shape against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "ray_check.h"
#include "rays/ray_packet.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

constexpr double kNoRefusal = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kAxisX = Eigen::Vector3d::UnitX(), kAxisY = Eigen::Vector3d::UnitY(),
                      kAxisZ = Eigen::Vector3d::UnitZ();

TEST(RayShape, ABoxIsHitOnEachFaceFromOutsideAndFromWithin) {
  TestWorld world;
  world.add(make_static("box", BoxShape{{2, 4, 6}}, at(1, 2, 3)));
  const RayScene& scene = fresh_rays(world);
  const Eigen::Vector3d center(1, 2, 3);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d out = side * Eigen::Vector3d::Unit(axis);
      const RayHit outside = cast_one(scene, ray_along(center + 10.0 * out, -out));
      EXPECT_NEAR(outside.distance_m, 10.0 - (axis + 1.0), 1e-12);
      EXPECT_TRUE(is_near(outside.normal_world, out, 1e-12));
      const RayHit within = cast_one(scene, ray_along(center, out));
      EXPECT_NEAR(within.distance_m, axis + 1.0, 1e-12);
      EXPECT_TRUE(is_near(within.normal_world, -out, 1e-12));
    }
  }
  EXPECT_EQ(range(scene, {10, 10, 10}, kAxisX), kNoRefusal);
}

TEST(RayShape, ASphereIsHitAsCloselyAsDoublesGoAlsoFarFromTheOrigin) {
  TestWorld world;
  const Eigen::Vector3d center(280, -290, 15);
  world.add(make_static("ball", SphereShape{0.7}, SE3{Eigen::Quaterniond::Identity(), center}));
  const RayScene& scene = fresh_rays(world);
  Draw draw("sphere");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = center + draw.uniform(1.0, 60.0) * draw.direction();
    const Eigen::Vector3d aim = center + 0.65 * draw.direction();
    const Eigen::Vector3d d = (aim - p).normalized();
    const double along = (center - p).dot(d);
    const double off_axis = (center - p - along * d).norm();
    const RayHit hit = cast_one(scene, ray_along(p, d));
    ASSERT_NEAR(hit.distance_m, along - std::sqrt(0.49 - off_axis * off_axis), 1e-9);
    ASSERT_TRUE(is_near(hit.normal_world, (p + hit.distance_m * d - center).normalized(), 1e-9));
  }
  EXPECT_NEAR(range(scene, center, {1, 1, 1}), 0.7, 1e-12);
  EXPECT_EQ(range(scene, center + 0.71 * kAxisZ, kAxisX), kNoRefusal);
}

/// Rays of pictures are as long as their pixel lies off the axis.
TEST(RayShape, PacketsHitRoundShapesWhateverTheLengthOfTheirDirections) {
  TestWorld world;
  world.add(make_static("ball", SphereShape{1.0}, at(5, 0, 0)));
  world.add(make_static("post", CylinderShape{0.4, 3.0}, at(4, 3, 1)));
  world.add(make_static("pill", CapsuleShape{0.5, 1.0}, at(4, -3, -1)));
  const RayScene& scene = fresh_rays(world);
  Draw draw("packets");
  std::size_t hit_count = 0;
  for (int i = 0; i < 500; ++i) {
    RayPacket rays;
    rays.origin_x = rays.origin_y = rays.origin_z = {};
    rays.t_min.fill(0.0F);
    rays.valid.fill(-1);
    std::vector<Ray> same;
    for (std::size_t lane = 0; lane < kPacketLanes; ++lane) {
      const double length = draw.uniform(0.3, 3.0);
      const Eigen::Vector3d d =
          length * Eigen::Vector3d(5.0, draw.uniform(-4, 4), draw.uniform(-2, 2)).normalized();
      rays.direction_x[lane] = static_cast<float>(d.x());
      rays.direction_y[lane] = static_cast<float>(d.y());
      rays.direction_z[lane] = static_cast<float>(d.z());
      rays.t_max[lane] = static_cast<float>(50.0 / length);
      same.push_back(ray_along(Eigen::Vector3d::Zero(), d));
    }
    PacketHits hits;
    PacketRays(scene).intersect(rays, hits);
    for (std::size_t lane = 0; lane < kPacketLanes; ++lane) {
      const Eigen::Vector3d d(rays.direction_x[lane], rays.direction_y[lane],
                              rays.direction_z[lane]);
      const RayHit alone = cast_one(scene, same[lane]);
      ASSERT_EQ(hits.shape[lane], alone.shape) << i << " " << lane;
      if (alone.shape == RayHit::kNothing) continue;
      ASSERT_NEAR(hits.t[lane] * d.norm(), alone.distance_m, 1e-3);
      ++hit_count;
    }
  }
  EXPECT_GT(hit_count, 1000u);
}

/// First distance at which `inside` changes, found by steps and bisection, without closed forms.
template <class Inside>
std::optional<double> march(const Ray& ray, double reach, Inside&& inside) {
  constexpr double kStep = 2e-3;
  const auto point = [&](double t) -> Eigen::Vector3d {
    return ray.p_world_origin + t * ray.direction_world;
  };
  const bool begins_inside = inside(point(0.0));
  for (double t = kStep; t < reach; t += kStep) {
    if (inside(point(t)) == begins_inside) continue;
    double low = t - kStep, high = t;
    while (high - low > 1e-10) {
      const double middle = 0.5 * (low + high);
      (inside(point(middle)) == begins_inside ? low : high) = middle;
    }
    return high;
  }
  return std::nullopt;
}

/// Casts from all sides and from within at a turned shape around the origin.
template <class Inside>
void expect_as_marched(const Shape& shape, bool is_static, Inside&& inside) {
  TestWorld world;
  const SE3 T = SE3::from_xyz_rpy({0.3, -0.2, 0.1}, 0.4, -0.7, 1.1);
  ModelSpec model = make_body("shape", shape, T);
  model.is_static = is_static;
  world.add(model);
  const RayScene& scene = fresh_rays(world);
  const SE3 T_shape_world = T.inverse();
  Draw draw("march");
  int hit_count = 0;
  for (int i = 0; i < 300; ++i) {
    const Ray ray = ray_along(draw.uniform(0.0, 3.0) * draw.direction(), draw.direction());
    const auto expected =
        march(ray, 6.0, [&](const Eigen::Vector3d& p) { return inside(T_shape_world * p); });
    const RayHit hit = cast_one(scene, ray);
    // What is grazed for less than a step is not marched into.
    if (!expected) continue;
    ++hit_count;
    ASSERT_LE(hit.distance_m, *expected + 1e-8) << "ray " << i;
    if (hit.distance_m < *expected - 1e-8) {
      const double behind = hit.distance_m + 2e-3;
      const Eigen::Vector3d p = ray.p_world_origin + behind * ray.direction_world;
      ASSERT_EQ(inside(T_shape_world * p), inside(T_shape_world * ray.p_world_origin));
      continue;
    }
    const Eigen::Vector3d p = ray.p_world_origin + hit.distance_m * ray.direction_world;
    const double step = 1e-6;
    ASSERT_NE(inside(T_shape_world * (p + step * hit.normal_world)),
              inside(T_shape_world * (p - step * hit.normal_world)));
    ASSERT_LT(hit.normal_world.dot(ray.direction_world), 0.0);
  }
  EXPECT_GT(hit_count, 50);
}

bool in_cylinder(const Eigen::Vector3d& p) {
  return p.head<2>().norm() <= 0.5 && std::abs(p.z()) <= 0.8;
}
bool in_capsule(const Eigen::Vector3d& p) {
  const double z = std::min(0.8, std::max(-0.8, p.z()));
  return (p - z * kAxisZ).norm() <= 0.5;
}
bool in_box(const Eigen::Vector3d& p) {
  return (p.cwiseAbs() - Eigen::Vector3d(0.5, 0.4, 0.8)).maxCoeff() <= 0.0;
}

TEST(RayShape, TurnedShapesAreHitWhereMarchingHitsThem) {
  for (const bool is_static : {true, false}) {
    expect_as_marched(CylinderShape{0.5, 1.6}, is_static, in_cylinder);
    expect_as_marched(CapsuleShape{0.5, 1.6}, is_static, in_capsule);
    expect_as_marched(BoxShape{{1.0, 0.8, 1.6}}, is_static, in_box);
    expect_as_marched(SphereShape{0.6}, is_static,
                      [](const Eigen::Vector3d& p) { return p.norm() <= 0.6; });
  }
}

TEST(RayShape, ACylinderIsHitOnTheWallTheLidsAndFromWithin) {
  TestWorld world;
  world.add(make_static("drum", CylinderShape{0.5, 2.0}, at(300, 0, 0)));
  const RayScene& scene = fresh_rays(world);
  EXPECT_NEAR(range(scene, {290, 0.3, 0.2}, kAxisX), 10.0 - 0.4, 1e-10);
  EXPECT_NEAR(range(scene, {300.2, 0.1, 5}, -kAxisZ), 4.0, 1e-12);
  EXPECT_NEAR(range(scene, {300, 0, 0}, kAxisY), 0.5, 1e-12);
  EXPECT_NEAR(range(scene, {300, 0, 0}, kAxisZ), 1.0, 1e-12);
  EXPECT_EQ(range(scene, {290, 0, 1.001}, kAxisX), kNoRefusal);
  EXPECT_EQ(range(scene, {290, 0.501, 0}, kAxisX), kNoRefusal);
}

TEST(RayShape, APlaneIsInfiniteLeansAndIsHitFromBothSides) {
  TestWorld world;
  world.add(make_static("slope", PlaneShape{{1, 0, 1}}, at(0, 0, 2)));
  const RayScene& scene = fresh_rays(world);
  EXPECT_NEAR(range(scene, {0, 0, 5}, -kAxisZ), 3.0, 1e-12);
  EXPECT_NEAR(range(scene, {1000, 4000, 5}, -kAxisZ), 1003.0, 1e-9);
  const RayHit below = cast_one(scene, ray_along({0, 0, 0}, kAxisZ));
  EXPECT_NEAR(below.distance_m, 2.0, 1e-12);
  EXPECT_TRUE(is_near(below.normal_world, Eigen::Vector3d(-1, 0, -1).normalized(), 1e-12));
  EXPECT_EQ(range(scene, {0, 0, 5}, kAxisZ), kNoRefusal);
  EXPECT_EQ(range(scene, {0, 0, 5}, {1, 0, -1}), kNoRefusal);
}

TEST(RayShape, WhatIsNearerThanAPlaneHidesItAndWhatIsBehindDoesNot) {
  TestWorld world;
  world.add(make_ground());
  world.add(make_static("above", BoxShape{{1, 1, 1}}, at(0, 0, 2)));
  world.add(make_static("below", BoxShape{{1, 1, 1}}, at(5, 0, -2)));
  world.add(make_static("pier", BoxShape{{1, 1, 4}}, at(10, 0, 0)));
  const RayScene& scene = fresh_rays(world);
  EXPECT_NEAR(range(scene, {0, 0, 5}, -kAxisZ), 2.5, 1e-12);
  EXPECT_NEAR(range(scene, {5, 0, 5}, -kAxisZ), 5.0, 1e-12);
  EXPECT_NEAR(range(scene, {10, 0, 5}, -kAxisZ), 3.0, 1e-12);
}

/// A tetrahedron as an OBJ file with an own material and picture coordinates.
constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(RayShape, AMeshIsHitWithItsScale) {
  const ScratchFolder folder;
  const std::string file = folder.write("tetrahedron.obj", kTetrahedron);
  TestWorld world;
  world.add(make_static("mesh", MeshShape{file, {2, 3, 4}}, at(0, 0, 0)));
  const RayScene& scene = fresh_rays(world);
  // x/2 + y/3 + z/4 = 1 is the leaning face.
  EXPECT_NEAR(range(scene, {0.4, 0.6, 10}, -kAxisZ), 10.0 - 4.0 * (1.0 - 0.2 - 0.2), 1e-6);
  EXPECT_NEAR(range(scene, {0.4, 0.6, -10}, kAxisZ), 10.0, 1e-6);
  EXPECT_NEAR(range(scene, {0.2, 0.3, 0.4}, kAxisX), 2.0 * (1.0 - 0.1 - 0.1) - 0.2, 1e-6);
  const RayHit hit = cast_one(scene, ray_along({0.4, 0.6, 10}, -kAxisZ));
  EXPECT_TRUE(
      is_near(hit.normal_world, Eigen::Vector3d(1.0 / 2, 1.0 / 3, 1.0 / 4).normalized(), 1e-6));
}

TEST(RayShape, DegenerateTrianglesAreNotHitAndDoNoHarm) {
  const ScratchFolder folder;
  const std::string file = folder.write(
      "thin.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 4\n");
  TestWorld world;
  world.add(make_visual("thin", MeshShape{file, {1, 1, 1}}, at(0, 0, 0)));
  const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  EXPECT_NEAR(range(scene, {0.2, 0.2, 1}, -kAxisZ), 1.0, 1e-6);
  const RayHit edge_on = cast_one(scene, ray_along({1.5, -1, 0}, kAxisY));
  EXPECT_TRUE(!edge_on.is_hit() || edge_on.normal_world.allFinite());
}

/// Height over (x, y) of a field of 5 x 4 samples of 4 m x 3 m, the triangles parted as ODE's.
double height_at(const std::vector<int>& samples, double x, double y) {
  const double column = x + 2.0, row = 1.5 - y;
  const int c = std::min(3, static_cast<int>(column)), r = std::min(2, static_cast<int>(row));
  const double u = column - c, v = row - r;
  const auto h = [&](int dr, int dc) { return samples[(r + dr) * 5 + c + dc] / 255.0; };
  return u + v <= 1.0 ? h(0, 0) + u * (h(0, 1) - h(0, 0)) + v * (h(1, 0) - h(0, 0))
                      : h(1, 1) + (1 - u) * (h(1, 0) - h(1, 1)) + (1 - v) * (h(0, 1) - h(1, 1));
}

TEST(RayShape, AHeightmapIsHitWhereItsTrianglesLie) {
  const ScratchFolder folder;
  Draw draw("heightmap");
  std::vector<int> samples;
  std::string text = "P2\n5 4\n255\n";
  for (int i = 0; i < 20; ++i) samples.push_back(static_cast<int>(draw.uniform(0, 255)));
  samples[7] = 255;
  for (const int sample : samples) text += std::to_string(sample) + "\n";
  TestWorld world;
  world.add(
      make_static("hills", HeightmapShape{folder.write("a.pgm", text), {4, 3, 1}}, at(20, 10, 5)));
  const RayScene& scene = fresh_rays(world);
  for (int i = 0; i < 500; ++i) {
    const double x = draw.uniform(-1.99, 1.99), y = draw.uniform(-1.49, 1.49);
    ASSERT_NEAR(range(scene, {20 + x, 10 + y, 10}, -kAxisZ), 5.0 - height_at(samples, x, y), 1e-6);
  }
  EXPECT_EQ(range(scene, {22.01, 10, 10}, -kAxisZ), kNoRefusal);
}

TEST(RayShape, CylindersAreStillRoundWhenSeenFromFarAway) {
  TestWorld world;
  world.add(make_static("pole", CylinderShape{0.05, 2.0}, at(150, 200, 1)));
  const RayScene& scene = fresh_rays(world);
  const Eigen::Vector3d p(-100, -120, 1.0);
  for (double offset = -0.045; offset <= 0.045; offset += 0.009) {
    const Eigen::Vector3d to = Eigen::Vector3d(150, 200, 1.0) - p;
    const Eigen::Vector3d side = Eigen::Vector3d(-to.y(), to.x(), 0.0).normalized();
    const RayHit hit = cast_one(scene, ray_along(p + offset * side, to));
    EXPECT_NEAR(hit.distance_m, to.norm() - std::sqrt(0.0025 - offset * offset), 1e-9);
  }
}

}  // namespace
}  // namespace trident::sim
