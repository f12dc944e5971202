// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "obstacle_survey.h"

#include <algorithm>
#include <cmath>

#include "trident_maps/distance_field.h"

namespace trident::nav {
namespace {

constexpr float kSqrt2 = 1.41421356F;

// From the rollouts' axes to cells.
struct CellMap {
  float offset_x, offset_y, cells_per_m;
  int width, height;
};

CellMap cell_map(const GridGeometry& geometry, const Pose2& origin) {
  return {static_cast<float>(origin.x - geometry.origin_x),
          static_cast<float>(origin.y - geometry.origin_y),
          static_cast<float>(1.0 / geometry.resolution), geometry.width, geometry.height};
}

// Index of the cell of each lane's circle; -1 outside of the grid.
TRIDENT_INLINE void find_cells(const CellMap& map, const CoverCircle& circle, const float* x,
                               const float* y, const float* cosine, const float* sine, int* cells) {
  for (int i = 0; i < kLanes; ++i) {
    const float px = x[i] + cosine[i] * circle.x - sine[i] * circle.y;
    const float py = y[i] + sine[i] * circle.x + cosine[i] * circle.y;
    // One is added and taken off so that what is just below the grid is not rounded into it.
    const int column = static_cast<int>((px + map.offset_x) * map.cells_per_m + 1.0F) - 1;
    const int row = static_cast<int>((py + map.offset_y) * map.cells_per_m + 1.0F) - 1;
    const bool is_in = (column >= 0) & (row >= 0) & (column < map.width) & (row < map.height);
    cells[i] = is_in ? row * map.width + column : -1;
  }
}

}  // namespace

ObstacleSurvey::ObstacleSurvey(const MppiModel& model, const FootprintChecker& checker,
                               const CostGrid& grid, const Pose2& origin, SurveyOptions options)
    : model_(model), checker_(checker), grid_(grid), origin_(origin), options_(options) {
  const auto inscribed = static_cast<float>(model.inscribed_radius);
  cover_ =
      options.considers_footprint ? model.cover : std::vector<CoverCircle>{{0.0F, 0.0F, inscribed}};
}

void ObstacleSurvey::clear_by_cover(const Rollouts& rollouts, int step, float* clearance) const {
  const CellMap map = cell_map(grid_.geometry, origin_);
  const float far = grid_.max_distance_m;
  std::fill(clearance, clearance + kLanes, far);
  for (const CoverCircle& circle : cover_) {
    run_lanes([&]() TRIDENT_LANES {
      int cells[kLanes];
      float distances[kLanes];
      find_cells(map, circle, rollouts.at(rollouts.x, step), rollouts.at(rollouts.y, step),
                 rollouts.at(rollouts.cosine, step), rollouts.at(rollouts.sine, step), cells);
      for (int i = 0; i < kLanes; ++i) {
        distances[i] = cells[i] >= 0 ? grid_.distance_m[cells[i]] : far;
      }
      for (int i = 0; i < kLanes; ++i) {
        clearance[i] = least(clearance[i], distances[i] - circle.radius);
      }
    });
  }
}

bool ObstacleSurvey::is_free(const Rollouts& rollouts, int step, int lane) const {
  const int i = step * kLanes + lane;
  return checker_.is_free(grid_, {origin_.x + static_cast<double>(rollouts.x[i]),
                                  origin_.y + static_cast<double>(rollouts.y[i]),
                                  static_cast<double>(rollouts.yaw[i])});
}

void ObstacleSurvey::check_exactly(int step, const float* clearance, Rollouts* rollouts) const {
  // Centers of cells stand for points and for squares, each up to half a diagonal away.
  const float unclear = kSqrt2 * static_cast<float>(grid_.geometry.resolution);
  for (int lane = 0; lane < kLanes; ++lane) {
    int& contact = rollouts->contact_step[lane];
    if (clearance[lane] > unclear || contact < rollouts->steps) continue;
    const bool is_hit =
        options_.considers_footprint ? !is_free(*rollouts, step, lane) : clearance[lane] <= 0.0F;
    if (is_hit) contact = step;
  }
}

void ObstacleSurvey::survey(Rollouts* rollouts) const {
  std::fill(rollouts->contact_step.begin(), rollouts->contact_step.end(), rollouts->steps);
  int filled = 0;
  for (int step = options_.step_stride - 1; filled < rollouts->steps;
       step += options_.step_stride) {
    step = std::min(step, rollouts->steps - 1);
    float* clearance = rollouts->at(rollouts->clearance, step);
    clear_by_cover(*rollouts, step, clearance);
    check_exactly(step, clearance, rollouts);
    for (; filled < step; ++filled) {
      std::copy(clearance, clearance + kLanes, rollouts->at(rollouts->clearance, filled));
    }
    filled = step + 1;
  }
}

void GridWithDistances::measure(const CostGrid& grid) {
  OccupancyGrid occupancy;
  occupancy.width = grid.geometry.width;
  occupancy.height = grid.geometry.height;
  occupancy.resolution = grid.geometry.resolution;
  for (std::size_t i = 0; i < grid.geometry.size(); ++i) {
    occupancy.cells.push_back(grid.cost[i] == kLethalCost ? OccupancyGrid::kOccupied
                                                          : OccupancyGrid::kFree);
  }
  const maps::DistanceField field(occupancy, kMaxDistance_m);
  distance_m_.clear();
  for (int y = 0; y < occupancy.height; ++y) {
    const auto row = field.padded().begin() + (y + 1) * field.stride() + 1;
    distance_m_.insert(distance_m_.end(), row, row + occupancy.width);
  }
  source_ = grid;
}

CostGrid GridWithDistances::of(const CostGrid& grid) {
  if (grid.distance_m != nullptr) return grid;
  const bool is_known = source_.cost == grid.cost && source_.revision == grid.revision &&
                        source_.geometry.size() == grid.geometry.size();
  if (!is_known) measure(grid);
  CostGrid result = grid;
  result.distance_m = distance_m_.data();
  result.max_distance_m = static_cast<float>(kMaxDistance_m);
  return result;
}

}  // namespace trident::nav
