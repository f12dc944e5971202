// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The scene as a whole: how it follows the world, and what it leaves out.
#include "trident_sim/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ray_check.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

constexpr double kNoShape = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kForward = Eigen::Vector3d::UnitX(), kLeft = Eigen::Vector3d::UnitY(),
                      kUpward = Eigen::Vector3d::UnitZ();

TEST(RayScene, InAnEmptyWorldNothingIsHit) {
  TestWorld world;
  const RayScene& scene = rays(*world, RayGeometry::kCollision);
  EXPECT_EQ(range(scene, {0, 0, 1}, -kUpward), kNoShape);
  fresh_rays(world);
  EXPECT_EQ(range(scene, {0, 0, 1}, -kUpward), kNoShape);
  bool dark = true;
  const Ray ray = ray_along({0, 0, 1}, -kUpward);
  scene.occluded({&ray, 1}, {&dark, 1});
  EXPECT_FALSE(dark);
  scene.cast({}, {});
}

TEST(RayScene, RaysThatAreNotFiniteHitNothing) {
  TestWorld world;
  world.add(make_ground());
  world.add(make_static("box", BoxShape{{1, 1, 1}}, at(0, 0, 0.5)));
  const RayScene& scene = fresh_rays(world);
  const double nan = std::nan("");
  std::vector<Ray> rays(5, ray_along({0, 0, 3}, -kUpward));
  rays[0].p_world_origin.x() = nan;
  rays[1].direction_world.y() = kNoShape;
  rays[2].t_max_m = nan;
  rays[3].t_min_m = 10.0, rays[3].t_max_m = 1.0;
  const std::vector<RayHit> hits = cast_all(scene, rays);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(hits[i].is_hit()) << i;
  EXPECT_NEAR(hits[4].distance_m, 2.0, 1e-12);
}

TEST(RayScene, OnlySurfacesWithinTheLimitsCount) {
  TestWorld world;
  world.add(make_static("near", BoxShape{{1, 1, 1}}, at(2, 0, 0)));
  world.add(make_static("far", SphereShape{0.5}, at(5, 0, 0)));
  const RayScene& scene = fresh_rays(world);
  const auto between = [&](double low, double high) {
    return cast_one(scene, {{0, 0, 0}, kForward, low, high}).distance_m;
  };
  EXPECT_NEAR(between(0.0, 1.5), 1.5, 1e-12);
  EXPECT_EQ(between(0.0, 1.4999), kNoShape);
  EXPECT_NEAR(between(2.0, kNoShape), 2.5, 1e-12);
  EXPECT_NEAR(between(2.6, kNoShape), 4.5, 1e-12);
  EXPECT_NEAR(between(4.6, kNoShape), 5.5, 1e-12);
  EXPECT_EQ(between(5.6, kNoShape), kNoShape);
}

TEST(RayScene, MovedAndTurnedModelsAreHitWhereTheyAre) {
  TestWorld world;
  Model& box = world.add(make_body("box", BoxShape{{2, 1, 1}}, at(5, 0, 0)));
  RayScene& scene = fresh_rays(world);
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 4.0, 1e-12);
  world->set_model_pose(box, SE3::from_xyz_rpy({6, 0, 0}, 0, 0, std::acos(0.0)));
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 4.0, 1e-12) << "moved before refresh()";
  scene.refresh();
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 5.5, 1e-12);
  EXPECT_NEAR(range(scene, {6, -5, 0}, kLeft), 4.0, 1e-12);
}

TEST(RayScene, FallingBodiesAreFollowed) {
  TestWorld world;
  world.add(make_ground());
  Model& ball = world.add(make_body("ball", SphereShape{0.2}, at(0, 0, 5)));
  RayScene& scene = fresh_rays(world);
  for (int i = 0; i < 60; ++i) {
    world->step();
    scene.refresh();
    ASSERT_NEAR(range(scene, {0, 0, 20}, -kUpward), 19.8 - ball.T_world_model().p.z(), 1e-9);
  }
  EXPECT_LT(ball.T_world_model().p.z(), 4.0);
}

TEST(RayScene, RefreshingCostsNothingWhenNothingMoved) {
  TestWorld world;
  world.add(make_ground());
  world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(3, 0, 0)));
  Model& ball = world.add(make_body("ball", SphereShape{0.2}, at(0, 0, 5)));
  RayScene& scene = fresh_rays(world);
  const RayScene::Commits first = scene.commits();
  scene.refresh();
  EXPECT_EQ(scene.commits().fixed, first.fixed);
  EXPECT_EQ(scene.commits().moving, first.moving);
  world->set_model_pose(ball, at(1, 0, 5));
  scene.refresh();
  scene.refresh();
  EXPECT_EQ(scene.commits().fixed, first.fixed);
  EXPECT_EQ(scene.commits().moving, first.moving + 1);
  world.add(make_body("other", SphereShape{0.2}, at(0, 3, 5)));
  scene.refresh();
  EXPECT_EQ(scene.commits().fixed, first.fixed) << "what moves is no part of it";
  world->remove("wall");
  scene.refresh();
  EXPECT_EQ(scene.commits().fixed, first.fixed + 1);
}

TEST(RayScene, FixedLinksThatArePlacedElsewhereAreNoticed) {
  TestWorld world;
  Model& wall = world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(3, 0, 0)));
  RayScene& scene = fresh_rays(world);
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 2.5, 1e-12);
  wall.links[0]->T_body_link = at(4, 0, 0);
  scene.refresh();
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 3.5, 1e-12);
}

TEST(RayScene, ModelsComeAndGo) {
  TestWorld world;
  RayScene& scene = fresh_rays(world);
  for (int i = 0; i < 50; ++i) {
    const double x = 2.0 + 0.1 * i;
    world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(x, 0, 0)));
    world.add(make_body("ball", SphereShape{0.5}, at(0, x, 0)));
    EXPECT_EQ(range(scene, {0, 0, 0}, kForward), kNoShape);
    scene.refresh();
    ASSERT_NEAR(range(scene, {0, 0, 0}, kForward), x - 0.5, 1e-9);
    ASSERT_NEAR(range(scene, {0, 0, 0}, kLeft), x - 0.5, 1e-9);
    ASSERT_EQ(scene.shapes().size(), 2u);
    world->remove("wall");
    world->remove("ball");
    EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), x - 0.5, 1e-9) << "still there until refresh()";
    scene.refresh();
    ASSERT_EQ(range(scene, {0, 0, 0}, kForward), kNoShape);
    ASSERT_EQ(range(scene, {0, 0, 0}, kLeft), kNoShape);
  }
}

TEST(RayScene, AModelThatTakesTheNameOfAnotherIsHit) {
  TestWorld world;
  world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(3, 0, 0)));
  RayScene& scene = fresh_rays(world);
  world->remove("wall");
  world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(7, 0, 0)));
  scene.refresh();
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 6.5, 1e-12);
}

TEST(RayScene, HitsSayWhatWasHit) {
  TestWorld world;
  world.add(make_static("a_wall", BoxShape{{1, 1, 1}}, at(3, 0, 0)));
  ModelSpec robot = make_body("robot", SphereShape{0.5}, at(-3, 0, 0));
  robot.links[0].collisions[0].name = "hull";
  robot.links.push_back(make_link("arm", 1.0, {0.01, 0.01, 0.01}, at(0, 3, 0)));
  robot.links[1].collisions.push_back(make_collision(BoxShape{{1, 1, 1}}));
  const Model& made = world.add(robot);
  const RayScene& scene = fresh_rays(world);
  const auto what = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
    return scene.shapes()[cast_one(scene, ray_along(p, d)).shape];
  };
  EXPECT_EQ(what({0, 0, 0}, kForward).model, "a_wall");
  const RayShape hull = what({0, 0, 0}, -kForward), arm = what({0, 3, 0}, -kForward);
  EXPECT_EQ(hull.model + "::" + hull.link + "::" + hull.name, "robot::link::hull");
  EXPECT_EQ(arm.link, "arm");
  EXPECT_EQ(hull.model_id, 1u);
  EXPECT_EQ(arm.model_id, 1u);
  EXPECT_EQ(hull.link_id, 1u);
  EXPECT_EQ(arm.link_id, 2u);
  EXPECT_EQ(hull.model_address, &made);
  EXPECT_EQ(arm.link_address, made.find_link("arm"));
}

TEST(RayScene, TheBodyThatCarriesTheSensorCanBeLeftOut) {
  for (const bool is_static : {true, false}) {
    TestWorld world;
    ModelSpec spec = make_body("robot", BoxShape{{1, 1, 1}}, at(0, 0, 0));
    spec.is_static = is_static;
    spec.links.push_back(make_link("mast", 1.0, {0.01, 0.01, 0.01}, at(2, 0, 0)));
    spec.links[1].collisions.push_back(make_collision(SphereShape{0.5}));
    const Model& robot = world.add(spec);
    world.add(make_static("wall", BoxShape{{1, 1, 1}}, at(5, 0, 0)));
    const RayScene& scene = fresh_rays(world);
    RayFilter filter;
    EXPECT_NEAR(range(scene, {0, 0, 0}, kForward, filter), 0.5, 1e-12);
    filter.exclude_link = robot.find_link("link");
    EXPECT_NEAR(range(scene, {0, 0, 0}, kForward, filter), 1.5, 1e-12);
    filter.exclude_link = nullptr;
    filter.exclude_model = &robot;
    EXPECT_NEAR(range(scene, {0, 0, 0}, kForward, filter), 4.5, 1e-12);
    bool dark = true;
    const Ray ray{{0, 0, 0}, kForward, 0.0, 4.0};
    scene.occluded({&ray, 1}, {&dark, 1}, filter);
    EXPECT_FALSE(dark);
  }
}

TEST(RayScene, CollisionsAndVisualsAreSeenApart) {
  TestWorld world;
  ModelSpec model = make_visual("body", BoxShape{{1, 1, 1}}, at(5, 0, 0));
  model.links[0].collisions.push_back(make_collision(SphereShape{2.0}));
  world.add(model);
  EXPECT_NEAR(range(fresh_rays(world, RayGeometry::kCollision), {0, 0, 0}, kForward), 3.0, 1e-12);
  EXPECT_NEAR(range(fresh_rays(world, RayGeometry::kVisual), {0, 0, 0}, kForward), 4.5, 1e-12);
}

TEST(RayScene, MasksChooseAmongVisuals) {
  for (const bool is_static : {true, false}) {
    TestWorld world;
    const std::vector<std::pair<std::string, Shape>> in_a_row = {{"a", BoxShape{{1, 1, 1}}},
                                                                 {"b", SphereShape{0.5}},
                                                                 {"c", BoxShape{{1, 1, 1}}},
                                                                 {"d", PlaneShape{kForward}}};
    for (std::size_t i = 0; i < in_a_row.size(); ++i) {
      ModelSpec model = make_visual(in_a_row[i].first, in_a_row[i].second, at(2.0 + 2.0 * i, 0, 0));
      model.is_static = is_static;
      model.links[0].visuals[0].visibility_flags = 1u << i;
      world.add(model);
    }
    const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
    const auto seen = [&](std::uint32_t mask) {
      RayFilter filter;
      filter.mask = mask;
      return range(scene, {0, 0, 0}, kForward, filter);
    };
    EXPECT_NEAR(seen(15), 1.5, 1e-12);
    EXPECT_NEAR(seen(2), 3.5, 1e-12);
    EXPECT_NEAR(seen(12), 5.5, 1e-12);
    EXPECT_NEAR(seen(8), 8.0, 1e-12);
    EXPECT_EQ(seen(16), kNoShape);
  }
}

TEST(RayScene, WhatIsTransparentIsNotSeen) {
  TestWorld world;
  ModelSpec glass = make_visual("glass", BoxShape{{1, 1, 1}}, at(2, 0, 0));
  glass.links[0].visuals[0].transparency = 1.0;
  world.add(glass);
  Material clear;
  clear.is_given = true;
  clear.diffuse.w() = 0.0;
  world.add(make_visual("clear", BoxShape{{1, 1, 1}}, at(4, 0, 0), clear));
  ModelSpec half = make_visual("half", BoxShape{{1, 1, 1}}, at(6, 0, 0));
  half.links[0].visuals[0].transparency = 0.5;
  world.add(half);
  EXPECT_NEAR(range(fresh_rays(world, RayGeometry::kVisual), {0, 0, 0}, kForward), 5.5, 1e-12);
}

TEST(RayScene, OnlyWhatCastsShadowsBlocksLight) {
  for (const bool is_static : {true, false}) {
    TestWorld world;
    for (const bool casts : {false, true}) {
      for (const bool round : {false, true}) {
        const Shape shape = round ? Shape(SphereShape{0.5}) : Shape(BoxShape{{1, 1, 1}});
        const std::string name = std::string(casts ? "dark" : "light") + (round ? "1" : "0");
        ModelSpec model = make_visual(name, shape, at(5, casts ? 3 : 0, round ? 3 : 0));
        model.is_static = is_static;
        model.links[0].visuals[0].casts_shadows = casts;
        world.add(model);
      }
    }
    const RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
    for (const double z : {0.0, 3.0}) {
      const std::vector<Ray> rays = {ray_along({0, 0, z}, kForward),
                                     ray_along({0, 3, z}, kForward),
                                     {{0, 3, z}, kForward, 0.0, 4.4}};
      bool dark[3] = {};
      scene.occluded(rays, dark);
      EXPECT_FALSE(dark[0]);
      EXPECT_TRUE(dark[1]);
      EXPECT_FALSE(dark[2]);
      EXPECT_NEAR(cast_one(scene, rays[0]).distance_m, 4.5, 1e-12) << "it is seen all the same";
    }
  }
}

TEST(RayScene, AVisualMeshThatCannotBeReadIsReportedOnce) {
  const ScratchFolder folder;
  TestWorld world;
  const std::string file = folder.write("bad.obj", "this is no mesh\n");
  world.add(make_visual("broken", MeshShape{file, {1, 1, 1}}, at(2, 0, 0)));
  world.add(make_visual("whole", BoxShape{{1, 1, 1}}, at(5, 0, 0)));
  RayScene& scene = fresh_rays(world, RayGeometry::kVisual);
  scene.refresh();
  EXPECT_NEAR(range(scene, {0, 0, 0}, kForward), 4.5, 1e-12);
  EXPECT_EQ(world.report_count(Severity::kWarning, "visual 'broken::link::visual': mesh '" + file),
            1u);
}

}  // namespace
}  // namespace trident::sim
