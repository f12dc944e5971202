// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world.h"

#include "core/physics/physics_engine.h"
#include "physics_check.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"

namespace trident::sim {

namespace {

/// Plugins hold references to bodies, ports and each other's samples: those of the world go first,
/// as they may reach into any model.
void dismantle(std::vector<std::unique_ptr<Plugin>>& world_plugins,
               const std::map<std::string, std::unique_ptr<Model>>& models, PhysicsEngine& engine) {
  world_plugins.clear();
  for (const auto& [name, model] : models) {
    model->plugins.clear();
    engine.destroy(*model);
  }
}

}  // namespace

World::World(const WorldSpec& spec, const Resources& resources, PluginRegistry& registry,
             WorldOptions options)
    : WorldSetting(spec, resources, std::move(options)),
      WorldReports(options_, *this),
      physics_(spec.physics),
      registry_(registry),
      workers_(options_.sensor_threads) {
  std::vector<std::string> odd;
  validate(physics_, options_.odd_elements == OddElements::kRefuse ? nullptr : &odd);
  for (const std::string& text : odd) report_odd(text);
  engine_ = std::make_unique<PhysicsEngine>(
      physics_, options_.timing == LoopTiming::kRotors,
      [this](const std::string& text) { report(Severity::kWarning, text); });
  dt_ = SimTime::from_seconds(physics_.max_step_size_s);
  for (const std::string& text : spec.odd_elements) report_odd(text);
  add_odd_repeats(spec.odd_repeats);
  try {
    for (const ModelSpec& model : spec.models) {
      leave_out_if_odd([&] { add_model(model, ""); });
    }
    for (const auto& [name, model] : models_) report_overlap(*model);
    for (const PluginSpec& plugin : spec.plugins) {
      leave_out_if_odd([&] {
        auto made = create_plugin(plugin, {}, "world '" + name_ + "'");
        if (made != nullptr) world_plugins_.push_back(std::move(made));
      });
    }
    rebuild_schedule();
  } catch (...) {
    dismantle(world_plugins_, models_, *engine_);
    throw;
  }
}

World::~World() { dismantle(world_plugins_, models_, *engine_); }

/// The name and pose of the request take the place of the file's.
Model& World::spawn(const SpawnRequest& request) {
  const std::string label = !request.label.empty()  ? request.label
                            : !request.name.empty() ? "model '" + request.name + "'"
                                                    : "model";
  ModelSpec spec = load_model_string(
      request.xml, label, resources_,
      [this](const std::string& text) { report(Severity::kWarning, text); }, options_.odd_elements);
  if (!request.name.empty()) spec.name = request.name;
  spec.T_world_model = request.T_world_model;
  return spawn(std::move(spec), request.robot_namespace);
}

Model& World::spawn(ModelSpec spec, const std::string& robot_namespace) {
  const std::vector<std::string> odd = std::move(spec.odd_elements);
  for (const std::string& text : odd) report_odd(text);
  add_odd_repeats(spec.odd_repeats);
  Model& model = add_model(std::move(spec), robot_namespace);
  report_overlap(model);
  return model;
}

/// Nothing of the world has changed until the model is complete: build_model() throws, or returns a
/// model that only needs to be listed.
Model& World::add_model(ModelSpec spec, const std::string& robot_namespace) {
  if (spec.name.empty()) throw Error("a model needs a name");
  if (models_.count(spec.name) != 0) {
    throw Error("model name '" + spec.name + "' already exists in the world");
  }
  if (!is_place(spec.T_world_model)) {
    throw Error("model '" + spec.name +
                "': initial pose is not finite, is beyond 1e7 m or has a zero quaternion");
  }
  spec.T_world_model.R.normalize();
  diagnostics_.forget_model(spec.name);  // of earlier attempts
  std::unique_ptr<Model> model = build_model(std::move(spec), robot_namespace);
  Model& result = *model;
  result.spawn_number = ++spawn_count_;
  models_.emplace(result.name, std::move(model));
  ++models_version_;
  rebuild_schedule();
  return result;
}

void World::report_overlap(const Model& model) {
  const auto overlap = engine_->deepest_overlap(model);
  if (!overlap || overlap->depth_m <= kDeepContact_m) return;
  const std::string depth = std::to_string(overlap->depth_m);
  diagnose({Severity::kWarning,
            "model '" + model.name + "'",
            "spawned inside",
            "was spawned with '" + overlap->own + "' " + depth + " m inside '" + overlap->other +
                "' and is pushed out slowly",
            {{"collision", overlap->own},
             {"obstacle", overlap->other},
             {"depth_m", depth},
             {"legal", "<= " + std::to_string(kDeepContact_m) + " m"}}});
}

void World::remove(const std::string& name) {
  const auto it = models_.find(name);
  if (it == models_.end()) throw Error("model '" + name + "' does not exist");
  drop_loads_on(*it->second);
  it->second->plugins.clear();
  engine_->destroy(*it->second);
  diagnostics_.forget_model(name);
  models_.erase(it);
  ++models_version_;
  rebuild_schedule();
}

/// Checked as a copy, so that a value out of range leaves everything as it was.
void World::set_physics(const PhysicsSpec& physics) {
  PhysicsSpec checked = physics;
  validate(checked);
  physics_ = checked;
  dt_ = SimTime::from_seconds(physics.max_step_size_s);
  engine_->configure(physics_);
}

}  // namespace trident::sim
