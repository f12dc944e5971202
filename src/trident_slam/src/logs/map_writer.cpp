// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/map_writer.h"

#include <cstdio>
#include <fstream>

#include "trident_base/error.h"

namespace trident {
namespace {

constexpr int kOccupiedFrom = 65;  // [%], map_saver's defaults
constexpr int kFreeBelow = 25;

char shade(std::int8_t occupancy) {
  if (occupancy >= kOccupiedFrom) return static_cast<char>(0);
  if (occupancy >= 0 && occupancy <= kFreeBelow) return static_cast<char>(254);
  return static_cast<char>(205);
}

void write_file(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.flush();
  if (!file) throw Error(path + ": cannot be written");
}

}  // namespace

std::string map_as_pgm(const OccupancyGrid& map) {
  char head[128];
  std::snprintf(head, sizeof(head), "P5\n# CREATOR: map_saver.cpp %.3f m/pix\n%d %d\n255\n",
                map.resolution, map.width, map.height);
  std::string pgm = head;
  pgm.reserve(pgm.size() + map.cells.size());
  for (int row = map.height - 1; row >= 0; --row) {
    for (int column = 0; column < map.width; ++column) {
      pgm.push_back(shade(map.cells[map.index(column, row)]));
    }
  }
  return pgm;
}

void write_map(const OccupancyGrid& map, const std::string& stem) {
  const std::string image = stem.substr(stem.find_last_of('/') + 1) + ".pgm";
  char yaml[512];
  std::snprintf(yaml, sizeof(yaml),
                "image: %s\nresolution: %f\norigin: [%f, %f, %f]\nnegate: 0\n"
                "occupied_thresh: 0.65\nfree_thresh: 0.196\n\n",
                image.c_str(), map.resolution, map.T_map_origin.p.x(), map.T_map_origin.p.y(),
                map.T_map_origin.angle);
  write_file(stem + ".pgm", map_as_pgm(map));
  write_file(stem + ".yaml", yaml);
}

}  // namespace trident
