// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_pain_scenes [--quick] [SCENE ...]: issues that users of other navigation stacks report, on
// costmaps, planners, controllers and the navigator alone; a line of JSON for each measurement.
// Scenes: obstacles, paths, tuning, bands, reasons; default: all. Exits with 2 for anything else.
#include <exception>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>

#include "pain.h"

namespace {

using trident::nav::pains::Pain;
using trident::nav::pains::Pains;

const std::map<std::string, Pains (*)(bool)> kScenes = {
    {"obstacles", trident::nav::pains::obstacle_pains}, {"paths", trident::nav::pains::path_pains},
    {"tuning", trident::nav::pains::tuning_pains},      {"bands", trident::nav::pains::band_pains},
    {"reasons", trident::nav::pains::reason_pains},
};

nlohmann::json json_of(const Pain& pain) {
  return {{"scene", pain.scene},       {"rival", pain.rival},         {"what", pain.what},
          {"measured", pain.measured}, {"limit", pain.limit},         {"unit", pain.unit},
          {"is_least", pain.is_least}, {"passed", pain.has_passed()}, {"note", pain.note}};
}

int run(const std::vector<std::string>& words) {
  bool is_quick = false;
  std::vector<std::string> names;
  for (const std::string& word : words) {
    if (word == "--quick") {
      is_quick = true;
    } else if (kScenes.count(word) != 0) {
      names.push_back(word);
    } else {
      std::cerr << "nav_pain_scenes: " << word << ", legal: --quick";
      for (const auto& [name, scene] : kScenes) std::cerr << ", " << name;
      std::cerr << "\n";
      return 2;
    }
  }
  if (names.empty()) {
    for (const auto& [name, scene] : kScenes) names.push_back(name);
  }
  for (const std::string& name : names) {
    for (const Pain& pain : kScenes.at(name)(is_quick)) std::cout << json_of(pain) << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "nav_pain_scenes: " << error.what() << "\n";
    return 2;
  }
}
