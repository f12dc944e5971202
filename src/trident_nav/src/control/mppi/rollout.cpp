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
  const bool turns_in_curves =
      model.motion == MppiMotion::kAckermann || model.motion == MppiMotion::kVessel;
  const bool is_car = turns_in_curves && radius > 0.0;
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

// What moves a vessel in a step.
struct VesselStep {
  float gain[3];  // dt / mass
  float linear[3], quadratic[3];
  float least[3], most[3];  // forces
  float surge_mass;         // of the centrifugal force in sway
  float munk_mass;
  float rudder[3];  // more force to both sides, over the square of the speed
  float current_x, current_y;
};

VesselStep vessel_step(const MppiModel& model) {
  const VesselMotion& vessel = model.vessel;
  VesselStep step{};
  for (std::size_t k = 0; k < 3; ++k) {
    step.gain[k] = static_cast<float>(model.dt_s / vessel.mass[k]);
    step.linear[k] = static_cast<float>(vessel.linear_damping[k]);
    step.quadratic[k] = static_cast<float>(vessel.quadratic_damping[k]);
    step.least[k] = static_cast<float>(vessel.force_min[k]);
    step.most[k] = static_cast<float>(vessel.force_max[k]);
  }
  step.surge_mass = static_cast<float>(vessel.mass[0]);
  step.munk_mass = static_cast<float>(vessel.munk_mass);
  step.rudder[1] = static_cast<float>(vessel.rudder_force);
  step.rudder[2] = static_cast<float>(vessel.rudder_moment);
  step.current_x = static_cast<float>(vessel.current.x);
  step.current_y = static_cast<float>(vessel.current.y);
  return step;
}

// The velocity through water after a step, as near to the wanted one as the forces allow. Drag acts
// on the velocity at the step's end, so that no step is too long for it.
// `load`: a force in addition to them; `steered`: of rudders, to both sides.
TRIDENT_INLINE float driven(const VesselStep& step, int axis, float v, float wanted, float load,
                            float steered) {
  const float damping =
      1.0F + step.gain[axis] * (step.linear[axis] + step.quadratic[axis] * absolute(v));
  const float lo = (v + step.gain[axis] * (step.least[axis] + load - steered)) / damping;
  const float hi = (v + step.gain[axis] * (step.most[axis] + load + steered)) / damping;
  return clamped(wanted, lo, hi);
}

// `before`: the velocities of the step before; those of the state are what is wanted now.
TRIDENT_INLINE void drive_vessel(const VesselStep& step, const State& before, State& state,
                                 float* vx, float* vy, float* wz) {
  for (int i = 0; i < kLanes; ++i) {
    const float c = state.cosine[i];
    const float s = state.sine[i];
    const float along = c * step.current_x + s * step.current_y;
    const float across = c * step.current_y - s * step.current_x;
    const float u = before.vx[i] - along;
    // Water that flows past a turning hull pushes it outward.
    const float outward = -step.surge_mass * u * before.wz[i];
    const float v = before.vy[i] - across;
    const float abeam = -step.munk_mass * u * v;
    const float side = step.rudder[1] * u * u;
    const float turn = step.rudder[2] * u * u;
    state.vx[i] = driven(step, 0, u, state.vx[i] - along, 0.0F, 0.0F) + along;
    state.vy[i] = driven(step, 1, v, state.vy[i] - across, outward, side) + across;
    state.wz[i] = driven(step, 2, before.wz[i], state.wz[i], abeam, turn);
    vx[i] = state.vx[i];
    vy[i] = state.vy[i];
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

namespace {

void roll_out_vessel(const MppiModel& model, const StepLimits& limits, State& state,
                     Rollouts* rollouts) {
  const VesselStep vessel = vessel_step(model);
  run_lanes([&]() TRIDENT_LANES {
    for (int step = 0; step < rollouts->steps; ++step) {
      float* vx = rollouts->at(rollouts->vx, step);
      float* vy = rollouts->at(rollouts->vy, step);
      float* wz = rollouts->at(rollouts->wz, step);
      const State before = state;
      constrain(limits, state, vx, vy, wz);
      drive_vessel(vessel, before, state, vx, vy, wz);
      integrate(limits, state);
      store(state, step, *rollouts);
    }
  });
}

}  // namespace

void roll_out(const MppiModel& model, const RolloutStart& start, Rollouts* rollouts) {
  const StepLimits limits = step_limits(model);
  State state;
  fill(start, &state);
  if (model.motion == MppiMotion::kVessel) {
    roll_out_vessel(model, limits, state, rollouts);
    return;
  }
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
