// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// VRX' floats: what a shape displaces, and models that float by it.
#include <gtest/gtest.h>

#include <cmath>

#include "boat_world.h"
#include "marine/vessel/submerged_shape.h"
#include "trident_base/angle.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

TEST(FloatingShape, ABoxIsImmersedAsFarAsItIsBelowTheLevel) {
  const FloatingShape box = FloatingShape::box({2.0, 1.0, 0.5});
  EXPECT_NEAR(box.volume_m3(), 1.0, 1e-12);
  const Submerged wet = box.below(3.1, at(7.0, -4.0, 3.0));
  EXPECT_NEAR(wet.volume_m3, 2.0 * 0.35, 1e-12);
  EXPECT_TRUE(wet.centroid.isApprox(Eigen::Vector3d(7.0, -4.0, 2.925), 1e-12));
  EXPECT_EQ(box.below(2.7, at(0, 0, 3.0)).volume_m3, 0.0);
  EXPECT_NEAR(box.below(9.0, at(0, 0, 3.0)).volume_m3, 1.0, 1e-12);
}

TEST(FloatingShape, ATurnedBoxIsCutByTheLevel) {
  const FloatingShape box = FloatingShape::box({2.0, 2.0, 2.0});
  const Submerged wet = box.below(0.0, SE3::from_xyz_rpy({0, 0, 0}, kPi / 4.0, 0, 0));
  EXPECT_NEAR(wet.volume_m3, 4.0, 1e-12);  // a triangle of height sqrt(2) and base 2 sqrt(2)
  EXPECT_NEAR(wet.centroid.z(), -std::sqrt(2.0) / 3.0, 1e-12);
}

TEST(FloatingShape, RoundOnesHaveTheirVolumeAndTheirHalves) {
  const FloatingShape drum = FloatingShape::cylinder(0.3, 1.0);
  EXPECT_NEAR(drum.below(9.0, SE3()).volume_m3, kPi * 0.09, 1e-12);
  EXPECT_NEAR(drum.below(0.25, SE3()).volume_m3, 0.75 * kPi * 0.09, 1e-3);
  const FloatingShape ball = FloatingShape::sphere(0.5);
  const Submerged half = ball.below(2.0, at(1, 1, 2));
  EXPECT_NEAR(half.volume_m3, 2.0 / 3.0 * kPi * 0.125, 1e-9);
  EXPECT_NEAR(half.centroid.z(), 2.0 - 3.0 / 8.0 * 0.5, 2e-3);
}

ParamNode element(const std::string& name, const std::string& text,
                  std::vector<ParamNode> children = {}) {
  return {name, text, {}, std::move(children)};
}

/// A box of 1 m that carries half its volume of water.
ModelSpec buoy(double height, const ParamList& params, ParamNode geometry) {
  ModelSpec spec = make_body("buoy", BoxShape{{1.0, 1.0, 1.0}}, at(0, 0, height));
  spec.links[0].inertial.mass_kg = 500.0;
  spec.links[0].inertial.inertia_com = 80.0 * Eigen::Matrix3d::Identity();
  spec.plugins = {make_plugin("float", "libbuoyancy_gazebo_plugin.so", params)};
  spec.plugins[0].params.children.push_back(
      element("buoyancy", "", {element("link_name", spec.links[0].name), std::move(geometry)}));
  return spec;
}

ParamNode cube() {
  return element("geometry", "", {element("box", "", {element("size", "1 1 1")})});
}

const ParamList kWater{{"fluid_density", "1000"}, {"linear_drag", "5"}, {"angular_drag", "5"}};

double height_of_float(TestWorld& world) {
  return world->find_model("buoy")->T_world_model().p.z();
}

TEST(Buoyancy, ABuoyComesToRestWhereItDisplacesItsMass) {
  TestWorld world(ocean());
  world.add(buoy(2.0, kWater, cube()));
  world->step(20000);
  EXPECT_NEAR(height_of_float(world), 0.0, 1e-4);
  EXPECT_TRUE(world.reports.empty());
}

TEST(Buoyancy, TheFluidLevelLiftsIt) {
  ParamList params = kWater;
  params.push_back({"fluid_level", "3"});
  TestWorld world(ocean());
  world.add(buoy(2.0, params, cube()));
  world->step(20000);
  EXPECT_NEAR(height_of_float(world), 3.0, 1e-4);
}

TEST(Buoyancy, OnWavesItFollowsTheSurfaceOfTheSea) {
  ParamList params = kWater;
  params.push_back({"wave_model", "ocean"});
  params[1].second = "20";
  TestWorld world(ocean({make_sea(
      {{"waves",
        {{"spectrum", "regular"}, {"amplitude", "0.5"}, {"period", "8"}, {"ramp_time", "0"}}}})}));
  world.add(buoy(0.0, params, cube()));
  double furthest = 0.0, highest = 0.0;
  for (int i = 0; i < 200; ++i) {
    world->step(100);
    const Eigen::Vector2d place = world->find_model("buoy")->T_world_model().p.head<2>();
    const double surface =
        find_sea(*world)->water().column(place, {0.0, 0.0}, world->time().seconds()).elevation_m;
    furthest = std::max(furthest, std::abs(height_of_float(world) - surface));
    highest = std::max(highest, surface);
  }
  EXPECT_GT(highest, 0.45);
  EXPECT_LT(furthest, 0.1);
}

TEST(Buoyancy, ALightMarkWithMuchDragStandsStill) {
  ParamList params = kWater;
  params[2].second = "1e5";  // explicitly it would turn ever faster
  TestWorld world(ocean());
  Model& mark = world.add(buoy(0.0, params, cube()));
  world->set_model_twist(mark, Eigen::Vector3d::Zero(), {0.0, 0.0, 1.0});
  world->step(1000);
  EXPECT_LT(mark.bodies[0]->angular_velocity().norm(), 1e-3);
}

TEST(Buoyancy, WhatIsNoFloatIsRefused) {
  const auto refusal = [](const ParamNode& geometry) {
    TestWorld world(ocean());
    return error_of([&] { world.add(buoy(0.0, kWater, geometry)); });
  };
  EXPECT_TRUE(contains(refusal(element("geometry", "", {element("mesh", "")})), "<geometry>"));
  EXPECT_TRUE(
      contains(refusal(element("geometry", "", {element("sphere", "", {element("radius", "-1")})})),
               "radius"));
  EXPECT_TRUE(contains(
      refusal(element("geometry", "", {element("box", "", {element("size", "1 0 1")})})), "size"));
}

}  // namespace
}  // namespace trident::sim
