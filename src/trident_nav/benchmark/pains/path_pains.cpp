// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "control/grid_world.h"
#include "pain.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/navigator/costmap_world.h"
#include "trident_nav/navigator/path_keeper.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav::pains {
namespace {

using testing::GridWorld;

constexpr double kPlanPeriod_s = 0.2;
constexpr double kPoseNoise_m = 0.01;
constexpr double kInscribed_m = 0.165;

Footprint rectangle() {
  return polygon_footprint({{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}});
}

MotionLimits limits() { return {0.5, -0.2, 0.0, 1.5, 1.0, 1.0, 0.0, 3.0, 0.0}; }

std::unique_ptr<Planner> make_planner(const std::string& name) {
  return builtin_planners().get(name)(parse_yaml("{}", "scene"), "scene");
}

/// Costs of paths on a grid that changes; plans are made elsewhere.
class GridCosts : public NavigatorWorld {
 public:
  explicit GridCosts(const GridWorld& world) : world_(world) {}
  void request_plan(const Pose2&, const Pose2&) override {}
  std::optional<PlanOutcome> take_plan() override { return std::nullopt; }
  void cancel_plan() override {}
  double path_cost(const Path& path, std::size_t first) override {
    return path_cost_on(world_.grid(), path, first);
  }
  void forget(const ClearedArea&) override {}
  std::vector<StaleSource> stale_sources(double) override { return {}; }
  std::string obstacle_text(const Pose2&) override { return ""; }

 private:
  const GridWorld& world_;
};

/// A room with walls, by costs as costmap_2d has them.
GridWorld room(double width_m, double height_m) {
  GridWorld world(width_m, height_m);
  world.fill({0.0, 0.0, width_m, 0.1});
  world.fill({0.0, height_m - 0.1, width_m, height_m});
  world.fill({0.0, 0.0, 0.1, height_m});
  world.fill({width_m - 0.1, 0.0, width_m, height_m});
  return world;
}

/// A robot that plans and keeps paths as the navigator does, by a pose with noise.
class Replanner {
 public:
  Replanner(const std::string& planner, const GridWorld& world, std::uint64_t seed)
      : world_(world), planner_(make_planner(planner)), costs_(world), random_(seed, "pose") {}

  /// True: the path changed.
  bool plan(const Pose2& robot, const Pose2& goal) {
    const Pose2 seen{robot.x + kPoseNoise_m * random_.normal(plans_, 0),
                     robot.y + kPoseNoise_m * random_.normal(plans_, 1), robot.yaw};
    const double now_s = kPlanPeriod_s * static_cast<double>(plans_++);
    keeper_.advance(seen);
    const CancelFlag never{false};
    PlanOutcome outcome = planner_->plan(world_.grid(), rectangle(), seen, goal, limits(), never);
    if (outcome.failure != Failure::kNone) return false;
    const double left_m = rectangle().circumscribed_radius;
    return keeper_.offer(std::move(outcome.path), now_s, seen, left_m, costs_);
  }
  std::uint64_t plans() const { return plans_; }
  const Path& path() const { return keeper_.path(); }

 private:
  const GridWorld& world_;
  std::unique_ptr<Planner> planner_;
  GridCosts costs_;
  RandomStream random_;
  PathKeeper keeper_{NavigatorParams{}};
  std::uint64_t plans_ = 0;
};

/// Two corridors of equal length about a block; small things flicker at their edges, which make
/// one of them better and then the other, and block none.
class TwoCorridors {
 public:
  explicit TwoCorridors(std::uint64_t seed) : random_(seed, "flicker") { flicker(0); }

  void flicker(std::uint64_t plan) {
    world_ = room(10.0, 6.0);
    world_.fill({3.5, 2.0, 6.5, 4.0});
    for (std::uint32_t i = 0; i < kThings; ++i) {
      if (random_.uniform(plan, 3 * i) < 0.5) continue;
      const double x = 3.5 + 2.9 * random_.uniform(plan, 3 * i + 1);
      const bool is_upper = i % 2 == 0;
      // Next to the block or to the wall, where the corridor stays wide enough.
      const double off = random_.uniform(plan, 3 * i + 2) < 0.5 ? 0.0 : 1.7;
      const double y = is_upper ? 4.0 + off : 1.8 - off;
      world_.fill({x, y, x + 0.1, y + 0.2});
    }
    world_.inflate(kInscribed_m, 0.6, 4.0);
  }
  const GridWorld& world() const { return world_; }

 private:
  static constexpr std::uint32_t kThings = 12;
  RandomStream random_;
  GridWorld world_{10.0, 6.0};
};

int side_of(const Path& path) {
  for (const Pose2& pose : path) {
    if (std::fabs(pose.x - 5.0) < 0.3) return pose.y > 3.0 ? 1 : -1;
  }
  return 0;
}

/// How often the kept path changes sides, for a robot that stands before the two corridors.
int side_changes(const std::string& planner, int plans) {
  TwoCorridors corridors(1);
  Replanner robot(planner, corridors.world(), 2);
  int changes = 0, side = 0;
  for (int i = 0; i < plans; ++i) {
    corridors.flicker(static_cast<std::uint64_t>(i));
    robot.plan({1.5, 3.0, 0.0}, {8.5, 3.0, 0.0});
    const int now = side_of(robot.path());
    changes += side != 0 && now != side ? 1 : 0;
    side = now;
  }
  return changes;
}

/// Pillars at random, none near the two ends of a drive.
GridWorld pillars(std::uint64_t seed) {
  const RandomStream random(seed, "pillars");
  GridWorld world = room(20.0, 8.0);
  for (std::uint64_t i = 0; i < 40; ++i) {
    const double x = 2.5 + 15.0 * random.uniform(i, 0), y = 0.3 + 7.2 * random.uniform(i, 1);
    world.fill({x, y, x + 0.2, y + 0.2});
  }
  world.inflate(kInscribed_m, 0.6, 4.0);
  return world;
}

Pose2 moved_along(const Path& path, const Pose2& robot, double step_m) {
  std::size_t nearest = 0;
  const auto off = [&](std::size_t i) { return distance(path[i].x, path[i].y, robot.x, robot.y); };
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (off(i) < off(nearest)) nearest = i;
  }
  while (nearest + 1 < path.size() && off(nearest) < step_m) ++nearest;
  const double d = std::max(off(nearest), 1e-9), kept = std::min(step_m / d, 1.0);
  return {robot.x + kept * (path[nearest].x - robot.x),
          robot.y + kept * (path[nearest].y - robot.y), path[nearest].yaw};
}

struct Replans {
  std::uint64_t plans = 0, changes = 0;
};

/// A drive through pillars at 0.5 m/s.
Replans drive(const std::string& planner, std::uint64_t seed) {
  const GridWorld world = pillars(seed);
  Replanner replanner(planner, world, seed);
  Pose2 robot{1.0, 4.0, 0.0};
  const Pose2 goal{19.0, 4.0, 0.0};
  Replans result;
  while (distance(robot.x, robot.y, goal.x, goal.y) > 0.1 && result.plans < 1000) {
    const bool is_first = replanner.path().empty();
    if (replanner.plan(robot, goal) && !is_first) ++result.changes;
    ++result.plans;
    if (replanner.path().empty()) break;  // no path through these pillars
    robot = moved_along(replanner.path(), robot, 0.5 * kPlanPeriod_s);
  }
  return result;
}

double changed_share(const std::string& planner, int seeds) {
  Replans sum;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Replans one = drive(planner, static_cast<std::uint64_t>(seed));
    sum.plans += one.plans;
    sum.changes += one.changes;
  }
  return static_cast<double>(sum.changes) /
         static_cast<double>(std::max<std::uint64_t>(sum.plans, 1));
}

std::vector<std::string> searching_planners() {
  std::vector<std::string> names = builtin_planners().names();
  names.erase(std::remove(names.begin(), names.end(), "carrot_planner/CarrotPlanner"), names.end());
  return names;
}

/// Of all planners, how many refuse a start; their names in `refusing`.
int refusals(const GridWorld& world, const Pose2& start, std::string* refusing) {
  int count = 0;
  for (const std::string& name : searching_planners()) {
    const CancelFlag never{false};
    const PlanOutcome outcome = make_planner(name)->plan(world.grid(), rectangle(), start,
                                                         {6.0, 3.0, 0.0}, limits(), never);
    if (outcome.failure == Failure::kNone) continue;
    ++count;
    *refusing += name + ": " + outcome.reason + " ";
  }
  return count;
}

Pain refusal_pain(const std::string& rival, const std::string& what, const GridWorld& world,
                  const Pose2& start) {
  Pain pain{"P7", rival, what + ": planners that refuse it", 0.0, 0.0, "planners", false, ""};
  pain.measured = refusals(world, start, &pain.note);
  return pain;
}

Pains refused_starts() {
  GridWorld near_wall = room(8.0, 6.0);
  near_wall.inflate(kInscribed_m, 0.6, 4.0);
  GridWorld false_obstacle = room(8.0, 6.0);
  false_obstacle.fill({1.95, 2.95, 2.05, 3.05});
  false_obstacle.inflate(kInscribed_m, 0.6, 4.0);
  return {refusal_pain("navigation2#5685", "start 5 cm from a wall, along it", near_wall,
                       {2.0, 0.1 + 0.165 + 0.05, 0.0}),
          refusal_pain("navigation2#5685", "start whose cell has the inscribed cost", near_wall,
                       {2.0, 0.235, 0.0}),
          refusal_pain("navigation2#4655", "false obstacle under the robot at the start",
                       false_obstacle, {2.0, 3.0, 0.0})};
}

}  // namespace

Pains path_pains(bool is_quick) {
  Pains pains;
  const int plans = is_quick ? 100 : 3000;  // of 10 minutes
  for (const char* planner : {"navfn/NavfnROS", "nav2_smac_planner/SmacPlanner2D"}) {
    pains.push_back({"P5", "navigation2#2381, #2804",
                     std::string("two corridors of equal length, flickering obstacles, ") +
                         planner + ": changes of side in " + std::to_string(plans) +
                         " plans at 5 Hz",
                     static_cast<double>(side_changes(planner, plans)), 1.0, "changes", false, ""});
    pains.push_back({"P5", "navigation2#2085, #1570",
                     std::string("5 Hz, 1 cm of pose noise, ") + planner +
                         ": part of the plans that change the path",
                     changed_share(planner, is_quick ? 2 : 20), 0.02, "1", false, ""});
  }
  for (Pain& pain : refused_starts()) pains.push_back(std::move(pain));
  return pains;
}

}  // namespace trident::nav::pains
