// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/denoise_layer.h"

#include <queue>
#include <string>
#include <vector>

#include "costmap_fixture.h"
#include "trident_base/error.h"

namespace trident::nav {
namespace {

using Plane = std::vector<std::uint8_t>;

/// Every group by a search from each of its cells.
Plane expected(const Plane& below, const GridGeometry& grid, const DenoiseLayerParams& params) {
  Plane above = below;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (below[grid.index({x, y})] != kLethalCost) continue;
      std::vector<bool> seen(grid.size());
      std::queue<Cell> open;
      int size = 0;
      open.push({x, y});
      seen[grid.index({x, y})] = true;
      while (!open.empty()) {
        const Cell at = open.front();
        open.pop();
        ++size;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const Cell next{at.x + dx, at.y + dy};
            if (params.group_connectivity_type == 4 && dx != 0 && dy != 0) continue;
            if (!grid.contains(next) || seen[grid.index(next)]) continue;
            if (below[grid.index(next)] != kLethalCost) continue;
            seen[grid.index(next)] = true;
            open.push(next);
          }
        }
      }
      if (size < params.minimal_group_size) above[grid.index({x, y})] = kFreeCost;
    }
  }
  return above;
}

class DenoiseLayerTest : public ::testing::TestWithParam<std::string> {};

TEST_P(DenoiseLayerTest, ChangesGiveTheGroupsOfTheWholeGrid) {
  const GridGeometry grid = grid_of(40, 15);
  auto layer = new_layer<DenoiseLayer>(GetParam());
  layer->resize(grid);
  BlockSet changed(grid.width, grid.height);
  layer->update({}, changed);
  Plane below(grid.size(), 0), above(grid.size(), 1);
  layer->process(below.data(), above.data(), changed);
  TestRandom random(9);
  for (int round = 0; round < 40; ++round) {
    changed.clear();
    for (int k = 0; k < 12; ++k) {
      const Cell cell{random.below(grid.width), random.below(grid.height)};
      const std::uint8_t costs[] = {254, 254, 0, 255, 253};
      below[grid.index(cell)] = costs[random.below(5)];
      changed.insert(cell.x, cell.y);
    }
    const Plane before = above;
    layer->process(below.data(), above.data(), changed);
    ASSERT_EQ(above, expected(below, grid, layer->params())) << round;
    for (int x = 0; x < grid.width; ++x) {
      for (int y = 0; y < grid.height; ++y) {
        const std::size_t i = grid.index({x, y});
        ASSERT_TRUE(above[i] == before[i] || changed.contains(x, y));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DenoiseLayerTest,
                         ::testing::Values("{minimal_group_size: 0}", "{minimal_group_size: 1}",
                                           "{minimal_group_size: 2}",
                                           "{minimal_group_size: 2, group_connectivity_type: 4}",
                                           "{minimal_group_size: 5}",
                                           "{minimal_group_size: 5, group_connectivity_type: 4}"));

TEST(DenoiseLayerParamsTest, OtherConnectivitiesAreRefused) {
  EXPECT_THROW(new_layer<DenoiseLayer>("{group_connectivity_type: 6}"), Error);
}

}  // namespace
}  // namespace trident::nav
