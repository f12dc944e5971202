// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "critic_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../path_centering.h"

namespace trident::nav {
namespace {

// Forward trajectories that get no farther along the path than this share of those backwards are
// those of a robot that can only leave backwards.
constexpr double kStuckShare = 0.3;

// Of circumscribed radii: where a robot has less room it passes straight or not at all.
constexpr double kNarrowRadii = 1.05;

int nearest_point(const CriticScene& scene, float x, float y) {
  int nearest = 0;
  float best = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < scene.path_x.size(); ++i) {
    const float dx = scene.path_x[i] - x;
    const float dy = scene.path_y[i] - y;
    const float square = dx * dx + dy * dy;
    if (square >= best) continue;
    best = square;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

bool drives_back(const Rollouts& rollouts, int lane) {
  float sum = 0.0F;
  for (int step = 0; step < rollouts.steps; ++step) sum += rollouts.at(rollouts.vx, step)[lane];
  return sum < 0.0F;
}

bool is_blocked(const CriticScene& scene, std::size_t point) {
  const Cell cell =
      scene.grid.geometry.cell(scene.origin.x + static_cast<double>(scene.path_x[point]),
                               scene.origin.y + static_cast<double>(scene.path_y[point]));
  if (!scene.grid.geometry.contains(cell)) return false;
  const auto d = static_cast<double>(scene.grid.distance_m[scene.grid.geometry.index(cell)]);
  return d < scene.model.inscribed_radius;
}

/// The share of the path's points up to one that the robot's center cannot pass.
double blocked_ratio(const CriticScene& scene, int last) {
  int blocked = 0;
  for (int i = 0; i <= last; ++i) {
    if (is_blocked(scene, static_cast<std::size_t>(i))) ++blocked;
  }
  return static_cast<double>(blocked) / (last + 1);
}

}  // namespace

CriticScene make_critic_scene(const MppiModel& model, const Situation& situation,
                              const CostGrid& grid) {
  CriticScene scene{model, situation.state.pose, grid, situation.tracks, {}, {}, {}, {}, {}};
  const LocalPath& path = situation.path;
  std::vector<Pose2> poses = path.poses;
  // Headings of its own say that the planner has checked the footprint.
  if (!path.has_headings) center_path(grid, kNarrowRadii * model.circumscribed_radius, &poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2& p = poses[i];
    scene.path_x.push_back(static_cast<float>(p.x - scene.origin.x));
    scene.path_y.push_back(static_cast<float>(p.y - scene.origin.y));
    scene.path_cosine.push_back(static_cast<float>(std::cos(p.yaw)));
    scene.path_sine.push_back(static_cast<float>(std::sin(p.yaw)));
    scene.path_yaw.push_back(static_cast<float>(path.has_headings ? path.headings[i] : p.yaw));
  }
  scene.path_spacing = static_cast<float>(path.spacing_m);
  scene.is_reverse = path.is_reverse;
  scene.has_headings = path.has_headings;
  scene.reaches_goal = path.reaches_goal;
  scene.goal_x = static_cast<float>(situation.goal.x - scene.origin.x);
  scene.goal_y = static_cast<float>(situation.goal.y - scene.origin.y);
  scene.goal_yaw = static_cast<float>(situation.goal.yaw);
  scene.goal_distance_m = path.remaining_m + path.deviation_m;
  return scene;
}

void find_furthest(const Rollouts& rollouts, CriticScene* scene) {
  scene->furthest = 0;
  int ahead = 0;
  const int last = rollouts.steps - 1;
  for (int lane = 0; lane < kLanes; ++lane) {
    if (rollouts.contact_step[static_cast<std::size_t>(lane)] < rollouts.steps) continue;
    const int point = nearest_point(*scene, rollouts.at(rollouts.x, last)[lane],
                                    rollouts.at(rollouts.y, last)[lane]);
    scene->furthest = std::max(scene->furthest, point);
    if (!drives_back(rollouts, lane)) ahead = std::max(ahead, point);
  }
  const double reached_m = static_cast<double>(scene->path_spacing) * scene->furthest;
  scene->leaves_backwards =
      reached_m > scene->model.circumscribed_radius && ahead < kStuckShare * scene->furthest;
  scene->blocked_ratio = blocked_ratio(*scene, scene->furthest);
}

}  // namespace trident::nav
