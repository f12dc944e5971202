// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "quad_world.h"

namespace trident::sim {
namespace {

constexpr double kStep_s = 0.01;

ModelSpec body_in_wind(const ParamList& params) {
  ModelSpec model = make_body("a", SphereShape{0.1}, at(0, 0, 10), 2.0);
  model.links[0].gravity = false;
  ParamList all{{"robotNamespace", "a"}, {"linkName", "link"}};
  all.insert(all.end(), params.begin(), params.end());
  model.plugins.push_back(make_plugin("wind", "librotors_gazebo_wind_plugin.so", all));
  return model;
}

/// Velocity after `steps` in wind.
Eigen::Vector3d drift(const ParamList& params, std::uint64_t steps) {
  TestWorld world;
  Model& body = world.add(body_in_wind(params));
  world->step(steps);
  return body.bodies[0]->velocity();
}

TEST(Wind, AGustWithoutForceNeedsNoDirection) {
  const std::vector<std::pair<std::string, std::string>> calm{
      {"windForceMean", "3"}, {"windDirection", "0 2 0"}, {"windGustDirection", "0 0 0"}};
  EXPECT_TRUE(is_near(drift(calm, 10),
                      drift({{"windForceMean", "3"}, {"windDirection", "0 2 0"}}, 10), 1e-12));
  auto gusty = calm;
  gusty.emplace_back("windGustForceMean", "1");
  EXPECT_TRUE(contains(error_of([&] { drift(gusty, 1); }), "<windGustDirection> is '0 0 0'"));
}

TEST(Wind, ForcePushesAlongTheNormalizedDirection) {
  EXPECT_TRUE(is_near(drift({{"windForceMean", "3"}, {"windDirection", "0 2 0"}}, 10),
                      {0, 3.0 / 2.0 * 10 * kStep_s, 0}, 1e-12));
}

TEST(Wind, NoForceByDefault) { EXPECT_EQ(drift({}, 10), Eigen::Vector3d(0, 0, 0)); }

TEST(Wind, GustLastsFromStartForItsDuration) {
  const ParamList gust{{"windGustForceMean", "4"},
                       {"windGustStart", "0.1"},
                       {"windGustDuration", "0.2"},
                       {"windGustDirection", "0 0 1"}};
  EXPECT_EQ(drift(gust, 9), Eigen::Vector3d(0, 0, 0));
  EXPECT_TRUE(is_near(drift(gust, 10), {0, 0, 4.0 / 2.0 * kStep_s}, 1e-12));
  EXPECT_TRUE(is_near(drift(gust, 50), {0, 0, 4.0 / 2.0 * 0.2}, 1e-12));
}

TEST(Wind, ForceOffTheCenterTurns) {
  TestWorld world;
  Model& body = world.add(body_in_wind({{"windForceMean", "3"}, {"xyzOffset", "0 0.1 0"}}));
  world->step();
  // r = +y, F = +x: torque along -z.
  EXPECT_NEAR(body.bodies[0]->angular_velocity().z(),
              -0.3 / body.bodies[0]->inertia_tensor()(2, 2) * kStep_s, 1e-12);
}

TEST(Wind, ForceAndSpeedAreShown) {
  TestWorld world;
  world.add(body_in_wind({{"windForceMean", "3"}, {"windSpeedMean", "5"}}));
  auto* force = world->ports().find_out<WrenchSample>("a/external_force");
  auto* speed = world->ports().find_out<WindSample>("a/wind_speed");
  force->add_listener();
  speed->add_listener();
  world->step();
  EXPECT_EQ(force->value.force, Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(speed->value.v_world, Eigen::Vector3d(5, 0, 0));
}

TEST(Wind, SpeedDragsTheRotorsOfTheSameNamespaceOnly) {
  QuadOptions options;
  options.rotor_drag = 2e-4;
  QuadWorld windy(options), calm(options);
  TestWorld& world = windy.world;
  ModelSpec elsewhere = body_in_wind({{"windSpeedMean", "9"}});
  calm.world.add(elsewhere);
  ModelSpec spec = body_in_wind({{"windSpeedMean", "5"}});
  spec.plugins[0].params.children[0].text = "quad";
  spec.T_world_model = at(50, 0, 10);
  world.add(spec);
  for (QuadWorld* quad : {&windy, &calm}) {
    quad->settle({400, 400, 400, 400});
    (*quad)->step();
  }
  EXPECT_NEAR(windy.body().velocity().x(), 4 * 400 * 2e-4 * 5.0 / options.mass_kg() * kStep_s,
              1e-9);
  EXPECT_NEAR(calm.body().velocity().x(), 0.0, 1e-12);
}

TEST(Wind, AStaticLinkIsNotPushed) {
  TestWorld world;
  ModelSpec spec = body_in_wind({{"windForceMean", "3"}});
  spec.is_static = true;
  world.add(std::move(spec));
  world->step(3);
  EXPECT_TRUE(is_near(world->find_model("a")->T_world_model(), at(0, 0, 10), 0.0));
}

}  // namespace
}  // namespace trident::sim
