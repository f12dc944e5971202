// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../steering.h"
#include "trajectory_critic.h"

namespace trident::nav {
namespace {

class GridCritic final : public TrajectoryCritic {
 public:
  GridCritic(GridKind kind, double scale, double forward_point_m, double silent_within_m,
             Aggregation aggregation, GridUnit unit)
      : TrajectoryCritic(scale),
        unit_(unit),
        kind_(kind),
        forward_point_m_(forward_point_m),
        silent_within_m_(silent_within_m),
        aggregation_(aggregation) {}

  double score(const DwaScene& scene, const Candidate& candidate) const override {
    if (is_silent(scene)) return 0.0;
    const double unit = unit_ == GridUnit::kMeters ? scene.resolution : 1.0;
    return unit * aggregated(scene, candidate);
  }

 private:
  double aggregated(const DwaScene& scene, const Candidate& candidate) const {
    if (aggregation_ == Aggregation::kLast) return at_step(scene, candidate, candidate.last);
    double total = aggregation_ == Aggregation::kSum ? 0.0 : 1.0;
    for (int step = 0; step <= candidate.last; ++step) {
      const double value = at_step(scene, candidate, step);
      total = aggregation_ == Aggregation::kSum ? total + value : total * value;
    }
    return total;
  }

  double at_step(const DwaScene& scene, const Candidate& candidate, int step) const {
    const Pose2 pose = candidate.pose(scene.situation.state.pose, step);
    const int index = step * kLanes + candidate.lane;
    const auto i = static_cast<std::size_t>(index);
    const Pose2& end = scene.situation.path.poses.back();
    // A point beyond the goal would pull back.
    const double left_m = distance(pose.x, pose.y, end.x, end.y);
    const double ahead_m =
        scene.situation.path.reaches_goal ? std::min(forward_point_m_, left_m) : forward_point_m_;
    const double x = pose.x + ahead_m * static_cast<double>(candidate.rollouts->cosine[i]);
    const double y = pose.y + ahead_m * static_cast<double>(candidate.rollouts->sine[i]);
    if (kind_ == GridKind::kPath) return static_cast<double>(scene.path_grid.at(x, y));
    const double straight = distance(x, y, end.x, end.y) / scene.resolution;
    // Next to the goal cells are too coarse.
    const bool is_near = scene.goal_distance_m < kStraightCells * scene.resolution;
    return is_near ? straight : std::max(static_cast<double>(scene.goal_grid.at(x, y)), straight);
  }

  bool is_silent(const DwaScene& scene) const { return scene.goal_distance_m < silent_within_m_; }

  static constexpr double kStraightCells = 6.0;

  GridUnit unit_;
  GridKind kind_;
  double forward_point_m_, silent_within_m_;
  Aggregation aggregation_;
};

class ObstacleCritic final : public TrajectoryCritic {
 public:
  ObstacleCritic(double scale, Aggregation aggregation, bool has_footprint)
      : TrajectoryCritic(scale), aggregation_(aggregation), has_footprint_(has_footprint) {}

  double score(const DwaScene& scene, const Candidate& candidate) const override {
    // Distances say nothing that costs do not, but the costs are what users scale.
    constexpr int kStride = 4;
    double total = 0.0;
    for (int step = candidate.last; step >= 0; step -= kStride) {
      const Pose2 pose = candidate.pose(scene.situation.state.pose, step);
      const std::uint8_t cost = cost_at(scene.situation, pose);
      const double value = cost == kUnknownCost ? 0.0 : static_cast<double>(cost);
      total = aggregation_ == Aggregation::kSum ? total + value : std::max(total, value);
    }
    return total;
  }

 private:
  std::uint8_t cost_at(const Situation& situation, const Pose2& pose) const {
    if (has_footprint_) return situation.checker.cost(situation.grid, pose);
    return situation.grid.at(pose.x, pose.y);
  }

  Aggregation aggregation_;
  bool has_footprint_;
};

class TurningRoomCritic final : public TrajectoryCritic {
 public:
  using TrajectoryCritic::TrajectoryCritic;
  double score(const DwaScene& scene, const Candidate& candidate) const override {
    const Situation& situation = scene.situation;
    const Footprint& footprint = situation.checker.footprint();
    const Pose2 end = candidate.pose(situation.state.pose, candidate.last);
    const double room_m = clearance_m(situation.grid, end, footprint, 1.0);
    const double wanted_m = footprint.circumscribed_radius - footprint.inscribed_radius;
    const double short_m = std::max(wanted_m + scene.resolution - room_m, 0.0);
    return short_m * short_m / (wanted_m + scene.resolution);
  }
};

class TwirlingTrajectoryCritic final : public TrajectoryCritic {
 public:
  using TrajectoryCritic::TrajectoryCritic;
  double score(const DwaScene& /*scene*/, const Candidate& candidate) const override {
    return std::fabs(candidate.twist.wz);
  }
};

class PreferForwardTrajectoryCritic final : public TrajectoryCritic {
 public:
  PreferForwardTrajectoryCritic(double scale, const PreferForwardWeights& weights)
      : TrajectoryCritic(scale), weights_(weights) {}

  double score(const DwaScene& /*scene*/, const Candidate& candidate) const override {
    const Twist2& twist = candidate.twist;
    if (twist.vx < 0.0) return weights_.penalty;
    if (twist.vx < weights_.strafe_x && std::fabs(twist.wz) < weights_.strafe_theta) {
      return weights_.penalty;
    }
    return std::fabs(twist.wz) * weights_.theta_scale;
  }

 private:
  PreferForwardWeights weights_;
};

// One velocity whose sign must not change.
class SignTrend {
 public:
  bool forbids(double value) const { return sign_ != 0 && value * sign_ < 0.0; }
  void update(double value) {
    if (std::fabs(value) > 1e-6) sign_ = value > 0.0 ? 1 : -1;
  }
  void reset() { sign_ = 0; }

 private:
  int sign_ = 0;
};

class OscillationCritic final : public TrajectoryCritic {
 public:
  OscillationCritic(double scale, const OscillationLimits& limits)
      : TrajectoryCritic(scale), limits_(limits) {}

  double score(const DwaScene& /*scene*/, const Candidate& candidate) const override {
    const Twist2& twist = candidate.twist;
    const bool turns_on_spot = std::fabs(twist.vx) < 1e-6 && std::fabs(twist.vy) < 1e-6;
    const bool is_back =
        x_.forbids(twist.vx) || y_.forbids(twist.vy) || (turns_on_spot && theta_.forbids(twist.wz));
    return is_back ? -1.0 : 0.0;
  }

  void prepare(const DwaScene& scene) override {
    const RobotState& state = scene.situation.state;
    const double moved = distance(state.pose.x, state.pose.y, since_.pose.x, since_.pose.y);
    const double turned = std::fabs(wrap_angle(state.pose.yaw - since_.pose.yaw));
    const bool is_late =
        limits_.reset_time_s >= 0.0 && state.time_s - since_.time_s >= limits_.reset_time_s;
    if (!has_since_ || moved >= limits_.reset_distance_m || turned >= limits_.reset_angle ||
        is_late) {
      reset();
      since_ = state;
      has_since_ = true;
    }
  }

  void on_chosen(const DwaScene& /*scene*/, const Twist2& twist) override {
    x_.update(twist.vx);
    y_.update(twist.vy);
    if (std::fabs(twist.vx) <= limits_.x_only_threshold) theta_.update(twist.wz);
  }

  void reset() override {
    x_.reset();
    y_.reset();
    theta_.reset();
    has_since_ = false;
  }

 private:
  OscillationLimits limits_;
  SignTrend x_, y_, theta_;
  RobotState since_;
  bool has_since_ = false;
};

class MovingObstacleCritic final : public TrajectoryCritic {
 public:
  MovingObstacleCritic(double scale, double dt_s) : TrajectoryCritic(scale), dt_s_(dt_s) {}

  double score(const DwaScene& scene, const Candidate& candidate) const override {
    constexpr int kStride = 4;
    double worst = 0.0;
    for (const Track& track : scene.situation.tracks) {
      for (int step = candidate.last; step >= 0; step -= kStride) {
        const double near = nearness(scene, candidate, track, step);
        if (near >= 1.0) return -1.0;
        worst = std::max(worst, near);
      }
    }
    return worst;
  }

 private:
  // 0 far away, 1 in contact while the robot moves.
  double nearness(const DwaScene& scene, const Candidate& candidate, const Track& track,
                  int step) const {
    const double after_s = dt_s_ * (step + 1);
    const Point2 p = track.position_at(after_s);
    const Pose2 pose = candidate.pose(scene.situation.state.pose, step);
    const double radius = scene.situation.checker.footprint().circumscribed_radius;
    const double gap = distance(p.x, p.y, pose.x, pose.y) - radius - track.radius_m;
    const double margin = radius + std::min(track.position_sigma(after_s), radius);
    const bool stands = std::fabs(candidate.twist.vx) + std::fabs(candidate.twist.vy) < 0.02;
    if (gap <= 0.0 && !stands) return 1.0;
    return 0.99 * std::clamp(1.0 - gap / margin, 0.0, 1.0);
  }

  double dt_s_;
};

class HeadingCritic final : public TrajectoryCritic {
 public:
  HeadingCritic(double scale, int step) : TrajectoryCritic(scale), step_(step) {}
  double score(const DwaScene& scene, const Candidate& candidate) const override {
    const Pose2 end = candidate.pose(scene.situation.state.pose, std::min(step_, candidate.last));
    const auto nearer = [&](const Pose2& a, const Pose2& b) {
      return distance(a.x, a.y, end.x, end.y) < distance(b.x, b.y, end.x, end.y);
    };
    const Path& path = scene.situation.path.poses;
    const Pose2& nearest = *std::min_element(path.begin(), path.end(), nearer);
    return std::fabs(wrap_angle(nearest.yaw - end.yaw));
  }

 private:
  int step_;
};

class AttractorCritic final : public TrajectoryCritic {
 public:
  using TrajectoryCritic::TrajectoryCritic;
  double score(const DwaScene& scene, const Candidate& candidate) const override {
    const Pose2 end = candidate.pose(scene.situation.state.pose, candidate.last);
    const Pose2& goal = scene.situation.path.poses.back();
    const double d = distance(end.x, end.y, goal.x, goal.y);
    return d * d;
  }
};

}  // namespace

Pose2 Candidate::pose(const Pose2& origin, int step) const {
  const int index = step * kLanes + lane;
  const auto i = static_cast<std::size_t>(index);
  return {origin.x + static_cast<double>(rollouts->x[i]),
          origin.y + static_cast<double>(rollouts->y[i]), static_cast<double>(rollouts->yaw[i])};
}

std::unique_ptr<TrajectoryCritic> make_grid_critic(GridKind kind, double scale,
                                                   double forward_point_m, double silent_within_m,
                                                   Aggregation aggregation, GridUnit unit) {
  return std::make_unique<GridCritic>(kind, scale, forward_point_m, silent_within_m, aggregation,
                                      unit);
}

std::unique_ptr<TrajectoryCritic> make_obstacle_critic(double scale, Aggregation aggregation) {
  return std::make_unique<ObstacleCritic>(scale, aggregation, false);
}

std::unique_ptr<TrajectoryCritic> make_footprint_critic(double scale, Aggregation aggregation) {
  return std::make_unique<ObstacleCritic>(scale, aggregation, true);
}

std::unique_ptr<TrajectoryCritic> make_turning_room_critic(double scale) {
  return std::make_unique<TurningRoomCritic>(scale);
}

std::unique_ptr<TrajectoryCritic> make_twirling_critic(double scale) {
  return std::make_unique<TwirlingTrajectoryCritic>(scale);
}

std::unique_ptr<TrajectoryCritic> make_prefer_forward_critic(double scale,
                                                             const PreferForwardWeights& weights) {
  return std::make_unique<PreferForwardTrajectoryCritic>(scale, weights);
}

std::unique_ptr<TrajectoryCritic> make_oscillation_critic(double scale,
                                                          const OscillationLimits& limits) {
  return std::make_unique<OscillationCritic>(scale, limits);
}

std::unique_ptr<TrajectoryCritic> make_moving_obstacle_critic(double scale, double dt_s) {
  return std::make_unique<MovingObstacleCritic>(scale, dt_s);
}

std::unique_ptr<TrajectoryCritic> make_heading_critic(double scale, int step) {
  return std::make_unique<HeadingCritic>(scale, step);
}

std::unique_ptr<TrajectoryCritic> make_attractor_critic(double scale) {
  return std::make_unique<AttractorCritic>(scale);
}

}  // namespace trident::nav
