// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "critic.h"

namespace trident::nav {
namespace {

bool is_far(const CriticScene& scene, double threshold_m) {
  return !scene.reaches_goal || scene.goal_distance_m > threshold_m;
}

// The distance from each point to the path's point at the same arc length.
class PathAlignCritic final : public MppiCritic {
 public:
  PathAlignCritic(const PathAlignParams& params, const MppiModel& model)
      : MppiCritic(params),
        params_(params),
        threshold_m_(params.threshold_to_consider.value_or(2.0 * model.circumscribed_radius)) {}

  bool is_active(const CriticScene& scene) const override {
    return is_far(scene, threshold_m_) && scene.furthest >= params_.offset_from_furthest &&
           scene.blocked_ratio <= params_.max_path_occupancy_ratio;
  }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const int stride = params_.trajectory_point_step;
    const int points = rollouts.steps / stride;
    const float scale =
        static_cast<float>(scene.model.distance_scale) / static_cast<float>(std::max(points, 1));
    const auto arc_step = static_cast<float>(scene.model.dt_s) / scene.path_spacing;
    const int last = scene.last_point();
    run_lanes([&]() TRIDENT_LANES {
      float arc[kLanes] = {};  // in points of the path
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* vx = rollouts.at(rollouts.vx, step);
        const float* vy = rollouts.at(rollouts.vy, step);
        for (int i = 0; i < kLanes; ++i) {
          arc[i] += arc_step * std::sqrt(vx[i] * vx[i] + vy[i] * vy[i]);
        }
        if ((step + 1) % stride == 0) add_step(scene, rollouts, step, last, arc, scale, cost);
      }
    });
  }

  TRIDENT_INLINE void add_step(const CriticScene& scene, const Rollouts& rollouts, int step,
                               int last, const float* arc, float scale, float* cost) const {
    const float* x = rollouts.at(rollouts.x, step);
    const float* y = rollouts.at(rollouts.y, step);
    const float* px = scene.path_x.data();
    const float* py = scene.path_y.data();
    float path_x[kLanes];
    float path_y[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      const int point = static_cast<int>(least(arc[i] + 0.5F, static_cast<float>(last)));
      path_x[i] = px[point];
      path_y[i] = py[point];
    }
    for (int i = 0; i < kLanes; ++i) {
      const float dx = x[i] - path_x[i];
      const float dy = y[i] - path_y[i];
      cost[i] += scale * std::sqrt(dx * dx + dy * dy);
    }
    if (params_.use_path_orientations) add_headings(scene, rollouts, step, last, arc, scale, cost);
  }

  TRIDENT_INLINE void add_headings(const CriticScene& scene, const Rollouts& rollouts, int step,
                                   int last, const float* arc, float scale, float* cost) const {
    const float* yaw = rollouts.at(rollouts.yaw, step);
    for (int i = 0; i < kLanes; ++i) {
      const int point = static_cast<int>(least(arc[i] + 0.5F, static_cast<float>(last)));
      const float off = yaw[i] - scene.path_yaw[static_cast<std::size_t>(point)];
      cost[i] += scale * (1.0F - std::cos(off));
    }
  }

  PathAlignParams params_;
  double threshold_m_;
};

// The distance from each trajectory's end to a point of the path a little beyond what is in reach.
class PathFollowCritic final : public MppiCritic {
 public:
  PathFollowCritic(const PathFollowParams& params, const MppiModel& model)
      : MppiCritic(params),
        offset_(params.offset_from_furthest),
        threshold_m_(params.threshold_to_consider.value_or(model.length_m)) {}

  bool is_active(const CriticScene& scene) const override { return is_far(scene, threshold_m_); }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const auto point =
        static_cast<std::size_t>(std::min(scene.furthest + offset_, scene.last_point()));
    const float px = scene.path_x[point];
    const float py = scene.path_y[point];
    const auto scale = static_cast<float>(scene.model.distance_scale);
    run_lanes([&]() TRIDENT_LANES {
      const float* x = rollouts.at(rollouts.x, rollouts.steps - 1);
      const float* y = rollouts.at(rollouts.y, rollouts.steps - 1);
      for (int i = 0; i < kLanes; ++i) {
        const float dx = x[i] - px;
        const float dy = y[i] - py;
        cost[i] += scale * std::sqrt(dx * dx + dy * dy);
      }
    });
  }

  int offset_;
  double threshold_m_;
};

// Where the path leads off to the side: the angle between the trajectory's last heading and the
// direction to a point of the path.
class PathAngleCritic final : public MppiCritic {
 public:
  PathAngleCritic(const PathAngleParams& params, const MppiModel& model)
      : MppiCritic(params),
        params_(params),
        threshold_m_(params.threshold_to_consider.value_or(2.0 * model.circumscribed_radius)) {}

  bool is_active(const CriticScene& scene) const override {
    if (!is_far(scene, threshold_m_)) return false;
    const std::size_t point = target(scene);
    const double bearing = std::atan2(static_cast<double>(scene.path_y[point]),
                                      static_cast<double>(scene.path_x[point]));
    double off = std::fabs(wrap_angle(bearing - scene.origin.yaw));
    if (is_either_end(scene)) off = std::min(off, 3.14159265358979 - off);
    return off > params_.max_angle_to_furthest;
  }

 private:
  std::size_t target(const CriticScene& scene) const {
    return static_cast<std::size_t>(
        std::min(scene.furthest + params_.offset_from_furthest, scene.last_point()));
  }
  bool is_either_end(const CriticScene& scene) const {
    return params_.mode == 1 || scene.is_reverse || scene.leaves_backwards;
  }

  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const std::size_t point = target(scene);
    const float px = scene.path_x[point];
    const float py = scene.path_y[point];
    const int last = rollouts.steps - 1;
    const bool is_either = is_either_end(scene);
    run_lanes([&]() TRIDENT_LANES {
      const float* x = rollouts.at(rollouts.x, last);
      const float* y = rollouts.at(rollouts.y, last);
      const float* c = rollouts.at(rollouts.cosine, last);
      const float* s = rollouts.at(rollouts.sine, last);
      for (int i = 0; i < kLanes; ++i) {
        const float dx = px - x[i];
        const float dy = py - y[i];
        const float along = dx * c[i] + dy * s[i];
        const float across = dy * c[i] - dx * s[i];
        cost[i] += absolute_angle(across, is_either ? absolute(along) : along);
      }
    });
  }

  PathAngleParams params_;
  double threshold_m_;
};

}  // namespace

void add_path_critics(MppiCriticRegistry& registry) {
  registry.add("PathAlignCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.PathAlignCritic.enabled
               ? std::make_unique<PathAlignCritic>(params.PathAlignCritic, model)
               : nullptr;
  });
  registry.add("PathFollowCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.PathFollowCritic.enabled
               ? std::make_unique<PathFollowCritic>(params.PathFollowCritic, model)
               : nullptr;
  });
  registry.add("PathAngleCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.PathAngleCritic.enabled
               ? std::make_unique<PathAngleCritic>(params.PathAngleCritic, model)
               : nullptr;
  });
}

}  // namespace trident::nav
