// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_pattern.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 2.0 * kPi;
constexpr double kWavesOnTile = 8.0;
constexpr std::size_t kMinNodes = 256, kMaxNodes = 512;
constexpr double kCellsPerWave = 1.8;  ///< of the shortest, which are the lowest, too
/// (omega period)^2 / 8 is the error of the interpolation in time.
constexpr double kPhaseStep = 0.4;
constexpr double kAnchorsOnTile = 16.0;

/// Wavelengths of the highest and the shortest wave, and how fast the sea moves.
struct Scales {
  const WaveComponent* highest = nullptr;
  double longest_k = 0.0, omega_rms = 0.0;
};

Scales scales_of(const std::vector<WaveComponent>& waves) {
  Scales scales;
  double energy = 0.0, moving = 0.0;
  for (const WaveComponent& wave : waves) {
    if (!(wave.amplitude_m > 0.0)) continue;
    const double a2 = wave.amplitude_m * wave.amplitude_m;
    energy += a2;
    moving += a2 * wave.omega_rad_s * wave.omega_rad_s;
    scales.longest_k = std::max(scales.longest_k, wave.k);
    if (scales.highest == nullptr || wave.amplitude_m > scales.highest->amplitude_m) {
      scales.highest = &wave;
    }
  }
  if (energy > 0.0) scales.omega_rms = std::sqrt(moving / energy);
  return scales;
}

std::size_t nodes_for(double cells, std::size_t most) {
  std::size_t n = kMinNodes;
  while (n < most && static_cast<double>(n) < cells) n *= 2;
  return n;
}

FoldedWave fold(const WaveComponent& wave, const WaterPattern& pattern) {
  FoldedWave folded{};
  folded.wave = wave;
  folded.along = {wave.direction.dot(pattern.axis), wave.direction.dot(pattern.across)};
  const double step = kTurn / pattern.length_m;
  folded.row = static_cast<int>(std::lround(wave.k * folded.along.x() / step));
  folded.column = static_cast<int>(std::lround(wave.k * folded.along.y() / step));
  folded.k_tile = step * (folded.row * pattern.axis + folded.column * pattern.across);
  return folded;
}

}  // namespace

WaterPattern make_water_pattern(const WaveField& field) {
  const WaveParams& params = field.params();
  const Scales scales = scales_of(field.components());
  WaterPattern pattern;
  if (scales.highest == nullptr) return pattern;
  pattern.is_gerstner = params.model == WaveModel::kGerstner;
  pattern.axis = scales.highest->direction;
  if (params.spectrum == WaveSpectrum::kJonswap ||
      params.spectrum == WaveSpectrum::kPiersonMoskowitz) {
    pattern.axis = {std::cos(params.direction), std::sin(params.direction)};
  }
  pattern.across = {-pattern.axis.y(), pattern.axis.x()};
  pattern.length_m = kWavesOnTile * kTurn / scales.highest->k;
  const double cells = kCellsPerWave * pattern.length_m * scales.longest_k / kTurn;
  pattern.n = nodes_for(cells, pattern.is_gerstner ? kMinNodes : kMaxNodes);
  pattern.cell_m = pattern.length_m / static_cast<double>(pattern.n);
  pattern.period_s = kPhaseStep / scales.omega_rms;
  pattern.anchor_step_m = pattern.length_m / kAnchorsOnTile;
  const auto waves = static_cast<double>(field.components().size());
  for (const WaveComponent& wave : field.components()) {
    FoldedWave folded = fold(wave, pattern);
    // As WaveField has it: crests must not cross.
    folded.particle_amplitude_m = std::min(wave.amplitude_m, params.steepness / (wave.k * waves));
    const int most = static_cast<int>(pattern.n / 2) - 1;
    // What is shorter than two cells cannot be held.
    if (std::abs(folded.row) > most || std::abs(folded.column) > most) continue;
    pattern.waves.push_back(folded);
  }
  return pattern;
}

}  // namespace trident::sim
