// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_tile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>

namespace trident::sim {
namespace {

using Complex = std::complex<double>;

std::size_t wrapped(int i, std::size_t n) { return static_cast<std::size_t>(i) & (n - 1); }

/// Adds the real waves a and b of one wave number, so that the transform's real part is the sum of
/// all a and its imaginary part that of all b.
void add_pair(const FoldedWave& wave, Complex a, Complex b, ComplexGrid& grid) {
  const Complex i(0.0, 1.0);
  const auto add = [&](int row, int column, Complex value) {
    const std::size_t place = wrapped(row, grid.n) * grid.n + wrapped(column, grid.n);
    grid.re[place] += static_cast<float>(0.5 * value.real());
    grid.im[place] += static_cast<float>(0.5 * value.imag());
    grid.column_is_used[wrapped(column, grid.n)] = 1;
  };
  // A real wave needs its conjugate at the opposite
  // wave number; two real fields share one transform.
  add(wave.row, wave.column, a + i * b);
  add(-wave.row, -wave.column, std::conj(a) + i * std::conj(b));
}

void clear(ComplexGrid& grid) {
  std::fill(grid.re.begin(), grid.re.end(), 0.0F);
  std::fill(grid.im.begin(), grid.im.end(), 0.0F);
  std::fill(grid.column_is_used.begin(), grid.column_is_used.end(), 0);
}

int floor_of(float value) {
  const int cut = static_cast<int>(value);
  return cut - (value < static_cast<float>(cut) ? 1 : 0);
}

/// Where between which nodes a place lies, in cells.
struct Between {
  std::size_t i0, i1, j0, j1;  ///< rows, columns
  float p, q;

  Between(float row, float column, std::size_t n) {
    const int row0 = floor_of(row), column0 = floor_of(column);
    p = row - static_cast<float>(row0);
    q = column - static_cast<float>(column0);
    i0 = wrapped(row0, n) * n;
    i1 = wrapped(row0 + 1, n) * n;
    j0 = wrapped(column0, n);
    j1 = wrapped(column0 + 1, n);
  }
  float of(const std::vector<float>& values) const {
    const float low = values[i0 + j0] + q * (values[i0 + j1] - values[i0 + j0]);
    const float high = values[i1 + j0] + q * (values[i1 + j1] - values[i1 + j0]);
    return low + p * (high - low);
  }
};

WaterTile::Bounds joined(const WaterTile::Bounds& a, const WaterTile::Bounds& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace

void WaterTile::find_bounds() {
  const std::size_t side = n_ / kBoundSides[0], upper = n_ / kBoundSides[1];
  constexpr auto kSide = static_cast<std::size_t>(kBoundSides[0]);
  constexpr std::size_t kRatio = kBoundSides[1] / kBoundSides[0];
  // Of each node, then of the nodes of a square, with those on its far edges.
  bounds_[0].resize(side * side);
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      Bounds square{ends_[i * kSide * n_ + j * kSide][0], ends_[i * kSide * n_ + j * kSide][0]};
      for (std::size_t row = i * kSide; row <= (i + 1) * kSide; ++row) {
        const std::array<float, 2>* const nodes = &ends_[(row & (n_ - 1)) * n_];
        for (std::size_t column = j * kSide; column <= (j + 1) * kSide; ++column) {
          const std::array<float, 2>& node = nodes[column & (n_ - 1)];
          square = joined(square, {std::min(node[0], node[1]), std::max(node[0], node[1])});
        }
      }
      bounds_[0][i * side + j] = square;
    }
  }
  bounds_[1].resize(upper * upper);
  all_ = bounds_[0][0];
  for (std::size_t i = 0; i < upper * upper; ++i) {
    const std::size_t row = i / upper * kRatio, column = i % upper * kRatio;
    bounds_[1][i] = bounds_[0][row * side + column];
    for (std::size_t k = 0; k < kRatio * kRatio; ++k) {
      bounds_[1][i] =
          joined(bounds_[1][i], bounds_[0][(row + k / kRatio) * side + column + k % kRatio]);
    }
    all_ = joined(all_, bounds_[1][i]);
  }
}

/// Between nodes, and between both ends, slopes are means of those that nodes have.
void WaterTile::find_steepest() {
  // Lanes, as a single greatest would be searched for one by one.
  constexpr std::size_t kLanes = 16;
  const std::size_t floats = 2 * n_;
  const auto widen = [](std::array<float, kLanes>& greatest, const float* a, const float* b) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float step = std::abs(a[i] - b[i]);
      greatest[i] = step > greatest[i] ? step : greatest[i];
    }
  };
  std::array<float, kLanes> along{}, across{};
  // A row with its first nodes once more at its end.
  std::vector<float> here(floats + kLanes);
  for (std::size_t row = 0; row < n_; ++row) {
    std::memcpy(here.data(), &ends_[row * n_], floats * sizeof(float));
    std::copy_n(here.begin(), kLanes, here.begin() + static_cast<std::ptrdiff_t>(floats));
    const float* const next = ends_[((row + 1) & (n_ - 1)) * n_].data();
    for (std::size_t i = 0; i < floats; i += kLanes) {
      widen(along, next + i, &here[i]);
      widen(across, &here[i + 2], &here[i]);
    }
  }
  steepest_step_m_ = std::hypot(*std::max_element(along.begin(), along.end()),
                                *std::max_element(across.begin(), across.end()));
}

WaterTileMaker::WaterTileMaker(const WaterPattern& pattern)
    : pattern_(pattern),
      transform_(pattern.n),
      elevations_(pattern.n),
      displacements_(pattern.is_gerstner ? pattern.n : 0) {}

void WaterTileMaker::transform_elevations(const std::array<Moment, 2>& ends) {
  clear(elevations_);
  for (const FoldedWave& wave : pattern_.waves) {
    std::array<Complex, 2> values;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const double phase = wave.phase(ends[i].p_world_anchor, ends[i].time_s);
      values[i] = std::polar(wave.wave.amplitude_m, phase);
    }
    add_pair(wave, values[0], values[1], elevations_);
  }
  transform_(elevations_);
}

void WaterTileMaker::transform_displacements(const Moment& moment) {
  clear(displacements_);
  for (const FoldedWave& wave : pattern_.waves) {
    // sin(theta) = Re(-i exp(i theta))
    const Complex sine =
        Complex(0.0, -1.0) *
        std::polar(wave.particle_amplitude_m, wave.phase(moment.p_world_anchor, moment.time_s));
    add_pair(wave, wave.along.x() * sine, wave.along.y() * sine, displacements_);
  }
  transform_(displacements_);
}

/// Gerstner's heights at the nodes: those of the particles that are there now, whose places of rest
/// are searched for as WaveField does, in as many steps as the tile is worth.
void WaterTileMaker::bend(std::size_t end, WaterTile& tile) const {
  constexpr int kSteps = 4;
  const std::size_t n = pattern_.n;
  const auto per_m = static_cast<float>(1.0 / pattern_.cell_m);
  const std::vector<float>& heights = end == 0 ? elevations_.re : elevations_.im;
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < n; ++column) {
      const auto u = static_cast<float>(row), v = static_cast<float>(column);
      float along = displacements_.re[row * n + column],
            across = displacements_.im[row * n + column];
      for (int step = 1; step < kSteps; ++step) {
        const Between rest(u + per_m * along, v + per_m * across, n);
        along = rest.of(displacements_.re);
        across = rest.of(displacements_.im);
      }
      tile.ends_[row * n + column][end] =
          Between(u + per_m * along, v + per_m * across, n).of(heights);
    }
  }
}

void WaterTileMaker::make(WaterTile& tile) {
  const WaterTile::Key& key = tile.key();
  const Eigen::Vector2d anchor =
      pattern_.anchor_step_m * (static_cast<double>(key.anchor_row) * pattern_.axis +
                                static_cast<double>(key.anchor_column) * pattern_.across);
  const double begin_s = static_cast<double>(key.period) * pattern_.period_s;
  const std::array<Moment, 2> ends = {Moment{anchor, begin_s},
                                      Moment{anchor, begin_s + pattern_.period_s}};
  tile.n_ = pattern_.n;
  tile.ends_.resize(pattern_.n * pattern_.n);
  // Elevations at both ends of the period are the real and the imaginary part of one transform.
  transform_elevations(ends);
  if (pattern_.is_gerstner) {
    for (std::size_t end = 0; end < ends.size(); ++end) {
      transform_displacements(ends[end]);
      bend(end, tile);
    }
  } else {
    for (std::size_t i = 0; i < tile.ends_.size(); ++i) {
      tile.ends_[i] = {elevations_.re[i], elevations_.im[i]};
    }
  }
  tile.find_bounds();
  tile.find_steepest();
}

}  // namespace trident::sim
