// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <limits>
#include <string>

#include "control/grid_world.h"
#include "control/scene.h"
#include "navigator/robot_world.h"
#include "pain.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav::pains {
namespace {

using testing::RobotWorld;

/// A planted cause: what is said when it strikes, and what that must name.
struct Cause {
  const char* name;
  std::function<std::string()> provoke;
  std::vector<std::string> words;
};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RobotWorld::Setup open_room() {
  RobotWorld::Setup setup;
  setup.start = {1.0, 2.0, 0.0};
  setup.params.planner_frequency = 2.0;
  setup.params.planner_patience = 2.0;
  setup.params.controller_patience = 3.0;
  return setup;
}

/// The text of the outcome of a goal.
std::string outcome_text(RobotWorld& world, const Pose2& goal, double limit_s = 90.0) {
  world.navigator().set_goal(goal, world.now_s());
  const NavigatorOutput output = world.drive(limit_s);
  return output.status == NavigatorStatus::kActive ? "still driving; " + world.waiting()
                                                   : output.text;
}

std::string drive_to(const RobotWorld::Setup& setup, const Pose2& goal) {
  RobotWorld world(setup);
  return outcome_text(world, goal);
}

std::string goal_in_wall() {
  RobotWorld::Setup setup = open_room();
  setup.mapped = {{4.0, 1.5, 5.0, 2.5}};
  return drive_to(setup, {4.5, 2.0, 0.0});
}

std::string walled_in_goal() {
  RobotWorld::Setup setup = open_room();
  setup.mapped = {{3.0, 0.0, 3.1, 4.0}};
  return drive_to(setup, {5.0, 2.0, 0.0});
}

std::string unseen_wall() {
  RobotWorld::Setup setup = open_room();
  setup.unmapped = {{3.0, 0.0, 3.1, 4.0}};
  RobotWorld world(setup);
  return outcome_text(world, {5.0, 2.0, 0.0}, 300.0);
}

std::string walled_in_robot() {
  RobotWorld::Setup setup = open_room();
  setup.mapped = {
      {0.6, 1.6, 1.4, 1.65}, {0.6, 2.35, 1.4, 2.4}, {0.6, 1.6, 0.65, 2.4}, {1.35, 1.6, 1.4, 2.4}};
  return drive_to(setup, {5.0, 2.0, 0.0});
}

std::string too_few_retries() {
  RobotWorld::Setup setup = open_room();
  setup.mapped = {{3.0, 0.0, 3.1, 4.0}};
  setup.params.max_planning_retries = 1;
  setup.params.planner_patience = 100.0;
  return drive_to(setup, {5.0, 2.0, 0.0});
}

/// A box that appears around a robot which nothing else holds.
std::string boxed_in() {
  RobotWorld world(open_room());
  world.navigator().set_goal({5.0, 2.0, 0.0}, 0.0);
  while (world.state().pose.x < 2.0) world.step();
  const double x = world.state().pose.x, y = world.state().pose.y;
  world.add({x + 0.25, y - 0.4, x + 0.35, y + 0.4});
  world.add({x - 0.35, y - 0.4, x - 0.25, y + 0.4});
  world.add({x - 0.35, y - 0.4, x + 0.35, y - 0.25});
  world.add({x - 0.35, y + 0.25, x + 0.35, y + 0.4});
  return world.drive(120.0).text;
}

std::string silent_lidar() {
  RobotWorld world(open_room());
  world.navigator().set_goal({5.0, 2.0, 0.0}, 0.0);
  while (world.now_s() < 2.0) world.step();
  world.set_lidar_on(false);
  while (world.now_s() < 4.0) world.step();
  return world.waiting();
}

std::string mute_lidar() {
  RobotWorld world(open_room());
  world.set_lidar_on(false);
  world.navigator().set_goal({5.0, 2.0, 0.0}, 0.0);
  while (world.now_s() < 2.0) world.step();
  return world.waiting();
}

/// What a controller says on a grid of its own.
std::string command_text(const testing::GridWorld& world, const RobotState& state, const Path& path,
                         const Tracks& tracks, const std::string& law = "dwa") {
  const ControlSetup setup = testing::jackal();
  const auto controller = make_controller(law, setup, parse_yaml("{}", "scene"), "scene");
  return controller->command(state, path, world.grid(), tracks).reason;
}

std::string walker_ahead() {
  testing::GridWorld world(6.0, 4.0);
  const Track walker{7, {2.6, 2.0}, {-1.0, 0.0}, 0.3, {}};
  const RobotState state{{2.0, 2.0, 0.0}, {1.5, 0.0, 0.0}, 0.0};
  return command_text(world, state, {{2.0, 2.0, 0.0}, {5.0, 2.0, 0.0}}, {walker},
                      "regulated_pure_pursuit");
}

std::string no_turn_at_goal() {
  testing::GridWorld world(6.0, 4.0);
  world.fill({1.0, 1.5, 5.0, 1.78});
  world.fill({1.0, 2.22, 5.0, 2.5});
  const RobotState state{{3.0, 2.0, 0.0}, {}, 0.0};
  return command_text(world, state, {{3.0, 2.0, 1.57}}, {});
}

}  // namespace

Pains reason_pains(bool /*is_quick*/) {
  const std::vector<Cause> causes = {
      {"goal in an obstacle", goal_in_wall, {"Failed to find a valid plan.", "goal (4.50, 2.00)"}},
      {"goal outside of the map",
       [] {
         return drive_to(open_room(), {9.0, 2.0, 0.0});
       },
       {"goal (9.00, 2.00)", "outside"}},
      {"goal walled in by the map", walled_in_goal, {"goal (5.00, 2.00)", "No path"}},
      {"goal walled in by what the lidar sees", unseen_wall, {"goal (5.00, 2.00)", "No path"}},
      {"robot walled in", walled_in_robot, {"Failed to find a valid", "cut it off from the start"}},
      {"max_planning_retries used up", too_few_retries, {"max_planning_retries of 1"}},
      {"box around the robot", boxed_in, {"Even after executing recovery behaviors.", "obstacle"}},
      {"goal that is no number",
       [] {
         return drive_to(open_room(), {kNaN, 2.0, 0.0});
       },
       {"goal pose is not finite"}},
      {"lidar falls silent", silent_lidar, {"scan", "obstacle_layer", "limit is 0.3 s"}},
      {"lidar never sent", mute_lidar, {"scan", "obstacle_layer"}},
      {"walker in the braking trajectory", walker_ahead, {"moving obstacle 7"}},
      {"no room for the goal's heading", no_turn_at_goal, {"goal's heading is blocked"}},
  };
  Pain pain{"P9",
            "navigation#57, #1178, navigation2#4778",
            "12 planted causes: named in the text",
            0.0,
            12.0,
            "causes",
            true,
            ""};
  for (const Cause& cause : causes) {
    const std::string text = cause.provoke();
    bool is_named = true;
    for (const std::string& word : cause.words) {
      is_named = is_named && text.find(word) != std::string::npos;
    }
    pain.measured += is_named ? 1.0 : 0.0;
    if (!is_named) pain.note += std::string(cause.name) + ": '" + text + "' ";
  }
  return {pain};
}

}  // namespace trident::nav::pains
