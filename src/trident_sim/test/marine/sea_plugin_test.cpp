// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "boat_world.h"
#include "marine/plugins/live_surroundings.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

std::string refusal(const PluginSpec& plugin) {
  return error_of([&] { TestWorld world(ocean({plugin})); });
}

const Environment& environment_of(TestWorld& world) {
  return *dynamic_cast<const LiveSurroundings&>(*find_sea(*world)).environment;
}

PluginSpec sea_of_file(const std::string& path) {
  return make_plugin("sea", "libtrident_sea.so", {{"environment", path}});
}

class ShippedEnvironment : public testing::TestWithParam<const char*> {};

TEST_P(ShippedEnvironment, IsASea) {
  TestWorld world(
      ocean({sea_of_file(std::string(TRIDENT_REPOSITORY) + "/config/environments/" + GetParam())}));
  EXPECT_NE(find_sea(*world), nullptr);
  EXPECT_TRUE(world.reports.empty());
}
INSTANTIATE_TEST_SUITE_P(All, ShippedEnvironment,
                         testing::Values("calm.yaml", "sea_state_2.yaml", "breeze.yaml"));

TEST(SeaPlugin, AWorldWithoutItHasNone) {
  TestWorld world(ocean());
  EXPECT_EQ(find_sea(*world), nullptr);
}

TEST(SeaPlugin, ElementsMeanWhatAFileSays) {
  const ScratchFolder folder;
  const std::string file = folder.write("env.yaml",
                                        "water_level: 0.7\n"
                                        "waves: {spectrum: jonswap, significant_height: 0.5, "
                                        "components: 20}\n"
                                        "current: {kind: vortex, speed: 0.4, center: [3, 4]}\n");
  PluginSpec elements = make_sea(
      {{"waves", {{"spectrum", "jonswap"}, {"significant_height", "0.5"}, {"components", "20"}}},
       {"current", {{"kind", "vortex"}, {"speed", "0.4"}, {"center", "[3, 4]"}}}});
  elements.params.children.push_back({"water_level", "0.7", {}, {}});
  TestWorld from_file(ocean({sea_of_file(file)})), from_elements(ocean({elements}));
  const Eigen::Vector2d p(1.5, -2.0);
  double highest = 0.0;
  for (const double time_s : {0.0, 1.0, 2.5}) {
    const double a = environment_of(from_file).waves().elevation_m(p, time_s);
    EXPECT_EQ(environment_of(from_elements).waves().elevation_m(p, time_s), a);
    highest = std::max(highest, std::abs(a - 0.7));
    const Eigen::Vector3d p3(p.x(), p.y(), 0.0);
    EXPECT_EQ(find_sea(*from_file)->current().velocity(p3, time_s),
              find_sea(*from_elements)->current().velocity(p3, time_s));
  }
  EXPECT_GT(highest, 0.01);
  EXPECT_LT(highest, 1.0);
}

TEST(SeaPlugin, WavesAreThoseOfTheWorldsSeed) {
  const PluginSpec sea = make_sea({{"waves", {{"spectrum", "jonswap"}, {"components", "20"}}}});
  const auto elevation = [&](std::uint64_t seed) {
    WorldOptions options;
    options.seed = seed;
    TestWorld world(ocean({sea}), options);
    return environment_of(world).waves().elevation_m({1.0, 2.0}, 3.0);
  };
  EXPECT_EQ(elevation(1), elevation(1));
  EXPECT_NE(elevation(1), elevation(2));
}

TEST(SeaPlugin, BadInputIsOneClearError) {
  const auto waves = [](const ParamList& elements) {
    return refusal(make_sea({{"waves", elements}}));
  };
  EXPECT_TRUE(contains(waves({{"spectrum", "tsunami"}}), "tsunami"));
  EXPECT_TRUE(contains(waves({{"spectrum", "tsunami"}}), "jonswap"));
  const std::string negative = waves({{"spectrum", "jonswap"}, {"significant_height", "-0.5"}});
  EXPECT_TRUE(contains(negative, "world 'default' plugin 'sea'"));
  EXPECT_TRUE(contains(negative, "significant_height"));
  EXPECT_TRUE(contains(negative, "-0.5"));
  EXPECT_TRUE(contains(waves({{"hight", "1"}}), "hight"));
  EXPECT_TRUE(contains(waves({{"spectrum", "none}, current: {kind: none"}}), "<waves> <spectrum>"));
  EXPECT_TRUE(contains(refusal(sea_of_file("no/such.yaml")),
                       "<environment> is 'no/such.yaml', expected a file"));
  EXPECT_TRUE(contains(refusal(make_sea({{"current", {{"kind", "file"}, {"file", "no.txt"}}}})),
                       "<current> <file> is 'no.txt', expected a file"));
  PluginSpec both = make_sea({{"waves", {{"spectrum", "none"}}}});
  both.params.children.push_back({"environment", "calm.yaml", {}, {}});
  EXPECT_TRUE(contains(refusal(both), "expected to stand alone"));
  EXPECT_TRUE(contains(error_of([] {
                         TestWorld world(ocean({make_sea({}), make_sea({})}));
                       }),
                       "the world has a sea already"));
}

}  // namespace
}  // namespace trident::sim
