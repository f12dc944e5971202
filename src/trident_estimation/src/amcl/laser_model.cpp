// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/laser_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "amcl/fast_math.h"

namespace trident::estimation {
namespace {

constexpr double kConvergedWithin = 0.5;  // of all particles about their mean [m]
constexpr std::size_t kBlock = 64;        // beams whose cells are worked out at a time

/// What all beams of a particle need of the padded table.
struct TableView {
  const float* cells;
  float right, top;  // the last column and row
  int stride;
};

/// The cells in which beams end, from a particle at (x, y) [cells, padded] with that heading.
inline void cells_of(const TableView& table, float x, float y, float sine, float cosine,
                     const float* beam_x, const float* beam_y, std::size_t count, int* cells) {
  for (std::size_t i = 0; i < count; ++i) {
    float column = x + (cosine * beam_x[i] - sine * beam_y[i]);
    float row = y + (sine * beam_x[i] + cosine * beam_y[i]);
    column = column > 0.0F ? column : 0.0F;
    row = row > 0.0F ? row : 0.0F;
    column = column < table.right ? column : table.right;
    row = row < table.top ? row : table.top;
    cells[i] = static_cast<int>(row) * table.stride + static_cast<int>(column);
  }
}

inline float sum_of(const float* table, const int* cells, std::size_t count) {
  float a = 0.0F, b = 0.0F, c = 0.0F, d = 0.0F;  // four chains of additions, not one
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    a += table[cells[i]];
    b += table[cells[i + 1]];
    c += table[cells[i + 2]];
    d += table[cells[i + 3]];
  }
  for (; i < count; ++i) a += table[cells[i]];
  return (a + b) + (c + d);
}

double cube(double x) { return x * x * x; }

}  // namespace

/// Evenly over the whole scan, first and last beam included as amcl does. A return that deskewing
/// moves to the range limit is kept below it, as the limit stands for no return.
ScanBeams select_beams(const LaserScan& scan, const LaserModelParams& params,
                       const SE2& T_start_end) {
  ScanBeams beams;
  beams.T_base_laser = scan.T_base_laser;
  beams.points.p_base_laser = scan.T_base_laser.p;
  const double min = std::max(scan.range_min, params.laser_min_range);
  beams.range_max = params.laser_max_range > 0.0 ? std::min(scan.range_max, params.laser_max_range)
                                                 : scan.range_max;
  const auto most = static_cast<std::size_t>(params.laser_max_beams);
  const std::size_t step =
      scan.size() <= most ? 1 : std::max<std::size_t>(1, (scan.size() - 1) / (most - 1));
  const SE2::Tangent motion =
      T_start_end.log() / static_cast<double>(std::max<std::size_t>(1, scan.size()));
  const bool is_still = motion.isZero(0.0);
  const SE2 T_laser_base = scan.T_base_laser.inverse();
  for (std::size_t i = 0; i < scan.size(); i += step) {
    const auto range = static_cast<double>(scan.ranges[i]);
    if (std::isnan(range)) continue;
    const bool is_return = range > min && range < beams.range_max;
    const double reach = is_return ? range : beams.range_max;
    const Eigen::Vector2d p_laser(reach * std::cos(scan.angle(i)), reach * std::sin(scan.angle(i)));
    Eigen::Vector2d p_base = scan.T_base_laser * p_laser;
    if (!is_still) p_base = SE2::exp(motion * static_cast<double>(i)) * p_base;
    const Eigen::Vector2d seen = T_laser_base * p_base;
    beams.angle.push_back(std::atan2(seen.y(), seen.x()));
    beams.range.push_back(is_return ? std::min(seen.norm(), 0.999999 * beams.range_max)
                                    : beams.range_max);
    if (is_return) beams.points.p_base.push_back(p_base.cast<float>());
  }
  return beams;
}

/// The beam model casts rays, which unknown space stops, too; the likelihood field looks at ends
/// only.
LaserModel2d::LaserModel2d(const OccupancyGrid& grid, const LaserModelParams& params)
    : params_(params), field_(grid, params.laser_likelihood_max_dist) {
  if (params.laser_model_type != LaserModel::kBeam) return;
  blocked_ = std::make_unique<maps::DistanceField>(
      grid, params.laser_likelihood_max_dist, maps::DistanceField::Obstacles::kOccupiedOrUnknown);
}

/// Of each cell: the cube of a beam's likelihood there, whose sum over the beams is the likelihood
/// field's score (as amcl has it, ad hoc, and blunt on purpose), or its logarithm.
void LaserModel2d::make_table(double range_max) {
  if (range_max == table_range_) return;
  table_range_ = range_max;
  const std::vector<float>& distances = field_.padded();
  table_.resize(distances.size());
  const double denominator = 2.0 * params_.laser_sigma_hit * params_.laser_sigma_hit;
  const bool is_log = params_.laser_model_type == LaserModel::kLikelihoodFieldProb;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto d = static_cast<double>(distances[i]);
    const double likelihood =
        params_.laser_z_hit * std::exp(-d * d / denominator) + params_.laser_z_rand / range_max;
    table_[i] =
        static_cast<float>(is_log ? std::log(std::max(likelihood, 1e-30)) : cube(likelihood));
  }
}

void LaserModel2d::prepare(const ScanBeams& beams, const ParticleSet& particles) {
  const auto cells_per_m = static_cast<float>(1.0 / field_.resolution());
  beam_x_.clear();
  beam_y_.clear();
  for (const Eigen::Vector2f& p_base : beams.points.p_base) {
    beam_x_.push_back(p_base.x() * cells_per_m);
    beam_y_.push_back(p_base.y() * cells_per_m);
  }
  for (auto* values : {&sine_, &cosine_, &sum_}) values->resize(particles.size());
  fast::sines_cosines(particles.yaw.data(), particles.size(), sine_.data(), cosine_.data());
  std::fill(sum_.begin(), sum_.end(), 0.0F);
}

/// Adds to each particle's sum what the table has for the beams [first, last), kBlock at most.
void LaserModel2d::sum_over_beams(const ParticleSet& particles, std::size_t first_beam,
                                  std::size_t last_beam) {
  const auto cells_per_m = static_cast<float>(1.0 / field_.resolution());
  const TableView table{table_.data(), static_cast<float>(field_.width() + 1),
                        static_cast<float>(field_.height() + 1), field_.stride()};
  const std::size_t count = last_beam - first_beam;
  std::array<int, kBlock> cells;  // NOLINT: filled below
  for (std::size_t i = 0; i < particles.size(); ++i) {
    cells_of(table, particles.x[i] * cells_per_m + 1.0F, particles.y[i] * cells_per_m + 1.0F,
             sine_[i], cosine_[i], &beam_x_[first_beam], &beam_y_[first_beam], count, cells.data());
    sum_[i] += sum_of(table.cells, cells.data(), count);
  }
}

double LaserModel2d::weigh(const ScanBeams& beams, ParticleSet& particles) {
  if (params_.laser_model_type == LaserModel::kBeam) return weigh_beams(beams, particles);
  make_table(beams.range_max);
  prepare(beams, particles);
  const bool is_prob = params_.laser_model_type == LaserModel::kLikelihoodFieldProb;
  if (is_prob && params_.do_beamskip && is_converged(particles)) skip_beams(particles);
  for (std::size_t first = 0; first < beam_x_.size(); first += kBlock) {
    sum_over_beams(particles, first, std::min(first + kBlock, beam_x_.size()));
  }
  return is_prob ? weigh_prob(particles) : weigh_field(particles);
}

double LaserModel2d::weigh_field(ParticleSet& particles) const {
  double total = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double likelihood = 1.0 + static_cast<double>(sum_[i]);
    particles.weight[i] *= likelihood;
    total += particles.weight[i];
  }
  return total;
}

double LaserModel2d::weigh_prob(ParticleSet& particles) {
  if (beam_x_.empty()) return 1.0;
  const float best = *std::max_element(sum_.begin(), sum_.end());
  const double per_beam = 1.0 / static_cast<double>(beam_x_.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    mean += particles.weight[i] * std::exp(per_beam * static_cast<double>(sum_[i]));
    particles.weight[i] *= std::exp(static_cast<double>(sum_[i] - best));
  }
  return mean;
}

bool LaserModel2d::is_converged(const ParticleSet& particles) const {
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    x += static_cast<double>(particles.x[i]);
    y += static_cast<double>(particles.y[i]);
  }
  x /= static_cast<double>(particles.size());
  y /= static_cast<double>(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (std::abs(static_cast<double>(particles.x[i]) - x) > kConvergedWithin ||
        std::abs(static_cast<double>(particles.y[i]) - y) > kConvergedWithin) {
      return false;
    }
  }
  return true;
}

/// Leaves out the beams that too few particles explain: people, chairs, doors.
void LaserModel2d::skip_beams(const ParticleSet& particles) {
  const auto m_per_cell = static_cast<float>(field_.resolution());
  const auto near = static_cast<float>(params_.beam_skip_distance);
  const double least = params_.beam_skip_threshold * static_cast<double>(particles.size());
  std::vector<float> x, y;
  for (std::size_t beam = 0; beam < beam_x_.size(); ++beam) {
    const float bx = beam_x_[beam] * m_per_cell, by = beam_y_[beam] * m_per_cell;
    int explained = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const float d = field_.at(particles.x[i] + (cosine_[i] * bx - sine_[i] * by),
                                particles.y[i] + (sine_[i] * bx + cosine_[i] * by));
      explained += d < near ? 1 : 0;
    }
    if (explained <= least) continue;
    x.push_back(beam_x_[beam]);
    y.push_back(beam_y_[beam]);
  }
  const auto skipped = static_cast<double>(beam_x_.size() - x.size());
  if (skipped >= params_.beam_skip_error_threshold * static_cast<double>(beam_x_.size())) return;
  beam_x_ = std::move(x);
  beam_y_ = std::move(y);
}

/// Equations 6.4 to 6.11.
double LaserModel2d::beam_likelihood(double measured, double expected, double range_max) const {
  const double z = measured - expected;
  double p = params_.laser_z_hit *
             std::exp(-(z * z) / (2.0 * params_.laser_sigma_hit * params_.laser_sigma_hit));
  if (z < 0.0) {
    p += params_.laser_z_short * params_.laser_lambda_short *
         std::exp(-params_.laser_lambda_short * measured);
  }
  return p + (measured < range_max ? params_.laser_z_rand / range_max : params_.laser_z_max);
}

double LaserModel2d::weigh_beams(const ScanBeams& beams, ParticleSet& particles) const {
  double total = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const SE2 T_grid_laser = particles.pose(i) * beams.T_base_laser;
    double likelihood = 1.0;
    for (std::size_t beam = 0; beam < beams.range.size(); ++beam) {
      const double expected =
          blocked_->ray(T_grid_laser.p, T_grid_laser.angle + beams.angle[beam], beams.range_max);
      likelihood += cube(beam_likelihood(beams.range[beam], expected, beams.range_max));
    }
    particles.weight[i] *= likelihood;
    total += particles.weight[i];
  }
  return total;
}

}  // namespace trident::estimation
