// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_surface.h"

#include <algorithm>
#include <cmath>

#include "trident_sim/world.h"

namespace trident {
namespace {

constexpr std::size_t kTilesKept = 32;  ///< for sensors that are far from each other
constexpr double kFarthestWaves_m = 200.0, kFarPerHeight = 500.0;

bool same(const WaveComponent& a, const WaveComponent& b) {
  return a.amplitude_m == b.amplitude_m && a.omega_rad_s == b.omega_rad_s && a.k == b.k &&
         a.phase_rad == b.phase_rad && a.direction == b.direction;
}

}  // namespace

bool WaterSurface::find_sea() {
  const PortBoard& ports = world_.ports();
  if (seen_ports_ != ports.version()) {
    seen_ports_ = ports.version();
    port_ = ports.find_out<SeaSample>(kSeaPort);
  }
  sea_ = port_ != nullptr ? port_->value.sea : nullptr;
  tile_.reset();
  time_s_ = world_.time().seconds();
  return sea_ != nullptr;
}

double WaterSurface::ceiling_m() {
  if (!find_sea()) return -std::numeric_limits<double>::infinity();
  const auto* const waves = dynamic_cast<const WaveField*>(&sea_->water());
  if (waves == nullptr) return std::numeric_limits<double>::infinity();
  follow_waves(*waves);
  return waves->level_m(time_s_) + amplitudes_m_;
}

bool WaterSurface::follow(const Eigen::Vector3d& p_world_viewer) {
  if (!find_sea()) return false;
  const Eigen::Vector2d p = p_world_viewer.head<2>();
  const auto* const waves = dynamic_cast<const WaveField*>(&sea_->water());
  level_m_ = waves != nullptr ? waves->level_m(time_s_)
                              : sea_->water().column(p, {0.0, 0.0}, time_s_).elevation_m;
  low_m_ = high_m_ = 0.0;
  far_m_ = 0.0;
  if (waves == nullptr || !p.allFinite()) return true;
  follow_waves(*waves);
  if (maker_ != nullptr && strength_ > 0.0) find_tile(p);
  return true;
}

void WaterSurface::follow_waves(const WaveField& waves) {
  waves_ = &waves;
  fades_ = waves.fades();
  strength_ = waves.open_strength(time_s_);
  const std::vector<WaveComponent>& now = waves.components();
  if (std::equal(now.begin(), now.end(), seen_waves_.begin(), seen_waves_.end(), same) &&
      seen_params_.model == waves.params().model &&
      seen_params_.steepness == waves.params().steepness) {
    return;
  }
  seen_params_ = waves.params();
  seen_waves_ = now;
  amplitudes_m_ = 0.0;
  for (const WaveComponent& wave : now) amplitudes_m_ += std::abs(wave.amplitude_m);
  tiles_.clear();
  maker_.reset();
  const WaterPattern pattern = make_water_pattern(waves);
  if (pattern.n > 0) maker_ = std::make_unique<WaterTileMaker>(pattern);
}

void WaterSurface::find_tile(const Eigen::Vector2d& p_world_viewer) {
  const WaterTile::Key key = maker_->key_near(p_world_viewer, time_s_);
  const auto known = std::find_if(tiles_.begin(), tiles_.end(),
                                  [&](const auto& tile) { return tile->key() == key; });
  if (known != tiles_.end()) {
    std::rotate(known, known + 1, tiles_.end());
  } else {
    // The oldest is written over, where nobody else holds it.
    if (tiles_.size() < kTilesKept) {
      tiles_.push_back(std::make_shared<WaterTile>());
    } else {
      std::rotate(tiles_.begin(), tiles_.begin() + 1, tiles_.end());
      if (tiles_.back().use_count() > 1) tiles_.back() = std::make_shared<WaterTile>();
    }
    maker_->make(key, ++tiles_made_, *tiles_.back());
  }
  tile_ = tiles_.back();
  const double period_s = maker_->pattern().period_s;
  weight_ = static_cast<float>(
      std::clamp(time_s_ / period_s - static_cast<double>(key.period), 0.0, 1.0));
  // A trace more, so that rounding leaves nothing outside.
  constexpr double kSlack = 1.0 + 1e-5;
  low_m_ = std::min(0.0, static_cast<double>(tile_->bounds().low)) * strength_ * kSlack;
  high_m_ = std::max(0.0, static_cast<double>(tile_->bounds().high)) * strength_ * kSlack;
  far_m_ = std::max(kFarthestWaves_m, kFarPerHeight * (high_m_ - low_m_));
}

double WaterSurface::strength(const Eigen::Vector2d& p_world) const {
  return fades_ ? waves_->strength(p_world, time_s_) : strength_;
}

/// Looked at every few metres, over which the ground changes little where the water is deep enough
/// for waves in full; of a long way, far off, at so many places.
bool WaterSurface::fades_along(const Ray& ray, double t0, double t1) const {
  if (!fades_) return false;
  constexpr double kApart_m = 4.0, kMost = 8.0;
  const Eigen::Vector2d from = (ray.p_world_origin + t0 * ray.direction_world).head<2>();
  const Eigen::Vector2d way = (t1 - t0) * ray.direction_world.head<2>();
  const double parts = std::clamp(std::ceil(way.norm() / kApart_m), 1.0, kMost);
  for (double part = 0.0; part <= parts; part += 1.0) {
    if (strength(from + part / parts * way) < strength_) return true;
  }
  return false;
}

/// Of heights at a cell's corners, each with the strength of its place.
WaterSurface::Patch WaterSurface::faded(std::array<double, 4> corners, std::int64_t row,
                                        std::int64_t column) const {
  const WaterPattern& pattern = maker_->pattern();
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
  const Patch cell =
      patch(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column), fades_);
  const double p = u - row, q = v - column;
  return cell.h + cell.h_u * p + (cell.h_v + cell.h_uv * p) * q;
}

double WaterSurface::height_m(const Eigen::Vector2d& p_world) const {
  if (tile_ == nullptr) return level_m_;
  const WaterPattern& pattern = maker_->pattern();
  return level_m_ + cell_height(pattern.axis.dot(p_world) / pattern.cell_m,
                                pattern.across.dot(p_world) / pattern.cell_m);
}

Eigen::Vector2d WaterSurface::slope(const Eigen::Vector2d& p_world) const {
  if (tile_ == nullptr) return Eigen::Vector2d::Zero();
  const WaterPattern& pattern = maker_->pattern();
  const double u = pattern.axis.dot(p_world) / pattern.cell_m;
  const double v = pattern.across.dot(p_world) / pattern.cell_m;
  const double row = std::floor(u), column = std::floor(v);
  const Patch cell =
      patch(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column), fades_);
  return ((cell.h_u + cell.h_uv * (v - column)) * pattern.axis +
          (cell.h_v + cell.h_uv * (u - row)) * pattern.across) /
         pattern.cell_m;
}

Eigen::Vector3d WaterSurface::normal(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d s = slope(p_world);
  return Eigen::Vector3d(-s.x(), -s.y(), 1.0).normalized();
}

}  // namespace trident
