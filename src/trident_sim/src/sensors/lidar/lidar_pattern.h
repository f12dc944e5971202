// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lidar_spec.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {

/// Where the beams of a lidar point, and when. A scan is a number of columns, one after the other;
/// the beams of a column are cast from one place, that of the sensor in the column's middle.
class LidarPattern {
 public:
  struct Beam {
    std::uint16_t ring = 0;
    double time_s = 0.0;  ///< since the column begins
  };

  virtual ~LidarPattern() = default;
  LidarPattern(const LidarPattern&) = delete;
  LidarPattern& operator=(const LidarPattern&) = delete;

  std::size_t columns() const { return columns_; }
  double column_period_s() const { return column_period_s_; }
  /// Of every column.
  const std::vector<Beam>& beams() const { return beams_; }
  /// Indices of the beams of a column in the order in which they are cast.
  const std::vector<std::size_t>& firing_order() const { return firing_order_; }
  /// Which beams lie close together: the same one of columns in a row, or those of a column.
  enum class Neighbors { kAcrossColumns, kWithinColumn };
  Neighbors neighbors() const { return neighbors_; }

  /// Directions of the beams of a column in the sensor's frame, of unit length.
  virtual void aim(std::uint64_t scan, std::size_t column, Eigen::Vector3d* directions) const = 0;

 protected:
  LidarPattern(std::size_t columns, double column_period_s, std::vector<Beam> beams,
               Neighbors neighbors);

 private:
  std::size_t columns_;
  double column_period_s_;
  std::vector<Beam> beams_;
  std::vector<std::size_t> firing_order_;
  Neighbors neighbors_;
};

/// What a pattern is made from. Of a snapshot all beams are cast at once.
struct PatternRequest {
  const LidarSpec& spec;
  double rate_hz;
  bool is_rolling;
};

/// The pattern that `<pattern>` names, of ours:
/// - "rings" (default): the `<scan>` of the sensor; rings by elevation, all turning about z.
///   `<elevations>` [rad], rising, stand in for an even spread of them; the beams of a column are
///   cast `<beamPeriod>` [s] apart (0) in the order of rings in `<firingOrder>` (rising).
///   Columns follow each other as the sensor turns, one turn a scan, and a beam's azimuth is that
///   of its own time.
/// - "rosette": two wedge prisms that turn at `<prism1Rpm>` (7294) and `<prism2Rpm>` (-4664) bend
///   the beam by half the cone's angle each; `<horizontal>` sets how many points a scan has and,
///   as its angles, -/+ half the cone. Phases run on from scan to scan, so that no scan repeats
///   another.
/// Throws Error that names element, value and legal range.
std::unique_ptr<LidarPattern> make_pattern(const PatternRequest& request,
                                           const PluginParams& params);

}  // namespace trident::sim
