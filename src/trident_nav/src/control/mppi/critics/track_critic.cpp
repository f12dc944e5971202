// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "critic.h"

namespace trident::nav {
namespace {

// Moving obstacles where they will be at each step, grown by what the prediction does not know.
class TrackCritic final : public MppiCritic {
 public:
  TrackCritic(const TrackCriticParams& params, const MppiModel& model)
      : MppiCritic(params),
        contact_(static_cast<float>(params.collision_cost)),
        margin_m_(static_cast<float>(params.margin.value_or(2.0 * model.inscribed_radius))),
        sigmas_(params.sigmas) {}

  bool is_active(const CriticScene& scene) const override { return !scene.tracks.empty(); }

 private:
  struct Disc {
    float x, y, radius, margin;
  };

  Disc disc_at(const CriticScene& scene, const Track& track, double after_s) const {
    const Point2 p = track.position_at(after_s);
    const double sigma = sigmas_ * track.position_sigma(after_s);
    // No less than a robot's radius is given for what the prediction does not know.
    const double grown = std::min(sigma, scene.model.circumscribed_radius);
    return {static_cast<float>(p.x - scene.origin.x), static_cast<float>(p.y - scene.origin.y),
            static_cast<float>(track.radius_m + scene.model.circumscribed_radius),
            margin_m_ + static_cast<float>(grown)};
  }

  void score(const CriticScene& scene, const Rollouts& rollouts, float* cost) const override {
    float contact[kLanes] = {};
    for (const Track& track : scene.tracks) {
      for (int step = 1; step < rollouts.steps; step += 2) {
        const Disc disc = disc_at(scene, track, scene.model.dt_s * (step + 1));
        add_step(rollouts, step, disc, contact, cost);
      }
    }
    for (int i = 0; i < kLanes; ++i) cost[i] += contact_ * contact[i];
  }

  void add_step(const Rollouts& rollouts, int step, const Disc& disc, float* contact,
                float* cost) const {
    const float share = 2.0F / static_cast<float>(rollouts.steps);
    const float early = 2.0F - static_cast<float>(step) / static_cast<float>(rollouts.steps);
    // A robot that stands is not what hits.
    constexpr float kStanding = 0.02F;  // [m/s]
    run_lanes([&]() TRIDENT_LANES {
      const float* x = rollouts.at(rollouts.x, step);
      const float* y = rollouts.at(rollouts.y, step);
      const float* vx = rollouts.at(rollouts.vx, step);
      for (int i = 0; i < kLanes; ++i) {
        const float dx = x[i] - disc.x;
        const float dy = y[i] - disc.y;
        const float gap = std::sqrt(dx * dx + dy * dy) - disc.radius;
        cost[i] += share * greatest(disc.margin - gap, 0.0F) / disc.margin;
        const bool is_hit = (gap < 0.0F) & (absolute(vx[i]) > kStanding);
        contact[i] = greatest(contact[i], is_hit ? early : 0.0F);
      }
    });
  }

  float contact_, margin_m_;
  double sigmas_;
};

}  // namespace

void add_track_critic(MppiCriticRegistry& registry) {
  registry.add("TrackCritic", [](const MppiParams& params, const MppiModel& model) {
    return params.TrackCritic.enabled ? std::make_unique<TrackCritic>(params.TrackCritic, model)
                                      : nullptr;
  });
}

}  // namespace trident::nav
