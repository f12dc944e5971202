// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps/grid_matcher.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "trident_base/angle.h"

namespace trident::maps {

namespace {

/// Whole cells from the robot's own, in whose middle it is, however far it is.
int cell_offset(double cells) {
  return static_cast<int>(std::clamp(std::floor(cells + 0.5), -1e8, 1e8));
}

}  // namespace

/// Translations [column, column + 2^level) x [row, row + 2^level) of one rotation.
struct GridMatcher::Node {
  int bound;
  int level;
  int rotation;
  int column, row;

  /// Finer first among equals, then whatever order, as long as it is always the same.
  bool operator<(const Node& other) const {
    return std::make_tuple(bound, -level, rotation, column, row) <
           std::make_tuple(other.bound, -other.level, other.rotation, other.column, other.row);
  }
};

/// The beams' ends at one heading, in whole cells from the robot.
struct GridMatcher::Rotation {
  double angle;
  std::vector<int> columns, rows;
};

GridMatcher::GridMatcher(const OccupancyGrid& grid, const GridMatcherParams& params)
    : params_(params),
      T_map_origin_(grid.T_map_origin),
      field_(grid, 4.0 * params.sigma),
      cell_(grid.resolution * std::max(1.0, std::round(params.cell / grid.resolution))),
      columns_(static_cast<int>(std::ceil(grid.width * grid.resolution / cell_))),
      rows_(static_cast<int>(std::ceil(grid.height * grid.resolution / cell_))),
      pad_(1 << params.depth),
      stride_(columns_ + pad_) {
  build_levels(grid);
}

/// The likelihood of the finest level is a Gaussian of the distance to the nearest obstacle
/// (likelihood field, "Probabilistic Robotics", 6.4) in 8 bits, so that sums over a scan are
/// integers.
void GridMatcher::build_levels(const OccupancyGrid& grid) {
  const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows_ + pad_);
  Level finest{std::vector<std::uint8_t>(size, 0), std::vector<std::uint8_t>(size, 0)};
  const int factor = static_cast<int>(std::lround(cell_ / grid.resolution));
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const auto at = static_cast<std::size_t>(row / factor + pad_) * stride_ +
                      static_cast<std::size_t>(column / factor + pad_);
      const float d = field_.padded()[static_cast<std::size_t>(row + 1) * field_.stride() +
                                      static_cast<std::size_t>(column + 1)];
      const double z = static_cast<double>(d) / params_.sigma;
      const auto likelihood =
          static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * z * z)));
      finest.likelihood[at] = std::max(finest.likelihood[at], likelihood);
      if (grid.cells[grid.index(column, row)] == OccupancyGrid::kFree) finest.is_free[at] = 1;
    }
  }
  levels_.push_back(std::move(finest));
  for (int level = 0; level < params_.depth; ++level) {
    levels_.push_back(coarser(levels_.back(), 1 << level));
  }
}

/// Maxima over twice the width from those over `step` cells.
GridMatcher::Level GridMatcher::coarser(const Level& finer, int step) const {
  Level result = finer;
  const int height = rows_ + pad_;
  for (auto* values : {&result.likelihood, &result.is_free}) {
    for (int row = 0; row < height; ++row) {
      std::uint8_t* line = values->data() + static_cast<std::ptrdiff_t>(row) * stride_;
      for (int i = 0; i + step < stride_; ++i) line[i] = std::max(line[i], line[i + step]);
    }
    for (int row = 0; row + step < height; ++row) {
      std::uint8_t* line = values->data() + static_cast<std::ptrdiff_t>(row) * stride_;
      const std::uint8_t* other = line + static_cast<std::ptrdiff_t>(step) * stride_;
      for (int i = 0; i < stride_; ++i) line[i] = std::max(line[i], other[i]);
    }
  }
  return result;
}

/// Headings so close that three quarters of the points move by a cell at most from one to the next.
std::vector<GridMatcher::Rotation> GridMatcher::rotations(const ScanPoints& points) const {
  std::vector<float> ranges;
  for (const Eigen::Vector2f& p : points.p_base) ranges.push_back(p.norm());
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(3 * ranges.size() / 4);
  std::nth_element(ranges.begin(), middle, ranges.end());
  const double step = std::clamp(cell_ / std::max(static_cast<double>(*middle), cell_),
                                 deg_to_rad(0.5), deg_to_rad(5.0));
  const int count = static_cast<int>(std::ceil(2.0 * kPi / step));
  std::vector<Rotation> result(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Rotation& rotation = result[static_cast<std::size_t>(i)];
    rotation.angle = 2.0 * kPi * i / count - kPi;
    const double c = std::cos(rotation.angle) / cell_, s = std::sin(rotation.angle) / cell_;
    for (const Eigen::Vector2f& point : points.p_base) {
      const Eigen::Vector2d p = point.cast<double>();
      rotation.columns.push_back(cell_offset(c * p.x() - s * p.y()));
      rotation.rows.push_back(cell_offset(s * p.x() + c * p.y()));
    }
  }
  return result;
}

/// Upper bound of the score of all translations of a node: each beam's end takes the maximum over
/// the cells that it can reach (Hess et al. 2016).
int GridMatcher::bound(const Rotation& rotation, int level, int column, int row) const {
  const std::uint8_t* cells = levels_[static_cast<std::size_t>(level)].likelihood.data();
  const auto width = static_cast<unsigned>(stride_), height = static_cast<unsigned>(rows_ + pad_);
  int sum = 0;
  for (std::size_t i = 0; i < rotation.columns.size(); ++i) {
    // Left of or below the padding a number becomes a very large one.
    const auto x = static_cast<unsigned>(rotation.columns[i] + column + pad_);
    const auto y = static_cast<unsigned>(rotation.rows[i] + row + pad_);
    if (x < width && y < height) sum += cells[static_cast<std::size_t>(y) * width + x];
  }
  return sum;
}

/// Prunes poses in walls or in unknown space, where no robot is.
bool GridMatcher::may_be_free(int level, int column, int row) const {
  if (column >= columns_ || row >= rows_) return false;
  return levels_[static_cast<std::size_t>(level)]
             .is_free[static_cast<std::size_t>(row + pad_) * stride_ +
                      static_cast<std::size_t>(column + pad_)] != 0;
}

/// The coarsest level of every heading; steps cover the map without gaps or overlaps.
std::vector<GridMatcher::Node> GridMatcher::first_nodes(
    const std::vector<Rotation>& rotations) const {
  std::vector<Node> nodes;
  const int level = params_.depth, step = 1 << level;
  for (int row = 0; row < rows_; row += step) {
    for (int column = 0; column < columns_; column += step) {
      if (!may_be_free(level, column, row)) continue;
      for (int i = 0; i < static_cast<int>(rotations.size()); ++i) {
        const int most = bound(rotations[static_cast<std::size_t>(i)], level, column, row);
        nodes.push_back({most, level, i, column, row});
      }
    }
  }
  return nodes;
}

/// Best first: the node whose bound is the highest is divided next, so that leaves come out in the
/// order of their scores, and the search ends at the first that is worse than what is kept.
/// Distinct leaves are hypotheses of places that look alike.
std::vector<GridMatcher::Node> GridMatcher::search(const std::vector<Rotation>& rotations) const {
  std::priority_queue<Node> open(std::less<Node>(), first_nodes(rotations));
  std::vector<Node> found;
  double least = 0.0;
  for (std::size_t looked_at = open.size(); !open.empty() && looked_at < params_.max_nodes;) {
    const Node node = open.top();
    open.pop();
    if (node.bound < least) break;
    const Rotation& rotation = rotations[static_cast<std::size_t>(node.rotation)];
    if (node.level == 0) {
      if (!is_distinct(rotation, node, found, rotations)) continue;
      found.push_back(node);
      least = params_.keep_ratio * found.front().bound;
      if (static_cast<int>(found.size()) == params_.max_hypotheses) break;
      continue;
    }
    const int level = node.level - 1, step = 1 << level;
    for (int corner = 0; corner < 4; ++corner) {
      const int column = node.column + (corner & 1) * step, row = node.row + (corner >> 1) * step;
      if (!may_be_free(level, column, row)) continue;
      ++looked_at;
      const int most = bound(rotation, level, column, row);
      if (most >= least) open.push({most, level, node.rotation, column, row});
    }
  }
  return found;
}

bool GridMatcher::is_distinct(const Rotation& rotation, const Node& node,
                              const std::vector<Node>& found,
                              const std::vector<Rotation>& rotations) const {
  return std::none_of(found.begin(), found.end(), [&](const Node& other) {
    const double angle = rotations[static_cast<std::size_t>(other.rotation)].angle;
    return std::hypot(node.column - other.column, node.row - other.row) * cell_ <
               params_.distinct_m &&
           std::abs(angle_difference(rotation.angle, angle)) < params_.distinct_rad;
  });
}

SE2 GridMatcher::pose_of(const Rotation& rotation, const Node& node) const {
  return SE2::from_xy_yaw((node.column + 0.5) * cell_, (node.row + 0.5) * cell_, rotation.angle);
}

/// Mean likelihood of the returns, exp(-d^2 / 2 sigma^2) with the distance d to the nearest
/// obstacle, as the likelihood field of AMCL has it; in [0, 1].
double GridMatcher::score_in_grid(const ScanPoints& points, const SE2& T_grid_base) const {
  if (points.p_base.empty()) return 0.0;
  const double c = std::cos(T_grid_base.angle), s = std::sin(T_grid_base.angle);
  double sum = 0.0;
  for (const Eigen::Vector2f& point : points.p_base) {
    const Eigen::Vector2d p = point.cast<double>();
    const double x = T_grid_base.p.x() + c * p.x() - s * p.y();
    const double y = T_grid_base.p.y() + s * p.x() + c * p.y();
    const float d = field_.at(static_cast<float>(x), static_cast<float>(y));
    const double z = static_cast<double>(d) / params_.sigma;
    sum += std::exp(-0.5 * z * z);
  }
  return sum / static_cast<double>(points.p_base.size());
}

double GridMatcher::score(const ScanPoints& points, const SE2& T_map_base) const {
  return score_in_grid(points, T_map_origin_.inverse() * T_map_base);
}

/// Climbs by ever smaller steps along x, y and heading.
SE2 GridMatcher::refined(const ScanPoints& points, SE2 T_grid_base) const {
  double best = score_in_grid(points, T_grid_base);
  double step_m = 0.5 * cell_, step_rad = deg_to_rad(1.0);
  for (int halving = 0; halving < 4; ++halving, step_m *= 0.5, step_rad *= 0.5) {
    for (bool is_better = true; is_better;) {
      is_better = false;
      for (const auto& [dx, dy, turn] : {std::tuple{step_m, 0.0, 0.0},
                                         {-step_m, 0.0, 0.0},
                                         {0.0, step_m, 0.0},
                                         {0.0, -step_m, 0.0},
                                         {0.0, 0.0, step_rad},
                                         {0.0, 0.0, -step_rad}}) {
        const SE2 tried = SE2::from_xy_yaw(T_grid_base.p.x() + dx, T_grid_base.p.y() + dy,
                                           T_grid_base.angle + turn);
        const double score = score_in_grid(points, tried);
        if (score <= best + 1e-9) continue;
        best = score;
        T_grid_base = tried;
        is_better = true;
      }
    }
  }
  return T_grid_base;
}

/// Agreement counts before the score: in a map with few obstacles a pose that looks through walls
/// may score higher than the true one. The sort is stable, so that equal hypotheses keep their
/// order on every machine.
std::vector<PoseHypothesis> GridMatcher::match(const ScanPoints& points) const {
  if (points.p_base.empty()) return {};
  const std::vector<Rotation> all = rotations(points);
  std::vector<PoseHypothesis> result;
  for (const Node& node : search(all)) {
    const SE2 T_grid_base =
        refined(points, pose_of(all[static_cast<std::size_t>(node.rotation)], node));
    result.push_back({T_map_origin_ * T_grid_base, score_in_grid(points, T_grid_base),
                      scan_agreement(field_, points, T_grid_base)});
  }
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return std::make_pair(a.agreement, a.score) > std::make_pair(b.agreement, b.score);
  });
  return result;
}

}  // namespace trident::maps
