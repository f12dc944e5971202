// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trident_sim/world.h"

namespace trident::sim {
namespace {

/// For sensors that are far from each other; the most: for more of them than are kept from period
/// to period.
constexpr std::size_t kTilesKept = 32, kMaxTiles = 96;
constexpr std::size_t kShoresKept = 32;

bool same(const WaveComponent& a, const WaveComponent& b) {
  return a.amplitude_m == b.amplitude_m && a.omega_rad_s == b.omega_rad_s && a.k == b.k &&
         a.phase_rad == b.phase_rad && a.direction == b.direction;
}

}  // namespace

std::shared_ptr<const Sea> WaterTiles::find_sea() {
  const PortBoard& ports = world_.ports();
  if (seen_ports_ != ports.version()) {
    seen_ports_ = ports.version();
    port_ = ports.find_out<SeaSample>(kSeaPort);
  }
  return port_ != nullptr ? port_->value.sea : nullptr;
}

bool WaterTiles::has_laid(const WaveField& waves) const {
  const std::vector<WaveComponent>& now = waves.components();
  return std::equal(now.begin(), now.end(), seen_waves_.begin(), seen_waves_.end(), same) &&
         seen_params_.model == waves.params().model &&
         seen_params_.steepness == waves.params().steepness &&
         seen_params_.shore_depth == waves.params().shore_depth;
}

void WaterTiles::follow(const WaveField& waves) {
  if (has_laid(waves)) return;
  const std::vector<WaveComponent>& now = waves.components();
  seen_params_ = waves.params();
  seen_waves_ = now;
  amplitudes_m_ = 0.0;
  for (const WaveComponent& wave : now) amplitudes_m_ += std::abs(wave.amplitude_m);
  tiles_.clear();
  shores_.clear();
  makers_.clear();
  pattern_.reset();
  auto pattern = std::make_shared<const WaterPattern>(make_water_pattern(waves));
  if (pattern->n == 0) return;
  pattern_ = std::move(pattern);
}

std::shared_ptr<const WaterTile> WaterTiles::tile(const Eigen::Vector2d& p_world, double time_s) {
  const WaterTile::Key key = key_near(p_world, time_s);
  const auto known = std::find_if(tiles_.begin(), tiles_.end(),
                                  [&](const auto& tile) { return tile->key() == key; });
  if (known != tiles_.end()) {
    // The one that was used last is at the end; the first is the next to go.
    std::rotate(known, known + 1, tiles_.end());
  } else {
    tiles_.push_back(take_room(key.period));
    tiles_.back()->begin(key, ++tiles_made_);
    maker(0).make(*tiles_.back());
  }
  return tiles_.back();
}

/// Makes room for the tiles that are not there yet, and lists them as missing.
void WaterTiles::begin_missing(const std::vector<Eigen::Vector2d>& places, double time_s) {
  missing_.clear();
  for (const Eigen::Vector2d& place : places) {
    // What is too much at a time is made when it is asked for.
    if (!place.allFinite() || missing_.size() == kTilesKept) continue;
    const WaterTile::Key key = key_near(place, time_s);
    if (knows(key)) continue;
    tiles_.push_back(take_room(key.period));
    tiles_.back()->begin(key, ++tiles_made_);
    missing_.push_back(tiles_.back().get());
  }
}

void WaterTiles::prepare(const std::vector<Eigen::Vector2d>& places, WorkerPool& workers) {
  const std::shared_ptr<const Sea> sea = find_sea();
  if (sea == nullptr) return;
  const auto* const waves = dynamic_cast<const WaveField*>(&sea->water());
  if (waves == nullptr) return;
  follow(*waves);
  const double time_s = world_.time().seconds();
  if (pattern_ == nullptr || !(waves->open_strength(time_s) > 0.0)) return;
  begin_missing(places, time_s);
  for (std::size_t worker = 0; worker < workers.threads() && !missing_.empty(); ++worker) {
    maker(worker);
  }
  workers.share(missing_.size(),
                [this](std::size_t i, std::size_t worker) { makers_[worker]->make(*missing_[i]); });
}

/// The tile whose anchor is nearest to a place, at a time.
WaterTile::Key WaterTiles::key_near(const Eigen::Vector2d& p_world, double time_s) const {
  const auto nearest = [this](double along_m) {
    return static_cast<std::int64_t>(std::llround(along_m / pattern_->anchor_step_m));
  };
  return {nearest(pattern_->axis.dot(p_world)), nearest(pattern_->across.dot(p_world)),
          static_cast<std::int64_t>(std::floor(time_s / pattern_->period_s))};
}

bool WaterTiles::knows(const WaterTile::Key& key) const {
  return std::any_of(tiles_.begin(), tiles_.end(),
                     [&](const auto& tile) { return tile->key() == key; });
}

WaterTileMaker& WaterTiles::maker(std::size_t worker) {
  if (makers_.size() <= worker) makers_.resize(worker + 1);
  if (makers_[worker] == nullptr) makers_[worker] = std::make_unique<WaterTileMaker>(*pattern_);
  return *makers_[worker];
}

/// The oldest is written over, where nobody else holds it; one of the same period, which somebody
/// may look at in every step, only when they are many.
std::shared_ptr<WaterTile> WaterTiles::take_room(std::int64_t period) {
  const bool is_all_in_use =
      tiles_.size() < kMaxTiles && !tiles_.empty() && tiles_.front()->key().period == period;
  if (tiles_.size() < kTilesKept || is_all_in_use) return std::make_shared<WaterTile>();
  std::shared_ptr<WaterTile> oldest = std::move(tiles_.front());
  tiles_.erase(tiles_.begin());
  return oldest.use_count() == 1 ? oldest : std::make_shared<WaterTile>();
}

std::shared_ptr<const WaterShores> WaterTiles::shores(const WaveField& waves,
                                                      const WaterTile::Key& key, double level_m) {
  constexpr double kLevelStep_m = 0.1;
  // A tide moves the shores in steps; what they say holds for all levels of a step.
  const auto level = static_cast<std::int64_t>(std::floor(level_m / kLevelStep_m));
  const auto known = std::find_if(shores_.begin(), shores_.end(), [&](const auto& other) {
    return other->anchor_row == key.anchor_row && other->anchor_column == key.anchor_column &&
           other->level == level;
  });
  if (known != shores_.end()) {
    std::rotate(known, known + 1, shores_.end());
  } else {
    if (shores_.size() == kShoresKept) shores_.erase(shores_.begin());
    const double low_m = static_cast<double>(level) * kLevelStep_m;
    shores_.push_back(std::make_shared<const WaterShores>(
        make_shores(waves, key, level, {low_m, low_m + kLevelStep_m})));
  }
  return shores_.back();
}

/// Asks at points a few metres apart, between which the ground changes little where it is deep
/// enough for waves in full, or dry.
WaterShores WaterTiles::make_shores(const WaveField& waves, const WaterTile::Key& key,
                                    std::int64_t level, std::array<double, 2> levels_m) const {
  constexpr std::int64_t kPoints = 4;  // along a side of a square
  constexpr std::int64_t kSide = WaterShores::kSide;
  const double square_m = pattern_->cell_m * static_cast<double>(WaterShores::kCells);
  const auto first = [&](std::int64_t anchor) {
    const double squares = static_cast<double>(anchor) * pattern_->anchor_step_m / square_m;
    return static_cast<std::int64_t>(std::floor(squares)) - kSide / 2;
  };
  WaterShores made{key.anchor_row,        key.anchor_column,        level,
                   first(key.anchor_row), first(key.anchor_column), {}};
  std::vector<std::array<bool, 3>> found(static_cast<std::size_t>(kSide * kSide));
  const double apart_m = square_m / static_cast<double>(kPoints);
  for (std::int64_t i = 0; i <= kSide * kPoints; ++i) {
    for (std::int64_t j = 0; j <= kSide * kPoints; ++j) {
      const double u = apart_m * static_cast<double>(made.first_row * kPoints + i);
      const double v = apart_m * static_cast<double>(made.first_column * kPoints + j);
      const auto shore = static_cast<std::size_t>(
          waves.shore(u * pattern_->axis + v * pattern_->across, levels_m[0], levels_m[1]));
      // One on a border counts for all that join there.
      for (const std::int64_t row : {(i - 1) / kPoints, i / kPoints}) {
        for (const std::int64_t column : {(j - 1) / kPoints, j / kPoints}) {
          if (row >= kSide || column >= kSide) continue;
          found[static_cast<std::size_t>(row * kSide + column)][shore] = true;
        }
      }
    }
  }
  for (const auto& [fading, open, dry] : found) {
    using Shore = WaveField::Shore;
    const bool is_one = !fading && open != dry;
    made.squares.push_back(!is_one ? Shore::kFading : open ? Shore::kOpen : Shore::kDry);
  }
  return made;
}

}  // namespace trident::sim
