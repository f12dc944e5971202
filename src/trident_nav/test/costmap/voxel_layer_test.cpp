// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/voxel_layer.h"

#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "costmap_fixture.h"

namespace trident::nav {
namespace {

/// 20 x 5 cells of 1 m under 10 voxels of 0.2 m; the sensor is at (0.5, 2.5).
class VoxelLayerTest : public ::testing::Test {
 protected:
  void make(const std::string& source, const std::string& layer = "") {
    layer_ = new_layer<VoxelLayer>("{footprint_clearing_enabled: false, " + layer +
                                       " sources: {cloud: {clearing: true, raytrace_range: 15, " +
                                       source + "}}}",
                                   true);
    layer_->resize(grid_of(20, 5));
  }
  void see(const std::vector<BeamEnd>& ends, const Eigen::Vector3d& origin = {0.5, 2.5, 0.5}) {
    Observation observation;
    observation.stamp_s = 1.0;
    for (BeamEnd end : ends) {
      end.p -= origin.cast<float>();
      observation.ends.push_back(end);
    }
    observation.groups.push_back({origin, 0, ends.size()});
    layer_->sources()[0].add(std::move(observation));
    BlockSet changed(20, 5);
    layer_->update({1.0, {}}, changed);
  }
  int cost(int x, int y = 2) {
    std::uint8_t value = kUnknownCost;
    layer_->combine(y, x, x + 1, &value);
    return value;
  }
  std::uint32_t column(int x, int y = 2) {
    return layer_->columns()[layer_->geometry_for_test().index({x, y})];
  }

  struct Layer : VoxelLayer {
    using VoxelLayer::VoxelLayer;
    const GridGeometry& geometry_for_test() const { return geometry(); }
  };
  template <class T>
  std::unique_ptr<Layer> new_layer(const std::string& yaml, bool is_unknown) {
    return std::make_unique<Layer>(layer_setup("layer", yaml, is_unknown));
  }
  std::unique_ptr<Layer> layer_;
};

TEST_F(VoxelLayerTest, ColumnsHaveTheBitsOfVoxelGrid) {
  make("obstacle_range: 10");
  EXPECT_EQ(column(8), 0x0000ffffU);
  see({{{4.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(column(4), 0x0004ffffU);  // marked at level 2, the others unknown
  EXPECT_EQ(column(2), 0x0000fffbU);  // free at level 2
  EXPECT_EQ(cost(4), 254);
  EXPECT_EQ(cost(2), 0);
  EXPECT_EQ(cost(8), 255);
}

TEST_F(VoxelLayerTest, ABeamAboveAnObstacleLeavesIt) {
  make("obstacle_range: 20");
  see({{{4.5F, 2.5F, 0.3F}, true}});
  see({{{9.5F, 2.5F, 1.5F}, true}}, {0.5, 2.5, 1.5});
  EXPECT_EQ(cost(4), 254);
  see({{{9.5F, 2.5F, 0.3F}, true}}, {0.5, 2.5, 0.3});
  EXPECT_EQ(cost(4), 0);
  EXPECT_EQ(cost(9), 254);
}

TEST_F(VoxelLayerTest, BeamsClearUpToTheVolumesTopWhereverTheyEnd) {
  make("obstacle_range: 20");
  see({{{4.5F, 2.5F, 0.9F}, true}});
  EXPECT_EQ(cost(4), 254);
  see({{{10.5F, 2.5F, 1.5F}, true}});  // passes (4.5, 0.9)
  EXPECT_EQ(cost(4), 0);
  see({{{4.5F, 2.5F, 0.9F}, true}});
  see({{{20.5F, 2.5F, 2.5F}, true}});  // too high to be marked
  EXPECT_EQ(cost(4), 0);
  EXPECT_EQ(cost(14), 0);
}

TEST_F(VoxelLayerTest, MarkThresholdCountsVoxels) {
  make("obstacle_range: 20", "mark_threshold: 1,");
  see({{{4.5F, 2.5F, 0.5F}, true}});
  EXPECT_NE(cost(4), 254);
  see({{{4.5F, 2.5F, 0.7F}, true}});
  EXPECT_EQ(cost(4), 254);
  see({{{9.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(cost(4), 0);
}

TEST_F(VoxelLayerTest, UnknownThresholdKeepsColumnsUnknown) {
  make("obstacle_range: 20", "unknown_threshold: 8,");
  see({{{9.5F, 2.5F, 0.5F}, true}});
  EXPECT_EQ(cost(4), 255);  // 9 of 10 voxels are unknown
  see({{{9.5F, 2.5F, 0.7F}, true}}, {0.5, 2.5, 0.7});
  EXPECT_EQ(cost(4), 0);
}

TEST_F(VoxelLayerTest, WhatIsTooLowButAnObstacleCountsAtTheLowestLevel) {
  make("obstacle_range: 20, min_obstacle_height: -1.0", "origin_z: 0.2,");
  see({{{4.5F, 2.5F, -0.5F}, true}});
  EXPECT_EQ(column(4) >> 16, 1U);
}

TEST_F(VoxelLayerTest, MarksOutliveObstacleRangeWhileTheyAreSeen) {
  make("obstacle_range: 5");
  see({{{4.5F, 2.5F, 0.5F}, true}});
  see({{{4.5F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(cost(4), 254);
  see({{{5.4F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(column(4) >> 16, 4U);
  see({{{9.5F, 2.5F, 0.5F}, true}}, {-3.5, 2.5, 0.5});
  EXPECT_EQ(cost(4), 0);
}

TEST_F(VoxelLayerTest, SteepBeamsClearEveryLevelTheyPass) {
  make("obstacle_range: 20");
  see({{{2.5F, 2.5F, 1.9F}, false}}, {0.5, 2.5, 0.1});
  // 0.9 m up per cell, half of that in the first and the last.
  EXPECT_EQ(column(0) & 0xffffU, 0xffffU & ~0x7U);
  EXPECT_EQ(column(1) & 0xffffU, 0xffffU & ~0xfcU);
  EXPECT_EQ(column(2) & 0xffffU, 0xffffU & ~0x380U);
  see({{{0.5F, 2.5F, 0.1F}, true}}, {0.5, 2.5, 1.9});
  EXPECT_EQ(cost(0), 254);
}

TEST_F(VoxelLayerTest, ManyBeamsFreeNearlyAllThatTheyWouldOneByOne) {
  // Beams of a crowd are cast once per voxel that they end in.
  TestRandom random(2);
  std::vector<BeamEnd> ends;
  for (int i = 0; i < 3000; ++i) {
    const auto x = static_cast<float>(random.uniform(1.0, 30.0));
    const auto y = static_cast<float>(random.uniform(-3.0, 8.0));
    ends.push_back({{x, y, static_cast<float>(random.uniform(0.0, 4.0))}, i % 3 != 0});
  }
  make("obstacle_range: 20");
  see(ends);
  const std::vector<std::uint32_t> together = layer_->columns();
  make("obstacle_range: 20, observation_persistence: 1.0");
  for (std::size_t i = 0; i < ends.size(); i += 500) {
    Observation observation;
    observation.stamp_s = 1.0;
    const Eigen::Vector3d origin(0.5, 2.5, 0.5);
    for (std::size_t k = i; k < i + 500; ++k) {
      BeamEnd end = ends[k];
      end.p -= origin.cast<float>();
      observation.ends.push_back(end);
    }
    observation.groups.push_back({origin, 0, 500});
    layer_->sources()[0].add(std::move(observation));
  }
  BlockSet changed(20, 5);
  layer_->update({1.0, {}}, changed);
  int different = 0;
  for (std::size_t i = 0; i < together.size(); ++i) {
    EXPECT_EQ(together[i] >> 16, layer_->columns()[i] >> 16);
    EXPECT_EQ(layer_->columns()[i] & ~together[i], 0U);  // what is free once is free
    different += __builtin_popcount(together[i] ^ layer_->columns()[i]);
  }
  EXPECT_LE(different, 20);  // of 1000 voxels
}

TEST_F(VoxelLayerTest, ForgettingAndTheFootprintChangeColumns) {
  make("obstacle_range: 20");
  see({{{4.5F, 2.5F, 0.5F}, true}, {{6.5F, 2.5F, 0.5F}, true}});
  BeamLayerParams params = layer_->beam_params();
  params.footprint_clearing_enabled = true;
  layer_->set_beam_params(params);
  layer_->set_footprint({{}, 0.3, 0.3});
  BlockSet changed(20, 5);
  layer_->update({1.0, {4.5, 2.5, 0.0}}, changed);
  EXPECT_EQ(column(4), 0U);
  EXPECT_EQ(cost(4), 0);
  layer_->forget({6, 2, 7, 3}, nav::Layer::Side::kInside);
  EXPECT_EQ(column(6), 0x0000ffffU);
  EXPECT_EQ(cost(6), 255);
}

}  // namespace
}  // namespace trident::nav
