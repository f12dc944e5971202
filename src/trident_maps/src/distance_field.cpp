// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps/distance_field.h"

#include <algorithm>
#include <cmath>

namespace trident::maps {
namespace {

constexpr double kAgreeWithin = 0.3;  // [m]: some cells, and what furniture is moved by

/// Squared distances [cells^2] along one line, `count` values `step` apart: the lower envelope of
/// the parabolas that stand on each value.
class LineTransform {
 public:
  explicit LineTransform(int longest)
      : at_(static_cast<std::size_t>(longest)),
        values_(static_cast<std::size_t>(longest)),
        from_(static_cast<std::size_t>(longest) + 1) {}

  /// Lower envelope of the parabolas of a line's values, then their least at each place
  /// (Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", 2012): the squared
  /// distance of two dimensions is that of columns taken along rows.
  void run(float* line, int count, std::ptrdiff_t step) {
    int top = -1;
    for (int i = 0; i < count; ++i) {
      const double value = line[i * step];
      double from = -1.0;
      while (top >= 0) {
        const auto k = static_cast<std::size_t>(top);
        from = crossing(at_[k], values_[k], i, value);
        if (from > from_[k]) break;
        --top;
      }
      const auto k = static_cast<std::size_t>(++top);
      at_[k] = i;
      values_[k] = value;
      from_[k] = top == 0 ? -1.0 : from;
    }
    int k = 0;
    for (int i = 0; i < count; ++i) {
      while (k < top && from_[static_cast<std::size_t>(k) + 1] < i) ++k;
      const double away = i - at_[static_cast<std::size_t>(k)];
      line[i * step] = static_cast<float>(away * away + values_[static_cast<std::size_t>(k)]);
    }
  }

 private:
  /// Where the parabola on (b, value_b), b > a, becomes the lower one.
  static double crossing(int a, double value_a, int b, double value_b) {
    const double square_a = static_cast<double>(a) * a, square_b = static_cast<double>(b) * b;
    return ((value_b + square_b) - (value_a + square_a)) / (2.0 * (b - a));
  }

  std::vector<int> at_;
  std::vector<double> values_;
  std::vector<double> from_;
};

bool is_obstacle(std::int8_t cell, DistanceField::Obstacles obstacles) {
  if (cell == OccupancyGrid::kOccupied) return true;
  return obstacles == DistanceField::Obstacles::kOccupiedOrUnknown && cell != OccupancyGrid::kFree;
}

/// Sets the distances of obstacles to zero; `padded` as `DistanceField` has it.
void mark_obstacles(const OccupancyGrid& grid, DistanceField::Obstacles obstacles,
                    std::size_t stride, std::vector<float>& padded) {
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      if (!is_obstacle(grid.cells[grid.index(column, row)], obstacles)) continue;
      padded[static_cast<std::size_t>(row + 1) * stride + column + 1] = 0.0F;
    }
  }
}

}  // namespace

/// Squared Euclidean distances by two passes of one-dimensional transforms, columns and then rows:
/// linear in the number of cells. The border of far cells lets at() clamp instead of checking.
DistanceField::DistanceField(const OccupancyGrid& grid, double max_distance, Obstacles obstacles)
    : width_(grid.width),
      height_(grid.height),
      resolution_(grid.resolution),
      max_distance_(max_distance),
      cells_per_m_(static_cast<float>(1.0 / grid.resolution)) {
  const double most = max_distance / resolution_;
  const auto far = static_cast<float>(most * most);
  const auto stride = static_cast<std::size_t>(this->stride());
  padded_.assign(stride * static_cast<std::size_t>(height_ + 2), far);
  mark_obstacles(grid, obstacles, stride, padded_);
  LineTransform transform(std::max(width_, height_));
  for (int column = 1; column <= width_; ++column) {
    transform.run(&padded_[stride + static_cast<std::size_t>(column)], height_,
                  static_cast<std::ptrdiff_t>(stride));
  }
  for (int row = 1; row <= height_; ++row) {
    transform.run(&padded_[static_cast<std::size_t>(row) * stride + 1], width_, 1);
  }
  const auto meters_per_cell = static_cast<float>(resolution_),
             limit = static_cast<float>(max_distance);
  for (float& cell : padded_) cell = std::min(std::sqrt(cell) * meters_per_cell, limit);
}

float DistanceField::at(float x, float y) const {
  const float column = std::clamp(x * cells_per_m_ + 1.0F, 0.0F, static_cast<float>(width_ + 1));
  const float row = std::clamp(y * cells_per_m_ + 1.0F, 0.0F, static_cast<float>(height_ + 1));
  return padded_[static_cast<std::size_t>(row) * static_cast<std::size_t>(stride()) +
                 static_cast<std::size_t>(column)];
}

double DistanceField::ray(const Eigen::Vector2d& p_grid, double angle, double max_range) const {
  // All in cells of the padded map.
  const auto cosine = static_cast<float>(std::cos(angle)),
             sine = static_cast<float>(std::sin(angle));
  const float x = static_cast<float>(p_grid.x()) * cells_per_m_ + 1.0F;
  const float y = static_cast<float>(p_grid.y()) * cells_per_m_ + 1.0F;
  const auto right = static_cast<float>(width_ + 1), top = static_cast<float>(height_ + 1);
  const auto limit = static_cast<float>(max_range / resolution_);
  const float* cells = padded_.data();
  const int stride = this->stride();
  // What is known is the distance between the cells' centres; beam and obstacle may each be half a
  // diagonal from theirs.
  constexpr float kSlack = 1.41421356F, kMinStep = 0.5F;
  for (float range = 0.0F; range < limit;) {
    const float column = std::min(std::max(x + range * cosine, 0.0F), right);
    const float row = std::min(std::max(y + range * sine, 0.0F), top);
    const float distance = cells[static_cast<int>(row) * stride + static_cast<int>(column)];
    if (distance <= 0.0F) return static_cast<double>(range) * resolution_;
    range += std::max(distance * cells_per_m_ - kSlack, kMinStep);
  }
  return max_range;
}

KnownSpace::KnownSpace(const OccupancyGrid& grid)
    : width_(grid.width),
      height_(grid.height),
      cells_per_m_(static_cast<float>(1.0 / grid.resolution)) {
  is_known_.reserve(grid.cells.size());
  for (const std::int8_t cell : grid.cells) is_known_.push_back(cell != OccupancyGrid::kUnknown);
}

bool KnownSpace::contains(float x, float y) const {
  const float column = std::floor(x * cells_per_m_), row = std::floor(y * cells_per_m_);
  const bool is_inside = column >= 0.0F && row >= 0.0F && column < static_cast<float>(width_) &&
                         row < static_cast<float>(height_);
  return is_inside && is_known_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(column)];
}

namespace {

/// How many beams of a scan the map explains, and how many it cannot judge.
struct BeamCounts {
  std::size_t explained = 0, unjudged = 0;
};

/// A return agrees with the map when an obstacle is near its end and nothing stands before it: the
/// end alone would also agree through a wall.
BeamCounts count_beams(const DistanceField& field, const KnownSpace* known,
                       const ScanPoints& points, const SE2& T_grid_base) {
  BeamCounts counts;
  const Eigen::Vector2d p_grid_laser = T_grid_base * points.p_base_laser;
  for (const Eigen::Vector2f& p_base : points.p_base) {
    const Eigen::Vector2d p_grid = T_grid_base * p_base.cast<double>();
    const auto x = static_cast<float>(p_grid.x()), y = static_cast<float>(p_grid.y());
    const bool is_near = static_cast<double>(field.at(x, y)) <= kAgreeWithin;
    if (!is_near && (known == nullptr || known->contains(x, y))) continue;
    const Eigen::Vector2d beam = p_grid - p_grid_laser;
    const double free_range = beam.norm() - kAgreeWithin;
    const double hit_range = field.ray(p_grid_laser, std::atan2(beam.y(), beam.x()), free_range);
    if (hit_range < free_range) continue;
    ++(is_near ? counts.explained : counts.unjudged);
  }
  return counts;
}

}  // namespace

double scan_agreement(const DistanceField& field, const ScanPoints& points,
                      const SE2& T_grid_base) {
  if (points.p_base.empty()) return 0.0;
  const BeamCounts counts = count_beams(field, nullptr, points, T_grid_base);
  return static_cast<double>(counts.explained) / static_cast<double>(points.p_base.size());
}

double scan_agreement(const DistanceField& field, const KnownSpace& known, const ScanPoints& points,
                      const SE2& T_grid_base) {
  if (points.p_base.empty()) return 0.0;
  const BeamCounts counts = count_beams(field, &known, points, T_grid_base);
  const std::size_t all = points.p_base.size();
  const std::size_t judged = std::max(all - counts.unjudged, (all + 1) / 2);
  return static_cast<double>(counts.explained) / static_cast<double>(judged);
}

}  // namespace trident::maps
