// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "matchers/correlative_match.h"
#include "matchers/line_match.h"
#include "motion/odometry_motion.h"
#include "trident_slam/graph_slam_front_end.h"

namespace trident::slam {

/// How uncertain odometry is taken to be, per motion between two scans (standard deviations).
struct OdometryNoise {
  double distance_per_meter = 0.15;  ///< wrong scale of the distance
  double yaw_per_radian = 0.15;      ///< wrong scale of the rotation
  OdometryNoiseOptions other;        ///< what does not scale with its own kind of motion

  /// Of the position [m] after a motion.
  double distance_sigma(double meters, double radians) const {
    return other.distance_floor + distance_per_meter * meters + other.distance_per_radian * radians;
  }
  /// Of the heading [rad] after a motion.
  double yaw_sigma(double meters, double radians) const {
    return other.yaw_floor + yaw_per_radian * radians + other.yaw_per_meter * meters;
  }
};

/// What a ScanTracker needs of GraphSlamOptions.
struct ScanTrackerOptions {
  OdometryNoise noise;           ///< of the prediction
  LineMatchOptions line;         ///< of a match with the surfaces
  TrackingOptions tracking;      ///< when a match is accepted
  TrackingSearchOptions search;  ///< the search where it is not
};

/// Finds a scan's pose from a guess in the frame of the map.
using RefinePose =
    std::function<MatchResult(const PointScan& scan, const SE2& guess, const PosePrior& prior)>;

/// Keeps the newest scan's pose against the surfaces of the map so far. Parts of the map that may
/// have drifted away from here are hidden from it until a loop has been closed.
class ScanTracker {
 public:
  explicit ScanTracker(const ScanTrackerOptions& options)
      : options_(options), surfels_(options.tracking.surfel_cell) {}

  MatchResult track(const PointScan& scan, const OdometryMotion::Step& step);
  /// Takes the place of matching against the surfaces' lines.
  void set_refine(RefinePose refine) { refine_ = std::move(refine); }
  /// Of the motions that are reported from now on, as a fraction of their distance.
  void set_distance_noise(double per_meter) { options_.noise.distance_per_meter = per_meter; }
  /// Moves without a scan.
  void coast(const OdometryMotion::Step& step);
  /// Adds a scan to the surfaces, of which `owner` says to which part of the map it belongs.
  void insert(const SE2& T_map_base, const PointScan& scan, int owner) {
    surfels_.insert(T_map_base, scan, owner);
    ++changes_;
  }
  void hide(std::vector<char> hidden) { surfels_.set_hidden(std::move(hidden)); }
  /// How many of a scan's points lie on surfaces of each owner.
  std::vector<std::pair<int, int>> owners_under(const PointScan& scan) const;

  const SE2& T_map_base() const { return T_map_base_; }
  /// The motion up to the newest scan.
  const SE2& T_before_now() const { return T_before_now_; }
  void set_pose(const SE2& T_map_base) { T_map_base_ = T_map_base; }
  const SurfelMap& surfels() const { return surfels_; }
  void set_surfels(SurfelMap surfels) {
    surfels_ = std::move(surfels);
    hits_.reset();
  }
  const ScanTrackerOptions& options() const { return options_; }

 private:
  /// A pose before the scan, and its standard deviations.
  struct Guess {
    SE2 T_map_base;
    double s_p = 0.0;    ///< [m]
    double s_yaw = 0.0;  ///< [rad]
    bool is_by_wheels = false;

    PosePrior prior() const;
    /// Squared standard deviations from the guess.
    double squared_deviation(const SE2& T_map_base) const;
  };

  MatchResult refine(const PointScan& scan, const SE2& guess, const PosePrior& prior) const {
    return refine_ ? refine_(scan, guess, prior)
                   : match_lines(surfels_, scan, guess, prior, options_.line);
  }
  SE2 expected(const OdometryMotion::Step& step);
  Guess guess(const OdometryMotion::Step& step);
  MatchResult match(const PointScan& scan, const Guess& guess, bool is_firm) const;
  bool is_off_prior(const MatchResult& match, const Guess& guess) const;
  bool is_uncertain(const OdometryMotion::Step& step, const MatchResult& match) const;
  MatchResult search_near(const PointScan& scan, const Guess& guess, const MatchResult& best);
  MatchResult search_wide(const PointScan& scan, const Guess& guess, const MatchResult& best);
  SearchWindow near_window(const Guess& guess) const;
  MatchResult search(const PointScan& scan, const Guess& guess, const SearchWindow& window);
  /// `a` if it fits better, odometry counted, else `b`.
  MatchResult better(const MatchResult& a, const MatchResult& b, const Guess& guess) const;
  const MaxPyramid& hits_about(const Eigen::Vector2d& p_map);

  ScanTrackerOptions options_;
  RefinePose refine_;
  SurfelMap surfels_;
  std::optional<MaxPyramid> hits_;  ///< of the surfels about `hits_center_`, not quite the newest
  Eigen::Vector2d hits_center_ = Eigen::Vector2d::Zero();
  int changes_ = 0;  ///< scans inserted
  int hits_changes_ = 0;
  SE2 T_map_base_;
  SE2 T_reported_base_;  ///< motion by scans since odometry reported a new pose
  SE2 T_before_now_;     ///< the last motion that a scan showed
};

}  // namespace trident::slam
