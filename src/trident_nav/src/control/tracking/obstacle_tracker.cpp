// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/obstacle_tracker.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

// Of the present values; the rest comes from what is seen now.
constexpr double kKeptOfRadius = 0.8;

bool is_finite(const ScanCluster& cluster) {
  return std::isfinite(cluster.center.x) && std::isfinite(cluster.center.y) &&
         std::isfinite(cluster.radius_m);
}

void require_finite(const std::vector<ScanCluster>& clusters, double time_s) {
  if (!std::isfinite(time_s)) throw Error("scan: its time is " + number_text(time_s) + " s");
  if (!std::all_of(clusters.begin(), clusters.end(), [](const auto& c) { return is_finite(c); })) {
    throw Error("scan: a cluster is not finite");
  }
}

}  // namespace

void ObstacleTracker::reset() {
  objects_.clear();
  moving_.clear();
  has_time_ = false;
}

// The center of what is hidden in part may lie anywhere within its radius.
double ObstacleTracker::measurement_variance(const ScanCluster& cluster) const {
  const double hidden_m = cluster.is_partial ? cluster.radius_m : 0.0;
  return params_.position_noise * params_.position_noise + hidden_m * hidden_m;
}

void ObstacleTracker::predict(Object* object, double duration_s) const {
  const double dt = duration_s;
  const double density = params_.acceleration_noise * params_.acceleration_noise;
  object->position.x += object->velocity.x * dt;
  object->position.y += object->velocity.y * dt;
  object->position_variance += dt * (2.0 * object->covariance + dt * object->velocity_variance) +
                               density * dt * dt * dt / 3.0;
  object->covariance += dt * object->velocity_variance + 0.5 * density * dt * dt;
  object->velocity_variance += density * dt;
}

void ObstacleTracker::correct(const ScanCluster& cluster, Object* object) const {
  const double innovation_variance = object->position_variance + measurement_variance(cluster);
  const double position_gain = object->position_variance / innovation_variance;
  const double velocity_gain = object->covariance / innovation_variance;
  const double dx = cluster.center.x - object->position.x;
  const double dy = cluster.center.y - object->position.y;
  object->position.x += position_gain * dx;
  object->position.y += position_gain * dy;
  object->velocity.x += velocity_gain * dx;
  object->velocity.y += velocity_gain * dy;
  object->velocity_variance -= velocity_gain * object->covariance;
  object->covariance -= position_gain * object->covariance;
  object->position_variance -= position_gain * object->position_variance;
  if (cluster.is_partial) {
    object->radius_m = std::max(object->radius_m, cluster.radius_m);
  } else {
    object->radius_m = std::max(cluster.radius_m, kKeptOfRadius * object->radius_m +
                                                      (1.0 - kKeptOfRadius) * cluster.radius_m);
  }
}

/// Whether what stood has moved by more than noise.
bool ObstacleTracker::begins_to_move(const Object& object, double speed) const {
  const double traveled_m =
      distance(object.position.x, object.position.y, object.confirmed_at.x, object.confirmed_at.y);
  const double noise = object.position_variance + params_.position_noise * params_.position_noise;
  const bool is_significant =
      speed * speed > object.velocity_variance && traveled_m * traveled_m > params_.gate * noise;
  // What is seen from another side has its center elsewhere, by no more than its radius.
  const double least_m = std::max(params_.min_travel, object.radius_m);
  return is_significant && speed > params_.min_speed && traveled_m > least_m;
}

void ObstacleTracker::judge_motion(Object* object) const {
  if (object->seen < params_.confirming_scans) return;
  if (object->seen == params_.confirming_scans) object->confirmed_at = object->position;
  const double speed = std::hypot(object->velocity.x, object->velocity.y);
  // What moves keeps on doing so until it is much slower.
  constexpr double kStops = 0.5;
  if (object->is_moving) {
    object->is_moving = speed > kStops * params_.min_speed;
    if (!object->is_moving) object->confirmed_at = object->position;
    return;
  }
  object->is_moving = begins_to_move(*object, speed);
}

/// All pairs within the gate, the nearest first.
void ObstacleTracker::find_pairs(const std::vector<ScanCluster>& clusters) {
  matches_.clear();
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      const double dx = clusters[k].center.x - objects_[i].position.x;
      const double dy = clusters[k].center.y - objects_[i].position.y;
      const double variance = objects_[i].position_variance + measurement_variance(clusters[k]);
      const double squared = (dx * dx + dy * dy) / variance;
      if (squared <= params_.gate) matches_.push_back({squared, i, k});
    }
  }
  std::sort(matches_.begin(), matches_.end(), [](const Match& a, const Match& b) {
    return std::tie(a.distance, a.object, a.cluster) < std::tie(b.distance, b.object, b.cluster);
  });
}

// The nearest pairs first; each object and each cluster once.
void ObstacleTracker::match(const std::vector<ScanCluster>& clusters) {
  find_pairs(clusters);
  is_used_.assign(clusters.size(), false);
  for (const Match& match : matches_) {
    Object& object = objects_[match.object];
    if (object.is_matched || is_used_[match.cluster]) continue;
    object.is_matched = is_used_[match.cluster] = true;
    correct(clusters[match.cluster], &object);
    ++object.seen;
    object.seen_s = time_s_;
    judge_motion(&object);
  }
}

void ObstacleTracker::begin(const ScanCluster& cluster) {
  Object object;
  object.id = next_id_++;
  object.position = cluster.center;
  object.position_variance = measurement_variance(cluster);
  object.velocity_variance = params_.initial_speed * params_.initial_speed;
  object.radius_m = cluster.radius_m;
  object.seen = 1;
  object.seen_s = time_s_;
  objects_.push_back(object);
}

/// Of what was not found in the newest scan, although it would have been seen for too long.
void ObstacleTracker::drop_lost(const ScanPoints* scan) {
  const auto is_lost = [&](const Object& object) {
    if (object.is_matched) return false;
    // What is not confirmed must be seen in each scan.
    if (object.seen < params_.confirming_scans) return true;
    const bool is_hidden = scan != nullptr && !scan->sees(object.position);
    const double limit_s = is_hidden ? std::max(params_.forget_after, params_.forget_hidden_after)
                                     : params_.forget_after;
    return time_s_ - object.seen_s > limit_s;
  };
  objects_.erase(std::remove_if(objects_.begin(), objects_.end(), is_lost), objects_.end());
}

void ObstacleTracker::advance_to(double time_s) {
  if (has_time_ && time_s < time_s_) reset();
  const double elapsed_s = has_time_ ? time_s - time_s_ : 0.0;
  time_s_ = time_s;
  has_time_ = true;
  for (Object& object : objects_) {
    predict(&object, elapsed_s);
    object.is_matched = false;
  }
}

void ObstacleTracker::update(const std::vector<ScanCluster>& clusters, double time_s,
                             const ScanPoints* scan) {
  require_finite(clusters, time_s);
  advance_to(time_s);
  match(clusters);
  drop_lost(scan);
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    if (!is_used_[k] && !clusters[k].is_partial) begin(clusters[k]);
  }
}

const Tracks& ObstacleTracker::moving_at(double time_s) {
  moving_.clear();
  for (const Object& object : objects_) {
    if (!object.is_moving) continue;
    Object now = object;
    predict(&now, std::max(time_s - time_s_, 0.0));
    Track track{now.id, now.position, now.velocity, now.radius_m, {}, 0.0};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      track.covariance[5 * axis] = now.position_variance;
      track.covariance[5 * axis + 2] = now.covariance;
      track.covariance[5 * axis + 8] = now.covariance;
      track.covariance[5 * axis + 10] = now.velocity_variance;
    }
    track.unseen_s = std::max(time_s_ - object.seen_s, 0.0);
    moving_.push_back(track);
  }
  return moving_;
}

}  // namespace trident::nav
