// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How a ray finds the water: through squares of cells whose bounds it may meet, down to the cell
// whose surface it meets, where that is the root of a quadratic.
#include <algorithm>
#include <cmath>

#include "water_surface.h"

namespace trident {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// The distances between which a ray is between two heights.
struct Stretch {
  double first, last;
};
Stretch between_heights(double z, double dz, double low, double high, double t_min, double t_max) {
  if (dz == 0.0) return z >= low && z <= high ? Stretch{t_min, t_max} : Stretch{t_max, t_min};
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

std::int64_t square_of(double cells, std::int64_t side) {
  // std::floor is a call where the processor is not known.
  const double squares = cells / static_cast<double>(side);
  const auto cut = static_cast<std::int64_t>(squares);
  return cut - (squares < static_cast<double>(cut) ? 1 : 0);
}

}  // namespace

WaterSurface::Path WaterSurface::path_of(const Ray& ray) const {
  const WaterPattern& pattern = maker_->pattern();
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

WaterMeeting WaterSurface::meet(const Ray& ray, double t_max) const {
  WaterMeeting meeting;
  const double t_min = ray.t_min_m;
  const double z = ray.p_world_origin.z() - level_m_, dz = ray.direction_world.z();
  const double begin_z = z + t_min * dz;
  double plane_from = t_min;
  if (tile_ == nullptr || begin_z > high_m_ || begin_z < low_m_) {
    meeting.begins_below = begin_z < (tile_ == nullptr ? 0.0 : low_m_);
    const double end_z = meeting.begins_below ? low_m_ : high_m_;
    // The commonest of all: it leads away.
    if (meeting.begins_below ? dz <= 0.0 : dz >= 0.0) return meeting;
    if ((end_z - z) / dz > t_max) return meeting;
  }
  if (tile_ != nullptr) {
    Path path = path_of(ray);
    if (begin_z <= high_m_ && begin_z >= low_m_) {
      meeting.begins_below =
          begin_z < cell_height(path.u + t_min * path.du, path.v + t_min * path.dv);
    }
    path.side = meeting.begins_below ? -1.0 : 1.0;
    path.fades = fades_;
    const double t_far = far_m_ / std::max(ray.direction_world.head<2>().norm(), 1e-300);
    const Stretch stretch = between_heights(z, dz, low_m_, high_m_, t_min, std::min(t_max, t_far));
    if (stretch.first <= stretch.last) {
      meeting.t =
          walk(path, static_cast<int>(WaterTile::kBoundSides.size()), stretch.first, stretch.last);
      if (meeting.t < kNowhere) return meeting;
    }
    if (t_far >= t_max) return meeting;
    plane_from = std::max(t_min, t_far);
  }
  const bool leads_there = meeting.begins_below ? dz > 0.0 : dz < 0.0;
  if (!leads_there) return meeting;
  const double t = std::max(-z / dz, plane_from);
  if (t <= t_max) meeting.t = t;
  return meeting;
}

/// The first meeting within [t0, t1], which lies in squares of `level`: 0 are cells, above them
/// those that have bounds.
double WaterSurface::walk(const Path& path, int level, double t0, double t1) const {
  const std::int64_t side =
      level == 0 ? 1 : WaterTile::kBoundSides[static_cast<std::size_t>(level - 1)];
  const auto size = static_cast<double>(side);
  std::int64_t row = square_of(path.u + t0 * path.du, side);
  std::int64_t column = square_of(path.v + t0 * path.dv, side);
  const std::int64_t row_step = path.du > 0.0 ? 1 : -1, column_step = path.dv > 0.0 ? 1 : -1;
  for (double t = t0;;) {
    const double next_row = static_cast<double>(row + (row_step > 0 ? 1 : 0)) * size;
    const double next_column = static_cast<double>(column + (column_step > 0 ? 1 : 0)) * size;
    const double t_row = path.du != 0.0 ? (next_row - path.u) * path.per_du : kNowhere;
    const double t_column = path.dv != 0.0 ? (next_column - path.v) * path.per_dv : kNowhere;
    const double leave = std::min(t_row, t_column);
    const double end = std::max(t, std::min(leave, t1));
    double met = kNowhere;
    if (level == 0) {
      met = meet_cell(path, row, column, t, end);
    } else if (path.fades && side == kShoreCells &&
               shore(row * side, column * side) != WaveField::Shore::kFading) {
      Path even = path;
      even.fades = false;
      if (shore(row * side, column * side) == WaveField::Shore::kDry) {
        met = meet_level(path, t, end);
      } else if (may_meet(even, level, row, column, t, end)) {
        met = walk(even, level - 1, t, end);
      }
    } else if (may_meet(path, level, row, column, t, end)) {
      met = walk(path, level - 1, t, end);
    }
    if (met < kNowhere || !(leave < t1)) return met;
    (t_row < t_column ? row : column) += t_row < t_column ? row_step : column_step;
    t = end;
  }
}

/// Where there are no waves.
double WaterSurface::meet_level(const Path& path, double t0, double t1) {
  if (path.side * (path.z + t0 * path.dz) <= 0.0) return t0;
  const double t = -path.z / path.dz;
  return t >= t0 && t <= t1 ? t : kNowhere;
}

bool WaterSurface::may_meet(const Path& path, int level, std::int64_t row, std::int64_t column,
                            double t0, double t1) const {
  const WaterTile::Bounds& bounds = tile_->bounds(static_cast<std::size_t>(level - 1), row, column);
  // What fades may be anything down to zero; a trace is for rounding.
  const double slack = 1e-5 * (high_m_ - low_m_);
  const double low = strength_ * static_cast<double>(bounds.low);
  const double high = strength_ * static_cast<double>(bounds.high);
  const double z0 = path.z + t0 * path.dz, z1 = path.z + t1 * path.dz;
  if (path.side > 0.0) return std::min(z0, z1) <= (path.fades ? std::max(high, 0.0) : high) + slack;
  return std::max(z0, z1) >= (path.fades ? std::min(low, 0.0) : low) - slack;
}

/// Within a cell a ray's height above the surface is a quadratic of the distance. What is on the
/// other side already as it comes in met the surface on the border.
double WaterSurface::meet_cell(const Path& path, std::int64_t row, std::int64_t column, double t0,
                               double t1) const {
  const Patch cell = patch(row, column, path.fades);
  const double p = path.u + t0 * path.du - static_cast<double>(row);
  const double q = path.v + t0 * path.dv - static_cast<double>(column);
  const double surface = cell.h + cell.h_u * p + (cell.h_v + cell.h_uv * p) * q;
  const double c = path.side * (path.z + t0 * path.dz - surface);
  if (c <= 0.0) return t0;
  const double b = path.side * (path.dz - cell.h_u * path.du - cell.h_v * path.dv -
                                cell.h_uv * (p * path.dv + q * path.du));
  const double a = -path.side * cell.h_uv * path.du * path.dv;
  const double root = first_root(a, b, c, t1 - t0);
  return root < kNowhere ? t0 + root : kNowhere;
}

}  // namespace trident
