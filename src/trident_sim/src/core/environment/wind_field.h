// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trident::sim {

/// A static wind field on a grid that follows the terrain, as RotorS' wind plugin takes it. Column
/// (i, j) stands at x = min_x + i res_x, y = min_y + j res_y and reaches from its bottom_z to its
/// top_z; its n_z points lie at the fractions `spacing_factors` of that height.
struct WindGrid {
  double min_x_m = 0.0, min_y_m = 0.0;
  double res_x_m = 1.0, res_y_m = 1.0;   ///< > 0
  std::size_t n_x = 0, n_y = 0;          ///< >= 2
  std::vector<double> spacing_factors;   ///< (n_z) >= 2 of them, rising, in [0, 1]
  std::vector<double> bottom_z_m;        ///< (n_x n_y), x runs fastest
  std::vector<double> top_z_m;           ///< (n_x n_y), above bottom_z_m
  std::vector<Eigen::Vector3d> v_world;  ///< (n_x n_y n_z) [m/s], x runs fastest, then y, then z

  std::size_t n_z() const { return spacing_factors.size(); }
  std::size_t column(std::size_t i, std::size_t j) const { return i + j * n_x; }
  std::size_t point(std::size_t column, std::size_t k) const { return column + k * n_x * n_y; }
};

/// Wind at a point [m/s, world frame]: linear along z in the four columns around it, then along x,
/// then along y. A column that the point lies below or above is continued along its outermost cell,
/// so that the wind does not jump where the terrain rises. Nothing outside of the grid, whose
/// borders belong to it: next to it, below the bottom of all four columns, or above all their tops.
std::optional<Eigen::Vector3d> wind_at(const WindGrid& grid, const Eigen::Vector3d& p_world);

/// Reads RotorS' text format: the fields min_x min_y n_x n_y res_x res_y vertical_spacing_factors
/// bottom_z top_z u v w in any order, each its name with a colon and then its numbers, all
/// separated by blanks or line ends. Throws Error naming file, line, field, value and legal range.
WindGrid read_wind_grid(const std::string& file);

}  // namespace trident::sim
