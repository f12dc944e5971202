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
      seen_params_.steepness == waves.params().steepness &&
      seen_params_.shore_depth == waves.params().shore_depth) {
    return;
  }
  seen_params_ = waves.params();
  seen_waves_ = now;
  amplitudes_m_ = 0.0;
  for (const WaveComponent& wave : now) amplitudes_m_ += std::abs(wave.amplitude_m);
  tiles_.clear();
  shores_.clear();
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
  if (fades_) find_shores();
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
  if (!fades_) return strength_;
  if (tile_ != nullptr) {
    const WaterPattern& pattern = maker_->pattern();
    const auto cell = [&](const Eigen::Vector2d& axis) {
      return static_cast<std::int64_t>(std::floor(axis.dot(p_world) / pattern.cell_m));
    };
    const WaveField::Shore ground = shore(cell(pattern.axis), cell(pattern.across));
    if (ground != WaveField::Shore::kFading) {
      return ground == WaveField::Shore::kOpen ? strength_ : 0.0;
    }
  }
  return waves_->strength(p_world, time_s_);
}

WaveField::Shore WaterSurface::shore(std::int64_t row, std::int64_t column) const {
  if (!fades_) return WaveField::Shore::kOpen;
  constexpr int kShift = 5;
  static_assert(std::int64_t{1} << kShift == kShoreCells, "as >> has it");
  const Shores& now = shores_.back();
  const std::int64_t i = (row >> kShift) - now.first_row, j = (column >> kShift) - now.first_column;
  if (i < 0 || j < 0 || i >= kShoreSide || j >= kShoreSide) return WaveField::Shore::kFading;
  return now.squares[static_cast<std::size_t>(i * kShoreSide + j)];
}

/// Asks at points a few metres apart, between which the ground changes little where it is deep
/// enough for waves in full, or dry.
void WaterSurface::find_shores() {
  constexpr double kLevelStep_m = 0.1;
  constexpr std::int64_t kPoints = 4;  // along a side of a square
  constexpr std::size_t kKept = 32;
  const WaterTile::Key& key = tile_->key();
  const auto level = static_cast<std::int64_t>(std::floor(level_m_ / kLevelStep_m));
  const auto known = std::find_if(shores_.begin(), shores_.end(), [&](const Shores& other) {
    return other.anchor_row == key.anchor_row && other.anchor_column == key.anchor_column &&
           other.level == level;
  });
  if (known != shores_.end()) {
    std::rotate(known, known + 1, shores_.end());
    return;
  }
  if (shores_.size() == kKept) shores_.erase(shores_.begin());
  const WaterPattern& pattern = maker_->pattern();
  const double square_m = pattern.cell_m * static_cast<double>(kShoreCells);
  const auto first = [&](std::int64_t anchor) {
    const double squares = static_cast<double>(anchor) * pattern.anchor_step_m / square_m;
    return static_cast<std::int64_t>(std::floor(squares)) - kShoreSide / 2;
  };
  Shores made{key.anchor_row,        key.anchor_column,        level,
              first(key.anchor_row), first(key.anchor_column), {}};
  std::vector<std::array<bool, 3>> found(static_cast<std::size_t>(kShoreSide * kShoreSide));
  const double low_m = static_cast<double>(level) * kLevelStep_m, high_m = low_m + kLevelStep_m;
  const double apart_m = square_m / static_cast<double>(kPoints);
  for (std::int64_t i = 0; i <= kShoreSide * kPoints; ++i) {
    for (std::int64_t j = 0; j <= kShoreSide * kPoints; ++j) {
      const double u = apart_m * static_cast<double>(made.first_row * kPoints + i);
      const double v = apart_m * static_cast<double>(made.first_column * kPoints + j);
      const auto shore = static_cast<std::size_t>(
          waves_->shore(u * pattern.axis + v * pattern.across, low_m, high_m));
      // One on a border counts for all that meet there.
      for (const std::int64_t row : {(i - 1) / kPoints, i / kPoints}) {
        for (const std::int64_t column : {(j - 1) / kPoints, j / kPoints}) {
          if (row >= kShoreSide || column >= kShoreSide) continue;
          found[static_cast<std::size_t>(row * kShoreSide + column)][shore] = true;
        }
      }
    }
  }
  for (const auto& [fading, open, dry] : found) {
    using Shore = WaveField::Shore;
    const bool is_one = !fading && open != dry;
    made.squares.push_back(!is_one ? Shore::kFading : open ? Shore::kOpen : Shore::kDry);
  }
  shores_.push_back(std::move(made));
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
  const Patch cell = patch_at(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column));
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
  const Patch cell = patch_at(static_cast<std::int64_t>(row), static_cast<std::int64_t>(column));
  return ((cell.h_u + cell.h_uv * (v - column)) * pattern.axis +
          (cell.h_v + cell.h_uv * (u - row)) * pattern.across) /
         pattern.cell_m;
}

Eigen::Vector3d WaterSurface::normal(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d s = slope(p_world);
  return Eigen::Vector3d(-s.x(), -s.y(), 1.0).normalized();
}

}  // namespace trident
