// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "radio_rules.h"

#include <algorithm>
#include <cstdint>

#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// "offered 3, delivered 2, ...".
template <class Counts>
std::string text_of(const Counts& counts) {
  std::string text;
  counts.visit([&text](const char* name, std::uint64_t count) {
    text += (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(count);
  });
  return text;
}

}  // namespace

void use_radio_rules(const std::string& file, WorldSpec* spec) {
  constexpr const char* kMedium = "libtrident_radio_medium.so";
  const auto medium =
      std::find_if(spec->plugins.begin(), spec->plugins.end(), [kMedium](const PluginSpec& plugin) {
        return PluginRegistry::key(plugin.filename) == PluginRegistry::key(kMedium);
      });
  PluginSpec& air = medium != spec->plugins.end()
                        ? *medium
                        : spec->plugins.emplace_back(PluginSpec{"radio_medium", kMedium, {}});
  auto& elements = air.params.children;
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                                [](const ParamNode& node) { return node.name == "rules"; }),
                 elements.end());
  elements.push_back({"rules", file, {}, {}});
}

void add_relay_notes(const RelayReport& relay, DiagnosticsTopic::Notes* notes) {
  for (const RelayFlow& flow : relay.flows()) {
    notes->emplace_back("radio: " + flow.rule + ": " + flow.source + " to " + flow.destination,
                        text_of(flow.counts));
  }
  for (const CallFlow& flow : relay.calls()) {
    notes->emplace_back("radio: " + flow.rule + ": calls of " + flow.caller + " to " + flow.server,
                        text_of(flow.counts));
  }
}

}  // namespace trident::sim
