// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/probability_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trident {
namespace {

/// A wall that was seen a hundred times can still be forgotten.
constexpr float kMaxLogOdds = 50.0F;

float log_odds(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

}  // namespace

ProbabilityGrid::ProbabilityGrid(double resolution, double passed, double ended)
    : resolution_(resolution),
      per_metre_(static_cast<float>(1.0 / resolution)),
      log_odds_passed_(log_odds(passed)),
      log_odds_ended_(log_odds(ended)) {}

Eigen::Vector2i ProbabilityGrid::cell_of(const Eigen::Vector2d& p_map) const {
  return {static_cast<int>(std::floor(p_map.x() / resolution_)),
          static_cast<int>(std::floor(p_map.y() / resolution_))};
}

void ProbabilityGrid::insert(const SE2& T_map_base, const PointScan& scan) {
  ++scans_;
  const Eigen::Vector2i from = cell_of(T_map_base * scan.origin.cast<double>());
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2i to = cell_of(T_map_base * point.p.cast<double>());
    pass(from, to);
    tell(to, true);
  }
}

/// The cells of a line from one cell's centre to another's, without the last (Bresenham 1965).
void ProbabilityGrid::pass(const Eigen::Vector2i& from, const Eigen::Vector2i& to) {
  const Eigen::Vector2i span = (to - from).cwiseAbs();
  const Eigen::Vector2i sign(to.x() > from.x() ? 1 : -1, to.y() > from.y() ? 1 : -1);
  Eigen::Vector2i cell = from;
  int error = span.x() - span.y();
  while (cell != to) {
    tell(cell, false);
    const int twice = 2 * error;
    if (twice > -span.y()) {
      error -= span.y();
      cell.x() += sign.x();
    }
    if (twice < span.x()) {
      error += span.x();
      cell.y() += sign.y();
    }
  }
}

void ProbabilityGrid::tell(const Eigen::Vector2i& cell, bool is_end) {
  Cell& c = cells_.at(cell.x(), cell.y());
  const std::int32_t passed = 2 * scans_;
  if (c.told >= passed + (is_end ? 1 : 0)) return;
  if (c.told == passed) c.log_odds -= log_odds_passed_;  // a beam ended where another had passed
  c.log_odds += is_end ? log_odds_ended_ : log_odds_passed_;
  c.log_odds = std::clamp(c.log_odds, -kMaxLogOdds, kMaxLogOdds);
  c.probability = 1.0F / (1.0F + std::exp(-c.log_odds));
  c.told = passed + (is_end ? 1 : 0);
}

ProbabilityGrid::Sample ProbabilityGrid::sample(const Eigen::Vector2f& p_map) const {
  const Eigen::Vector2f at = p_map * per_metre_ - Eigen::Vector2f::Constant(0.5F);
  const Eigen::Vector2f corner(std::floor(at.x()), std::floor(at.y()));
  const Eigen::Vector2f t = at - corner;
  const int x = static_cast<int>(corner.x());
  const int y = static_cast<int>(corner.y());
  const float p00 = cells_.get(x, y).probability;
  const float p10 = cells_.get(x + 1, y).probability;
  const float p01 = cells_.get(x, y + 1).probability;
  const float p11 = cells_.get(x + 1, y + 1).probability;
  const float below = p00 + t.x() * (p10 - p00);
  const float above = p01 + t.x() * (p11 - p01);
  Sample sample;
  sample.value = below + t.y() * (above - below);
  sample.gradient.x() = per_metre_ * ((1.0F - t.y()) * (p10 - p00) + t.y() * (p11 - p01));
  sample.gradient.y() = per_metre_ * (above - below);
  return sample;
}

OccupancyGrid ProbabilityGrid::occupancy() const {
  OccupancyGrid grid;
  const auto extent = cells_.extent();
  grid.width = extent.width;
  grid.height = extent.height;
  grid.resolution = resolution_;
  grid.T_map_origin = SE2::from_xy_yaw(extent.min_x * resolution_, extent.min_y * resolution_, 0.0);
  grid.cells.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const Cell cell = cells_.get(extent.min_x + column, extent.min_y + row);
      std::int8_t value = OccupancyGrid::kUnknown;
      if (cell.told != 0 && cell.log_odds < 0.0F) value = OccupancyGrid::kFree;
      if (cell.log_odds > 0.0F) value = OccupancyGrid::kOccupied;
      grid.cells.push_back(value);
    }
  }
  return grid;
}

}  // namespace trident
