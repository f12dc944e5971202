// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "control/scene.h"
#include "pain.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"

namespace trident::nav::pains {
namespace {

using testing::Drive;
using testing::GridWorld;
using testing::Scene;

Drive drive_band(const ControlSetup& setup, const Scene& scene, const Path& path = {}) {
  const auto controller = make_controller("teb_local_planner/TebLocalPlannerROS", setup,
                                          parse_yaml("{}", "scene"), "scene");
  return testing::drive(*controller, setup, scene, 60.0, path);
}

/// The scenes have a contact, an arrival, and commands that were refused.
Pains judged(const std::string& rival, const std::string& what, const Drive& drive) {
  const double failed = drive.has_contact || !drive.is_reached ? 1.0 : 0.0;
  const double refused = drive.commands.empty() ? 1.0
                                                : static_cast<double>(drive.failures) /
                                                      static_cast<double>(drive.commands.size());
  const std::string note = drive.failures > 0 ? drive.last_reason : "";
  return {{"P8", rival, "TEB, " + what + ": contacts, or not reached", failed, 0.0, "drives", false,
           note},
          {"P8", rival, "TEB, " + what + ": part of the calls without a feasible command", refused,
           0.02, "1", false, note}};
}

Scene walled_gap(const ControlSetup& setup) {
  GridWorld world(6.0, 4.0);
  world.fill({2.8, 0.1, 3.2, 1.75});
  world.fill({2.8, 2.25, 3.2, 3.9});
  world.inflate(setup.footprint.inscribed_radius, 0.6, 5.0);
  return {"gap", world, {1.0, 2.0, 0.0}, {5.0, 2.0, 0.0}};
}

Scene u_shape(const ControlSetup& setup) {
  GridWorld world(8.0, 6.0);
  world.fill({3.0, 2.0, 4.5, 2.15});
  world.fill({3.0, 3.85, 4.5, 4.0});
  world.fill({4.5, 2.0, 4.65, 4.0});
  world.inflate(setup.footprint.inscribed_radius, 0.6, 5.0);
  return {"U", world, {3.8, 3.0, 0.0}, {6.5, 3.0, 0.0}};
}

/// A wall of one cell, which bands of sparse poses jump.
Scene thin_wall(const ControlSetup& setup) {
  GridWorld world(8.0, 6.0);
  world.fill({4.0, 0.0, 4.05, 4.2});
  world.inflate(setup.footprint.inscribed_radius, 0.6, 5.0);
  return {"thin wall", world, {2.0, 2.0, 0.0}, {6.0, 2.0, 0.0}};
}

Scene pillar(const ControlSetup& setup) {
  GridWorld world(8.0, 6.0);
  world.fill({3.3, 2.6, 4.1, 3.4});
  world.inflate(setup.footprint.inscribed_radius, 0.6, 5.0);
  return {"pillar", world, {1.0, 3.0, 0.0}, {7.0, 3.0, 0.0}};
}

Path straight_path(const Scene& scene) {
  Path path;
  const double length_m = scene.goal.x - scene.start.x;
  const int count = static_cast<int>(std::lround(length_m / 0.1));
  for (int i = 0; i <= count; ++i) {
    path.push_back({scene.start.x + length_m * i / count, scene.start.y, 0.0});
  }
  return path;
}

/// How often the sign of the turn rate changes beyond a tenth of its limit, per second.
double turn_changes_per_s(const Drive& drive, const ControlSetup& setup) {
  int changes = 0;
  double last = 0.0;
  for (const Twist2& twist : drive.commands) {
    if (std::fabs(twist.wz) < 0.1 * setup.limits.wz_max) continue;
    changes += last * twist.wz < 0.0 ? 1 : 0;
    last = twist.wz;
  }
  return changes / std::max(drive.time_s, 1e-9);
}

}  // namespace

Pains band_pains(bool is_quick) {
  const ControlSetup setup = testing::jackal();
  Pains pains = judged("teb_local_planner#7, #12", "out of a U-shaped obstacle",
                       drive_band(setup, u_shape(setup)));
  const auto add = [&](const Pains& more) { pains.insert(pains.end(), more.begin(), more.end()); };
  add(judged("teb_local_planner#3, #22", "gap of 0.5 m", drive_band(setup, walled_gap(setup))));
  const Scene obstacle = pillar(setup);
  const Drive around = drive_band(setup, obstacle, straight_path(obstacle));
  add(judged("teb_local_planner#107, #227", "pillar on the path", around));
  pains.push_back({"P8", "teb_local_planner#279", "TEB, the same: changes of the turn's direction",
                   turn_changes_per_s(around, setup), 1.0, "1/s", false, ""});
  if (is_quick) return pains;
  const Scene wall = thin_wall(setup);
  const Drive thin = drive_band(setup, wall);
  add(judged("teb_local_planner#338", "wall of one cell", thin));
  return pains;
}

}  // namespace trident::nav::pains
