// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_estimation/amcl_params.h"
#include "trident_estimation/particle_set.h"
#include "trident_maps/distance_field.h"

namespace trident::estimation {

/// The beams of one scan that the filter uses.
struct ScanBeams {
  SE2 T_base_laser;           ///< as in the scan
  double range_max = 0.0;     ///< of the scan and `laser_max_range` [m]
  std::vector<double> angle;  ///< in the laser's frame [rad]
  std::vector<double> range;  ///< [m]; range_max: no return
  maps::ScanPoints points;    ///< of those that are returns

  /// Whether beam i hit something in range.
  bool is_return(std::size_t i) const { return range[i] < range_max; }
};

/// `laser_max_beams` beams, evenly from the whole scan. A range that is NaN is left out, one that
/// is too near, too far or infinite becomes "no return". `T_start_end` is the robot's motion from
/// the first beam to a beam after the last one: beams are put where they were measured from, as
/// seen from the robot's pose at the first one.
ScanBeams select_beams(const LaserScan& scan, const LaserModelParams& params,
                       const SE2& T_start_end = {});

/// Weighs particles by how well a map explains a scan from each.
class LaserModel2d {
 public:
  /// Computes the distance field, or two of them for the beam model; `grid` is not kept.
  LaserModel2d(const OccupancyGrid& grid, const LaserModelParams& params);

  /// Multiplies the weights, without normalising them. Returns the mean likelihood over the
  /// particles: the model's own for `beam` and `likelihood_field`, its geometric mean per beam for
  /// `likelihood_field_prob`, whose products over beams would differ by powers of ten from scan to
  /// scan.
  double weigh(const ScanBeams& beams, ParticleSet& particles);

  /// Distances to occupied cells, up to laser_likelihood_max_dist.
  const maps::DistanceField& field() const { return field_; }

 private:
  void prepare(const ScanBeams& beams, const ParticleSet& particles);
  void make_table(double range_max);
  void sum_over_beams(const ParticleSet& particles, std::size_t first_beam, std::size_t last_beam);
  double weigh_field(ParticleSet& particles) const;
  double weigh_prob(ParticleSet& particles);
  double weigh_beams(const ScanBeams& beams, ParticleSet& particles) const;
  double beam_likelihood(double measured, double expected, double range_max) const;
  void skip_beams(const ParticleSet& particles);
  bool is_converged(const ParticleSet& particles) const;

  LaserModelParams params_;
  maps::DistanceField field_;
  std::unique_ptr<maps::DistanceField>
      blocked_;                             ///< for the beam model: unknown cells stop beams, too
  double table_range_ = -1.0;               ///< that the table was made for [m]
  std::vector<float> table_;                ///< what a beam that ends in a cell adds; padded
  std::vector<float> beam_x_, beam_y_;      ///< ends in the robot's frame [cells]
  std::vector<float> sine_, cosine_, sum_;  ///< of each particle
};

}  // namespace trident::estimation
