// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rollout.h"

#include <cmath>

namespace trident::nav {
namespace {

constexpr float kSlow = 0.01F;  // nothing slides sideways below [m/s]

// Limits of one step.
struct StepLimits {
  float vx_min, vx_max, vx_gain, vx_loss;  // gain: of |v| by acceleration; loss: by braking
  float vy_max, vy_step, wz_max, wz_step;
  float sideways_max;  // acceleration of a turn across the wheels
  float curvature_max;
  float free_turn;  // what a robot that stands may turn at
  float dt;
};

StepLimits step_limits(const MppiModel& model) {
  const MotionLimits& limits = model.limits;
  const double dt = model.dt_s;
  const double radius = limits.min_turning_radius;
  constexpr double kAnyTurn = 1e9;  // [rad/s]
  const bool is_car = model.motion == MppiMotion::kAckermann && radius > 0.0;
  return {static_cast<float>(limits.vx_min),
          static_cast<float>(limits.vx_max),
          static_cast<float>(limits.ax_max * dt),
          static_cast<float>(limits.decel_max * dt),
          static_cast<float>(model.motion == MppiMotion::kOmni ? limits.vy_max : 0.0),
          static_cast<float>(limits.ay_max * dt),
          static_cast<float>(limits.wz_max),
          static_cast<float>(limits.alpha_max * dt),
          static_cast<float>(turning_acceleration(limits)),
          static_cast<float>(is_car ? 1.0 / radius : 0.0),
          static_cast<float>(is_car ? 0.0 : kAnyTurn),
          static_cast<float>(dt)};
}

// What the lanes carry from step to step.
struct State {
  float vx[kLanes], vy[kLanes], wz[kLanes];
  float x[kLanes], y[kLanes], cosine[kLanes], sine[kLanes], yaw[kLanes];
};

void fill(const RolloutStart& start, State* state) {
  for (int i = 0; i < kLanes; ++i) {
    state->vx[i] = static_cast<float>(start.twist.vx);
    state->vy[i] = static_cast<float>(start.twist.vy);
    state->wz[i] = static_cast<float>(start.twist.wz);
    state->x[i] = 0.0F;
    state->y[i] = 0.0F;
    state->cosine[i] = static_cast<float>(std::cos(start.yaw));
    state->sine[i] = static_cast<float>(std::sin(start.yaw));
    state->yaw[i] = static_cast<float>(start.yaw);
  }
}

TRIDENT_INLINE void constrain(const StepLimits& limits, State& state, float* vx, float* vy,
                              float* wz) {
  for (int i = 0; i < kLanes; ++i) {
    const float v = state.vx[i];
    const float up = v < 0.0F ? limits.vx_loss : limits.vx_gain;
    const float down = v > 0.0F ? limits.vx_loss : limits.vx_gain;
    const float wanted = clamped(vx[i], limits.vx_min, limits.vx_max);
    state.vx[i] = clamped(wanted, v - down, v + up);
    vx[i] = state.vx[i];
  }
  for (int i = 0; i < kLanes; ++i) {
    const float v = state.vy[i];
    const float wanted = clamped(vy[i], -limits.vy_max, limits.vy_max);
    state.vy[i] = clamped(wanted, v - limits.vy_step, v + limits.vy_step);
    vy[i] = state.vy[i];
  }
  for (int i = 0; i < kLanes; ++i) {
    const float w = state.wz[i];
    const float fast = limits.sideways_max / greatest(absolute(state.vx[i]), kSlow);
    const float wz_max = least(limits.wz_max, fast);
    const float wanted = clamped(wz[i], -wz_max, wz_max);
    const float reached = clamped(wanted, w - limits.wz_step, w + limits.wz_step);
    const float most = absolute(state.vx[i]) * limits.curvature_max + limits.free_turn;
    state.wz[i] = clamped(reached, -most, most);
    wz[i] = state.wz[i];
  }
}

// Exact on arcs but for the chord, whose length is that of the arc to the fourth order.
TRIDENT_INLINE void integrate(const StepLimits& limits, State& state) {
  for (int i = 0; i < kLanes; ++i) {
    const float half = 0.5F * state.wz[i] * limits.dt;
    const float ch = small_cosine(half);
    const float sh = small_sine(half);
    const float chord = limits.dt * (1.0F - half * half * (1.0F / 6.0F));
    const float cm = state.cosine[i] * ch - state.sine[i] * sh;
    const float sm = state.sine[i] * ch + state.cosine[i] * sh;
    state.x[i] += (state.vx[i] * cm - state.vy[i] * sm) * chord;
    state.y[i] += (state.vx[i] * sm + state.vy[i] * cm) * chord;
    state.cosine[i] = cm * ch - sm * sh;
    state.sine[i] = sm * ch + cm * sh;
    state.yaw[i] += 2.0F * half;
  }
}

TRIDENT_INLINE void copy(const float* from, float* to) {
  for (int i = 0; i < kLanes; ++i) to[i] = from[i];
}

TRIDENT_INLINE void store(const State& state, int step, Rollouts& rollouts) {
  copy(state.x, rollouts.at(rollouts.x, step));
  copy(state.y, rollouts.at(rollouts.y, step));
  copy(state.cosine, rollouts.at(rollouts.cosine, step));
  copy(state.sine, rollouts.at(rollouts.sine, step));
  copy(state.yaw, rollouts.at(rollouts.yaw, step));
}

}  // namespace

Rollouts::Rollouts(int steps_) : steps(steps_), contact_step(kLanes, steps_) {
  for (auto* values : {&vx, &vy, &wz, &x, &y, &cosine, &sine, &yaw, &clearance}) {
    values->assign(static_cast<std::size_t>(steps) * kLanes, 0.0F);
  }
}

void roll_out(const MppiModel& model, const RolloutStart& start, Rollouts* rollouts) {
  const StepLimits limits = step_limits(model);
  State state;
  fill(start, &state);
  run_lanes([&]() TRIDENT_LANES {
    for (int step = 0; step < rollouts->steps; ++step) {
      constrain(limits, state, rollouts->at(rollouts->vx, step), rollouts->at(rollouts->vy, step),
                rollouts->at(rollouts->wz, step));
      integrate(limits, state);
      store(state, step, *rollouts);
    }
  });
}

}  // namespace trident::nav
