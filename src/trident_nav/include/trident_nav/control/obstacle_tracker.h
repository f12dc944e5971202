// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/control/robot_state.h"
#include "trident_nav/control/scan_clusters.h"

namespace trident::nav {

struct TrackerParams {
  double position_noise = 0.04;
  double acceleration_noise = 0.5;
  double initial_speed = 1.0;
  double gate = 9.21;
  int confirming_scans = 4;
  double forget_after = 0.8;
  double forget_hidden_after = 3.0;
  double min_speed = 0.15;
  double min_travel = 0.15;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("position_noise", position_noise, Range::positive(),
             "standard deviation of the center of what is seen whole [m]");
    ar.field("acceleration_noise", acceleration_noise, Range::positive(),
             "square root of the power density of accelerations [m/s^1.5]");
    ar.field("initial_speed", initial_speed, Range::positive(),
             "standard deviation of the velocity of what appears [m/s]");
    ar.field("gate", gate, Range::positive(),
             "squared Mahalanobis distance up to which a cluster may belong to a track; 9.21 "
             "holds 99 % of them");
    ar.field("confirming_scans", confirming_scans, Range::at_least(1.0),
             "scans in which an object must be seen");
    ar.field("forget_after", forget_after, Range::positive(),
             "without being seen where it would be seen [s]");
    ar.field("forget_hidden_after", forget_hidden_after, Range::positive(),
             "without being seen where it is hidden, or out of the field of view [s]");
    ar.field("min_speed", min_speed, Range::non_negative(), "what is slower stands [m/s]");
    ar.field("min_travel", min_travel, Range::non_negative(),
             "from where it was confirmed, and no less than its radius, until an object counts as "
             "moving [m]");
  }
};

/// Tracks the objects in scans and says which of them move, and where to: a Kalman filter of
/// constant velocity for each, whose accelerations are white noise; clusters belong to the nearest
/// track within the gate. Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking
/// and Navigation" (2001), sections 6.2 and 3.5. Not thread-safe.
class ObstacleTracker {
 public:
  explicit ObstacleTracker(const TrackerParams& params) : params_(params) {}

  /// The clusters of a scan at its time, in the costmap's frame. An earlier time than the last one
  /// makes it forget everything. `scan`: what they were found in, which says where else something
  /// would have been seen; nullptr: everywhere. Throws Error for a time or a cluster that is not
  /// finite.
  void update(const std::vector<ScanCluster>& clusters, double time_s,
              const ScanPoints* scan = nullptr);

  /// Objects that are confirmed and move, predicted to a time that is not before the last scan's.
  /// The reference stays valid until the next call.
  const Tracks& moving_at(double time_s);
  /// All objects, those that stand and those that are not confirmed included.
  std::size_t size() const { return objects_.size(); }
  void reset();

 private:
  // Both axes have the same covariance, as noise does not depend on direction.
  struct Object {
    int id = 0;
    Point2 position, velocity;
    double position_variance = 0.0, covariance = 0.0, velocity_variance = 0.0;
    double radius_m = 0.0;
    int seen = 0;
    double seen_s = 0.0;
    Point2 confirmed_at;
    bool is_moving = false;
    bool is_matched = false;
  };
  struct Match {
    double distance = 0.0;  ///< Squared Mahalanobis distance.
    std::size_t object = 0, cluster = 0;
  };

  double measurement_variance(const ScanCluster& cluster) const;
  void predict(Object* object, double duration_s) const;
  void correct(const ScanCluster& cluster, Object* object) const;
  void advance_to(double time_s);
  bool begins_to_move(const Object& object, double speed) const;
  void judge_motion(Object* object) const;
  void find_pairs(const std::vector<ScanCluster>& clusters);
  void match(const std::vector<ScanCluster>& clusters);
  void begin(const ScanCluster& cluster);
  void drop_lost(const ScanPoints* scan);

  TrackerParams params_;
  std::vector<Object> objects_;
  std::vector<Match> matches_;
  std::vector<bool> is_used_;  ///< Of the clusters.
  Tracks moving_;
  double time_s_ = 0.0;
  bool has_time_ = false;
  int next_id_ = 1;
};

}  // namespace trident::nav
