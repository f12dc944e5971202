// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "critic.h"

#include <cmath>

namespace trident::nav {

void MppiCritic::add(const CriticScene& scene, const Rollouts& rollouts, float* total) const {
  float cost[kLanes] = {};
  score(scene, rollouts, cost);
  for (int i = 0; i < kLanes; ++i) {
    const float weighted = weight_ * cost[i];
    float powered = weighted;
    for (int k = 1; k < power_; ++k) powered *= weighted;
    total[i] += powered;
  }
}

std::vector<std::unique_ptr<MppiCritic>> make_mppi_critics(const MppiParams& params,
                                                           const MppiModel& model) {
  MppiCriticRegistry registry("critic");
  add_goal_critics(registry);
  add_motion_critics(registry);
  add_obstacle_critics(registry);
  add_path_critics(registry);
  add_track_critic(registry);
  std::vector<std::unique_ptr<MppiCritic>> critics;
  for (const std::string& name : params.critics) {
    if (auto critic = registry.get(name)(params, model)) critics.push_back(std::move(critic));
  }
  return critics;
}

}  // namespace trident::nav
