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

int run(int argc, char** argv) {
  trident::nav::LatticeOptions options;
  std::string out;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (i + 1 == argc) throw Error(option + ": needs a value");
    const std::string value = argv[i + 1];
    if (option == "--model") {
      options.motion_model = value;
    } else if (option == "--radius") {
      options.turning_radius_m = number_of(option, value);
    } else if (option == "--resolution") {
      options.resolution_m = number_of(option, value);
    } else if (option == "--headings") {
      options.headings = static_cast<int>(number_of(option, value));
    } else if (option == "--out") {
      out = value;
    } else {
      throw Error(option + ": legal: --model, --radius, --resolution, --headings, --out");
    }
  }
  const std::string text = trident::nav::lattice_json(trident::nav::make_lattice(options));
  if (out.empty()) {
    std::cout << text;
    return 0;
  }
  std::ofstream file(out, std::ios::binary);
  if (!(file << text) || !file.flush()) throw Error(out + ": cannot be written");
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
