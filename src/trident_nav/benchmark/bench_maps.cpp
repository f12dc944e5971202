// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "bench_maps.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_maps/distance_field.h"

namespace trident::nav::bench {
namespace {

constexpr double kResolution = 0.05;

/// Random numbers in turn.
class Draw {
 public:
  Draw(std::uint64_t seed, const char* name) : stream_(seed, name) {}
  double between(double low, double high) {
    return low + (high - low) * stream_.uniform(next_++, 0);
  }
  int cell(int below) { return static_cast<int>(between(0.0, below)); }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

BenchMap empty_map(const char* name, int width, int height, double resolution) {
  BenchMap map;
  map.name = name;
  map.geometry = {width, height, resolution, 0.0, 0.0};
  map.cost.assign(map.geometry.size(), kFreeCost);
  return map;
}

void fill(BenchMap& map, int x0, int y0, int x1, int y1, std::uint8_t cost) {
  for (int y = std::max(0, y0); y < std::min(map.geometry.height, y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(map.geometry.width, x1); ++x) {
      map.cost[map.geometry.index({x, y})] = cost;
    }
  }
}

void frame(BenchMap& map) {
  const int w = map.geometry.width;
  const int h = map.geometry.height;
  fill(map, 0, 0, w, 2, kLethalCost);
  fill(map, 0, h - 2, w, h, kLethalCost);
  fill(map, 0, 0, 2, h, kLethalCost);
  fill(map, w - 2, 0, w, h, kLethalCost);
}

int cells(double length_m) { return static_cast<int>(std::lround(length_m / kResolution)); }

/// One room: its walls, two doors, and some furniture.
void add_room(BenchMap& map, Draw& draw, int x0, int y0, int x1, int y1) {
  const int wall = cells(0.15);
  const int door = cells(1.0);
  fill(map, x0, y0, x1, y0 + wall, kLethalCost);
  fill(map, x0, y1 - wall, x1, y1, kLethalCost);
  fill(map, x0, y0, x0 + wall, y1, kLethalCost);
  fill(map, x1 - wall, y0, x1, y1, kLethalCost);
  for (int i = 0; i < 2; ++i) {
    const int x = x0 + wall + draw.cell(std::max(1, x1 - x0 - 2 * wall - door));
    const int y = i == 0 ? y0 : y1 - wall;
    fill(map, x, y, x + door, y + wall, kFreeCost);
  }
  for (int i = 0; i < 3; ++i) {
    const int x = x0 + cells(1.2) + draw.cell(std::max(1, x1 - x0 - cells(3.2)));
    const int y = y0 + cells(1.2) + draw.cell(std::max(1, y1 - y0 - cells(3.2)));
    fill(map, x, y, x + cells(draw.between(0.3, 1.0)), y + cells(draw.between(0.3, 1.0)),
         kLethalCost);
  }
}

std::uint8_t inflated(double distance_m, const Inflation& inflation) {
  if (distance_m <= 0.0) return kLethalCost;
  if (distance_m > inflation.inflation_radius_m) return kFreeCost;
  if (distance_m <= inflation.inscribed_radius_m) return kInscribedCost;
  const double factor =
      std::exp(-inflation.cost_scaling_factor * (distance_m - inflation.inscribed_radius_m));
  return static_cast<std::uint8_t>(252.0 * factor);
}

std::ifstream open_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path + ": cannot be read");
  return file;
}

}  // namespace

CostGrid BenchMap::view() const {
  CostGrid grid;
  grid.geometry = geometry;
  grid.cost = cost.data();
  grid.distance_m = distance_m.empty() ? nullptr : distance_m.data();
  grid.max_distance_m = max_distance_m;
  grid.revision = revision;
  grid.row_revisions = row_revisions.empty() ? nullptr : row_revisions.data();
  return grid;
}

void inflate(BenchMap& map, const Inflation& inflation) {
  OccupancyGrid grid;
  grid.width = map.geometry.width;
  grid.height = map.geometry.height;
  grid.resolution = map.geometry.resolution;
  grid.cells.assign(map.geometry.size(), OccupancyGrid::kFree);
  for (std::size_t i = 0; i < map.cost.size(); ++i) {
    if (map.cost[i] == kLethalCost) grid.cells[i] = OccupancyGrid::kOccupied;
  }
  constexpr double kReach = 3.0;
  const maps::DistanceField field(grid, kReach);
  map.max_distance_m = static_cast<float>(kReach);
  map.distance_m.resize(map.geometry.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::size_t i = grid.index(x, y);
      map.distance_m[i] =
          field.padded()[static_cast<std::size_t>((y + 1) * field.stride() + x + 1)];
      map.cost[i] = inflated(map.distance_m[i], inflation);
    }
  }
}

void add_box(BenchMap& map, Cell center, int side, const Inflation& inflation) {
  const GridGeometry& g = map.geometry;
  const int reach = static_cast<int>(std::ceil(inflation.inflation_radius_m / g.resolution));
  const int half = side / 2;
  const int x0 = center.x - half, y0 = center.y - half, x1 = x0 + side - 1, y1 = y0 + side - 1;
  for (int y = std::max(0, y0 - reach); y <= std::min(g.height - 1, y1 + reach); ++y) {
    for (int x = std::max(0, x0 - reach); x <= std::min(g.width - 1, x1 + reach); ++x) {
      const int dx = std::max({0, x0 - x, x - x1});
      const int dy = std::max({0, y0 - y, y - y1});
      std::uint8_t& cost = map.cost[g.index({x, y})];
      cost = std::max(cost, inflated(std::hypot(dx, dy) * g.resolution, inflation));
    }
  }
}

BenchMap office_map(int width, int height, std::uint64_t seed, const Inflation& inflation) {
  BenchMap map = empty_map("office", width, height, kResolution);
  Draw draw(seed, "office");
  const int corridor = cells(2.0);
  for (int y = corridor; y + cells(4.0) < height;) {
    const int room_y = std::min(cells(draw.between(4.0, 8.0)), height - y);
    for (int x = corridor; x + cells(4.0) < width;) {
      const int room_x = std::min(cells(draw.between(4.0, 8.0)), width - x);
      add_room(map, draw, x, y, x + room_x, y + room_y);
      x += room_x + (draw.between(0.0, 1.0) < 0.3 ? corridor : 0);
    }
    y += room_y + corridor;
  }
  frame(map);
  inflate(map, inflation);
  return map;
}

BenchMap hall_map(int width, int height, std::uint64_t seed, const Inflation& inflation) {
  BenchMap map = empty_map("hall", width, height, kResolution);
  Draw draw(seed, "hall");
  const double area = map.geometry.size() * kResolution * kResolution;
  for (double covered = 0.0; covered < 0.2 * area;) {
    const double w = draw.between(0.5, 4.0);
    const double h = draw.between(0.5, 4.0);
    const int x = draw.cell(width);
    const int y = draw.cell(height);
    fill(map, x, y, x + cells(w), y + cells(h), kLethalCost);
    covered += w * h;
  }
  frame(map);
  inflate(map, inflation);
  return map;
}

BenchMap load_movingai_map(const std::string& path) {
  std::ifstream file = open_file(path);
  std::string word, type;
  int height = 0;
  int width = 0;
  file >> word >> type >> word >> height >> word >> width >> word;
  if (!file || width <= 0 || height <= 0) {
    throw Error(path + ":1: is not a MovingAI map (type, height, width, map)");
  }
  BenchMap map = empty_map("movingai", width, height, 1.0);
  for (int y = 0; y < height; ++y) {
    std::string row;
    file >> row;
    if (static_cast<int>(row.size()) != width) {
      throw Error(path + ":" + std::to_string(y + 5) + ": " + std::to_string(row.size()) +
                  " cells, legal: " + std::to_string(width));
    }
    for (int x = 0; x < width; ++x) {
      const char c = row[static_cast<std::size_t>(x)];
      map.cost[map.geometry.index({x, y})] = c == '.' || c == 'G' ? kFreeCost : kLethalCost;
    }
  }
  return map;
}

std::vector<Scenario> load_movingai_scenarios(const std::string& path) {
  std::ifstream file = open_file(path);
  std::vector<Scenario> scenarios;
  std::string line;
  std::getline(file, line);
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream fields(line);
    std::string bucket, name;
    int w = 0;
    int h = 0;
    Scenario s;
    fields >> bucket >> name >> w >> h >> s.start.x >> s.start.y >> s.goal.x >> s.goal.y >>
        s.length;
    if (!fields) throw Error(path + ":" + std::to_string(number) + ": not nine fields: " + line);
    scenarios.push_back(s);
  }
  return scenarios;
}

std::vector<std::pair<Cell, Cell>> random_queries(const BenchMap& map, int count, double least_m,
                                                  std::uint64_t seed) {
  Draw draw(seed, "queries");
  const CostGrid grid = map.view();
  const auto free_cell = [&] {
    while (true) {
      const Cell c{draw.cell(map.geometry.width), draw.cell(map.geometry.height)};
      if (grid.at(c) < 128) return c;
    }
  };
  std::vector<std::pair<Cell, Cell>> queries;
  while (static_cast<int>(queries.size()) < count) {
    const Cell a = free_cell();
    const Cell b = free_cell();
    const double length = std::hypot(a.x - b.x, a.y - b.y) * map.geometry.resolution;
    if (length >= least_m) queries.push_back({a, b});
  }
  return queries;
}

}  // namespace trident::nav::bench
