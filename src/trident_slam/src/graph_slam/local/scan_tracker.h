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

namespace trident::slam {

/// How uncertain odometry is taken to be, per motion between two scans (standard deviations).
struct OdometryNoise {
  double distance_floor = 0.01;       ///< [m]
  double distance_per_metre = 0.15;   ///< wrong scale of the distance
  double distance_per_radian = 0.05;  ///< [m/rad]
  double yaw_floor = 0.005;           ///< [rad]
  double yaw_per_radian = 0.15;
  double yaw_per_metre = 0.03;  ///< [rad/m]

  double distance_sigma(double metres, double radians) const {
    return distance_floor + distance_per_metre * metres + distance_per_radian * radians;
  }
  double yaw_sigma(double metres, double radians) const {
    return yaw_floor + yaw_per_radian * radians + yaw_per_metre * metres;
  }
};

struct ScanTrackerOptions {
  OdometryNoise noise;
  LineMatchOptions line;
  double surfel_cell = 0.1;               ///< [m]
  double search_resolution = 0.05;        ///< of the correlative search [m]
  double smallest_inlier_fraction = 0.6;  ///< below this the pose is sought in a window
  double inlier_fraction_by_scans = 0.8;  ///< the same where scans alone tell the motion
  double lost_inlier_fraction = 0.5;      ///< below this it is sought in a wide one
  double search_motion = 0.3;             ///< moved farther than this: sought in a window, too [m]
  double search_turn = 0.3;               ///< [rad]
  double search_reach = 12.0;             ///< surfaces that the search knows [m]
};

/// Finds a scan's pose from a guess in the frame of the map.
using RefinePose =
    std::function<MatchResult(const PointScan& scan, const SE2& guess, const PosePrior& prior)>;

/// Keeps the newest scan's pose against the surfaces of the map so far. Parts of the map that may
/// have drifted away from here are hidden from it until a loop has been closed.
class ScanTracker {
 public:
  explicit ScanTracker(const ScanTrackerOptions& options)
      : options_(options), surfels_(options.surfel_cell) {}

  MatchResult track(const PointScan& scan, const OdometryMotion::Step& step);
  /// Takes the place of matching against the surfaces' lines.
  void set_refine(RefinePose refine) { refine_ = std::move(refine); }
  /// Of the motions that are told from now on, as a part of their way.
  void set_distance_noise(double per_metre) { options_.noise.distance_per_metre = per_metre; }
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
  MatchResult search(const PointScan& scan, const Guess& guess, const SearchWindow& window);
  /// `a` if it fits better, odometry counted, else `b`.
  static MatchResult better(const MatchResult& a, const MatchResult& b, const Guess& guess);
  const MaxPyramid& hits_about(const Eigen::Vector2d& p_map);

  ScanTrackerOptions options_;
  RefinePose refine_;
  SurfelMap surfels_;
  std::optional<MaxPyramid> hits_;  ///< of the surfels about `hits_centre_`, not quite the newest
  Eigen::Vector2d hits_centre_ = Eigen::Vector2d::Zero();
  int changes_ = 0;  ///< scans inserted
  int hits_changes_ = 0;
  SE2 T_map_base_;
  SE2 T_told_base_;   ///< motion by scans since odometry told a new pose
  SE2 T_before_now_;  ///< the last motion that a scan told of
};

}  // namespace trident::slam
