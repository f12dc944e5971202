// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wind_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trident::sim {
namespace {

/// Of a cell's length: what rounding may cost a point on the border.
constexpr double kBorder = 1e-9;

/// Where a point lies along one axis: between the points `low` and `low` + 1 of the grid.
struct Place {
  std::size_t low;
  double weight;  ///< of `low` + 1
};

/// `coordinate`: counted in cells from the first point of the grid.
std::optional<Place> place_along(double coordinate, std::size_t points) {
  const double last = static_cast<double>(points - 1);
  if (!(coordinate >= -kBorder && coordinate <= last + kBorder)) return std::nullopt;
  const double low = std::clamp(std::floor(coordinate), 0.0, last - 1.0);
  return Place{static_cast<std::size_t>(low), coordinate - low};
}

/// Of a height, as a fraction of its column: within the column's outermost cells, or beyond them.
Place place_in_column(const std::vector<double>& factors, double fraction) {
  const auto above = std::upper_bound(factors.begin() + 1, factors.end() - 1, fraction);
  const auto low = static_cast<std::size_t>(above - factors.begin()) - 1;
  return {low, (fraction - factors[low]) / (factors[low + 1] - factors[low])};
}

Eigen::Vector3d blend(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double weight) {
  return low + weight * (high - low);
}

Eigen::Vector3d wind_in_column(const WindGrid& grid, std::size_t column, double fraction) {
  const Place z = place_in_column(grid.spacing_factors, fraction);
  return blend(grid.v_world[grid.point(column, z.low)], grid.v_world[grid.point(column, z.low + 1)],
               z.weight);
}

}  // namespace

std::optional<Eigen::Vector3d> wind_at(const WindGrid& grid, const Eigen::Vector3d& p_world) {
  const auto x = place_along((p_world.x() - grid.min_x_m) / grid.res_x_m, grid.n_x);
  const auto y = place_along((p_world.y() - grid.min_y_m) / grid.res_y_m, grid.n_y);
  if (!x || !y) return std::nullopt;
  const std::size_t columns[4] = {grid.column(x->low, y->low), grid.column(x->low + 1, y->low),
                                  grid.column(x->low, y->low + 1),
                                  grid.column(x->low + 1, y->low + 1)};
  double fractions[4];
  for (int i = 0; i < 4; ++i) {
    const double bottom = grid.bottom_z_m[columns[i]];
    fractions[i] = (p_world.z() - bottom) / (grid.top_z_m[columns[i]] - bottom);
  }
  const auto [lowest, highest] = std::minmax_element(std::begin(fractions), std::end(fractions));
  if (!(*highest >= 0.0 && *lowest <= 1.0)) return std::nullopt;
  Eigen::Vector3d along_z[4];
  for (int i = 0; i < 4; ++i) along_z[i] = wind_in_column(grid, columns[i], fractions[i]);
  return blend(blend(along_z[0], along_z[1], x->weight), blend(along_z[2], along_z[3], x->weight),
               y->weight);
}

}  // namespace trident::sim
