// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "trident_base/config_types.h"
#include "trident_base/laser_scan.h"
#include "trident_base/se3.h"
#include "trident_base/span.h"
#include "trident_nav/control/obstacle_tracker.h"
#include "trident_nav/control/robot_state.h"
#include "trident_nav/control/scan_clusters.h"

namespace trident::nav {

struct MovingObstacleParams {
  bool enabled = true;
  double report_timeout = 1.0;
  ClusterParams clusters;
  TrackerParams tracker;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "what moves in the scans is tracked, and avoided where it goes");
    ar.field("report_timeout", report_timeout, Range::positive(),
             "how long obstacles that others report last without a new report [s]");
    ar.field("clusters", clusters, "how scans are split into objects");
    ar.field("tracker", tracker, "how objects are followed");
  }
};

/// Heights within which a beam's end is an obstacle, in the costmap's frame [m].
struct HeightBand {
  double low_m = 0.0;
  double high_m = 2.0;
};

/// The ends of a scan's beams on the ground of the costmap's frame, each where the laser was at its
/// time. `T_costmap_laser`: its poses at equal distances in time from the first beam to the last,
/// at least one. Beams without a return, or that end outside of the heights, end nowhere.
ScanPoints scan_points(const LaserScan& scan, Span<const SE3> T_costmap_laser,
                       const HeightBand& heights);

/// What moves around the robot: objects tracked in the scans of any number of sources, and those
/// that others report. All in one frame, the local costmap's. Not thread-safe.
class MovingObstacles {
 public:
  explicit MovingObstacles(const MovingObstacleParams& params = {}) : params_(params) {}

  /// Begins again with other parameters.
  void set_params(const MovingObstacleParams& params);
  bool is_enabled() const { return params_.enabled; }

  /// Takes a scan of a source. Throws Error as ScanClusterer and ObstacleTracker do.
  void add_scan(const std::string& source, double stamp_s, const ScanPoints& scan);
  /// Takes obstacles that others report as they were at a time, in place of those of before.
  void set_reported(Tracks tracks, double stamp_s);

  /// What moves, at a time: that of the robot's state. Ids are unique among sources.
  Tracks at(double time_s);

 private:
  struct Source {
    ScanClusterer clusterer;
    ObstacleTracker tracker;
    double stamp_s;
  };

  MovingObstacleParams params_;
  std::map<std::string, Source> sources_;
  Tracks reported_;
  double reported_s_ = 0.0;
};

}  // namespace trident::nav
