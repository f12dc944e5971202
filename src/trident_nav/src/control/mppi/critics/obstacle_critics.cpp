// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "critic.h"

namespace trident::nav {
namespace {

// The earlier the contact the dearer: between once and twice the cost.
void add_contacts(const Rollouts& rollouts, float contact_cost, float* cost) {
  for (int i = 0; i < kLanes; ++i) {
    const int contact = rollouts.contact_step[static_cast<std::size_t>(i)];
    if (contact >= rollouts.steps) continue;
    const float early = 1.0F - static_cast<float>(contact) / static_cast<float>(rollouts.steps);
    cost[i] += contact_cost * (1.0F + early);
  }
}

// Nearness to obstacles along the trajectory, by the distance field. It counts by the distance
// driven near them, not by the time, so that waiting in front of a gap is not cheaper; and the
// faster the robot, the more room it wants, as bases slide and react late.
class ObstaclesCritic final : public MppiCritic {
 public:
  ObstaclesCritic(const ObstaclesParams& params, const MppiModel& model)
      : MppiCritic(params),
        repulsion_(static_cast<float>(params.repulsion_weight)),
        critical_(static_cast<float>(params.critical_weight)),
        contact_(static_cast<float>(params.collision_cost)),
        margin_m_(static_cast<float>(
            params.collision_margin_distance.value_or(0.5 * model.inscribed_radius))),
        speed_margin_s_(static_cast<float>(params.speed_margin)),
        reach_m_(
            static_cast<float>(params.inflation_radius.value_or(2.0 * model.inscribed_radius))),
        near_goal_m_(params.near_goal_distance.value_or(model.circumscribed_radius)) {}

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    // Nav2's costs are for a margin of 0.1 m.
    constexpr float kTunedMargin = 0.1F;
    const bool is_near_goal = scene.reaches_goal && scene.goal_distance_m < near_goal_m_;
    const float share = 1.0F / static_cast<float>(rollouts.steps);
    const float repulsion = is_near_goal ? 0.0F : share * repulsion_ / reach_m_;
    const float critical = share * critical_ * kTunedMargin / margin_m_;
    const float per_speed = 1.0F / static_cast<float>(scene.model.limits.vx_max);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* clearance = rollouts.at(rollouts.clearance, step);
        const float* vx = rollouts.at(rollouts.vx, step);
        for (int i = 0; i < kLanes; ++i) {
          const float near = repulsion * greatest(reach_m_ - clearance[i], 0.0F);
          const float speed = absolute(vx[i]);
          const float margin = margin_m_ + speed_margin_s_ * speed;
          const float close = critical * greatest(margin - clearance[i], 0.0F);
          cost[i] += (near + close) * (0.1F + speed * per_speed);
        }
      }
    });
    add_contacts(rollouts, contact_, cost);
  }

  float repulsion_, critical_, contact_, margin_m_, speed_margin_s_, reach_m_;
  double near_goal_m_;
};

// The costmap's costs along the trajectory.
class CostCritic final : public MppiCritic {
 public:
  CostCritic(const CostCriticParams& params, const MppiModel& model)
      : MppiCritic(params),
        params_(params),
        near_goal_m_(params.near_goal_distance.value_or(model.circumscribed_radius)) {}

 private:
  float cost_at(const CriticScene& scene, float x, float y, bool is_near_goal) const {
    const double px = scene.origin.x + static_cast<double>(x);
    const double py = scene.origin.y + static_cast<double>(y);
    const std::uint8_t cell = scene.grid.at(px, py);
    if (cell == kUnknownCost || cell == kFreeCost) return 0.0F;
    if (cell >= params_.near_collision_cost) return static_cast<float>(params_.critical_cost);
    return is_near_goal ? 0.0F : static_cast<float>(cell);
  }

  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const bool is_near_goal = scene.reaches_goal && scene.goal_distance_m < near_goal_m_;
    const int stride = params_.trajectory_point_step;
    const int points = 1 + (rollouts.steps - 1) / stride;
    const float share = 1.0F / (254.0F * static_cast<float>(points));
    for (int step = 0; step < rollouts.steps; step += stride) {
      const float* x = rollouts.at(rollouts.x, step);
      const float* y = rollouts.at(rollouts.y, step);
      for (int i = 0; i < kLanes; ++i) cost[i] += share * cost_at(scene, x[i], y[i], is_near_goal);
    }
    add_contacts(rollouts, static_cast<float>(params_.collision_cost), cost);
  }

  CostCriticParams params_;
  double near_goal_m_;
};

}  // namespace

void add_obstacle_critics(MppiCriticRegistry& registry) {
  registry.add("ObstaclesCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.ObstaclesCritic.enabled
               ? std::make_unique<ObstaclesCritic>(params.ObstaclesCritic, model)
               : nullptr;
  });
  registry.add("CostCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.CostCritic.enabled ? std::make_unique<CostCritic>(params.CostCritic, model)
                                     : nullptr;
  });
}

}  // namespace trident::nav
