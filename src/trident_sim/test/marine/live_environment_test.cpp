// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boat_world.h"
#include "marine/plugins/live_surroundings.h"
#include "ray_check.h"
#include "scratch_folder.h"
#include "trident_base/config_writer.h"
#include "trident_sim/samples/text_sample.h"

namespace trident::sim {
namespace {

PluginSpec sea_with_wind() {
  return make_sea(
      {{"waves", {{"spectrum", "jonswap"}, {"significant_height", "0.4"}, {"components", "24"}}},
       {"wind", {{"speed", "6"}, {"gusts", "dryden"}}}});
}

void say(World& world, const std::string& section, const std::string& yaml) {
  auto* const port = world.ports().find_in<TextCommand>("environment/" + section);
  ASSERT_NE(port, nullptr) << section;
  port->write({world.time(), yaml});
}

std::string published_state(World& world) {
  return world.ports().find_out<EnvironmentSample>("environment/state")->value.yaml;
}

double elevation(World& world, double time_s) {
  return find_sea(world)->water().column({1, 2}, {0, 0}, time_s).elevation_m;
}

TEST(LiveEnvironment, StateReadsBackAsItself) {
  TestWorld world(ocean({sea_with_wind()}));
  const auto params = load_yaml_string<EnvironmentParams>(published_state(*world), "state");
  EXPECT_EQ(params.waves.significant_height, 0.4);
  EXPECT_TRUE(std::isinf(params.waves.depth));
  EXPECT_EQ(params.wind.gusts, GustKind::kDryden);
  EXPECT_EQ(to_yaml(params), published_state(*world));
}

TEST(LiveEnvironment, ChangesActInTheNextStepAndKeepTheRest) {
  TestWorld world(ocean({sea_with_wind()}));
  world->step(3);
  const double before = elevation(*world, 5.0);
  say(*world, "waves", "significant_height: 0.8");
  say(*world, "current", "{kind: uniform, speed: 0.3, direction: 0}");
  command(*world, "environment/water_level", 0.25);
  EXPECT_EQ(elevation(*world, 5.0), before);
  world->step();
  // The same waves, twice as high, on a higher level.
  EXPECT_NEAR(elevation(*world, 5.0), 0.25 + 2.0 * before, 1e-9);
  EXPECT_NEAR(find_sea(*world)->current().velocity({0, 0, 0}, 0.0).x(), 0.3, 1e-12);
  EXPECT_TRUE(contains(published_state(*world), "water_level: 0.25\n"));
  EXPECT_TRUE(contains(published_state(*world), "significant_height: 0.8\n"));
  EXPECT_TRUE(contains(published_state(*world), "components: 24\n"));
}

TEST(LiveEnvironment, SeveralChangesOfOneStepAddUp) {
  TestWorld world(ocean({sea_with_wind()}));
  say(*world, "wind", "speed: 3");
  say(*world, "wind", "{direction: 1.5, gusts: none}");
  world->step();
  EXPECT_TRUE(is_near(find_air(*world)->wind({0, 0, 0}),
                      3.0 * Eigen::Vector3d(std::cos(1.5), std::sin(1.5), 0.0), 1e-12));
}

struct BadChange {
  const char *section, *yaml, *error;
};
class BadChanges : public testing::TestWithParam<BadChange> {};

TEST_P(BadChanges, AreRefusedOnceAndNothingChanges) {
  TestWorld world(ocean({sea_with_wind()}));
  world->step();
  const std::string state = published_state(*world);
  const std::size_t before = world.reports.size();
  const double height = elevation(*world, 7.0);
  for (int i = 0; i < 3; ++i) {
    say(*world, GetParam().section, GetParam().yaml);
    world->step();
  }
  EXPECT_EQ(published_state(*world), state);
  EXPECT_EQ(elevation(*world, 7.0), height);
  EXPECT_EQ(world.reports.size(), before + 1);
  EXPECT_EQ(world.report_count(Severity::kError, GetParam().error), 1U)
      << world.reports.back().text;
  EXPECT_EQ(world.report_count(Severity::kError, std::string("environment/") + GetParam().section),
            1U);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadChanges,
    testing::Values(BadChange{"waves", "significant_height: -0.5", "-0.5"},
                    BadChange{"waves", "spectrum: tsunami", "tsunami"},
                    BadChange{"waves", "significant_height: .nan", "nan"},
                    BadChange{"waves", "hight: 1", "hight"},
                    BadChange{"waves", "{spectrum: regular, amplitude: 2, period: 1}", "breaks"},
                    BadChange{"waves", "[1, 2", "environment/waves"},
                    BadChange{"waves", "just words", "environment/waves"},
                    BadChange{"current", "{kind: file, file: no.txt}", "no.txt"},
                    BadChange{"wind", "speed: -1", "-1"},
                    BadChange{"wind", "gusts: howling", "howling"},
                    BadChange{"tide", "period: 0", "period"}));

TEST(LiveEnvironment, ManyDifferentBadChangesAreSeldomReported) {
  TestWorld world(ocean({sea_with_wind()}));
  for (int i = 0; i < 1000; ++i) {
    if (i % 2 == 0) say(*world, "tide", "{}");
    say(*world, "tide", "period: " + std::to_string(-i));
    world->step();
    if (i % 100 == 0) world->reset();
  }
  // The first ten, then as their number doubles: 16, 32 ... 512.
  EXPECT_EQ(world.report_count(Severity::kError, "environment/tide"), 16U);
}

TEST(LiveEnvironment, BadLevelsAreRefused) {
  TestWorld world(ocean({sea_with_wind()}));
  for (const double level : {std::numeric_limits<double>::quiet_NaN(), 1e5}) {
    command(*world, "environment/water_level", level);
    world->step();
  }
  EXPECT_EQ(world.report_count(Severity::kError, "environment/water_level is"), 2U);
  EXPECT_TRUE(contains(published_state(*world), "water_level: 0\n"));
}

TEST(LiveEnvironment, ResetBringsBackTheFile) {
  TestWorld world(ocean({sea_with_wind()}));
  const std::string file = published_state(*world), hash = world->state_hash();
  const double height = elevation(*world, 5.0);
  say(*world, "waves", "significant_height: 0.9");
  say(*world, "wind", "speed: 12");
  world->step(50);
  EXPECT_NE(published_state(*world), file);
  world->reset();
  EXPECT_EQ(published_state(*world), file);
  EXPECT_EQ(elevation(*world, 5.0), height);
  EXPECT_EQ(world->state_hash(), hash);
}

/// Rays keep which squares of the water are open, fading or dry: of a shore that is moved, none.
TEST(LiveEnvironment, RaysSeeAShoreThatIsMoved) {
  const ScratchFolder folder;
  const std::string file =
      folder.write("six_metres_deep.asc",
                   "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n-6 -6\n-6 -6\n");
  TestWorld world(ocean({make_sea(
      {{"waves",
        {{"spectrum", "regular"}, {"amplitude", "0.3"}, {"period", "4"}, {"shore_depth", "4"}}},
       {"bathymetry", {{"kind", "file"}, {"file", file}}}})}));
  const auto compare = [&](double strength) {
    RayScene& rays = fresh_rays(world);
    rays.refresh_surface({20, 5, 8});
    double farthest = 0.0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d from(0.4 * i, 0.1 * i, 8.0);
      const double z = from.z() - range(rays, from, -Eigen::Vector3d::UnitZ());
      const Eigen::Vector2d p = from.head<2>();
      EXPECT_NEAR(z,
                  find_sea(*world)->water().column(p, {0, 0}, world->time().seconds()).elevation_m,
                  0.01);
      farthest = std::max(farthest, std::abs(z));
    }
    EXPECT_NEAR(farthest, 0.3 * strength, 0.01);
  };
  world->step(1);
  compare(1.0);
  say(*world, "waves", "shore_depth: 12");  // six metres are half of it now: half the height
  world->step(1);
  compare(0.5);
  say(*world, "waves", "shore_depth: 4");
  world->step(1);
  compare(1.0);
}

TEST(LiveEnvironment, IsPartOfTheHash) {
  const auto hash = [](const char* section, const char* yaml) {
    TestWorld world(ocean({sea_with_wind()}));
    if (section != nullptr) say(*world, section, yaml);
    world->step(2);
    return world->state_hash();
  };
  const std::string plain = hash(nullptr, "");
  EXPECT_EQ(hash(nullptr, ""), plain);
  EXPECT_NE(hash("tide", "amplitude: 1"), plain);
  EXPECT_NE(hash("wind", "speed: 6.5"), plain);
  EXPECT_EQ(hash("wind", "speed: -6.5"), plain);
}

TEST(LiveEnvironment, ContinuesFromASnapshotAndRepeats) {
  TestWorld world(ocean({sea_with_wind()}));
  world.add(make_boat("wamv"));
  world->step(20);
  const Snapshot snapshot = world->save_snapshot();
  const auto run = [&] {
    world->step(10);
    say(*world, "waves", "{significant_height: 0.7, direction: 1}");
    say(*world, "wind", "speed: 9");
    world->step(100);
    return world->state_hash();
  };
  const std::string first = run();
  world->restore_snapshot(snapshot);
  EXPECT_TRUE(contains(find_sea(*world)->state_text(), "significant_height: 0.4\n"));
  EXPECT_EQ(run(), first);
}

TEST(LiveEnvironment, GustsContinueWhenTheWindChanges) {
  TestWorld world(ocean({sea_with_wind()}));
  world->step(500);
  const Eigen::Vector3d gust = find_air(*world)->wind({0, 0, 0}) - Eigen::Vector3d(6, 0, 0);
  say(*world, "wind", "speed: 6.0001");
  world->step();
  const Eigen::Vector3d next = find_air(*world)->wind({0, 0, 0}) - Eigen::Vector3d(6.0001, 0, 0);
  EXPECT_LT((next - gust).norm(), 0.2);
  EXPECT_GT(gust.norm(), 1e-3);
}

}  // namespace
}  // namespace trident::sim
