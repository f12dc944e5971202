// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "critic.h"

namespace trident::nav {
namespace {

// Speeds beyond the limits, and arcs narrower than the least turning radius. Where the rollouts
// hold the limits, what is left is a robot that is too fast as it begins.
class ConstraintCritic final : public MppiCritic {
 public:
  using MppiCritic::MppiCritic;

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const auto dt = static_cast<float>(scene.model.dt_s);
    const auto vx_max = static_cast<float>(scene.model.limits.vx_max);
    const auto vx_min = static_cast<float>(scene.model.limits.vx_min);
    const auto radius = static_cast<float>(scene.model.limits.min_turning_radius);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* vx = rollouts.at(rollouts.vx, step);
        const float* wz = rollouts.at(rollouts.wz, step);
        for (int i = 0; i < kLanes; ++i) {
          const float above = greatest(vx[i] - vx_max, 0.0F);
          const float below = greatest(vx_min - vx[i], 0.0F);
          const float narrow = greatest(radius * absolute(wz[i]) - absolute(vx[i]), 0.0F);
          cost[i] += dt * (above + below + narrow);
        }
      }
    });
  }
};

// Distance driven backwards, where the path does not want it.
class PreferForwardCritic final : public MppiCritic {
 public:
  PreferForwardCritic(const ThresholdCriticParams& params, const MppiModel& model)
      : MppiCritic(params),
        threshold_m_(params.threshold_to_consider.value_or(2.0 * model.circumscribed_radius)) {}

  bool is_active(const CriticScene& scene) const override {
    return !scene.is_reverse && !scene.leaves_backwards && scene.goal_distance_m > threshold_m_;
  }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const auto scale = static_cast<float>(scene.model.dt_s * scene.model.distance_scale);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* vx = rollouts.at(rollouts.vx, step);
        for (int i = 0; i < kLanes; ++i) cost[i] += scale * greatest(-vx[i], 0.0F);
      }
    });
  }

  double threshold_m_;
};

// The mean turn rate.
class TwirlingCritic final : public MppiCritic {
 public:
  using MppiCritic::MppiCritic;

 private:
  void score(const CriticScene& /*scene*/, const Rollouts& rollouts, float* cost) const override {
    const float share = 1.0F / static_cast<float>(rollouts.steps);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* wz = rollouts.at(rollouts.wz, step);
        for (int i = 0; i < kLanes; ++i) cost[i] += share * absolute(wz[i]);
      }
    });
  }
};

// Speeds at which the base does not move yet.
class VelocityDeadbandCritic final : public MppiCritic {
 public:
  explicit VelocityDeadbandCritic(const DeadbandParams& params) : MppiCritic(params) {
    for (int axis = 0; axis < 3; ++axis) {
      band_[axis] = static_cast<float>(params.deadband_velocities[static_cast<std::size_t>(axis)]);
    }
  }

 private:
  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    const auto dt = static_cast<float>(scene.model.dt_s);
    run_lanes([&]() TRIDENT_LANES {
      for (int step = 0; step < rollouts.steps; ++step) {
        const float* vx = rollouts.at(rollouts.vx, step);
        const float* vy = rollouts.at(rollouts.vy, step);
        const float* wz = rollouts.at(rollouts.wz, step);
        for (int i = 0; i < kLanes; ++i) {
          cost[i] += dt * (greatest(band_[0] - absolute(vx[i]), 0.0F) +
                           greatest(band_[1] - absolute(vy[i]), 0.0F) +
                           greatest(band_[2] - absolute(wz[i]), 0.0F));
        }
      }
    });
  }

  float band_[3];
};

}  // namespace

void add_motion_critics(MppiCriticRegistry& registry) {
  registry.add("ConstraintCritic", [](const MppiParams& params, const MppiModel&) {
    return params.ConstraintCritic.enabled
               ? std::make_unique<ConstraintCritic>(params.ConstraintCritic)
               : nullptr;
  });
  registry.add("PreferForwardCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.PreferForwardCritic.enabled
               ? std::make_unique<PreferForwardCritic>(params.PreferForwardCritic, model)
               : nullptr;
  });
  registry.add("TwirlingCritic", [](const MppiParams& params, const MppiModel&) {
    return params.TwirlingCritic.enabled ? std::make_unique<TwirlingCritic>(params.TwirlingCritic)
                                         : nullptr;
  });
  registry.add("VelocityDeadbandCritic", [](const MppiParams& params, const MppiModel&) {
    return params.VelocityDeadbandCritic.enabled
               ? std::make_unique<VelocityDeadbandCritic>(params.VelocityDeadbandCritic)
               : nullptr;
  });
}

}  // namespace trident::nav
