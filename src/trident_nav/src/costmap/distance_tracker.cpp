// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/distance_tracker.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "column_pass.h"
#include "square_kernel.h"

namespace trident::nav {
namespace {

constexpr std::uint16_t kNoSeed = 65535;
// Quotients such as 0.55 / 0.05 may come out just below the whole number that is meant.
constexpr double kCutRounding = 1e-6;

constexpr int kBlock = BlockSet::kCells;

int round_up(int cells) { return (cells + kBlock - 1) / kBlock * kBlock; }

}  // namespace

DistanceTracker::DistanceTracker(double max_distance_m, Seeds seeds)
    : seeds_(seeds), wanted_distance_m_(max_distance_m) {}

void DistanceTracker::set_max_distance(double max_distance_m) {
  wanted_distance_m_ = max_distance_m;
  resize(geometry_);
}

void DistanceTracker::resize(const GridGeometry& geometry) {
  geometry_ = geometry;
  fill_tables();
  rows_.assign(geometry.size(), static_cast<std::uint8_t>(reach_ + 1));
  distance_m_.assign(geometry.size(), max_distance_m_);
  near_.resize(geometry.width, geometry.height);
  stale_.resize(geometry.width, geometry.height);
  const int blocks = geometry.width / kBlock + 1;
  is_near_.assign(static_cast<std::size_t>(blocks), 0);
  const auto longest = static_cast<std::size_t>(round_up(geometry.width));
  squares_.assign(longest + static_cast<std::size_t>(2 * reach_), kNoSeed);
  result_.assign(longest, 0);
}

/// Distances are looked up by their square in cells, which is a whole number; beyond the reach all
/// are the greatest one.
void DistanceTracker::fill_tables() {
  const double resolution = geometry_.resolution > 0.0 ? geometry_.resolution : 1.0;
  const double cells =
      std::clamp(wanted_distance_m_ / resolution, 1.0, static_cast<double>(kMaxReach)) +
      kCutRounding;
  reach_ = static_cast<int>(cells);
  beyond_ = static_cast<int>(cells * cells) + 1;
  max_distance_m_ = static_cast<float>((cells - kCutRounding) * resolution);
  table_m_.resize(static_cast<std::size_t>(beyond_) + 1);
  for (int square = 0; square < beyond_; ++square) {
    table_m_[static_cast<std::size_t>(square)] =
        static_cast<float>(std::sqrt(static_cast<double>(square)) * resolution);
  }
  table_m_.back() = max_distance_m_;
}

/// Few cells that become obstacles or cease to be ones are followed one by one through the columns
/// that they reach; with many it is cheaper to work all columns out again. Only blocks whose rows
/// have changed are measured then.
void DistanceTracker::update(const std::uint8_t* cost, const BlockSet& changed,
                             DistanceSink& sink) {
  stale_.clear();
  stale_.insert(changed);
  if (collect_toggles(cost, changed)) {
    for (const Cell& cell : toggles_) {
      if (rows_[geometry_.index(cell)] == 0) {
        remove_seed(cell.x, cell.y);
      } else {
        add_seed(cell.x, cell.y);
      }
    }
  } else {
    rebuild_columns(cost);
    stale_.insert_all();
  }
  stale_.for_each_span([&](int y, int x0, int x1) { refresh_span(y, x0, x1, sink); });
}

/// Fills toggles_; false when there are so many that a computation from nothing is faster.
bool DistanceTracker::collect_toggles(const std::uint8_t* cost, const BlockSet& changed) {
  // Each toggle reads and writes about 4 reach cells of a column, the two passes 3 of each cell.
  const std::size_t most = geometry_.size() / static_cast<std::size_t>(8 * reach_) + 16;
  toggles_.clear();
  changed.for_each_span([&](int y, int x0, int x1) {
    if (toggles_.size() <= most) collect_span(cost, y, x0, x1);
  });
  return toggles_.size() <= most;
}

/// Blocks without a change are passed over by comparing all their cells at once.
void DistanceTracker::collect_span(const std::uint8_t* cost, int y, int x0, int x1) {
  const std::size_t row = geometry_.index({0, y});
  const bool unknown = seeds_ == Seeds::kLethalOrUnknown;
  for (int x = x0; x < x1; x += kBlock) {
    const std::size_t first = row + static_cast<std::size_t>(x);
    if (x + kBlock <= x1) {
      const Bytes was_seed = static_cast<Bytes>(load_bytes(rows_.data() + first) == Bytes{});
      if (!any_bit(seeds_among(load_bytes(cost + first), unknown) ^ was_seed)) continue;
    }
    for (int i = x; i < std::min(x + kBlock, x1); ++i) {
      const std::size_t cell = row + static_cast<std::size_t>(i);
      if (is_seed(cost[cell]) != (rows_[cell] == 0)) toggles_.push_back({i, y});
    }
  }
}

/// One pass along the columns and one back: the distance along the column to the nearest seed on
/// either side.
void DistanceTracker::rebuild_columns(const std::uint8_t* cost) {
  const auto width = static_cast<std::size_t>(geometry_.width);
  const auto none = static_cast<std::uint8_t>(reach_ + 1);
  const bool unknown = seeds_ == Seeds::kLethalOrUnknown;
  std::vector<std::uint8_t> away(width, none);
  for (int y = 0; y < geometry_.height; ++y) {
    const std::uint8_t* from = cost + geometry_.index({0, y});
    std::uint8_t* to = rows_.data() + geometry_.index({0, y});
    const std::uint8_t* before = y == 0 ? away.data() : to - width;
    advance_rows(from, before, none, unknown, geometry_.width, to);
  }
  for (int y = geometry_.height - 2; y >= 0; --y) {
    std::uint8_t* to = rows_.data() + geometry_.index({0, y});
    limit_rows(to + width, geometry_.width, to);
  }
}

void DistanceTracker::add_seed(int x, int y) {
  set_rows(x, y, 0);
  for (const int step : {-1, 1}) {
    for (int k = 1; k <= reach_; ++k) {
      const int at = y + step * k;
      if (at < 0 || at >= geometry_.height || rows_[geometry_.index({x, at})] <= k) break;
      set_rows(x, at, k);
    }
  }
}

void DistanceTracker::remove_seed(int x, int y) {
  const int below = rows_to_seed(x, y, -1), above = rows_to_seed(x, y, 1);
  set_rows(x, y, std::min({below, above, reach_ + 1}));
  for (const int step : {-1, 1}) {
    const int ahead = step < 0 ? below : above, behind = step < 0 ? above : below;
    for (int k = 1; k <= reach_ && ahead - k > k; ++k) {
      const int at = y + step * k;
      if (at < 0 || at >= geometry_.height) break;
      set_rows(x, at, std::min({ahead - k, behind + k, reach_ + 1}));
    }
  }
}

/// Rows from a cell to the next seed of its column in one sense, the cell itself not counted; more
/// than 2 reach when none is near enough to matter.
int DistanceTracker::rows_to_seed(int x, int y, int step) const {
  const int far = 2 * reach_ + 1;
  for (int k = 1; k < far; ++k) {
    const int at = y + step * k;
    if (at < 0 || at >= geometry_.height) break;
    if (rows_[geometry_.index({x, at})] == 0) return k;
  }
  return far;
}

void DistanceTracker::set_rows(int x, int y, int rows) {
  rows_[geometry_.index({x, y})] = static_cast<std::uint8_t>(rows);
  stale_.insert_span(y, x - reach_, x + reach_ + 1);
}

/// Runs of blocks that are near a seed are measured, the others get the greatest distance, which
/// needs no search.
void DistanceTracker::refresh_span(int y, int x0, int x1, DistanceSink& sink) {
  const int first = x0 / kBlock, end = (x1 + kBlock - 1) / kBlock;
  find_near_blocks(y, first, end);
  for (int block = first; block < end;) {
    int next = block + 1;
    const bool is_near = is_near_[static_cast<std::size_t>(block)] != 0;
    while (next < end && (is_near_[static_cast<std::size_t>(next)] != 0) == is_near) ++next;
    const int from = block * kBlock, to = std::min(next * kBlock, x1);
    if (is_near) {
      refresh_near(y, from, to, sink);
    } else {
      refresh_beyond(y, from, to, sink);
    }
    block = next;
  }
}

/// Sets is_near_ of the blocks [first, end) that a seed of a column nearby may reach.
void DistanceTracker::find_near_blocks(int y, int first, int end) {
  const int margin = (reach_ + kBlock - 1) / kBlock;
  const std::uint8_t* row = rows_.data() + geometry_.index({0, y});
  std::fill(is_near_.begin() + first, is_near_.begin() + end, std::uint8_t{0});
  const int last = std::min(end + margin, round_up(geometry_.width) / kBlock);
  for (int block = std::max(first - margin, 0); block < last; ++block) {
    const int x0 = block * kBlock, x1 = std::min(x0 + kBlock, geometry_.width);
    if (all_equal(row + x0, x1 - x0, static_cast<std::uint8_t>(reach_ + 1))) continue;
    const int from = std::max(block - margin, first), to = std::min(block + margin + 1, end);
    for (int near = from; near < to; ++near) is_near_[static_cast<std::size_t>(near)] = 1;
  }
}

void DistanceTracker::refresh_near(int y, int x0, int x1, DistanceSink& sink) {
  const int count = round_up(x1 - x0), from = x0 - reach_;
  const std::size_t row = geometry_.index({0, y});
  const int inside = std::max(from, 0), end = std::min(x0 + count + reach_, geometry_.width);
  std::fill_n(squares_.data(), inside - from, kNoSeed);
  square_rows(rows_.data() + row + inside, end - inside, reach_, squares_.data() + inside - from);
  std::fill(squares_.data() + end - from, squares_.data() + count + 2 * reach_, kNoSeed);
  least_squares_in_row(squares_.data(), count, reach_, static_cast<std::uint16_t>(beyond_),
                       result_.data());
  float* distance = distance_m_.data() + row + x0;
  for (int i = 0; i < x1 - x0; ++i) distance[i] = table_m_[result_[static_cast<std::size_t>(i)]];
  near_.insert_span(y, x0, x1);
  sink.take({y, x0, x1, result_.data()});
}

void DistanceTracker::refresh_beyond(int y, int x0, int x1, DistanceSink& sink) {
  float* distance = distance_m_.data() + geometry_.index({0, y});
  for (int x = x0; x < x1; x += kBlock) {
    if (!near_.contains(x, y)) continue;
    std::fill(distance + x, distance + std::min(x + kBlock, x1), max_distance_m_);
    near_.erase(x, y);
  }
  sink.take({y, x0, x1, nullptr});
}

}  // namespace trident::nav
