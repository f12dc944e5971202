// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/costmap_world.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/range_sensor_layer.h"

namespace trident::nav {
namespace {

constexpr double kReach_m = 2.0;  // of what is named as an obstacle

CellBox box_about(const GridGeometry& grid, const Pose2& robot, double side_m) {
  const double half = 0.5 * side_m;
  const Cell low = grid.cell(robot.x - half, robot.y - half);
  const Cell high = grid.cell(robot.x + half, robot.y + half);
  return {std::clamp(low.x, 0, grid.width), std::clamp(low.y, 0, grid.height),
          std::clamp(high.x + 1, 0, grid.width), std::clamp(high.y + 1, 0, grid.height)};
}

std::string topics_text(const Layer& layer) {
  std::vector<std::string> topics;
  if (const auto* beams = dynamic_cast<const BeamLayer*>(&layer)) {
    for (const BeamSource& source : beams->sources()) topics.push_back(source.topic());
  } else if (const auto* ranges = dynamic_cast<const RangeSensorLayer*>(&layer)) {
    topics = ranges->params().topics;
  }
  return topics.empty() ? "" : " (" + join(topics) + ")";
}

bool is_lethal_in(const Layer& layer, Cell cell) {
  const auto* cells = dynamic_cast<const CellLayer*>(&layer);
  if (cells == nullptr || !layer.is_enabled()) return false;
  std::uint8_t cost = kFreeCost;
  cells->combine(cell.y, cell.x, cell.x + 1, &cost);
  return cost == kLethalCost;
}

std::optional<Cell> nearest_lethal(const CostGrid& grid, const Pose2& robot, double reach_m) {
  const GridGeometry& g = grid.geometry;
  const CellBox box = box_about(g, robot, 2.0 * reach_m);
  std::optional<Cell> best;
  double least = reach_m;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (grid.at(Cell{x, y}) != kLethalCost) continue;
      const Point2 p = g.center({x, y});
      const double d = distance(p.x, p.y, robot.x, robot.y);
      if (d >= least) continue;
      least = d;
      best = Cell{x, y};
    }
  }
  return best;
}

}  // namespace

double path_cost_on(const CostGrid& grid, const Path& path, std::size_t first) {
  constexpr double kMaxBelowInscribed = 252.0;
  double total = 0.0;
  for (std::size_t i = first + 1; i < path.size(); ++i) {
    const int cost = grid.at(path[i].x, path[i].y);
    if (cost == kInscribedCost || cost == kLethalCost) {
      return std::numeric_limits<double>::infinity();
    }
    const double weight = cost == kUnknownCost ? 1.0 : 1.0 + cost / kMaxBelowInscribed;
    total += weight * distance(path[i - 1].x, path[i - 1].y, path[i].x, path[i].y);
  }
  return total;
}

void forget_area(Costmap& costmap, const Pose2& robot, const ClearedArea& area) {
  const CellBox box = box_about(costmap.grid().geometry, robot, area.side_m);
  for (const auto& layer : costmap.layers()) {
    const bool is_meant = area.layers.empty() || std::find(area.layers.begin(), area.layers.end(),
                                                           layer->name()) != area.layers.end();
    if (is_meant) layer->forget(box, area.side);
  }
}

std::string lethal_layers_text(const Costmap& costmap, Cell cell) {
  if (!costmap.grid().geometry.contains(cell)) return "";
  std::vector<std::string> names;
  for (const auto& layer : costmap.layers()) {
    if (is_lethal_in(*layer, cell)) names.push_back(layer->name() + topics_text(*layer));
  }
  return join(names);
}

std::string nearest_obstacle_text(const Costmap& costmap, const Pose2& robot, double reach_m) {
  const CostGrid grid = costmap.grid();
  const std::optional<Cell> cell = nearest_lethal(grid, robot, reach_m);
  if (!cell) return "";
  const Point2 p = grid.geometry.center(*cell);
  char text[160];
  std::snprintf(text, sizeof text, "The nearest obstacle is at (%.2f, %.2f) in %s, %.2f m away",
                p.x, p.y, costmap.params().global_frame.c_str(),
                distance(p.x, p.y, robot.x, robot.y));
  const std::string layers = lethal_layers_text(costmap, *cell);
  return std::string(text) + (layers.empty() ? "." : ", in layer " + layers + ".");
}

void CostmapWorld::request_plan(const Pose2& start, const Pose2& goal) {
  const CancelFlag never{false};
  outcome_ =
      avoided_.plan(planner_, global_.grid(), global_.footprint(), start, goal, limits_, never);
}

std::optional<PlanOutcome> CostmapWorld::take_plan() {
  return std::exchange(outcome_, std::nullopt);
}

double CostmapWorld::path_cost(const Path& path, std::size_t first) {
  return path_cost_on(global_.grid(), path, first);
}

void CostmapWorld::avoid(const Path& ahead) {
  if (ahead.empty()) avoided_.clear();
  avoided_.add(global_.grid(), global_.footprint(), ahead);
}

void CostmapWorld::forget(const ClearedArea& area) {
  if (area.maps != AffectedMaps::kLocal) forget_area(global_, robot_global_, area);
  if (area.maps != AffectedMaps::kGlobal) forget_area(local_, robot_local_, area);
}

std::vector<StaleSource> CostmapWorld::stale_sources(double now_s) {
  return local_.stale_sources(now_s);
}

std::string CostmapWorld::obstacle_text(const Pose2& robot_local) {
  return nearest_obstacle_text(local_, robot_local, kReach_m);
}

}  // namespace trident::nav
