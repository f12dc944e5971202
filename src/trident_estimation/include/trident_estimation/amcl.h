// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/random_stream.h"
#include "trident_estimation/amcl_params.h"
#include "trident_estimation/laser_model.h"
#include "trident_estimation/motion_model.h"
#include "trident_estimation/particle_set.h"
#include "trident_maps/grid_matcher.h"

namespace trident::estimation {

/// Where the robot is believed to be.
struct PoseEstimate {
  SE2 T_map_base;  ///< mean of the heaviest cluster of particles
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x [m], y [m], yaw [rad]) in map
  double cluster_weight = 0.0;                           ///< share of the belief in that cluster
  std::size_t clusters = 0;                              ///< groups of particles that hang together
  std::size_t particles = 0;                             ///< in all of them
  /// Share of the last scan's beams that the map explains from there, among those that it can
  /// judge, see maps::scan_agreement().
  double agreement = 0.0;
};

/// What a scan led to.
struct AmclStep {
  bool is_updated = false;     ///< false: the robot has not moved enough
  bool is_resampled = false;   ///< every resample_interval updates
  bool is_searched = false;    ///< the scan was looked for in the whole map
  std::size_t hypotheses = 0;  ///< places in the whole map that got particles because of this scan
  std::string problem;         ///< empty, or one line on what was wrong with the input
};

/// Adaptive Monte Carlo localisation in a known map (Fox 2003; "Probabilistic Robotics", 8.3) with
/// the parameters of the package amcl. A lost robot is found again by two methods: by random
/// particles when the mean weight drops (recovery_alpha_*), and, when the scan disagrees with the
/// map at the estimate, by particles at the places that branch and bound finds for the scan; which
/// of them is right the next scans decide. No clock and no threads: equal calls give equal poses,
/// to the bit.
class Amcl {
 public:
  /// Throws Error for a map without a free cell.
  Amcl(const AmclParams& params, const OccupancyGrid& map);
  ~Amcl();

  /// Spreads `max_particles` about a pose. Throws Error unless all is finite and the covariance
  /// (of x [m], y [m], yaw [rad]) symmetric and not negative.
  void set_pose(const SE2& T_map_base, const Eigen::Matrix3d& covariance);

  /// Spreads `max_particles` evenly over all free cells and headings; the next scan is looked for
  /// in the whole map, too.
  void set_anywhere();

  /// The next scan is used even if the robot has not moved.
  void force_update() { is_forced_ = true; }

  /// `T_odom_base`: odometry at the scan's stamp; `T_start_end`: the robot's motion while the scan
  /// was taken, for scanners that turn slowly (see select_beams). Input that is not usable changes
  /// nothing and is reported in `problem`; a jump of odometry is taken out of it.
  AmclStep update(const LaserScan& scan, const SE2& T_odom_base, const SE2& T_start_end = {});

  /// Odometry starts again: the next scan is used without motion since the last one.
  void forget_odometry();

  /// After the last update(), set_pose() or set_anywhere().
  const PoseEstimate& estimate() const { return estimate_; }
  std::size_t particle_count() const { return particles_.size(); }  ///< follows KLD-sampling
  /// A particle's pose in the map, and its weight.
  SE2 particle(std::size_t i) const { return free_space_.T_map_origin * particles_.pose(i); }
  /// All of them sum up to one.
  double weight(std::size_t i) const { return particles_.weight[i]; }

 private:
  /// Where poses may be drawn in the whole map.
  struct FreeSpace {
    SE2 T_map_origin;
    std::vector<std::uint32_t> cells;
    int width;
    double resolution;
  };
  struct Draws {
    RandomStream stream;
    std::uint64_t count = 0;  ///< numbers everything that draws random numbers
  };
  struct Resampling {
    std::vector<double> cumulative;
    std::vector<std::uint32_t> guide;  ///< where a search of `cumulative` begins
    int updates_since = 0;
  };
  struct LastOdometry {
    std::optional<SE2> used;  ///< of the last update
    std::optional<SE2> seen;  ///< of the last scan
  };
  /// The search for a robot that is lost.
  struct Recovery {
    int patience;               ///< disagreement that leads to a search; doubled by one in vain
    double disagreement = 0.0;  ///< of updates in a row, each 0 ... 1
    bool is_anywhere = false;   ///< look for the next scan in the whole map
  };
  /// Of augmented MCL (Thrun, Burgard and Fox, "Probabilistic Robotics", section 8.3.5).
  struct MeanWeights {
    double slow = 0.0, fast = 0.0;
  };

  bool has_moved(const SE2& T_odom_base) const;
  void remove_jump(const SE2& T_odom_base, AmclStep& step);
  void note_mean_weight(double mean_weight);
  double random_share() const;
  void resample();
  bool resample_when_due();
  void make_guide();
  std::size_t chosen(double u) const;
  void push_random_pose(ParticleSet& particles, std::uint64_t number);
  void draw(double share_of_random, std::uint64_t number);
  bool is_search_due();
  void recover(const ScanBeams& beams, AmclStep& step);
  void inject(const std::vector<maps::PoseHypothesis>& hypotheses, const ScanBeams& beams);
  void update_estimate();
  double agreement(const ScanBeams& beams) const;

  AmclParams params_;
  FreeSpace free_space_;
  maps::KnownSpace known_;
  LaserModel2d laser_;
  MotionModel motion_;
  std::unique_ptr<maps::GridMatcher> matcher_;  ///< only if it is wanted
  Draws random_;

  ParticleSet particles_, next_;
  PoseHistogram histogram_;
  Resampling resampling_;
  PoseEstimate estimate_;
  LastOdometry T_odom_;
  bool is_forced_ = false;
  Recovery recovery_;
  MeanWeights mean_weights_;
};

}  // namespace trident::estimation
