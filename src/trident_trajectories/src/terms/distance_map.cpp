// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/distance_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "trident_base/error.h"

namespace trident::trajectories {
namespace {

/// The cell along one axis that holds a coordinate, and how far into it.
struct Place {
  int cell;
  double part;     ///< 0 ... 1
  bool is_inside;  ///< else the border's value counts, without a slope
};

Place place(double cells, int nodes) {
  const double last = nodes - 1;
  const double held = cells > 0.0 ? std::min(cells, last) : 0.0;  // 0 of NaN, too
  const int cell = std::min(static_cast<int>(held), nodes - 2);
  return {cell, held - cell, held == cells};
}

bool has_legal_frame(const GridDistanceMap::Grid& grid) {
  return grid.spacing > 0.0 && std::isfinite(grid.spacing) && grid.origin.allFinite();
}

void check_grid(const GridDistanceMap::Grid& grid, std::size_t values) {
  if (!has_legal_frame(grid))
    throw Error("distance grid: spacing is " + std::to_string(grid.spacing) +
                "; legal are a finite origin and a spacing > 0");
  if (grid.nodes.x() < 2 || grid.nodes.y() < 2 || grid.nodes.z() < 1)
    throw Error("distance grid: nodes are too few; legal are >= 2 along x and y, >= 1 along z");
  const std::size_t wanted = static_cast<std::size_t>(grid.nodes.x()) * grid.nodes.y() *
                             static_cast<std::size_t>(grid.nodes.z());
  if (values != wanted)
    throw Error("distance grid: " + std::to_string(values) + " distances; legal are " +
                std::to_string(wanted));
}

template <class Distance>
GridDistanceMap fill(const GridDistanceMap::Grid& grid, Distance distance) {
  std::vector<double> values;
  for (int z = 0; z < grid.nodes.z(); ++z)
    for (int y = 0; y < grid.nodes.y(); ++y)
      for (int x = 0; x < grid.nodes.x(); ++x)
        values.push_back(distance(grid.origin + grid.spacing * Eigen::Vector3d(x, y, z)));
  return GridDistanceMap(grid, std::move(values));
}

}  // namespace

RoundObstacles::RoundObstacles(std::vector<RoundObstacle> obstacles)
    : obstacles_(std::move(obstacles)) {
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const RoundObstacle& round = obstacles_[i];
    if (!round.center.allFinite() || !(round.radius > 0.0) || !std::isfinite(round.radius))
      throw Error("obstacle " + std::to_string(i) + ": radius is " + std::to_string(round.radius) +
                  "; legal are a finite center and a radius > 0");
  }
}

double RoundObstacles::distance(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const {
  double best = std::numeric_limits<double>::infinity();
  gradient.setZero();
  for (const RoundObstacle& round : obstacles_) {
    Eigen::Vector3d away = p - round.center;
    if (round.is_cylinder) away.z() = 0.0;
    const double length = away.norm();
    if (length - round.radius >= best) continue;
    best = length - round.radius;
    gradient = length > 0.0 ? Eigen::Vector3d(away / length) : Eigen::Vector3d::UnitX();
  }
  return best;
}

GridDistanceMap::GridDistanceMap(const Grid& grid, std::vector<double> distances)
    : grid_(grid), distances_(std::move(distances)) {
  check_grid(grid_, distances_.size());
  for (const double value : distances_)
    if (std::isnan(value)) throw Error("distance grid: a distance is NaN; legal are numbers");
}

GridDistanceMap GridDistanceMap::sampled(const Grid& grid, const DistanceMap& map) {
  return fill(grid, [&](const Eigen::Vector3d& p) {
    Eigen::Vector3d gradient;
    return map.distance(p, gradient);
  });
}

GridDistanceMap GridDistanceMap::of_cloud(const Grid& grid,
                                          const std::vector<Eigen::Vector3d>& points) {
  const bool is_plane = grid.nodes.z() == 1;
  return fill(grid, [&](const Eigen::Vector3d& p) {
    double best = std::numeric_limits<double>::max();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d delta = point - p;
      best = std::min(best, is_plane ? delta.head<2>().squaredNorm() : delta.squaredNorm());
    }
    return std::sqrt(best);
  });
}

double GridDistanceMap::distance(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const {
  const Eigen::Vector3d cells = (p - grid_.origin) / grid_.spacing;
  const Place x = place(cells.x(), grid_.nodes.x()), y = place(cells.y(), grid_.nodes.y());
  const bool is_plane = grid_.nodes.z() == 1;
  const Place z = is_plane ? Place{0, 0.0, false} : place(cells.z(), grid_.nodes.z());
  const std::size_t row = grid_.nodes.x(), layer = row * grid_.nodes.y();
  const std::size_t first = z.cell * layer + y.cell * row + x.cell;
  Eigen::Vector4d values = Eigen::Vector4d::Zero();  // distance, then its slopes [per cell]
  for (int above = 0; above < (is_plane ? 1 : 2); ++above) {
    const double* d = &distances_[first + above * layer];
    const double near = d[0] + x.part * (d[1] - d[0]);
    const double far = d[row] + x.part * (d[row + 1] - d[row]);
    const double weight = above ? z.part : 1.0 - z.part;
    const double here = near + y.part * (far - near);
    const double along_x = (d[1] - d[0]) + y.part * ((d[row + 1] - d[row]) - (d[1] - d[0]));
    values += Eigen::Vector4d(weight * here, weight * along_x, weight * (far - near),
                              above ? here : -here);
  }
  gradient = {x.is_inside ? values[1] : 0.0, y.is_inside ? values[2] : 0.0,
              z.is_inside ? values[3] : 0.0};
  gradient /= grid_.spacing;
  return values[0];
}

}  // namespace trident::trajectories
