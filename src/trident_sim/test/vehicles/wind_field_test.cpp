// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/environment/wind_field.h"

#include <gtest/gtest.h>

#include <functional>

#include "test_world.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

using Wind = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Eigen::Vector3d point_of(const WindGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
  const std::size_t column = grid.column(i, j);
  const double bottom = grid.bottom_z_m[column], top = grid.top_z_m[column];
  return {grid.min_x_m + static_cast<double>(i) * grid.res_x_m,
          grid.min_y_m + static_cast<double>(j) * grid.res_y_m,
          bottom + grid.spacing_factors[k] * (top - bottom)};
}

void for_each_point(const WindGrid& grid,
                    const std::function<void(std::size_t, std::size_t, std::size_t)>& visit) {
  for (std::size_t k = 0; k < grid.n_z(); ++k) {
    for (std::size_t j = 0; j < grid.n_y; ++j) {
      for (std::size_t i = 0; i < grid.n_x; ++i) visit(i, j, k);
    }
  }
}

void fill(WindGrid& grid, const Wind& wind) {
  grid.v_world.clear();
  for_each_point(grid, [&](std::size_t i, std::size_t j, std::size_t k) {
    grid.v_world.push_back(wind(point_of(grid, i, j, k)));
  });
}

/// 4 x 3 columns over x in [-2, 2.5], y in [10, 14]; bottoms in [-1, 1), tops in [5, 7).
WindGrid hilly_grid(const RandomStream& random) {
  WindGrid grid;
  grid.min_x_m = -2.0, grid.min_y_m = 10.0;
  grid.res_x_m = 1.5, grid.res_y_m = 2.0;
  grid.n_x = 4, grid.n_y = 3;
  grid.spacing_factors = {0.0, 0.1, 0.35, 1.0};
  for (std::size_t i = 0; i < grid.n_x * grid.n_y; ++i) {
    grid.bottom_z_m.push_back(2.0 * random.uniform(i, 0) - 1.0);
    grid.top_z_m.push_back(2.0 * random.uniform(i, 1) + 5.0);
  }
  return grid;
}
WindGrid flat_grid() {
  WindGrid grid = hilly_grid(RandomStream(1, "flat"));
  grid.bottom_z_m.assign(12, 1.0);
  grid.top_z_m.assign(12, 6.0);
  return grid;
}

/// A point between the lowest and the highest z that all columns of hilly_grid() hold.
Eigen::Vector3d point_within(const RandomStream& random, std::uint64_t sample) {
  return {-2.0 + 4.5 * random.uniform(sample, 0), 10.0 + 4.0 * random.uniform(sample, 1),
          1.0 + 4.0 * random.uniform(sample, 2)};
}

Eigen::Vector3d linear_wind(const Eigen::Vector3d& p) {
  return {1.0 + 0.5 * p.x() - 2.0 * p.y() + 0.25 * p.z(), -3.0 + p.x() + 0.1 * p.y() - p.z(),
          0.7 * p.z()};
}

/// Componentwise bounds of the eight winds that surround a point within the columns around it.
struct Bounds {
  Eigen::Vector3d least = Eigen::Vector3d::Constant(1e9), most = -least;

  void add_column(const WindGrid& grid, std::size_t i, std::size_t j, double z) {
    for (std::size_t k = 0; k + 1 < grid.n_z(); ++k) {
      if (z < point_of(grid, i, j, k).z() || z > point_of(grid, i, j, k + 1).z()) continue;
      for (const std::size_t end : {k, k + 1}) {
        const Eigen::Vector3d& wind = grid.v_world[grid.point(grid.column(i, j), end)];
        least = least.cwiseMin(wind), most = most.cwiseMax(wind);
      }
    }
  }
};
Bounds bounds_at(const WindGrid& grid, const Eigen::Vector3d& p) {
  const auto i = static_cast<std::size_t>((p.x() - grid.min_x_m) / grid.res_x_m);
  const auto j = static_cast<std::size_t>((p.y() - grid.min_y_m) / grid.res_y_m);
  Bounds bounds;
  for (const std::size_t di : {0, 1}) {
    for (const std::size_t dj : {0, 1}) bounds.add_column(grid, i + di, j + dj, p.z());
  }
  return bounds;
}

/// A different wind at every point.
Wind gusty_wind(const RandomStream& random) {
  return [&random, point = std::uint64_t{0}](const Eigen::Vector3d&) mutable {
    ++point;
    return Eigen::Vector3d(random.normal(point, 0), random.normal(point, 1),
                           random.normal(point, 2));
  };
}

class OverRandomTerrain : public testing::TestWithParam<std::uint64_t> {
 protected:
  OverRandomTerrain() : random(GetParam(), "wind field"), grid(hilly_grid(random)) {}
  RandomStream random;
  WindGrid grid;
};

TEST_P(OverRandomTerrain, ALinearFieldIsExact) {
  fill(grid, linear_wind);
  for (std::uint64_t sample = 0; sample < 500; ++sample) {
    const Eigen::Vector3d p = point_within(random, sample);
    const auto wind = wind_at(grid, p);
    ASSERT_TRUE(wind) << p.transpose();
    EXPECT_TRUE(is_near(*wind, linear_wind(p), 1e-12)) << p.transpose();
  }
}

TEST_P(OverRandomTerrain, AColumnThatThePointIsBelowOrAboveIsContinued) {
  fill(grid, linear_wind);
  int beyond = 0;
  for (std::uint64_t sample = 0; sample < 500; ++sample) {
    Eigen::Vector3d p = point_within(random, sample);
    p.z() = -1.0 + 8.0 * random.uniform(sample, 3);
    const auto wind = wind_at(grid, p);
    if (!wind) continue;
    if (p.z() < 1.0 || p.z() > 5.0) ++beyond;
    EXPECT_TRUE(is_near(*wind, linear_wind(p), 1e-12)) << p.transpose();
  }
  EXPECT_GT(beyond, 100);
}

TEST_P(OverRandomTerrain, EveryPointOfTheGridKeepsItsWind) {
  fill(grid, gusty_wind(random));
  for_each_point(grid, [&](std::size_t i, std::size_t j, std::size_t k) {
    const auto wind = wind_at(grid, point_of(grid, i, j, k));
    ASSERT_TRUE(wind) << i << " " << j << " " << k;
    EXPECT_TRUE(is_near(*wind, grid.v_world[grid.point(grid.column(i, j), k)], 1e-12));
  });
}

TEST_P(OverRandomTerrain, TheWindStaysBetweenThoseOfTheColumnsAround) {
  fill(grid, gusty_wind(random));
  for (std::uint64_t sample = 0; sample < 500; ++sample) {
    const Eigen::Vector3d p = point_within(random, sample);
    const Bounds bounds = bounds_at(grid, p);
    const auto wind = wind_at(grid, p);
    ASSERT_TRUE(wind) << p.transpose();
    EXPECT_TRUE(((*wind - bounds.least).array() >= -1e-12).all()) << p.transpose();
    EXPECT_TRUE(((bounds.most - *wind).array() >= -1e-12).all()) << p.transpose();
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, OverRandomTerrain,
                         testing::Range(std::uint64_t{0}, std::uint64_t{8}));

TEST(WindField, AFieldThatIsLinearAlongEachAxisIsExactInACell) {
  WindGrid grid = flat_grid();
  grid.n_x = grid.n_y = 2;
  grid.bottom_z_m.resize(4), grid.top_z_m.resize(4);
  grid.spacing_factors = {0.0, 1.0};
  const auto product = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() * p.y() * p.z(), p.x() * p.y(), p.y() * p.z());
  };
  fill(grid, product);
  const RandomStream random(3, "cell");
  for (std::uint64_t sample = 0; sample < 200; ++sample) {
    const Eigen::Vector3d p(-2.0 + 1.5 * random.uniform(sample, 0),
                            10.0 + 2.0 * random.uniform(sample, 1),
                            1.0 + 5.0 * random.uniform(sample, 2));
    const auto wind = wind_at(grid, p);
    ASSERT_TRUE(wind) << p.transpose();
    EXPECT_TRUE(is_near(*wind, product(p), 1e-11)) << p.transpose();
  }
}

TEST(WindField, BordersBelongToItAndBeyondThereIsNone) {
  WindGrid grid = flat_grid();
  fill(grid, linear_wind);
  for (const double x : {-2.0, 0.0, 2.5}) {
    for (const double y : {10.0, 11.0, 14.0}) {
      for (const double z : {1.0, 3.0, 6.0}) {
        const auto wind = wind_at(grid, {x, y, z});
        ASSERT_TRUE(wind) << x << " " << y << " " << z;
        EXPECT_TRUE(is_near(*wind, linear_wind({x, y, z}), 1e-12));
      }
    }
  }
  for (const double below : {1e-6, 1.0, 1e6}) {
    EXPECT_FALSE(wind_at(grid, {-2.0 - below, 12, 3}));
    EXPECT_FALSE(wind_at(grid, {2.5 + below, 12, 3}));
    EXPECT_FALSE(wind_at(grid, {0, 10.0 - below, 3}));
    EXPECT_FALSE(wind_at(grid, {0, 14.0 + below, 3}));
    EXPECT_FALSE(wind_at(grid, {0, 12, 1.0 - below}));
    EXPECT_FALSE(wind_at(grid, {0, 12, 6.0 + below}));
  }
}

TEST(WindField, ResolutionsThatAreNoBinaryFractionReachTheirBorder) {
  WindGrid grid = flat_grid();
  for (std::size_t n = 2; n < 200; ++n) {
    grid.n_x = n, grid.n_y = 2, grid.res_x_m = 0.1, grid.min_x_m = 0.3;
    grid.bottom_z_m.assign(2 * n, 1.0), grid.top_z_m.assign(2 * n, 6.0);
    fill(grid, [](const Eigen::Vector3d&) { return Eigen::Vector3d(1, 2, 3); });
    const double border = 0.3 + 0.1 * static_cast<double>(n - 1);
    ASSERT_TRUE(wind_at(grid, {border, 10, 3})) << n;
    ASSERT_FALSE(wind_at(grid, {border + 1e-6, 10, 3})) << n;
  }
}

TEST(WindField, SpacingThatDoesNotFillTheColumnIsContinuedToItsEnds) {
  WindGrid grid = flat_grid();
  grid.spacing_factors = {0.2, 0.5, 0.9};
  fill(grid, linear_wind);
  for (const double z : {1.0, 1.5, 3.0, 5.8, 6.0}) {
    const auto wind = wind_at(grid, {0.1, 12.3, z});
    ASSERT_TRUE(wind) << z;
    EXPECT_TRUE(is_near(*wind, linear_wind({0.1, 12.3, z}), 1e-12)) << z;
  }
}

}  // namespace
}  // namespace trident::sim
