// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "marine/environment/wave_field.h"

namespace trident::sim {

/// One wave of a sea, folded onto the wave numbers that a periodic tile can hold.
struct FoldedWave {
  WaveComponent wave;           ///< as the sea has it
  double particle_amplitude_m;  ///< Gerstner: amplitude of a particle's displacement along the wave
  Eigen::Vector2d k_tile;       ///< what it was folded to [1/m], in the world
  Eigen::Vector2d along;        ///< its direction in the tile's axes
  int row, column;              ///< the same as a whole number of waves on the tile, along its axes

  /// Phase at the world's origin of the folded wave, which has the true phase at `p_world_anchor`.
  double phase(const Eigen::Vector2d& p_world_anchor, double time_s) const {
    return wave.phase_rad - wave.omega_rad_s * time_s +
           (wave.k * wave.direction - k_tile).dot(p_world_anchor);
  }
};

/// How a sea is laid onto a square tile that repeats. The tile is eight of the sea's highest waves
/// long and lies along them, so that a regular sea, and a long-crested one across the waves, folds
/// without an error. Every wave keeps its amplitude and frequency; its wave number is rounded to
/// the tile's, by up to pi / length along each axis. At distance d from the anchor, where phases
/// are true, heights are therefore off by a standard deviation of 1.8 d / length times that of the
/// sea itself (for d << length), and unrelated to it where that reaches one.
struct WaterPattern {
  std::size_t n = 0;  ///< nodes along a side, a power of two
  double length_m = 0.0, cell_m = 0.0;
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();    ///< the rows' direction in the world
  Eigen::Vector2d across = Eigen::Vector2d::UnitY();  ///< the columns'
  /// Tiles are made for whole multiples of it; between them heights are interpolated, which is off
  /// by 2 % of the sea's standard deviation at most.
  double period_s = 0.0;
  /// Anchors lie on a grid of this step, so that what is near each other sees one and the same
  /// water.
  double anchor_step_m = 0.0;
  bool is_gerstner = false;
  std::vector<FoldedWave> waves;
};

/// n = 0: no waves.
WaterPattern make_water_pattern(const WaveField& field);

}  // namespace trident::sim
