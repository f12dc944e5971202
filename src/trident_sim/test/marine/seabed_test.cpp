// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/environment/seabed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "boat_world.h"
#include "marine/plugins/live_surroundings.h"
#include "scratch_folder.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

/// 3 x 3 cells of 10 m, corner at (-15, -15): from -6 m in the west to +2 m in the east.
constexpr const char* kBeach =
    "ncols 3\nnrows 3\nxllcorner -15\nyllcorner -15\ncellsize 10\nNODATA_value -9999\n"
    "-6 -2 2\n-6 -2 2\n-6 -2 2\n";

BathymetryParams beach(const ScratchFolder& folder) {
  BathymetryParams params;
  params.kind = BathymetryKind::kFile;
  params.file = folder.write("beach.asc", kBeach);
  return params;
}

PluginSpec sea_over(const std::string& file, const ParamList& waves, const ParamList& current) {
  return make_sea(
      {{"waves", waves}, {"current", current}, {"bathymetry", {{"kind", "file"}, {"file", file}}}});
}

TEST(Seabed, IsLinearBetweenTheMiddlesOfCellsAndLevelBeyond) {
  const ScratchFolder folder;
  const Seabed ground({read_ascii_grid(beach(folder))});
  EXPECT_NEAR(ground.height_m({-10, 0}), -6.0, 1e-6);
  EXPECT_NEAR(ground.height_m({-5, 3}), -4.0, 1e-6);
  EXPECT_NEAR(ground.height_m({5, -7}), 0.0, 1e-6);
  EXPECT_NEAR(ground.height_m({500, 0}), 2.0, 1e-6);
  EXPECT_NEAR(ground.height_m({-500, 700}), -6.0, 1e-6);
  EXPECT_NEAR(ground.mean_depth_m(0.0), 4.0, 1e-6);
  EXPECT_NEAR(ground.mean_depth_m(-1.0), 3.0, 1e-6);
}

TEST(Seabed, RowsRunFromNorthToSouthAndDepthsDownwards) {
  const ScratchFolder folder;
  BathymetryParams params = beach(folder);
  params.file =
      folder.write("d.asc", "NCOLS 2 NROWS 2 XLLCENTER 0 YLLCENTER 0 CELLSIZE 1\n1 2\n3 4");
  params.positive = VerticalSense::kDown;
  params.offset = {100.0, 0.0, 0.5};
  const Seabed ground({read_ascii_grid(params)});
  EXPECT_NEAR(ground.depth_m({100, 1}), 0.5, 1e-6);
  EXPECT_NEAR(ground.depth_m({101, 0}), 3.5, 1e-6);
}

TEST(Seabed, StaysWithinItsValuesAndIsContinuous) {
  GroundGrid grid;
  grid.columns = 7;
  grid.rows = 5;
  grid.cell = {2.0, 3.0};
  grid.along = {std::cos(0.7), std::sin(0.7)};
  RandomStream random(1, "ground");
  for (std::uint64_t i = 0; i < 35; ++i) {
    grid.z_m.push_back(static_cast<float>(random.uniform(i, 0)));
  }
  const Seabed ground({grid});
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(40.0 * random.uniform(i, 1) - 20.0, 40.0 * random.uniform(i, 2) - 20.0);
    const double z = ground.height_m(p);
    ASSERT_TRUE(z >= 0.0 && z <= 1.0) << z;
    ASSERT_NEAR(ground.height_m(p + Eigen::Vector2d(1e-6, -1e-6)), z, 3e-6);
  }
}

TEST(Seabed, BadFilesAreOneClearError) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    BathymetryParams params = beach(folder);
    params.file = folder.write("bad.asc", text);
    return error_of([&] { read_ascii_grid(params); });
  };
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  EXPECT_TRUE(contains(refusal(head + "1 2\n3 x\n"), "line 7: row 2 column 2 is 'x'"));
  EXPECT_TRUE(contains(refusal(head + "1 2\n3 nan\n"), "a finite number"));
  EXPECT_TRUE(contains(refusal(head + "1 2\n3\n"), "ends before row 2 column 2"));
  EXPECT_TRUE(contains(refusal(head + "1 2\n3 4 5\n"), "'5' follows the last cell"));
  EXPECT_TRUE(contains(refusal(head + "nodata_value -9\n1 2\n3 -9\n"), "has no data (-9)"));
  EXPECT_TRUE(contains(refusal("nrows 2\ncellsize 1\n1 2"), "no ncols"));
  EXPECT_TRUE(contains(refusal("ncols 1\nnrows 2\n"), "ncols is 1, expected a whole number in [2"));
  EXPECT_TRUE(contains(refusal("ncols 2\nnrows 2\ncellsize -1\n"), "cellsize is -1"));
  EXPECT_TRUE(contains(refusal("ncols 2\nnrows 2\ncellsize 1\n1 2 3 4"), "neither xllcorner nor"));
  EXPECT_TRUE(contains(error_of([&] { TestWorld world(ocean({sea_over("no/such.asc", {}, {})})); }),
                       "<bathymetry> <file> is 'no/such.asc', expected a file"));
  EXPECT_TRUE(
      contains(error_of([&] {
                 TestWorld world(ocean({make_sea({{"bathymetry", {{"kind", "terrain"}}}})}));
               }),
               "expected a static model with the collision of a heightmap"));
  EXPECT_TRUE(contains(error_of([&] {
                         TestWorld world(ocean({make_sea({{"bathymetry", {{"kind", "file"}}}})}));
                       }),
                       "must name a file"));
}

TEST(Seabed, WavesAndCurrentFadeTowardsTheShore) {
  const ScratchFolder folder;
  const std::string file = beach(folder).file;
  TestWorld world(ocean({sea_over(
      file, {{"spectrum", "regular"}, {"amplitude", "0.2"}, {"period", "4"}, {"shore_depth", "4"}},
      {{"kind", "uniform"}, {"speed", "0.5"}})}));
  const auto sea = find_sea(*world);
  const auto highest = [&](double x) {
    double result = 0.0;
    for (double t = 0.0; t < 4.0; t += 0.05) {
      result = std::max(result, sea->water().column({x, 0}, {0, 0}, t).elevation_m);
    }
    return result;
  };
  const auto flow = [&](double x) { return sea->current().velocity({x, 0, 0}, 0.0).x(); };
  EXPECT_NEAR(highest(-10), 0.2, 1e-3);  // 6 m deep
  EXPECT_NEAR(highest(0), 0.1, 1e-3);    // 2 m deep: half of smoothstep
  EXPECT_EQ(highest(10), 0.0);
  EXPECT_EQ(flow(-10), 0.5);
  EXPECT_GT(flow(4), 0.0);
  EXPECT_LT(flow(4), 0.25);
  EXPECT_EQ(flow(10), 0.0);
  EXPECT_NEAR(sea->depth_m({-10, 0}, 0.0), 6.0, 1e-6);
}

/// Wave lengths are those of water as deep as it is in the mean, 4 m; fading begins at 2 Hs.
TEST(Seabed, GivesWavesTheirLengthAndShore) {
  const ScratchFolder folder;
  TestWorld world(ocean({sea_over(
      beach(folder).file, {{"spectrum", "regular"}, {"amplitude", "0.1"}, {"period", "6"}}, {})}));
  const Environment& sea = *dynamic_cast<const LiveSurroundings&>(*find_sea(*world)).environment;
  EXPECT_NEAR(sea.waves().components()[0].k, wave_number(2.0 * M_PI / 6.0, 4.0, 9.81), 1e-9);
  EXPECT_NEAR(sea.waves().params().shore_depth, 8.0 * 0.1 / std::sqrt(2.0), 1e-9);
}

TEST(VesselOnLand, IsRefusedWithNamePlaceAndDepths) {
  const ScratchFolder folder;
  TestWorld world(ocean({sea_over(beach(folder).file, {}, {})}));
  const auto put = [&](double x) {
    ModelSpec boat = make_boat("otter");
    boat.T_world_model = at(x, 3.0, 0.0);
    world.add(std::move(boat));
  };
  const std::string error = error_of([&] { put(10.0); });
  for (const char* part : {"model 'boat'", "vessel 'otter'", "x = ", "y = ", "is -2 m deep there",
                           "legal is >= 0.19512 m"}) {
    EXPECT_TRUE(contains(error, part));
  }
  // Its bow, 0.9 m ahead, would touch the ground: the water ends at x = 5.
  EXPECT_TRUE(contains(error_of([&] { put(4.0); }), "deep there"));
  put(-5.0);
  EXPECT_NE(world->find_model("boat"), nullptr);
}

TEST(VesselOnLand, OfTheWorldsFileIsRefusedAsTheSeaComes) {
  const ScratchFolder folder;
  WorldSpec spec = ocean({sea_over(beach(folder).file, {}, {})});
  ModelSpec boat = make_boat("wamv");
  boat.T_world_model = at(12.0, 0.0, 0.0);
  spec.models.push_back(boat);
  EXPECT_TRUE(contains(error_of([&] { TestWorld world(spec); }), "is -2 m deep there"));
}

/// A valley along y, as a picture of 3 x 2 pixels: 4 m high at x = -20 and 20, 0 at x = 0.
ModelSpec valley(const ScratchFolder& folder, double yaw) {
  ModelSpec spec;
  spec.name = "terrain";
  spec.is_static = true;
  spec.T_world_model = SE3::from_xyz_rpy({100.0, 0.0, -3.0}, 0.0, 0.0, yaw);
  spec.links.push_back(make_link("link", 1.0, Eigen::Vector3d::Ones()));
  const std::string file = folder.write("v.pgm", "P2 3 2 100\n100 0 100\n100 0 100\n");
  spec.links[0].collisions.push_back(make_collision(HeightmapShape{file, {40.0, 40.0, 4.0}}));
  return spec;
}

TEST(Terrain, IsTheGroundOfTheSeaAndStopsABoatThatDriftsAshore) {
  const ScratchFolder folder;
  WorldSpec spec = ocean({make_sea({{"bathymetry", {{"kind", "terrain"}}},
                                    {"current", {{"kind", "uniform"}, {"speed", "1"}}}})});
  spec.models.push_back(valley(folder, 0.0));
  TestWorld world(spec);
  const auto sea = find_sea(*world);
  EXPECT_NEAR(sea->depth_m({100, 5}, 0.0), 3.0, 1e-5);
  EXPECT_NEAR(sea->depth_m({110, -5}, 0.0), 1.0, 1e-5);
  EXPECT_NEAR(sea->depth_m({120, 0}, 0.0), -1.0, 1e-5);
  ModelSpec boat = make_boat("otter");
  boat.links[0].collisions.push_back(make_collision(BoxShape{{2.0, 1.0, 0.4}}));
  boat.T_world_model = at(108.0, 0.0, 0.0);
  const Model& model = world.add(boat);
  world->step(6000);
  // The shore is at x = 115; without ground the boat would be at 168.
  const Eigen::Vector3d p = model.T_world_model().p;
  EXPECT_GT(p.x(), 111.0);
  EXPECT_LT(p.x(), 115.5);
  EXPECT_LT(model.links[0]->v_world_at(p).norm(), 0.1);
}

TEST(Terrain, MayBeTurned) {
  const ScratchFolder folder;
  WorldSpec spec = ocean({make_sea({{"bathymetry", {{"kind", "terrain"}, {"model", "terrain"}}}})});
  spec.models.push_back(valley(folder, M_PI_2));
  TestWorld world(spec);
  const auto sea = find_sea(*world);
  EXPECT_NEAR(sea->depth_m({105, 0}, 0.0), 3.0, 1e-5);
  EXPECT_NEAR(sea->depth_m({100, 10}, 0.0), 1.0, 1e-5);
}

TEST(Tide, RaisesTheSeaAndWhatFloatsOnIt) {
  TestWorld world(ocean({make_sea({{"tide", {{"amplitude", "0.5"}, {"period", "400"}}}})}));
  const Model& boat = world.add(make_boat("otter"));
  world->step(10000);  // a quarter of a period
  EXPECT_NEAR(find_sea(*world)->water().column({0, 0}, {0, 0}, 100.0).elevation_m, 0.5, 1e-9);
  EXPECT_NEAR(boat.T_world_model().p.z(), 0.5, 0.01);
  const TideParams rising{0.0, 1.0, 0.0, 0.002};
  EXPECT_NEAR(rising.level_m(1000.0), 2.0, 1e-12);
}

}  // namespace
}  // namespace trident::sim
