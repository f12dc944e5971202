// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Making models and their plugins.
#include "core/physics/physics_engine.h"
#include "silent_elements.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_sim/world.h"

namespace trident::sim {

std::unique_ptr<Model> World::build_model(ModelSpec spec, const std::string& robot_namespace) {
  auto model = std::make_unique<Model>();
  model->name = spec.name;
  model->robot_namespace = robot_namespace;
  model->T_world_model_initial = spec.T_world_model;
  model->is_static = spec.is_static;
  std::vector<PluginSpec> plugins = std::move(spec.plugins);
  spec.plugins.clear();
  model->spec = std::move(spec);
  // Before the bodies are built: a rotor joint decides which links share one.
  std::vector<std::string> rotor_joints;
  for (const PluginSpec& plugin : plugins) {
    const PluginFactory* factory = registry_.find_or_load(plugin.filename, resources_);
    if (factory == nullptr || !factory->rotor_joint) continue;
    const PluginParams params(plugin.params,
                              "model '" + model->name + "' plugin '" + plugin.name + "'");
    if (std::string joint = factory->rotor_joint(params); !joint.empty())
      rotor_joints.push_back(joint);
  }
  engine_->build(*model, rotor_joints,
                 [this](const std::function<void()>& make) { leave_out_if_odd(make); });
  try {
    create_plugins(*model, plugins);
  } catch (...) {
    model->plugins.clear();
    engine_->destroy(*model);
    throw;
  }
  return model;
}

void World::create_plugins(Model& model, const std::vector<PluginSpec>& specs) {
  const std::string owner = "model '" + model.name + "'";
  for (const PluginSpec& spec : specs) {
    leave_out_if_odd([&] {
      auto plugin = create_plugin(spec, {&model, nullptr, nullptr}, owner);
      if (plugin != nullptr) model.plugins.push_back(std::move(plugin));
    });
  }
  for (LinkSpec& link : model.spec.links) {
    for (SensorSpec& sensor : link.sensors) create_sensor(model, link, sensor);
  }
}

void World::create_sensor(Model& model, const LinkSpec& link, SensorSpec& sensor) {
  const std::string owner =
      "model '" + model.name + "' link '" + link.name + "' sensor '" + sensor.name + "'";
  for (const PluginSpec& spec : sensor.plugins) {
    leave_out_if_odd([&] {
      auto plugin = create_plugin(spec, {&model, model.find_link(link.name), &sensor}, owner);
      if (plugin != nullptr) model.plugins.push_back(std::move(plugin));
    });
  }
  sensor.plugins.clear();
  sensor.params = {};
}

namespace {

/// What a plugin's name begins with: "MODEL::" or "WORLD::", in a sensor "MODEL::LINK::SENSOR::".
std::string scope_of(const Model* model, const Link* link, const SensorSpec* sensor,
                     const std::string& world) {
  const std::string outer = (model != nullptr ? model->name : world) + "::";
  return sensor == nullptr ? outer : outer + link->name + "::" + sensor->name + "::";
}

/// Errors say whose they are, those of a port that is taken, too.
std::unique_ptr<Plugin> create_named(const PluginFactory& factory, const PluginContext& context,
                                     const std::string& owner) {
  try {
    return factory.create(context);
  } catch (const Error& error) {
    const std::string text = error.what();
    if (text.find(owner) != std::string::npos) throw;
    throw Error(owner + ": " + text);
  }
}

}  // namespace

std::unique_ptr<Plugin> World::create_plugin(const PluginSpec& spec, const PluginPlace& place,
                                             const std::string& owner) {
  Model* const model = place.model;
  const PluginFactory* factory = registry_.find_or_load(spec.filename, resources_);
  if (factory == nullptr) {
    // Once of an owner: a course of buoys has one in each buoy.
    if (!reported_elements_.insert(owner + " " + spec.filename).second) return nullptr;
    const std::string known = join(registry_.names());
    report(Severity::kWarning, owner + ": plugin '" + spec.name + "' (" + spec.filename +
                                   ") is unknown and is left out; known: " + known);
    return nullptr;
  }
  ParamNode params = spec.params;
  if (model != nullptr && params.find("robotNamespace") == nullptr) {
    params.children.push_back({"robotNamespace", model->robot_namespace, {}, {}});
  }
  const PluginParams reader(params, owner + " plugin '" + spec.name + "'");
  const std::string name = scope_of(model, place.link, place.sensor, name_);
  const PluginContext context{*this, model, reader, name + spec.name, place.link, place.sensor};
  auto plugin = create_named(*factory, context, owner + " plugin '" + spec.name + "'");
  if (plugin != nullptr) report_unread(spec, reader);
  return plugin;
}

/// Once in the world, or a fleet would report it a hundred times.
void World::report_unread(const PluginSpec& spec, const PluginParams& params) {
  // Of a link that libsdformat has joined to another; it writes the offsets itself.
  const bool is_lumped = params.has("ignition::corrected_offsets");
  std::string list;
  std::size_t count = 0;
  for (const std::string& element : params.unread()) {
    const bool is_offset = element == "xyzOffset" || element == "rpyOffset";
    if (is_ignored_element(spec.filename, element) || (is_offset && is_lumped)) continue;
    if (!reported_elements_.insert(spec.filename + " " + element).second) continue;
    list.append(list.empty() ? "<" : ", <").append(element).append(">");
    ++count;
  }
  if (list.empty()) return;
  diagnose({Severity::kWarning,
            params.owner(),
            "elements without effect",
            list + " of " + spec.filename +
                (count == 1 ? " is not known here and has no effect"
                            : " are not known here and have no effect"),
            {{"elements", list}}});
}

}  // namespace trident::sim
