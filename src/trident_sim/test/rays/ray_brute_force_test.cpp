// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Many rays: against closed forms and brute force, from several threads, in any order.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "ray_check.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

struct PlacedBox {
  Eigen::Vector3d size;
  SE3 T_world_box;
};

/// Where a ray hits the hull of a box grown by `margin`, by slabs.
double slab_range(const PlacedBox& box, const Ray& ray, double margin) {
  const SE3 T_box_world = box.T_world_box.inverse();
  const Eigen::Vector3d o = T_box_world * ray.p_world_origin;
  const Eigen::Vector3d d = T_box_world.R * ray.direction_world;
  double enter = -kNothing, leave = kNothing;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * box.size[axis] + margin;
    const double a = (-half - o[axis]) / d[axis], b = (half - o[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave || leave < 0.0) return kNothing;
  return enter >= 0.0 ? enter : leave;
}

double nearest_slab(const std::vector<PlacedBox>& boxes, const Ray& ray, double margin) {
  double nearest = kNothing;
  for (const PlacedBox& box : boxes) nearest = std::min(nearest, slab_range(box, ray, margin));
  return nearest;
}

std::vector<PlacedBox> add_boxes(TestWorld& world, int count, const std::string& seed) {
  Draw draw(seed);
  std::vector<PlacedBox> boxes;
  for (int i = 0; i < count; ++i) {
    boxes.push_back({Eigen::Vector3d::Constant(2.1) + draw.point(1.9), draw.pose(10.0)});
    ModelSpec model =
        make_body("box" + std::to_string(i), BoxShape{boxes.back().size}, boxes.back().T_world_box);
    model.is_static = i % 2 == 0;
    world.add(model);
  }
  return boxes;
}

/// Packets of rays from anywhere to anywhere, and as many from one place in about the same
/// direction.
std::vector<Ray> random_rays(std::size_t count, const std::string& seed) {
  Draw draw(seed);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const bool is_bundle = rays.size() / RayScene::kPacket % 2 == 0;
    const Eigen::Vector3d p = draw.point(12.0), along = draw.direction();
    for (std::size_t i = 0; i < RayScene::kPacket && rays.size() < count; ++i) {
      rays.push_back(is_bundle ? ray_along(p, along + 0.1 * draw.direction())
                               : ray_along(draw.point(12.0), draw.direction()));
    }
  }
  return rays;
}

/// How many boxes; half of them can move. A few that do are intersected one by one, more as
/// instances.
class AmongBoxes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(ManyRays, AmongBoxes, testing::Values(14, 60));

TEST_P(AmongBoxes, AHundredThousandRaysAgreeWithSlabs) {
  TestWorld world;
  const std::vector<PlacedBox> boxes = add_boxes(world, GetParam(), "boxes");
  const RayScene& scene = fresh_rays(world);
  const std::vector<Ray> rays = random_rays(100000, "slabs");
  const std::vector<RayHit> hits = cast_all(scene, rays);
  int hit_count = 0, at_edges = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double exact = nearest_slab(boxes, rays[i], 0.0);
    hit_count += hits[i].is_hit() ? 1 : 0;
    if (exact == hits[i].distance_m || std::abs(exact - hits[i].distance_m) < 1e-9) continue;
    // Embree may err by a rounded float at an edge: then the box grown or shrunk by that agrees.
    ++at_edges;
    const double grown = nearest_slab(boxes, rays[i], 1e-5);
    const double shrunk = nearest_slab(boxes, rays[i], -1e-5);
    const auto agrees = [&](double with) {
      return with == hits[i].distance_m || std::abs(with - hits[i].distance_m) < 1e-3;
    };
    ASSERT_TRUE(agrees(grown) || agrees(shrunk))
        << i << ": " << exact << ", not " << hits[i].distance_m;
  }
  EXPECT_GT(hit_count, 300 * GetParam());
  EXPECT_LT(at_edges, 10);
}

TEST(ManyRays, NoneSlipsBetweenBoxesSideBySide) {
  for (const double far_m : {0.0, 3000.0}) {
    TestWorld world;
    const SE3 T_world_seam{Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3).normalized(),
                           {far_m, -0.7 * far_m, 1.0}};
    for (const double side : {-1.0, 1.0}) {
      const SE3 T_world_box = T_world_seam * at(0.0, side, 0.0);
      world.add(make_static(side < 0.0 ? "left" : "right", BoxShape{{2, 2, 2}}, T_world_box));
    }
    const RayScene& scene = fresh_rays(world);
    Draw draw("seam");
    std::vector<Ray> rays;
    for (int i = 0; i < 50000; ++i) {
      const Eigen::Vector3d from(-1.5 - draw.uniform(0.0, 40.0), draw.uniform(-5.0, 5.0), 0.0);
      const Eigen::Vector3d to(-1.0, draw.uniform(-1e-5, 1e-5), draw.uniform(-0.9, 0.9));
      rays.push_back(ray_along(T_world_seam * from, T_world_seam.R * (to - from)));
    }
    for (const RayHit& hit : cast_all(scene, rays)) ASSERT_LT(hit.distance_m, 45.0) << far_m;
  }
}

TEST(ManyRays, FromWithinABoxHitTheFaceInFrontOfThem) {
  TestWorld world;
  const SE3 T_world_box{Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3).normalized(), {5.0, -7.0, 1.0}};
  world.add(make_static("box", BoxShape{{2, 4, 6}}, T_world_box));
  const RayScene& scene = fresh_rays(world);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d along = side * Eigen::Vector3d::Unit(axis);
      const Ray ray = ray_along(T_world_box * (0.25 * along), T_world_box.R * along);
      const RayHit hit = cast_one(scene, ray);
      EXPECT_NEAR(hit.distance_m, axis + 0.75, 1e-9);
      EXPECT_NEAR(hit.normal_world.dot(ray.direction_world), -1.0, 1e-9);
      bool is_dark = false;
      scene.occluded({&ray, 1}, {&is_dark, 1});
      EXPECT_TRUE(is_dark);
    }
  }
}

TEST_P(AmongBoxes, OcclusionAgreesWithCasting) {
  TestWorld world;
  add_boxes(world, GetParam(), "occluders");
  world.add(make_ground());
  world.add(make_static("ball", SphereShape{2.0}, at(3, 3, 3)));
  world.add(make_body("drum", CylinderShape{1.0, 3.0}, at(-3, 3, 3)));
  const RayScene& scene = fresh_rays(world);
  std::vector<Ray> rays = random_rays(20000, "occlusion");
  for (Ray& ray : rays) ray.t_max_m = 12.0;
  const std::vector<RayHit> hits = cast_all(scene, rays);
  const std::unique_ptr<bool[]> dark(new bool[rays.size()]);
  scene.occluded(rays, {dark.get(), rays.size()});
  int different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) different += hits[i].is_hit() != dark[i] ? 1 : 0;
  EXPECT_LE(different, 2) << "but for rays that graze an edge";
}

struct Soup {
  std::vector<Eigen::Vector3d> corners;  ///< three a triangle

  std::string obj() const {
    std::string text;
    char line[96];
    for (const Eigen::Vector3d& p : corners) {
      std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
      text += line;
    }
    for (std::size_t i = 1; i <= corners.size(); i += 3) {
      std::snprintf(line, sizeof line, "f %zu %zu %zu\n", i, i + 1, i + 2);
      text += line;
    }
    return text;
  }

  /// Moeller and Trumbore's intersection in double, of triangles grown by `margin` (of their size).
  double range(const Ray& ray, double margin) const {
    double nearest = kNothing;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const Eigen::Vector3d ab = corners[i + 1] - corners[i], ac = corners[i + 2] - corners[i];
      const Eigen::Vector3d h = ray.direction_world.cross(ac);
      const double det = ab.dot(h);
      const Eigen::Vector3d s = ray.p_world_origin - corners[i], q = s.cross(ab);
      const double u = s.dot(h) / det, v = ray.direction_world.dot(q) / det;
      const double t = ac.dot(q) / det;
      if (u < -margin || v < -margin || u + v > 1.0 + margin || t < 0.0) continue;
      nearest = std::min(nearest, t);
    }
    return nearest;
  }
};

TEST(ManyRays, ARandomMeshAgreesWithBruteForce) {
  Draw draw("soup");
  Soup soup;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d center = draw.point(5.0);
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3f corner = (center + draw.point(3.0)).cast<float>();
      soup.corners.push_back(corner.cast<double>());
    }
  }
  const ScratchFolder folder;
  const std::string file = folder.write("soup.obj", soup.obj());
  for (const bool is_static : {true, false}) {
    TestWorld world;
    ModelSpec model = make_visual("soup", MeshShape{file, {1, 1, 1}}, at(0, 0, 0));
    model.is_static = is_static;
    world.add(model);
    const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
    const std::vector<Ray> rays = random_rays(10000, "at soup");
    const std::vector<RayHit> hits = cast_all(scene, rays);
    int hit_count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hit_count += hits[i].is_hit() ? 1 : 0;
      const double low = soup.range(rays[i], 1e-4), high = soup.range(rays[i], -1e-4);
      ASSERT_GE(hits[i].distance_m, low - 1e-5) << i;
      ASSERT_TRUE(hits[i].distance_m <= high + 1e-5) << i;
    }
    EXPECT_GT(hit_count, 1000);
  }
}

TEST(ManyRays, ThreadsChangeNothing) {
  TestWorld world;
  add_boxes(world, 40, "threads");
  world.add(make_ground());
  world.add(make_static("ball", SphereShape{2.0}, at(3, 3, 3)));
  const Model& own = world.add(make_body("drum", CylinderShape{1.0, 3.0}, at(-3, 3, 3)));
  const RayScene& scene = fresh_rays(world);
  const std::vector<Ray> rays = random_rays(32000, "threads");
  RayFilter filter;
  filter.exclude_model = &own;
  const std::vector<RayHit> alone = cast_all(scene, rays, filter);
  std::vector<RayHit> shared(rays.size());
  std::vector<std::thread> threads;
  constexpr std::size_t kThreads = 4;
  const std::size_t part = rays.size() / kThreads;
  static_assert(32000 / kThreads % RayScene::kPacket == 0);
  for (std::size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      scene.cast(Span(rays).subspan(i * part, part), Span(shared).subspan(i * part, part), filter);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(alone[i].distance_m, shared[i].distance_m);
    ASSERT_EQ(alone[i].shape, shared[i].shape);
    ASSERT_EQ(alone[i].normal_world, shared[i].normal_world);
  }
}

TEST(ManyRays, TheOrderOfSpawningChangesNothing) {
  const std::vector<Ray> rays = random_rays(4000, "order");
  const auto look = [&](bool backwards) {
    TestWorld world;
    for (int i = 0; i < 20; ++i) {
      Draw draw("order" + std::to_string(backwards ? 19 - i : i));
      const SE3 T = draw.pose(15.0);
      ModelSpec model =
          make_body("m" + std::to_string(backwards ? 19 - i : i), BoxShape{{3, 3, 3}}, T);
      model.is_static = true;
      world.add(model);
      fresh_rays(world);
    }
    return cast_all(sim::rays(*world, RayGeometry::kCollision), rays);
  };
  const std::vector<RayHit> forwards = look(false), backwards = look(true);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(forwards[i].distance_m, backwards[i].distance_m);
    ASSERT_EQ(forwards[i].shape, backwards[i].shape);
  }
}

}  // namespace
}  // namespace trident::sim
