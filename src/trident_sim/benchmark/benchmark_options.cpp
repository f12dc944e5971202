// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark_options.h"

#include <map>

#include "trident_base/error.h"
#include "trident_base/option_number.h"

namespace trident::sim {
namespace {

constexpr int kMaxVehicles = 1000;

void require(const std::string& option, const std::string& value) {
  if (value.empty()) throw Error("option " + option + " is missing; see sim_benchmark --help");
}

void set_number(const std::string& name, const std::string& text, BenchmarkOptions& options) {
  if (name == "--n") {
    options.vehicles = static_cast<int>(option_count(name, text, 1, kMaxVehicles));
  } else if (name == "--window") {
    options.window_s = option_number(name, text, 1.0, 1e6);
  } else if (name == "--min-wall") {
    options.min_wall_s = option_number(name, text, 0.0, 3600.0);
  } else if (name == "--airborne") {
    options.airborne_z_m = option_number(name, text, 0.0, 0.9);
  } else {
    throw Error("option " + name + " is unknown; see sim_benchmark --help");
  }
}

}  // namespace

const char* const kBenchmarkUsage =
    "sim_benchmark: hovering vehicles whose controllers run inside the simulator; no ROS\n"
    "  --world FILE       SDF world\n"
    "  --urdf FILE        one vehicle, with MARKER where its namespace goes\n"
    "  --marker MARKER\n"
    "  --parameters TEXT  the controller's YAML files, separated by spaces\n"
    "  --n N              vehicles (6)\n"
    "  --window S         simulated seconds of a measured window (60)\n"
    "  --min-wall S       windows are added until this wall time is reached (2)\n"
    "  --airborne Z       measured once all are above it [m] (0.5)\n"
    "  --profile          time per stage of a step\n"
    "Prints one JSON object.\n";

BenchmarkOptions parse_benchmark_options(const std::vector<std::string>& arguments) {
  BenchmarkOptions options;
  const std::map<std::string, std::string*> texts = {{"--world", &options.world_file},
                                                     {"--urdf", &options.urdf_file},
                                                     {"--marker", &options.marker},
                                                     {"--parameters", &options.parameters}};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    if (name == "--profile") {
      options.profile = true;
      continue;
    }
    if (i + 1 == arguments.size()) {
      throw Error("option " + name + " is unknown or needs a value; see sim_benchmark --help");
    }
    const std::string& value = arguments[++i];
    if (const auto text = texts.find(name); text != texts.end()) {
      *text->second = value;
    } else {
      set_number(name, value, options);
    }
  }
  for (const auto& [name, value] : texts) require(name, *value);
  return options;
}

}  // namespace trident::sim
