// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Prints what each plugin asks of its SDF element, a line per element, separated by tabs: file name
// of the plugin, name, kind, default, least and largest legal value, whether it is required. It
// makes each plugin once in each form that asks for other elements, and keeps what it asks for;
// docs/reference/plugins.md is written from this.
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "plugin_reference_cases.h"
#include "test_world.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_bridges_sim/register_plugins.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {
namespace {

using Reference = std::map<std::string, ParamQueries>;

/// Adds what a plugin has asked for; of two queries for one element the one that says more counts.
void keep(const std::string& filename, const PluginParams& params, Reference& reference) {
  for (const auto& [name, query] : params.queries()) {
    ParamQuery& known = reference[filename][name];
    const bool is_required = known.is_required || query.is_required;
    if (query.kind > known.kind) known = query;
    known.is_required = is_required;
  }
}

/// The factories of `from`, which keep in `reference` what their plugins ask for.
void record(const PluginRegistry& from, Reference& reference, PluginRegistry& to) {
  for (const std::string& name : from.names()) {
    PluginFactory factory = *from.find(name);
    const auto create = factory.create;
    factory.create = [create, name, &reference](const PluginContext& context) {
      reference[name];
      try {
        auto plugin = create(context);
        keep(name, context.params, reference);
        return plugin;
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
        keep(name, context.params, reference);
        throw;
      }
    };
    to.add(name, std::move(factory));
  }
}

void make(const ReferenceCase& plugin, PluginRegistry& registry) {
  WorldSpec world_with = world_spec();
  if (plugin.is_of_world) world_with.plugins = {plugin.plugin};
  World world(world_with, Resources({std::string(TRIDENT_REPOSITORY) + "/worlds/models"}), registry,
              WorldOptions{});
  if (plugin.is_of_world) return;
  world.spawn(reference_model(plugin), "");
}

const char* kind_text(ParamQuery::Kind kind) {
  switch (kind) {
    case ParamQuery::Kind::kElement:
      return "element";
    case ParamQuery::Kind::kText:
      return "text";
    case ParamQuery::Kind::kNumber:
      return "number";
    case ParamQuery::Kind::kInteger:
      return "integer";
    case ParamQuery::Kind::kFlag:
      return "flag";
    case ParamQuery::Kind::kVector:
      return "vector";
  }
  return "";
}

void print(const Reference& reference) {
  for (const auto& [filename, elements] : reference) {
    std::printf("%s\n", filename.c_str());
    for (const auto& [name, query] : elements) {
      std::printf("%s\t%s\t%s\t%s\t%s\t%s\t%d\n", filename.c_str(), name.c_str(),
                  kind_text(query.kind), query.fallback.c_str(),
                  number_text(query.limits.lo).c_str(), number_text(query.limits.hi).c_str(),
                  query.is_required ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace trident::sim

int main() {
  trident::sim::PluginRegistry shipped, recorded;
  trident::sim::register_builtin_plugins(shipped);
  trident::control::register_control_plugins(shipped);
  trident::bridges::register_sitl_plugins(shipped);
  trident::sim::Reference reference;
  trident::sim::record(shipped, reference, recorded);
  for (const trident::sim::ReferenceCase& plugin : trident::sim::reference_cases()) {
    try {
      trident::sim::make(plugin, recorded);
    } catch (const trident::Error&) {  // reported, and what was asked for is kept
    }
  }
  trident::sim::print(reference);
  return 0;
}
