// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "golden_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace fs = std::filesystem;
namespace {

fs::path wanted_folder() {
  const char* data = std::getenv("TRIDENT_DATA");
  const fs::path folder = data != nullptr && *data != '\0'
                              ? fs::path(data)
                              : fs::path(TRIDENT_REPOSITORY).parent_path() / "shared" / "data";
  return (folder / ".." / "golden").lexically_normal();
}

}  // namespace

std::string golden_folder() {
  const fs::path folder = wanted_folder();
  return fs::is_directory(folder) ? folder.string() : "";
}

std::string golden_hint() {
  return "recorded flights NOT compared: no folder '" + wanted_folder().string() +
         "' (set TRIDENT_DATA to its sibling data/)";
}

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw Error(path + ": cannot be read");
  return text.str();
}

std::vector<std::vector<double>> read_csv(const std::string& path) {
  std::istringstream in(read_file(path));
  std::string line, word;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    rows.emplace_back();
    while (std::getline(words, word, ',')) rows.back().push_back(std::stod(word));
  }
  return rows;
}

std::vector<FlightRow> read_flight(const std::string& path, double dt_s) {
  std::vector<FlightRow> flight;
  for (const auto& row : read_csv(path)) {
    if (row.size() < 21) throw Error(path + ": a row has fewer than 21 columns");
    FlightRow out;
    out.t_s = row[0];
    out.step = static_cast<std::uint64_t>(std::llround(row[1] / dt_s));
    out.T_world_base = {Eigen::Quaterniond(row[8], row[5], row[6], row[7]).normalized(),
                        {row[2], row[3], row[4]}};
    out.v_world = {row[9], row[10], row[11]};
    out.w_base = {row[12], row[13], row[14]};
    for (std::size_t i = 0; i < 6; ++i) out.rotor_rad_s[i] = row[15 + i];
    flight.push_back(out);
  }
  return flight;
}

std::vector<RecordedCommand> read_commands(const std::string& path) {
  std::vector<RecordedCommand> commands;
  for (const auto& row : read_csv(path)) {
    if (row.size() != 7) throw Error(path + ": a row has not 7 columns");
    commands.push_back({SimTime::from_seconds(row[0]), {}});
    std::copy(row.begin() + 1, row.end(), commands.back().rotor_rad_s.begin());
  }
  return commands;
}

void Deviation::add(const SE3& a, const SE3& b) {
  position_m = std::max(position_m, (a.p - b.p).norm());
  angle_deg = std::max(angle_deg, rad_to_deg(a.R.angularDistance(b.R)));
}

}  // namespace trident::sim
