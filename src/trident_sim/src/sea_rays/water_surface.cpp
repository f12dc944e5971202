// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_surface.h"

#include <algorithm>
#include <cmath>

#include "trident_sim/world.h"

namespace trident::sim {
namespace {

constexpr double kFarthestWaves_m = 200.0, kFarPerHeight = 500.0;

}  // namespace

bool WaterSurface::follow(const Eigen::Vector3d& p_world_viewer) {
  tile_.reset();
  waves_ = nullptr;
  fades_ = false;
  strength_ = 1.0;
  low_m_ = high_m_ = far_m_ = steepest_.open = steepest_.fading = 0.0;
  time_s_ = tiles_->world().time().seconds();
  sea_ = tiles_->find_sea();
  if (sea_ == nullptr) return false;
  const Eigen::Vector2d p = p_world_viewer.head<2>();
  waves_ = dynamic_cast<const WaveField*>(&sea_->water());
  level_m_ = waves_ != nullptr ? waves_->level_m(time_s_)
                               : sea_->water().column(p, {0.0, 0.0}, time_s_).elevation_m;
  if (waves_ == nullptr || !p.allFinite()) return true;
  tiles_->follow(*waves_);
  pattern_ = tiles_->pattern();
  fades_ = waves_->fades();
  strength_ = waves_->open_strength(time_s_);
  if (pattern_ != nullptr && strength_ > 0.0) find_tile(p);
  return true;
}

void WaterSurface::find_tile(const Eigen::Vector2d& p_world_viewer) {
  tile_ = tiles_->tile(p_world_viewer, time_s_);
  if (fades_) shores_ = tiles_->shores(*waves_, tile_->key(), level_m_);
  // Heights between the two ends of a tile's period are interpolated.
  weight_ = static_cast<float>(std::clamp(
      time_s_ / pattern_->period_s - static_cast<double>(tile_->key().period), 0.0, 1.0));
  // A trace more, so that rounding leaves nothing outside.
  constexpr double kSlack = 1.0 + 1e-5;
  low_m_ = std::min(0.0, static_cast<double>(tile_->bounds().low)) * strength_ * kSlack;
  high_m_ = std::max(0.0, static_cast<double>(tile_->bounds().high)) * strength_ * kSlack;
  far_m_ = std::max(kFarthestWaves_m, kFarPerHeight * (high_m_ - low_m_));
  const double per_m = strength_ * kSlack / pattern_->cell_m;
  steepest_.open = per_m * static_cast<double>(tile_->steepest_step_m());
  steepest_.fading =
      fades_ ? std::sqrt(2.0) * (high_m_ - low_m_) / pattern_->cell_m : steepest_.open;
}

double WaterSurface::strength(const Eigen::Vector2d& p_world) const {
  if (!fades_) return strength_;
  if (tile_ != nullptr) {
    const WaterPattern& pattern = *pattern_;
    const auto cell = [&](const Eigen::Vector2d& axis) {
      return floor_of(axis.dot(p_world) / pattern.cell_m);
    };
    const WaveField::Shore ground = shore(cell(pattern.axis), cell(pattern.across));
    if (ground != WaveField::Shore::kFading) {
      return ground == WaveField::Shore::kOpen ? strength_ : 0.0;
    }
  }
  return waves_->strength(p_world, time_s_);
}

/// Of heights at a cell's corners, each with the strength of its place.
WaterSurface::Patch WaterSurface::faded(std::array<double, 4> corners, std::int64_t row,
                                        std::int64_t column) const {
  const WaterPattern& pattern = *pattern_;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto u = static_cast<double>(row + (i == 1 || i == 3 ? 1 : 0));
    const auto v = static_cast<double>(column + (i >= 2 ? 1 : 0));
    corners[i] *= strength(pattern.cell_m * (u * pattern.axis + v * pattern.across));
  }
  const auto [h00, h10, h01, h11] = corners;
  return {h00, h10 - h00, h01 - h00, (h00 - h10) - (h01 - h11)};
}

double WaterSurface::cell_height(double u, double v) const {
  const double row = std::floor(u), column = std::floor(v);
  const Patch cell = patch_at(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column));
  const double p = u - row, q = v - column;
  return cell.h + cell.h_u * p + (cell.h_v + cell.h_uv * p) * q;
}

double WaterSurface::height_m(const Eigen::Vector2d& p_world) const {
  if (tile_ == nullptr) return level_m_;
  const WaterPattern& pattern = *pattern_;
  return level_m_ + cell_height(pattern.axis.dot(p_world) / pattern.cell_m,
                                pattern.across.dot(p_world) / pattern.cell_m);
}

Eigen::Vector2d WaterSurface::slope(const Eigen::Vector2d& p_world) const {
  if (tile_ == nullptr) return Eigen::Vector2d::Zero();
  const WaterPattern& pattern = *pattern_;
  const double u = pattern.axis.dot(p_world) / pattern.cell_m;
  const double v = pattern.across.dot(p_world) / pattern.cell_m;
  const double row = std::floor(u), column = std::floor(v);
  const Patch cell = patch_at(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column));
  return ((cell.h_u + cell.h_uv * (v - column)) * pattern.axis +
          (cell.h_v + cell.h_uv * (u - row)) * pattern.across) /
         pattern.cell_m;
}

Eigen::Vector3d WaterSurface::normal(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d s = slope(p_world);
  return Eigen::Vector3d(-s.x(), -s.y(), 1.0).normalized();
}

}  // namespace trident::sim
