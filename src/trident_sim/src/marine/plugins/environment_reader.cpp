// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "environment_reader.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include "marine_files.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr const char* kSections[] = {"tide", "waves", "current", "wind", "bathymetry"};

/// Element `key` and what is below it as the YAML that an environment file would have there.
/// The text of a child of <key>; refuses what would mean something else in YAML than in XML.
std::string yaml_value(const PluginParams& params, const std::string& key, const ParamNode& child) {
  std::istringstream words(child.text);
  std::string value, word;
  while (words >> word) value.append(value.empty() ? "" : " ").append(word);
  if (child.name == "file" && value.find_first_of("\"\\") == std::string::npos) {
    return '"' + value + '"';  // a URI has a colon
  }
  if (value.find_first_of(":#&*!|>'\"%@`") != std::string::npos) {
    params.refuse(key + "> <" + child.name, value, "a number, a word or a list [x, y]");
  }
  return value;
}

std::string yaml_of(const PluginParams& params, const std::string& key) {
  const ParamNode* const node = params.node(key);
  if (node == nullptr || node->children.empty()) return "";
  std::string yaml = key + ":\n";
  for (const ParamNode& child : node->children) {
    const std::string value = yaml_value(params, key, child);
    yaml.append("  ").append(child.name).append(": ").append(value).append("\n");
  }
  return yaml;
}

/// The path that `file` means, which <section> <file> names.
std::string existing_path(const Resources& resources, const std::string& folder,
                          const std::string& section, const std::string& file) {
  std::string path = resources.find(file, folder);
  if (path.empty() || std::filesystem::is_directory(path)) {
    throw Error("<" + section + "> <file> is '" + file +
                "', expected a file; searched: as given, then " + resources.searched());
  }
  return path;
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

}  // namespace

namespace {

/// From the file that <environment> names, or from `inline_yaml`; by default where there is
/// neither.
EnvironmentParams load_environment(const PluginContext& context, const std::string& inline_yaml) {
  const PluginParams& params = context.params;
  EnvironmentParams environment;
  std::string folder;
  if (params.has("environment")) {
    const std::string path = params.required_text("environment");
    if (!inline_yaml.empty()) {
      params.refuse("environment", path, "to stand alone, without <waves>, <current> ...");
    }
    const std::string file = existing_file(context, "environment", path);
    folder = std::filesystem::path(file).parent_path().string();
    environment = load_yaml<EnvironmentParams>(file);
  } else if (!inline_yaml.empty()) {
    environment = load_yaml_string<EnvironmentParams>(inline_yaml, "<waves>, <current> ...");
  }
  find_files(context.world.resources(), folder, &environment);
  return environment;
}

}  // namespace

EnvironmentParams read_environment(const PluginContext& context) {
  const PluginParams& params = context.params;
  std::string inline_yaml;
  for (const char* section : kSections) inline_yaml += yaml_of(params, section);
  EnvironmentParams environment;
  try {
    environment = load_environment(context, inline_yaml);
  } catch (const ConfigError& error) {
    throw Error(params.owner() + ": " + error.what());
  } catch (const Error& error) {
    if (starts_with(error.what(), params.owner())) throw;
    throw Error(params.owner() + ": " + error.what());
  }
  environment.water_level =
      params.number("water_level", environment.water_level, {-1000.0, 9000.0});
  return environment;
}

void find_files(const Resources& resources, const std::string& folder, EnvironmentParams* params) {
  if (params->current.kind == CurrentKind::kFile) {
    params->current.file = existing_path(resources, folder, "current", params->current.file);
  }
  if (!params->wind.file.empty()) {
    params->wind.file = existing_path(resources, folder, "wind", params->wind.file);
  }
  if (params->bathymetry.kind == BathymetryKind::kFile) {
    params->bathymetry.file =
        existing_path(resources, folder, "bathymetry", params->bathymetry.file);
  }
}

EnvironmentParams read_vrx_waves(const PluginContext& context) {
  // They shape the mesh that VRX shows, and what it does without a model.
  for (const char* key : {"static", "update_rate", "size", "cell_count"}) context.params.node(key);
  const PluginParams wave = context.params.below("wave");
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
  // VRX' value, by which its wave numbers follow from the periods.
  waves.gravity = 9.8;
  for (const std::string& name : wave.unread()) {
    wave.refuse(name, wave.text(name, ""),
                "no such element; known: model, number, scale, angle, steepness, amplitude, "
                "period, phase, direction, tau, gain");
  }
  return environment;
}

}  // namespace trident::sim
