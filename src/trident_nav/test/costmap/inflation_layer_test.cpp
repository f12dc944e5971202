// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/inflation_layer.h"

#include <cmath>
#include <string>
#include <vector>

#include "costmap_fixture.h"

namespace trident::nav {
namespace {

using Plane = std::vector<std::uint8_t>;

Plane inflate(InflationLayer& layer, const GridGeometry& grid, const Plane& below,
              double inscribed) {
  Footprint footprint;
  footprint.inscribed_radius = inscribed;
  layer.set_footprint(footprint);
  layer.resize(grid);
  Plane above(below.size(), 1);
  BlockSet changed(grid.width, grid.height);
  layer.update({}, changed);
  layer.process(below.data(), above.data(), changed);
  return above;
}

/// The formula of costmap_2d, cell by cell.
std::uint8_t expected(const Plane& below, const GridGeometry& grid, Cell at,
                      const InflationLayerParams& params, double inscribed) {
  const std::uint8_t old = below[grid.index(at)];
  const int square = nearest_square(below, grid, at);
  double cost = 0.0;
  const double d = std::sqrt(square) * grid.resolution;
  if (square == 0) {
    cost = 254;
  } else if (square > 0 && d <= params.inflation_radius + 1e-9) {
    cost = d <= inscribed
               ? 253
               : std::floor(252.0 * std::exp(-params.cost_scaling_factor * (d - inscribed)));
  }
  if (old == kUnknownCost) {
    const bool replaces = params.inflate_unknown ? cost > 0 : cost >= 253;
    return replaces ? static_cast<std::uint8_t>(cost) : kUnknownCost;
  }
  return std::max(old, static_cast<std::uint8_t>(cost));
}

TEST(InflationLayerTest, OneObstacleGivesTheRingsOfTheFormula) {
  // d = 1: 253 (inscribed 1.0), sqrt 2: 252 exp(-0.4142) = 166, 2: 252 exp(-1) = 92, sqrt 5: 73,
  // sqrt 8: 40, 3: 34; sqrt 10 lies beyond the radius.
  auto layer = new_layer<InflationLayer>("{inflation_radius: 3.0, cost_scaling_factor: 1.0}");
  const GridGeometry grid = grid_of(5, 1);
  EXPECT_EQ(inflate(*layer, grid, {254, 0, 0, 0, 0}, 1.0), (Plane{254, 253, 92, 34, 0}));
  const GridGeometry square = grid_of(4, 4);
  Plane corner(16, 0);
  corner[0] = 254;
  EXPECT_EQ(inflate(*layer, square, corner, 1.0), (Plane{254, 253, 92, 34,  //
                                                         253, 166, 73, 0,   //
                                                         92, 73, 40, 0,     //
                                                         34, 0, 0, 0}));
}

TEST(InflationLayerTest, CostsAtTheEdgesOfTheRadii) {
  auto layer = new_layer<InflationLayer>("{inflation_radius: 0.15, cost_scaling_factor: 0.0}");
  const GridGeometry grid = grid_of(6, 1, 0.05);
  // 253 up to and with the inscribed radius, 252 from there to and with the inflation radius.
  EXPECT_EQ(inflate(*layer, grid, {254, 0, 0, 0, 0, 0}, 0.1), (Plane{254, 253, 253, 252, 0, 0}));
  EXPECT_EQ(inflate(*layer, grid, {254, 0, 0, 0, 0, 0}, 0.0999), (Plane{254, 253, 252, 252, 0, 0}));
}

TEST(InflationLayerTest, UnknownCellsKeepUnknownBelow253) {
  const GridGeometry grid = grid_of(5, 1);
  const Plane below{254, 255, 255, 255, 255};
  const std::string params = "inflation_radius: 2.0, cost_scaling_factor: 1.0";
  auto layer = new_layer<InflationLayer>("{" + params + "}");
  EXPECT_EQ(inflate(*layer, grid, below, 1.0), (Plane{254, 253, 255, 255, 255}));
  auto unknown = new_layer<InflationLayer>("{" + params + ", inflate_unknown: true}");
  EXPECT_EQ(inflate(*unknown, grid, below, 1.0), (Plane{254, 253, 92, 255, 255}));
  auto around = new_layer<InflationLayer>("{" + params + ", inflate_around_unknown: true}");
  EXPECT_EQ(inflate(*around, grid, {0, 0, 0, 255, 0}, 1.0), (Plane{0, 92, 253, 254, 253}));
  EXPECT_EQ(around->distance_m(), nullptr);
}

TEST(InflationLayerTest, HigherCostsStay) {
  auto layer = new_layer<InflationLayer>("{inflation_radius: 2.0, cost_scaling_factor: 1.0}");
  EXPECT_EQ(inflate(*layer, grid_of(4, 1), {254, 200, 200, 7}, 1.0), (Plane{254, 253, 200, 7}));
}

TEST(InflationLayerTest, ChangesGiveWhatAComputationFromNothingGives) {
  const GridGeometry grid = grid_of(41, 35, 0.05);
  auto layer = new_layer<InflationLayer>("{inflation_radius: 0.4, cost_scaling_factor: 5.0}");
  const double inscribed = 0.17;
  TestRandom random(3);
  Plane below(grid.size(), 0);
  Plane above = inflate(*layer, grid, below, inscribed);
  for (int round = 0; round < 25; ++round) {
    BlockSet changed(grid.width, grid.height);
    for (int k = 0; k < 3 + round; ++k) {
      const Cell cell{static_cast<int>(random.uniform() * grid.width),
                      static_cast<int>(random.uniform() * grid.height)};
      const std::uint8_t costs[] = {0, 0, 255, 254, 100};
      below[grid.index(cell)] = costs[static_cast<int>(random.uniform() * 5)];
      changed.insert(cell.x, cell.y);
    }
    const Plane before = above;
    layer->process(below.data(), above.data(), changed);
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const std::size_t i = grid.index({x, y});
        ASSERT_EQ(above[i], expected(below, grid, {x, y}, layer->params(), inscribed))
            << x << ' ' << y << " in round " << round;
        ASSERT_TRUE(above[i] == before[i] || changed.contains(x, y));
      }
    }
  }
}

}  // namespace
}  // namespace trident::nav
