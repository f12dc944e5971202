// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "critic.h"

namespace trident::nav {
namespace {

// Near the goal: the mean distance from it.
class GoalCritic final : public MppiCritic {
 public:
  GoalCritic(const ThresholdCriticParams& params, const MppiModel& model)
      : MppiCritic(params), threshold_m_(params.threshold_to_consider.value_or(model.length_m)) {}

  bool is_active(const CriticScene& scene) const override {
    return scene.reaches_goal && scene.goal_distance_m < threshold_m_;
  }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const float scale =
        static_cast<float>(scene.model.distance_scale) / static_cast<float>(rollouts.steps);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* x = rollouts.at(rollouts.x, step);
        const float* y = rollouts.at(rollouts.y, step);
        for (int i = 0; i < kLanes; ++i) {
          const float dx = x[i] - scene.goal_x;
          const float dy = y[i] - scene.goal_y;
          cost[i] += scale * std::sqrt(dx * dx + dy * dy);
        }
      }
    });
  }

  double threshold_m_;
};

// Next to the goal: the mean error of the heading. A robot that turns on the spot need not look
// where it will in the end as long as it must drive.
class GoalAngleCritic final : public MppiCritic {
 public:
  GoalAngleCritic(const ThresholdCriticParams& params, const MppiModel& model)
      : MppiCritic(params),
        threshold_m_(params.threshold_to_consider.value_or(
            model.motion == MppiMotion::kDiffDrive ? model.goal_tolerance_m
                                                   : 2.0 * model.circumscribed_radius)) {}

  bool is_active(const CriticScene& scene) const override {
    return scene.reaches_goal && scene.goal_distance_m < threshold_m_;
  }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const float share = 1.0F / static_cast<float>(rollouts.steps);
    const float goal_cosine = std::cos(scene.goal_yaw);
    const float goal_sine = std::sin(scene.goal_yaw);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* c = rollouts.at(rollouts.cosine, step);
        const float* s = rollouts.at(rollouts.sine, step);
        for (int i = 0; i < kLanes; ++i) {
          const float along = c[i] * goal_cosine + s[i] * goal_sine;
          const float across = s[i] * goal_cosine - c[i] * goal_sine;
          cost[i] += share * absolute_angle(across, along);
        }
      }
    });
  }

  double threshold_m_;
};

}  // namespace

void add_goal_critics(MppiCriticRegistry& registry) {
  registry.add("GoalCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.GoalCritic.enabled ? std::make_unique<GoalCritic>(params.GoalCritic, model)
                                     : nullptr;
  });
  registry.add("GoalAngleCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.GoalAngleCritic.enabled
               ? std::make_unique<GoalAngleCritic>(params.GoalAngleCritic, model)
               : nullptr;
  });
}

}  // namespace trident::nav
