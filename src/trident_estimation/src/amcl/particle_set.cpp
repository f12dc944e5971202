// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/particle_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "trident_base/angle.h"

namespace trident::estimation {
namespace {

// The bins of amcl's kd-tree: 0.5 m x 0.5 m x 10 degrees. The number of particles that KLD-sampling
// asks for depends on them, so that other bins would need other values of kld_err.
constexpr float kCellsPerM = 2.0F;
constexpr int kHeadings = 36;
constexpr float kHeadingsPerRad = static_cast<float>(kHeadings / (2.0 * kPi));
constexpr std::int64_t kOffset =
    1 << 23;  // keeps columns and rows positive: 4000 km in each direction

std::uint64_t key_of(std::int64_t column, std::int64_t row, std::int64_t heading) {
  return (static_cast<std::uint64_t>(column + kOffset) << 32) |
         (static_cast<std::uint64_t>(row + kOffset) << 8) | static_cast<std::uint64_t>(heading);
}

/// std::floor() of a float, without its call: this runs once per particle and axis.
int floored(float value) {
  const int towards_zero = static_cast<int>(value);
  return towards_zero - (static_cast<float>(towards_zero) > value ? 1 : 0);
}

}  // namespace

void ParticleSet::clear() {
  x.clear();
  y.clear();
  yaw.clear();
  weight.clear();
}

void ParticleSet::reserve(std::size_t count) {
  x.reserve(count);
  y.reserve(count);
  yaw.reserve(count);
  weight.reserve(count);
}

void ParticleSet::set_equal_weights() { weight.assign(size(), 1.0 / static_cast<double>(size())); }

double ParticleSet::normalize() {
  const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    set_equal_weights();
    return sum;
  }
  const double factor = 1.0 / sum;
  for (double& w : weight) w *= factor;
  return sum;
}

/// Kish's effective sample size.
double ParticleSet::effective_count() const {
  double squares = 0.0;
  for (const double w : weight) squares += w * w;
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

SE2 ParticleSet::pose(std::size_t i) const {
  return SE2::from_xy_yaw(static_cast<double>(x[i]), static_cast<double>(y[i]),
                          static_cast<double>(yaw[i]));
}

/// Sums about the first particle of a cell, so that nothing is lost to rounding far from zero.
struct PoseHistogram::Moments {
  double weight = 0.0, x = 0.0, y = 0.0, c = 0.0, s = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  std::size_t count = 0;

  void add(double w, double px, double py, double cosine, double sine) {
    ++count;
    weight += w;
    x += w * px;
    y += w * py;
    c += w * cosine;
    s += w * sine;
    xx += w * px * px;
    xy += w * px * py;
    yy += w * py * py;
  }
  void add(const Moments& other) {
    count += other.count;
    weight += other.weight;
    x += other.x;
    y += other.y;
    c += other.c;
    s += other.s;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
  }
  PoseCluster cluster(double x0, double y0) const {
    PoseCluster result;
    result.count = count;
    result.weight = weight;
    if (weight <= 0.0) return result;
    const double mx = x / weight, my = y / weight;
    result.T_grid_base = SE2::from_xy_yaw(x0 + mx, y0 + my, std::atan2(s, c));
    result.covariance(0, 0) = xx / weight - mx * mx;
    result.covariance(1, 1) = yy / weight - my * my;
    result.covariance(0, 1) = result.covariance(1, 0) = xy / weight - mx * my;
    // Circular variance; a mean resultant of one may round beyond it.
    const double resultant = std::min(std::hypot(s, c) / weight, 1.0);
    result.covariance(2, 2) =
        -2.0 * std::log(std::max(resultant, std::numeric_limits<double>::min()));
    return result;
  }
};

void PoseHistogram::reset(std::size_t most_particles) {
  std::size_t size = 64;
  while (size < 2 * most_particles) size *= 2;
  if (table_.size() < size) {
    table_.assign(size, 0);
  } else {
    std::fill(table_.begin(), table_.end(), 0U);
  }
  keys_.clear();
}

/// The slot that holds the key, or the empty one where it belongs.
std::uint32_t* PoseHistogram::slot_of(std::uint64_t key) {
  const std::size_t mask = table_.size() - 1;
  // Fibonacci hashing: the multiplier is 2^64 divided by the golden ratio; high bits mix best. At
  // most half of the slots are taken, so that linear probing ends soon.
  std::size_t at = (key * 0x9E3779B97F4A7C15ULL) >> 20;
  while (true) {
    std::uint32_t& slot = table_[at & mask];
    if (slot == 0 || keys_[slot - 1] == key) return &slot;
    ++at;
  }
}

std::uint32_t PoseHistogram::insert(float x, float y, float yaw) {
  const int heading = floored(yaw * kHeadingsPerRad) + kHeadings;
  const std::uint64_t key =
      key_of(floored(x * kCellsPerM), floored(y * kCellsPerM), heading % kHeadings);
  std::uint32_t* slot = slot_of(key);
  if (*slot == 0) {
    keys_.push_back(key);
    *slot = static_cast<std::uint32_t>(keys_.size());
  }
  return *slot - 1;
}

/// The first cell of each cell's group.
std::vector<std::uint32_t> PoseHistogram::join_neighbors() {
  std::vector<std::uint32_t> parent(keys_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t cell) {
    while (parent[cell] != cell) cell = parent[cell] = parent[parent[cell]];
    return cell;
  };
  for (std::uint32_t cell = 0; cell < keys_.size(); ++cell) {
    const auto column = static_cast<std::int64_t>(keys_[cell] >> 32) - kOffset;
    const auto row = static_cast<std::int64_t>((keys_[cell] >> 8) & 0xFFFFFF) - kOffset;
    const auto heading = static_cast<std::int64_t>(keys_[cell] & 0xFF);
    for (int neighbor = 0; neighbor < 27; ++neighbor) {
      const std::uint64_t key = key_of(column + neighbor % 3 - 1, row + neighbor / 3 % 3 - 1,
                                       (heading + neighbor / 9 - 1 + kHeadings) % kHeadings);
      const std::uint32_t slot = *slot_of(key);
      if (slot == 0) continue;
      const std::uint32_t a = root(cell), b = root(slot - 1);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t cell = 0; cell < parent.size(); ++cell) parent[cell] = root(cell);
  return parent;
}

/// Heading's mean and variance are circular (Mardia and Jupp, Directional Statistics, 2000): a
/// cluster about +-pi would average to 0 otherwise.
std::vector<PoseCluster> PoseHistogram::clusters(const ParticleSet& particles) {
  reset(particles.size());
  if (particles.size() == 0) return {};
  const auto x0 = static_cast<double>(particles.x[0]), y0 = static_cast<double>(particles.y[0]);
  std::vector<Moments> moments;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::uint32_t cell = insert(particles.x[i], particles.y[i], particles.yaw[i]);
    if (cell == moments.size()) moments.emplace_back();
    const float yaw = particles.yaw[i];
    moments[cell].add(particles.weight[i], static_cast<double>(particles.x[i]) - x0,
                      static_cast<double>(particles.y[i]) - y0, static_cast<double>(std::cos(yaw)),
                      static_cast<double>(std::sin(yaw)));
  }
  const std::vector<std::uint32_t> group = join_neighbors();
  for (std::size_t cell = 0; cell < moments.size(); ++cell) {
    if (group[cell] != cell) moments[group[cell]].add(moments[cell]);
  }
  std::vector<PoseCluster> result;
  for (std::size_t cell = 0; cell < moments.size(); ++cell) {
    if (group[cell] == cell) result.push_back(moments[cell].cluster(x0, y0));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
  return result;
}

/// The Wilson-Hilferty approximation of the chi-square quantile with k degrees of freedom, scaled
/// by 1 / (2 kld_err). One cell has no spread to measure and no bound follows from it.
std::size_t kld_sample_size(std::size_t cells, double kld_err, double kld_z) {
  if (cells <= 1) return std::numeric_limits<std::size_t>::max();
  const double k = static_cast<double>(cells) - 1.0;
  const double b = 2.0 / (9.0 * k);
  const double x = 1.0 - b + std::sqrt(b) * kld_z;
  return static_cast<std::size_t>(std::ceil(k / (2.0 * kld_err) * x * x * x));
}

}  // namespace trident::estimation
