// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The order of a step.
#include <chrono>

#include "core/physics/physics_engine.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

/// Adds the wall time between construction and destruction, when there is somewhere to add it.
class StageTimer {
 public:
  explicit StageTimer(double* seconds) : seconds_(seconds) {
    if (seconds_ != nullptr) begin_ = Clock::now();
  }
  ~StageTimer() {
    if (seconds_ != nullptr) {
      *seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
    }
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double* seconds_;
  Clock::time_point begin_;
};

template <class Work>
void timed(double* seconds, const Work& work) {
  const StageTimer timer(seconds);
  work();
}

}  // namespace

/// Which plugins run in a phase is worked out when models come or go, not in every step. World
/// plugins come first: models find the wind and the sea of this step.
void World::rebuild_schedule() {
  for (auto& phase : schedule_) phase.clear();
  const auto add = [this](Plugin* plugin) {
    for (const Phase phase : plugin->phases()) {
      schedule_[static_cast<std::size_t>(phase)].push_back(plugin);
    }
  };
  std::vector<Model*> models;
  for (const auto& plugin : world_plugins_) add(plugin.get());
  for (const auto& [name, model] : models_) {
    models.push_back(model.get());
    for (const auto& plugin : model->plugins) add(plugin.get());
  }
  engine_->set_models(models);
  for (const auto& plugin : world_plugins_) plugin->models_changed();
}

void World::run_phase(Phase phase, const StepInfo& info) {
  for (Plugin* plugin : schedule_[static_cast<std::size_t>(phase)]) {
    plugin->pre_step(phase, *this, info);
  }
}

StepInfo World::next_step() const {
  const std::uint64_t step = step_count_ + 1;
  return {step, time_, time_ + dt_, dt_, physics_.max_step_size_s, step - reset_step_};
}

void World::sense(const StepInfo& info) {
  run_phase(Phase::kSense, info);
  extensions_.end_phase(Phase::kSense);
}

void World::actuate(const StepInfo& info) {
  run_phase(Phase::kActuate, info);
  apply_loads(info);
}

void World::finish_step(const StepInfo& info) {
  for (Plugin* plugin : schedule_[static_cast<std::size_t>(Phase::kPost)]) {
    plugin->post_step(*this, info);
  }
  extensions_.end_phase(Phase::kPost);
  if (time_ >= next_floor_look_) report_missing_floor();
}

void World::step(std::uint64_t n) {
  extensions_.begin_steps();
  const auto seconds = [this](double StageTimes::*stage) {
    return profiling_ ? &(stage_times_.*stage) : nullptr;
  };
  for (std::uint64_t i = 0; i < n; ++i) {
    const StepInfo info = next_step();
    // Sensors that measure the beginning of a step, as RotorS' do.
    timed(seconds(&StageTimes::sense_s), [&] { sense(info); });
    // Measurements and setpoints become commands.
    timed(seconds(&StageTimes::control_s), [&] { run_phase(Phase::kControl, info); });
    // Commands, drives and what is applied from outside become forces.
    timed(seconds(&StageTimes::actuate_s), [&] { actuate(info); });
    // Forces and contacts move the bodies.
    timed(seconds(&StageTimes::physics_s), [&] { engine_->step(info.dt_s); });
    // The state is that of the end of the step from here.
    time_ = info.end;
    step_count_ = info.step;
    // Sensors that measure the end of a step.
    timed(seconds(&StageTimes::post_s), [&] { finish_step(info); });
    if (profiling_) ++stage_times_.steps;
  }
}

const std::vector<Contact>& World::contacts() const { return engine_->contacts(); }

World::StageTimes World::take_stage_times() {
  const StageTimes result = stage_times_;
  stage_times_ = {};
  return result;
}

}  // namespace trident::sim
