// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "probability_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace trident::slam {
namespace {

/// A wall that was seen a hundred times can still be forgotten.
constexpr float kMaxLogOdds = 50.0F;

float log_odds(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

}  // namespace

/// 1 / (1 + exp(-x)) of the few values that most cells of a map have, each worked out once.
class ProbabilityGrid::Logistic {
 public:
  float of(float log_odds) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &log_odds, sizeof(bits));
    Known& known = known_[(bits * 2654435761U) >> 24U];  // Knuth's multiplicative hash
    if (known.log_odds != log_odds) known = {log_odds, 1.0F / (1.0F + std::exp(-log_odds))};
    return known.probability;
  }

 private:
  struct Known {
    float log_odds = 0.0F;
    float probability = 0.5F;
  };
  std::array<Known, 256> known_;
};

ProbabilityGrid::ProbabilityGrid(double resolution, double passed, double ended)
    : resolution_(resolution),
      per_meter_(static_cast<float>(1.0 / resolution)),
      log_odds_passed_(log_odds(passed)),
      log_odds_ended_(log_odds(ended)) {}

Eigen::Vector2i ProbabilityGrid::cell_of(const Eigen::Vector2d& p_map) const {
  return {static_cast<int>(std::floor(p_map.x() / resolution_)),
          static_cast<int>(std::floor(p_map.y() / resolution_))};
}

void ProbabilityGrid::insert(const SE2& T_map_base, const PointScan& scan) {
  ++scans_;
  const Eigen::Vector2i from = cell_of(T_map_base * scan.origin.cast<double>());
  const Eigen::Matrix2d R = T_map_base.rotation();
  TiledGrid<Cell>::Pen pen(cells_);
  Logistic logistic;
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2i to = cell_of(R * point.p.cast<double>() + T_map_base.p);
    pass(logistic, pen, from, to);
    update(logistic, pen.at(to.x(), to.y()), true);
  }
}

/// The cells of a line from one cell's centre to another's, without the last (Bresenham 1965).
void ProbabilityGrid::pass(Logistic& logistic, TiledGrid<Cell>::Pen& pen,
                           const Eigen::Vector2i& from, const Eigen::Vector2i& to) {
  const Eigen::Vector2i span = (to - from).cwiseAbs();
  const Eigen::Vector2i sign(to.x() > from.x() ? 1 : -1, to.y() > from.y() ? 1 : -1);
  Eigen::Vector2i cell = from;
  int error = span.x() - span.y();
  while (cell != to) {
    Cell& passed = pen.at(cell.x(), cell.y());
    if (passed.last_update < 2 * scans_) update(logistic, passed, false);
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

void ProbabilityGrid::update(Logistic& logistic, Cell& c, bool is_end) {
  const std::int32_t passed = 2 * scans_;
  if (c.last_update >= passed + (is_end ? 1 : 0)) return;
  const float before = c.log_odds;
  if (c.last_update == passed)
    c.log_odds -= log_odds_passed_;  // a beam ended where another had passed
  c.log_odds += is_end ? log_odds_ended_ : log_odds_passed_;
  c.log_odds = std::clamp(c.log_odds, -kMaxLogOdds, kMaxLogOdds);
  if (c.log_odds != before) c.probability = logistic.of(c.log_odds);
  c.last_update = passed + (is_end ? 1 : 0);
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
      if (cell.last_update != 0 && cell.log_odds < 0.0F) value = OccupancyGrid::kFree;
      if (cell.log_odds > 0.0F) value = OccupancyGrid::kOccupied;
      grid.cells.push_back(value);
    }
  }
  return grid;
}

}  // namespace trident::slam
