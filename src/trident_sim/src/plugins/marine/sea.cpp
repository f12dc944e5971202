// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/sea.h"

#include <cmath>
#include <sstream>

#include "../../marine/environment.h"
#include "../plugin_util.h"
#include "marine_files.h"
#include "marine_plugins.h"

namespace trident {
namespace {

/// Element `key` and what is below it as the YAML that an environment file would have there.
std::string yaml_of(const PluginParams& params, const std::string& key) {
  const ParamNode* const node = params.node(key);
  if (node == nullptr) return "";
  std::string yaml = key + ":\n";
  for (const ParamNode& child : node->children) {
    std::istringstream words(child.text);
    std::string line, word;
    while (words >> word) line += (line.empty() ? "" : " ") + word;
    // What would mean something else in YAML than in XML.
    if (line.find_first_of(":#&*!|>'\"%@`") != std::string::npos) {
      params.refuse(key + "> <" + child.name, line, "a number, a word or a list [x, y]");
    }
    yaml.append("  ").append(child.name).append(": ").append(line).append("\n");
  }
  return yaml;
}

EnvironmentParams read_environment(const PluginContext& context) {
  const PluginParams& params = context.params;
  const std::string inline_yaml = yaml_of(params, "waves") + yaml_of(params, "current");
  EnvironmentParams environment;
  std::string folder;
  try {
    if (params.has("environment")) {
      const std::string path = params.required_text("environment");
      if (!inline_yaml.empty()) {
        params.refuse("environment", path, "to stand alone, without <waves> and <current>");
      }
      const std::string file = existing_file(context, "environment", path);
      folder = std::filesystem::path(file).parent_path().string();
      environment = load_yaml<EnvironmentParams>(file);
    } else if (!inline_yaml.empty()) {
      environment = load_yaml_string<EnvironmentParams>(inline_yaml, "<waves>, <current>");
    }
  } catch (const ConfigError& error) {
    throw Error(params.owner() + ": " + error.what());
  }
  environment.water_level =
      params.number("water_level", environment.water_level, {-1000.0, 9000.0});
  if (environment.current.kind == CurrentKind::kFile) {
    environment.current.file =
        existing_file(context, "current> <file", environment.current.file, folder);
  }
  return environment;
}

double read_angle(const PluginParams& params, const std::string& key) {
  const std::string text = params.text(key, "1 0");
  std::istringstream words(text);
  double x = 0.0, y = 0.0;
  std::string rest;
  if (!(words >> x >> y) || words >> rest || !(std::hypot(x, y) > 1e-9) || !std::isfinite(x + y)) {
    params.refuse(key, text, "two finite numbers, not both zero");
  }
  return std::atan2(y, x);
}

/// VRX' <wave>, with the defaults of its code.
EnvironmentParams read_vrx_waves(const PluginContext& context) {
  static const ParamNode kNothing{};
  const ParamNode* const node = context.params.node("wave");
  // They shape the mesh that VRX shows, and what it does without a model.
  for (const char* key : {"static", "update_rate", "size", "cell_count"}) context.params.node(key);
  const PluginParams wave(node != nullptr ? *node : kNothing, context.params.owner() + " <wave>");
  EnvironmentParams environment;
  WaveParams& waves = environment.waves;
  const std::string model = wave.text("model", "PMS");
  if (model != "PMS" && model != "CWR") wave.refuse("model", model, "PMS or CWR");
  waves.spectrum = model == "PMS" ? WaveSpectrum::kVrxPms : WaveSpectrum::kVrxCwr;
  waves.number = wave.integer("number", 1, {1.0, 3.0});
  waves.scale = wave.number("scale", 2.0, {1.0, 10.0});
  waves.angle = wave.number("angle", 0.628, {-3.2, 3.2});
  waves.steepness = wave.number("steepness", 1.0, {0.0, 1.0});
  waves.amplitude = wave.number("amplitude", 0.0, {0.0, 15.0});
  waves.period = wave.number("period", 1.0, {0.2, 40.0});
  waves.phase = wave.number("phase", 0.0, {-6.3, 6.3});
  waves.direction = read_angle(wave, "direction");
  waves.ramp_time = wave.number("tau", 1.0, {0.0, 1e6});
  waves.gain = wave.number("gain", 1.0, {0.0, 100.0});
  waves.gravity = 9.8;
  for (const std::string& name : wave.unread()) {
    wave.refuse(name, wave.text(name, ""),
                "no such element; known: model, number, scale, angle, steepness, amplitude, "
                "period, phase, direction, tau, gain");
  }
  return environment;
}

/// libtrident_sea.so, a world's plugin: the sea of the file <environment>, or of <waves> and
/// <current> with the file's keys as elements; <water_level> [m] comes before that of the file.
/// Without any of them the sea is flat and at rest.
/// libWavefieldModelPlugin.so: VRX' waves, <wave>. As VRX' physics takes them: linear.
class SeaPlugin : public Plugin {
 public:
  SeaPlugin(const PluginContext& context, const EnvironmentParams& params) {
    if (context.world.ports().find(kSeaPort, PortDirection::kOut) != nullptr) {
      throw Error(context.params.owner() + ": the world has a sea already, legal is one");
    }
    try {
      port_ = advertise<SeaSample>(context, kSeaPort, PortRank::kState);
      port_->value.sea = std::make_shared<const Environment>(params, context.world.seed());
    } catch (const Error& error) {
      throw Error(context.params.owner() + ": " + error.what());
    }
  }

  std::vector<Phase> phases() const override { return {}; }

 private:
  OutHandle<SeaSample> port_;
};

}  // namespace

std::shared_ptr<const Sea> find_sea(const World& world) {
  const auto* const port = world.ports().find_out<SeaSample>(kSeaPort);
  return port != nullptr ? port->value.sea : nullptr;
}

PluginFactory sea_factory() {
  return {[](const PluginContext& context) {
            return std::make_unique<SeaPlugin>(context, read_environment(context));
          },
          {}};
}

PluginFactory vrx_wave_field_factory() {
  return {[](const PluginContext& context) {
            return std::make_unique<SeaPlugin>(context, read_vrx_waves(context));
          },
          {}};
}

}  // namespace trident
