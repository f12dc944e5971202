// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_lattice [--model diff|ackermann|omni] [--radius M] [--resolution M] [--headings 8|16|32]
// [--out FILE.json]: makes a control set for SmacPlannerLattice in Nav2's form; to standard output
// unless a file is given.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "planning/curves/lattice_set.h"
#include "trident_base/error.h"

namespace {

using trident::Error;

double number_of(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw Error(option + ": " + text + ", legal: a number");
  return value;
}

struct Settings {
  trident::nav::LatticeOptions lattice;
  std::string out;  // empty: standard output
};

void take_option(const std::string& option, const std::string& value, Settings* settings) {
  if (option == "--model") {
    settings->lattice.motion_model = value;
  } else if (option == "--radius") {
    settings->lattice.turning_radius_m = number_of(option, value);
  } else if (option == "--resolution") {
    settings->lattice.resolution_m = number_of(option, value);
  } else if (option == "--headings") {
    settings->lattice.headings = static_cast<int>(number_of(option, value));
  } else if (option == "--out") {
    settings->out = value;
  } else {
    throw Error(option + ": legal: --model, --radius, --resolution, --headings, --out");
  }
}

void write(const std::string& text, const std::string& out) {
  if (out.empty()) {
    std::cout << text;
    return;
  }
  std::ofstream file(out, std::ios::binary);
  if (!(file << text) || !file.flush()) throw Error(out + ": cannot be written");
}

int run(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (i + 1 == argc) throw Error(option + ": needs a value");
    take_option(option, argv[i + 1], &settings);
  }
  write(trident::nav::lattice_json(trident::nav::make_lattice(settings.lattice)), settings.out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "nav_lattice: " << error.what() << "\n";
    return 2;
  }
}
