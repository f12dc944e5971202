// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// A landmark as seen from the robot.
struct PointObservation {
  Eigen::Vector2d p_base = Eigen::Vector2d::Zero();                 ///< [m]
  Eigen::Matrix2d covariance = 0.04 * Eigen::Matrix2d::Identity();  ///< of p_base [m^2]
};

/// Gates, noise of the odometry's systematic errors and life of a landmark. A landmark that is in
/// view (`view_range`, `view_half_angle`) and is not seen counts as missed.
struct EkfSlamParams {
  double match_probability = 0.999;   ///< share of true pairs that the gate lets pass
  double new_probability = 0.999999;  ///< what lies outside this of every landmark is a new one
  double new_distance = 2.0;          ///< [m] and at least this far from every landmark
  double yaw_scale_sigma = 0.1;       ///< of the odometry's share of error in turning
  double curvature_sigma = 0.01;      ///< [rad/m] of its yaw drift over distance
  double yaw_scale_walk = 0.02;       ///< [1/sqrt(m)] how fast that share changes
  double curvature_walk = 0.0003;     ///< [rad/m/sqrt(m)] how fast that drift changes
  double observation_sigma = 0.0;     ///< [m] of each coordinate; 0: that of each observation
  int max_pairings = 4000;            ///< joint hypotheses tried per scan before the best is taken
  int confirm_sightings = 3;          ///< a landmark seen less often may be forgotten
  int forget_misses = 8;              ///< times it was in view, unseen, until it is
  double view_range = 25.0;           ///< [m] within which a landmark should be seen
  double view_half_angle = 1.2;       ///< [rad] from straight ahead, see above

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& archive) {
    archive.field("match_probability", match_probability, Range{0.0, 1.0, true, true},
                  "share of true pairs that the gate lets pass");
    archive.field("new_probability", new_probability, Range{0.0, 1.0, true, true},
                  "what lies outside this of every landmark is a new one");
    archive.field("new_distance", new_distance, Range::non_negative(),
                  "and is at least this far from every landmark [m]");
    archive.field("yaw_scale_sigma", yaw_scale_sigma, Range::non_negative(),
                  "of the odometry's share of error in turning");
    archive.field("curvature_sigma", curvature_sigma, Range::non_negative(),
                  "of the odometry's yaw drift over distance [rad/m]");
    archive.field("yaw_scale_walk", yaw_scale_walk, Range::non_negative(),
                  "how fast that share of error changes, per root metre");
    archive.field("curvature_walk", curvature_walk, Range::non_negative(),
                  "how fast that drift changes, per root metre [rad/m]");
    archive.field("observation_sigma", observation_sigma, Range::non_negative(),
                  "of each coordinate; 0: that of each observation [m]");
    archive.field("max_pairings", max_pairings, Range::at_least(1),
                  "joint hypotheses tried per scan");
    archive.field("confirm_sightings", confirm_sightings, Range::at_least(1),
                  "a landmark seen less often may be forgotten");
    archive.field("forget_misses", forget_misses, Range::at_least(1),
                  "times that it was in view, unseen, until it is forgotten");
    archive.field("view_range", view_range, Range::non_negative(), "of the sensor [m]");
    archive.field("view_half_angle", view_half_angle, Range{0.0, 3.15},
                  "of the sensor, from straight ahead [rad]");
  }
  /// Throws Error.
  void validate() const;
};

/// One observation that could be of one landmark.
struct LandmarkPair {
  std::size_t observed = 0;  ///< index of the observation
  std::size_t landmark = 0;  ///< index of the landmark
  double distance2 = 0.0;    ///< squared Mahalanobis distance of this pair alone
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();  ///< seen - expected, in the base frame [m]
  Eigen::Matrix<double, 2, 5> H;  ///< of the expectation by (x, y, yaw) and the landmark's (x, y)
};

/// Simultaneous localisation and mapping of point landmarks by an extended Kalman filter over the
/// robot's pose, two systematic errors of its odometry (both slow random walks: the share by which
/// it misjudges turns, and its yaw drift per metre) and all landmarks (Smith, Self, Cheeseman
/// 1990), with joint compatibility branch and bound for data association (Neira and Tardos 2001):
/// of all sets of pairs that are jointly within the chi-square gate, the largest and of those the
/// nearest is taken.
class EkfSlam {
 public:
  static constexpr int kRobotStates = 5;  ///< x, y, yaw; yaw scale error, yaw drift [rad/m]
  static constexpr int kAmbiguous = -1;   ///< neither a known landmark nor surely a new one

  /// A landmark as it is known now.
  struct Landmark {
    int id = 0;                                            ///< never used again
    Eigen::Vector2d p_map = Eigen::Vector2d::Zero();       ///< [m]
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of p_map [m^2]
    int sightings = 0;  ///< observations that were paired with it
  };

  /// Throws Error for parameters out of range.
  explicit EkfSlam(EkfSlamParams params = {});

  /// The robot moved by T_before_now; `covariance` is of (x, y, yaw) of that motion, in the frame
  /// before it. Throws Error for what is not finite.
  void predict(const SE2& T_before_now, const Eigen::Matrix3d& covariance);

  /// Corrects by what was seen at one moment. Returns the id of each observation's landmark, or
  /// kAmbiguous (then it was not used). Observations that are not finite are kAmbiguous.
  std::vector<int> observe(const std::vector<PointObservation>& observations);

  /// As `observe`, with known association of landmarks; ids that are not known yet are new ones.
  void observe_known(const std::vector<PointObservation>& observations,
                     const std::vector<int>& ids);

  /// Mean of the robot's pose; the first one is the identity.
  SE2 T_map_base() const;
  /// Of (x [m], y [m], yaw [rad]) in map.
  Eigen::Matrix3d pose_covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  /// All that are known, in the order in which they were first seen.
  std::vector<Landmark> landmarks() const;
  /// The cost of an update grows with its square.
  std::size_t landmark_count() const { return tracks_.size(); }

 private:
  struct Track {
    int id;
    int sightings;
    int misses;
  };

  Eigen::Matrix2d noise(const PointObservation& observation) const;
  bool is_usable(const PointObservation& observation) const;
  LandmarkPair pair(const PointObservation& observation, std::size_t observed,
                    std::size_t landmark) const;
  Eigen::Matrix2d cross_covariance(const LandmarkPair& a, const LandmarkPair& b) const;
  std::vector<std::vector<LandmarkPair>> compatible_pairs(
      const std::vector<PointObservation>&) const;
  bool is_new(const PointObservation& observation) const;
  void correct(const std::vector<LandmarkPair>& pairs,
               const std::vector<PointObservation>& observations);
  void add(const PointObservation& observation, int id);
  void add_new(const std::vector<PointObservation>& observations, std::vector<int>& ids);
  void count_misses(const std::vector<bool>& was_seen);
  bool should_be_seen(std::size_t landmark) const;
  void forget(std::size_t landmark);
  Eigen::Index index(std::size_t landmark) const {
    return kRobotStates + 2 * static_cast<Eigen::Index>(landmark);
  }

  EkfSlamParams params_;
  std::vector<double> joint_gates_;  ///< of the squared Mahalanobis distance of 0, 1, 2 ... pairs
  double new_gate_;                  ///< the same of one observation and any landmark
  Eigen::VectorXd state_;            ///< of the robot, then x, y of each landmark
  Eigen::MatrixXd covariance_;
  std::vector<Track> tracks_;
  int next_id_ = 0;
};

}  // namespace trident::slam
