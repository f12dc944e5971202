// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/voxel_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../beams/ray_walk.h"

namespace trident::nav {
namespace {

constexpr int kLevels = 16;
constexpr std::uint32_t kUnknownColumn = 0x0000ffff;
// Fewer beams than this from one place hardly ever end in one voxel.
constexpr std::size_t kManyBeams = 1000;
constexpr double kFixed = 4294967296.0;  // 2^32

/// Both bits of the voxels from one level to another.
std::uint32_t both_bits(int from, int to) {
  const std::uint32_t levels = (2U << std::max(from, to)) - (1U << std::min(from, to));
  return levels | levels << kLevels;
}

int count_bits(std::uint32_t bits) { return __builtin_popcount(bits); }
int marked_count(std::uint32_t column) { return count_bits(column >> kLevels); }
int unknown_count(std::uint32_t column) {
  return count_bits((column ^ column >> kLevels) & 0xffffU);
}

}  // namespace

/// A beam in cells and levels, clipped to the voxels.
struct VoxelLayer::Beam {
  RayPart ray;
  double z, dz;
  bool is_open;  ///< Its last voxel is an obstacle.
  std::size_t end_cell;
  int end_level;
};

VoxelLayer::VoxelLayer(const LayerSetup& setup)
    : BeamLayer(setup, setup.params<Params>()),
      params_(setup.params<Params>()),
      unknown_threshold_(params_.unknown_threshold + kLevels - params_.z_voxels),
      columns_(kUnknownColumn) {}

void VoxelLayer::set_params(const Params& params) {
  set_beam_params(params);
  const bool is_other_volume = params.origin_z != params_.origin_z ||
                               params.z_resolution != params_.z_resolution ||
                               params.z_voxels != params_.z_voxels;
  params_ = params;
  unknown_threshold_ = params.unknown_threshold + kLevels - params.z_voxels;
  if (is_other_volume) forget({0, 0, geometry().width, geometry().height}, Side::kInside);
}

void VoxelLayer::resize(const GridGeometry& geometry) {
  BeamLayer::resize(geometry);
  columns_.resize(geometry);
  ends_.assign(geometry.size(), 0);
}

void VoxelLayer::clear_beams(const Observation& observation, const Reach& reach) {
  for (const BeamGroup& group : observation.groups) {
    const bool are_many = group.count >= kManyBeams;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const Beam beam = beam_to(group, observation.ends[i], reach);
      if (beam.ray.empty() || (are_many && !is_new_end(beam))) continue;
      clear_beam(beam);
    }
    for (const std::size_t cell : ended_) ends_[cell] = 0;
    ended_.clear();
  }
}

VoxelLayer::Beam VoxelLayer::beam_to(const BeamGroup& group, const BeamEnd& end,
                                     const Reach& reach) const {
  const GridGeometry& grid = geometry();
  const double dx = static_cast<double>(end.p.x()), dy = static_cast<double>(end.p.y());
  const double per_cell = 1.0 / grid.resolution, per_level = 1.0 / params_.z_resolution;
  Beam beam{{(group.origin.x() - grid.origin_x) * per_cell,
             (group.origin.y() - grid.origin_y) * per_cell, dx * per_cell, dy * per_cell},
            (group.origin.z() - params_.origin_z) * per_level,
            static_cast<double>(end.p.z()) * per_level,
            false,
            0,
            0};
  RayPart& ray = beam.ray;
  ray.clip_length(std::sqrt(dx * dx + dy * dy), reach.clear_from_m, reach.clear_to_m);
  const double z_end = group.origin.z() + static_cast<double>(end.p.z());
  const bool is_obstacle = z_end >= reach.low_m && z_end <= reach.high_m;
  constexpr double kInside = 1e-5;
  ray.clip(beam.z, beam.dz, kInside, params_.z_voxels - kInside);
  ray.clip_to(grid.width, grid.height);
  if (ray.empty()) return beam;
  beam.is_open = end.is_hit && reach.is_marking && is_obstacle && ray.t1 == 1.0;
  beam.end_cell = static_cast<std::size_t>(fast_floor(ray.y + ray.t1 * ray.dy) * grid.width +
                                           fast_floor(ray.x + ray.t1 * ray.dx));
  beam.end_level = static_cast<int>(beam.z + ray.t1 * beam.dz);
  return beam;
}

/// Beams from one place that end in one voxel pass the same voxels, but for parts of one: the first
/// stands for all.
bool VoxelLayer::is_new_end(const Beam& beam) {
  const std::uint32_t bit = 1U << (beam.end_level + (beam.is_open ? kLevels : 0));
  std::uint32_t& ends = ends_[beam.end_cell];
  if ((ends & bit) != 0) return false;
  if (ends == 0) ended_.push_back(beam.end_cell);
  ends |= bit;
  return true;
}

/// In each column the beam passes the levels from where it enters to where it leaves.
void VoxelLayer::clear_beam(const Beam& beam) {
  const RayPart& ray = beam.ray;
  const bool is_flat = std::abs(ray.dx) >= std::abs(ray.dy);
  const double along = is_flat ? ray.x : ray.y, d_along = is_flat ? ray.dx : ray.dy;
  const double from = beam.z + ray.t0 * beam.dz, to = beam.z + ray.t1 * beam.dz;
  const double first = along + ray.t0 * d_along;
  const double edge = static_cast<double>(fast_floor(first)) + (d_along > 0.0 ? 1.0 : 0.0);
  const double rise = d_along != 0.0 ? beam.dz / std::abs(d_along) : 0.0;  // per column
  const double low = std::min(from, to), high = std::max(from, to);
  const auto fixed = [&](double z) {
    return static_cast<std::int64_t>(std::clamp(z, low, high) * kFixed);
  };
  std::int64_t leave = d_along != 0.0 ? fixed(from + std::abs(edge - first) * rise) : fixed(to);
  const auto step = static_cast<std::int64_t>(rise * kFixed);
  const std::int64_t lowest = fixed(low), highest = fixed(high);
  int level = static_cast<int>(from);
  walk_cells(ray, geometry().width, beam.is_open, [&](std::size_t cell) {
    const int next = static_cast<int>(std::clamp(leave, lowest, highest) >> 32);
    clear_voxels(cell, both_bits(level, next));
    level = next;
    leave += step;
  });
}

void VoxelLayer::clear_voxels(std::size_t cell, std::uint32_t levels) {
  std::uint32_t& column = columns_.cells()[cell];
  if ((column & levels) == 0) return;
  column &= ~levels;
  if (marked_count(column) > params_.mark_threshold) return;
  set_cost(cell, unknown_count(column) <= unknown_threshold_ ? kFreeCost : kUnknownCost);
}

void VoxelLayer::mark_ends(const Observation& observation, const Reach& reach, double now_s) {
  const GridGeometry& grid = geometry();
  const double top = params_.origin_z + params_.z_voxels * params_.z_resolution;
  const float near = static_cast<float>(reach.mark_from_m * reach.mark_from_m);
  const float far = static_cast<float>(reach.mark_to_m * reach.mark_to_m);
  for (const BeamGroup& group : observation.groups) {
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const BeamEnd& end = observation.ends[i];
      const double z = group.origin.z() + static_cast<double>(end.p.z());
      if (!end.is_hit || z < reach.low_m || z > reach.high_m || z >= top) continue;
      const float square = end.p.squaredNorm();
      if (square < near || square >= far) continue;
      const Cell cell = grid.cell(group.origin.x() + static_cast<double>(end.p.x()),
                                  group.origin.y() + static_cast<double>(end.p.y()));
      if (!grid.contains(cell)) continue;
      // What is too low for the voxels but is an obstacle counts in the lowest.
      const double level = std::max((z - params_.origin_z) / params_.z_resolution, 0.0);
      mark_voxel(grid.index(cell), static_cast<int>(level), now_s);
    }
  }
}

void VoxelLayer::mark_voxel(std::size_t cell, int level, double now_s) {
  std::uint32_t& column = columns_.cells()[cell];
  column |= both_bits(level, level);
  if (marked_count(column) > params_.mark_threshold) mark(cell, now_s);
}

void VoxelLayer::keep_cell(std::size_t cell) { kept_columns_.push_back(columns_.cells()[cell]); }

void VoxelLayer::restore_cell(std::size_t cell, std::size_t index, double now_s) {
  const std::uint32_t marks = kept_columns_[index] >> kLevels;
  columns_.cells()[cell] |= marks | marks << kLevels;
  mark(cell, now_s);
  if (index + 1 == kept_columns_.size()) kept_columns_.clear();
}

void VoxelLayer::forget_cells(int y, int x0, int x1) {
  std::uint32_t* row = columns_.cells().data() + geometry().index({0, y});
  std::fill(row + x0, row + x1, kUnknownColumn);
}

void VoxelLayer::free_cells(int y, int x0, int x1) {
  std::uint32_t* row = columns_.cells().data() + geometry().index({0, y});
  std::fill(row + x0, row + x1, 0U);
}

TRIDENT_COSTMAP_LAYER(voxel_layer, "VoxelLayer", VoxelLayer)

}  // namespace trident::nav
