// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Neighboring points of a scan that belong to one object.
struct ScanCluster {
  /// Of the circle over the chord between its ends; of a disc, up to 0.4 of its radius nearer to
  /// the sensor than its own [m].
  Point2 center;
  double radius_m = 0.0;  ///< Of the circle about the center that encloses its points.
  int points = 0;
  /// Something nearer, or the edge of the scan, hides an end: size and center are not what they
  /// seem.
  bool is_partial = false;
};

struct ClusterParams {
  double min_gap = 0.08;
  double incidence_angle = 0.17;
  int min_points = 3;
  double max_radius = 0.6;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_gap", min_gap, Range::positive(), "points that are nearer are one object's [m]");
    ar.field("incidence_angle", incidence_angle, Range{0.0, 1.5, true},
             "the flattest at which a surface is still seen as one [rad]");
    ar.field("min_points", min_points, Range::at_least(1.0), "of an object");
    ar.field("max_radius", max_radius, Range::positive(),
             "of an object; larger ones are walls [m]");
  }
};

/// A scan whose beams end at points of the costmap's frame, in the order of their angles.
struct ScanPoints {
  Point2 sensor;
  double angle_increment = 0.0;  ///< Between beams, without its sign [rad].
  bool is_full_turn = false;     ///< The first beam is next to the last one.
  std::vector<Point2> ends;      ///< Not finite: the beam saw nothing.
  double first_angle = 0.0;      ///< Direction of the first beam [rad].
  bool is_clockwise = false;     ///< Angles decrease from beam to beam.

  /// Whether a beam leads to a point, and ends there or beyond.
  bool sees(const Point2& point) const;
};

/// Splits scans where the distance between neighbors is greater than a surface at the flattest
/// angle would have. Borges and Aldon, "Line extraction in 2D range images for mobile robotics",
/// Journal of Intelligent and Robotic Systems 40 (2004), equation 5.
class ScanClusterer {
 public:
  explicit ScanClusterer(const ClusterParams& params) : params_(params) {}

  /// In the order of their angles; valid until the next call. Throws Error for a sensor or an
  /// angle increment that is not finite, and for an increment that is not positive.
  const std::vector<ScanCluster>& cluster(const ScanPoints& scan);

 private:
  struct Beam {
    std::size_t index;
    double range_m;
  };

  void collect_beams(const ScanPoints& scan);
  std::size_t first_beam(const ScanPoints& scan) const;
  bool is_break(const ScanPoints& scan, const Beam& a, const Beam& b) const;
  bool is_hidden(const ScanPoints& scan, const Beam& end, int direction) const;
  void add(const ScanPoints& scan, std::size_t first, std::size_t count);

  ClusterParams params_;
  std::vector<Beam> beams_;  ///< Those that saw something.
  std::vector<double> ranges_m_;
  std::vector<ScanCluster> clusters_;
};

}  // namespace trident::nav
