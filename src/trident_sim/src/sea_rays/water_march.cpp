// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How a ray finds the water: through squares of cells whose bounds it may intersect, down to the
// cell whose surface it hits, where that is the root of a quadratic.
#include <algorithm>
#include <cmath>

#include "water_surface.h"

namespace trident::sim {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// The distances between which a ray is between two heights.
struct Interval {
  double first, last;
};
Interval between_heights(double z, double dz, double low, double high, double t_min, double t_max) {
  if (dz == 0.0) return z >= low && z <= high ? Interval{t_min, t_max} : Interval{t_max, t_min};
  const double a = (low - z) / dz, b = (high - z) / dz;
  return {std::max(t_min, std::min(a, b)), std::min(t_max, std::max(a, b))};
}

/// First root in [0, last] of a t^2 + b t + c, where c > 0.
double first_root(double a, double b, double c, double last) {
  // Most often it is positive at the end, too, and does not dip below zero before.
  const bool ends_above = (a * last + b) * last + c > 0.0;
  if (ends_above && (a <= 0.0 || b >= 0.0 || -b >= 2.0 * a * last)) return kNowhere;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return kNowhere;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  // b < 0: both roots are positive, c / q the smaller, or one is. b >= 0: it takes a < 0.
  const double root = b < 0.0 ? c / q : (a < 0.0 ? q / a : kNowhere);
  return root <= last ? root : kNowhere;
}

}  // namespace

WaterSurface::Path WaterSurface::path_of(const Ray& ray) const {
  const WaterPattern& pattern = *pattern_;
  const Eigen::Vector3d &p = ray.p_world_origin, &d = ray.direction_world;
  Path path{};
  path.u = pattern.axis.dot(p.head<2>()) / pattern.cell_m;
  path.v = pattern.across.dot(p.head<2>()) / pattern.cell_m;
  path.z = p.z() - level_m_;
  path.du = pattern.axis.dot(d.head<2>()) / pattern.cell_m;
  path.dv = pattern.across.dot(d.head<2>()) / pattern.cell_m;
  path.dz = d.z();
  path.per_du = 1.0 / path.du;
  path.per_dv = 1.0 / path.dv;
  return path;
}

WaterReach WaterSurface::reach(const Ray& ray) const {
  const double z = ray.p_world_origin.z() - level_m_, sinking = -ray.direction_world.z();
  if (!(sinking > 0.0)) return {kNowhere, kNowhere};
  return {(z - high_m_) / sinking, (z - low_m_) / sinking};
}

double WaterSurface::cos_most(const Ray& ray, double steepest) {
  const double sinking = -ray.direction_world.z();
  const double level = std::sqrt(std::max(1.0 - sinking * sinking, 0.0));
  if (steepest * sinking >= level) return 1.0;
  return (sinking + steepest * level) / std::sqrt(1.0 + steepest * steepest);
}

/// Whether a ray reaches the water above one or two squares that the ground leaves alone.
bool WaterSurface::is_open_between(const Ray& ray, const WaterReach& reach) const {
  if (!fades_ || tile_ == nullptr) return true;
  const double t0 = reach.first, t1 = reach.last;
  const double per_m = 1.0 / (pattern_->cell_m * static_cast<double>(WaterShores::kCells));
  const Eigen::Vector2d p = per_m * ray.p_world_origin.head<2>();
  const Eigen::Vector2d d = per_m * ray.direction_world.head<2>();
  const double u = pattern_->axis.dot(p), v = pattern_->across.dot(p);
  const double du = pattern_->axis.dot(d), dv = pattern_->across.dot(d);
  const std::int64_t row0 = floor_of(u + t0 * du), row1 = floor_of(u + t1 * du);
  const std::int64_t column0 = floor_of(v + t0 * dv), column1 = floor_of(v + t1 * dv);
  return std::abs(row0 - row1) + std::abs(column0 - column1) <= 1 &&
         shores_->of_square(row0, column0) == WaveField::Shore::kOpen &&
         shores_->of_square(row1, column1) == WaveField::Shore::kOpen;
}

WaterHit WaterSurface::find_hit(const Ray& ray, double t_max) const {
  WaterHit hit;
  const double t_min = ray.t_min_m;
  const double z = ray.p_world_origin.z() - level_m_, dz = ray.direction_world.z();
  const double begin_z = z + t_min * dz;
  // First the rays that cannot hit: they begin above
  // or below all waves and lead away, or end before.
  double plane_from = t_min;
  if (tile_ == nullptr || begin_z > high_m_ || begin_z < low_m_) {
    hit.begins_below = begin_z < (tile_ == nullptr ? 0.0 : low_m_);
    const double end_z = hit.begins_below ? low_m_ : high_m_;
    // The commonest of all: it leads away.
    if (hit.begins_below ? dz <= 0.0 : dz >= 0.0) return hit;
    if ((end_z - z) / dz > t_max) return hit;
  }
  if (tile_ != nullptr) {
    Path path = path_of(ray);
    if (begin_z <= high_m_ && begin_z >= low_m_) {
      hit.begins_below = begin_z < cell_height(path.u + t_min * path.du, path.v + t_min * path.dv);
    }
    // The sign makes the height above the surface positive on the side that the ray begins on.
    path.side = hit.begins_below ? -1.0 : 1.0;
    path.fades = fades_;
    const double t_far = far_m_ / std::max(ray.direction_world.head<2>().norm(), 1e-300);
    const Interval interval =
        between_heights(z, dz, low_m_, high_m_, t_min, std::min(t_max, t_far));
    if (interval.first <= interval.last) {
      const Found found = walk<WaterTile::kBoundSides.size()>(path, interval.first, interval.last);
      if (found.is_hit()) {
        hit.t = found.t;
        hit.slope =
            (found.along * pattern_->axis + found.across * pattern_->across) / pattern_->cell_m;
        return hit;
      }
    }
    if (t_far >= t_max) return hit;
    plane_from = std::max(t_min, t_far);
  }
  // Beyond the waves that are drawn the water is a plane.
  const bool leads_there = hit.begins_below ? dz > 0.0 : dz < 0.0;
  if (!leads_there) return hit;
  const double t = std::max(-z / dz, plane_from);
  if (t > t_max) return hit;
  hit.t = t;
  hit.is_far = tile_ != nullptr;
  return hit;
}

/// The first hit within [t0, t1], which lies in squares of a level: 0 are cells, above them
/// those that have bounds.
template <std::size_t kLevel>
WaterSurface::Found WaterSurface::walk(const Path& path, double t0, double t1) const {
  constexpr double kSize = kLevel == 0 ? 1.0 : WaterTile::kBoundSides[kLevel == 0 ? 0 : kLevel - 1];
  std::int64_t row = floor_of((path.u + t0 * path.du) / kSize);
  std::int64_t column = floor_of((path.v + t0 * path.dv) / kSize);
  const std::int64_t row_step = path.du > 0.0 ? 1 : -1, column_step = path.dv > 0.0 ? 1 : -1;
  for (double t = t0;;) {
    // Grid traversal after Amanatides and Woo 1987: into the square whose border comes first.
    const double next_row = static_cast<double>(row + (row_step > 0 ? 1 : 0)) * kSize;
    const double next_column = static_cast<double>(column + (column_step > 0 ? 1 : 0)) * kSize;
    const double t_row = path.du != 0.0 ? (next_row - path.u) * path.per_du : kNowhere;
    const double t_column = path.dv != 0.0 ? (next_column - path.v) * path.per_dv : kNowhere;
    const double leave = std::min(t_row, t_column);
    const double end = std::max(t, std::min(leave, t1));
    const Found found = intersect_square<kLevel>(path, row, column, t, end);
    if (found.is_hit() || !(leave < t1)) return found;
    (t_row < t_column ? row : column) += t_row < t_column ? row_step : column_step;
    t = end;
  }
}

template <std::size_t kLevel>
WaterSurface::Found WaterSurface::intersect_square(const Path& path, std::int64_t row,
                                                   std::int64_t column, double t0,
                                                   double t1) const {
  if constexpr (kLevel == 0) {
    return intersect_cell(path, row, column, t0, t1);
  } else {
    constexpr std::int64_t kSide = WaterTile::kBoundSides[kLevel - 1];
    if (kSide == WaterShores::kCells && path.fades) {
      const WaveField::Shore ground = shore(row * kSide, column * kSide);
      if (ground == WaveField::Shore::kDry) return intersect_level(path, t0, t1);
      if (ground == WaveField::Shore::kOpen) {
        Path even = path;
        even.fades = false;
        return may_hit(even, kLevel, row, column, t0, t1) ? walk<kLevel - 1>(even, t0, t1)
                                                          : Found{};
      }
    }
    return may_hit(path, kLevel, row, column, t0, t1) ? walk<kLevel - 1>(path, t0, t1) : Found{};
  }
}

/// Where there are no waves.
WaterSurface::Found WaterSurface::intersect_level(const Path& path, double t0, double t1) {
  Found found;
  const double t = path.side * (path.z + t0 * path.dz) <= 0.0 ? t0 : -path.z / path.dz;
  if (t >= t0 && t <= t1) found.t = t;
  return found;
}

bool WaterSurface::may_hit(const Path& path, std::size_t level, std::int64_t row,
                           std::int64_t column, double t0, double t1) const {
  const WaterTile::Bounds& bounds = tile_->bounds(level - 1, row, column);
  // What fades may be anything down to zero; a trace is for rounding.
  const double slack = 1e-5 * (high_m_ - low_m_);
  const double low = strength_ * static_cast<double>(bounds.low);
  const double high = strength_ * static_cast<double>(bounds.high);
  const double z0 = path.z + t0 * path.dz, z1 = path.z + t1 * path.dz;
  if (path.side > 0.0) return std::min(z0, z1) <= (path.fades ? std::max(high, 0.0) : high) + slack;
  return std::max(z0, z1) >= (path.fades ? std::min(low, 0.0) : low) - slack;
}

/// Within a cell a ray's height above the surface is a quadratic of the distance. What is on the
/// other side already as it comes in hit the surface on the border.
WaterSurface::Found WaterSurface::intersect_cell(const Path& path, std::int64_t row,
                                                 std::int64_t column, double t0, double t1) const {
  Found found;
  const std::array<double, 4> corners = corners_of(row, column);
  if (stays_clear(path, corners, t0, t1)) return found;
  const Patch cell = path.fades ? faded(corners, row, column) : even(corners);
  const double p = path.u + t0 * path.du - static_cast<double>(row);
  const double q = path.v + t0 * path.dv - static_cast<double>(column);
  // A bilinear patch along a straight line is a quadratic in the distance.
  const double surface = cell.h + cell.h_u * p + (cell.h_v + cell.h_uv * p) * q;
  const double c = path.side * (path.z + t0 * path.dz - surface);
  double root = 0.0;
  if (c > 0.0) {
    const double b = path.side * (path.dz - cell.h_u * path.du - cell.h_v * path.dv -
                                  cell.h_uv * (p * path.dv + q * path.du));
    const double a = -path.side * cell.h_uv * path.du * path.dv;
    root = first_root(a, b, c, t1 - t0);
    if (root == kNowhere) return found;
  }
  found.t = t0 + root;
  found.along = cell.h_u + cell.h_uv * (q + root * path.dv);
  found.across = cell.h_v + cell.h_uv * (p + root * path.du);
  return found;
}

/// For certain: a ray above the highest, or below the lowest, of a cell's corners. What fades may
/// be anything down to zero.
bool WaterSurface::stays_clear(const Path& path, const std::array<double, 4>& corners, double t0,
                               double t1) const {
  const auto [h00, h10, h01, h11] = corners;
  const double slack = 1e-5 * (high_m_ - low_m_);
  const double z0 = path.z + t0 * path.dz, z1 = path.z + t1 * path.dz;
  if (path.side > 0.0) {
    const double top = strength_ * std::max(std::max(h00, h10), std::max(h01, h11));
    return std::min(z0, z1) > (path.fades ? std::max(top, 0.0) : top) + slack;
  }
  const double bottom = strength_ * std::min(std::min(h00, h10), std::min(h01, h11));
  return std::max(z0, z1) < (path.fades ? std::min(bottom, 0.0) : bottom) - slack;
}

}  // namespace trident::sim
