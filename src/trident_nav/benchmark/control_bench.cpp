// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// control_bench [--rounds N]: times one command of each controller in a field of obstacles; a line
// of JSON each with the median, the mean and the 99th percentile of the CPU time of all threads,
// and the median of the wall time [ms].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "control/grid_world.h"
#include "control/scene.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/controller.h"

namespace {

using trident::nav::ControlSetup;
using trident::nav::Path;
using trident::nav::RobotState;
using trident::nav::testing::GridWorld;

struct Row {
  const char* name;
  const char* law;
  const char* params;
  int threads;
};

constexpr Row kRows[] = {
    {"mppi 2000x56", "mppi", "{batch_size: 2000}", 1},
    {"mppi 2000x56, 2 threads", "mppi", "{batch_size: 2000}", 2},
    {"mppi 1000x56", "mppi", "{batch_size: 1000}", 1},
    {"dwa 20x40", "dwa", "{vx_samples: 20, vth_samples: 40, max_vel_x: 0.55, max_vel_theta: 1.0}",
     1},
    {"trajectory planner 20x20", "trajectory_planner", "{max_vel_x: 0.55, max_vel_theta: 1.0}", 1},
    {"dwb 20x20", "dwb", "{max_vel_x: 0.55, max_vel_theta: 1.0, linear_granularity: 0.05}", 1},
    {"teb", "teb", "{}", 1},
    {"graceful", "graceful", "{}", 1},
    {"rotation shim", "rotation_shim", "{}", 1},
    {"regulated pure pursuit", "regulated_pure_pursuit", "{}", 1},
};

// 6 x 6 m with pillars through which a path leads.
GridWorld pillars() {
  GridWorld world(6.0, 6.0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double x = 1.2 + 1.2 * column + (row % 2 == 0 ? 0.0 : 0.5);
      const double y = 0.9 + 1.3 * row;
      world.fill({x - 0.1, y - 0.1, x + 0.1, y + 0.1});
    }
  }
  world.inflate(0.165, 0.55, 5.0);
  return world;
}

double clock_ms(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Times {
  std::vector<double> cpu_ms, wall_ms;
};

// The robot drives the path at full speed, whatever is commanded, so that all see the same.
Times measure(const Row& row, int rounds) {
  ControlSetup setup = trident::nav::testing::jackal();
  setup.threads = row.threads;
  const auto controller =
      trident::nav::make_controller(row.law, setup, trident::parse_yaml(row.params, "benchmark"));
  const GridWorld world = pillars();
  const Path path = trident::nav::testing::plan_on(world.grid(), {0.5, 0.4, 0.5}, {5.5, 5.4, 0.8},
                                                   setup.footprint.inscribed_radius);
  Times times;
  RobotState state;
  for (int i = 0; i < rounds; ++i) {
    const std::size_t reach = path.size() * 2 / 3;
    state.pose = path[static_cast<std::size_t>(i) * 7 % reach];
    state.twist = {0.5, 0.0, 0.0};
    state.time_s += setup.period_s;
    const double cpu_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
    const double wall_ms = clock_ms(CLOCK_MONOTONIC);
    controller->command(state, path, world.grid(), {});
    times.cpu_ms.push_back(clock_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_ms);
    times.wall_ms.push_back(clock_ms(CLOCK_MONOTONIC) - wall_ms);
  }
  std::sort(times.cpu_ms.begin(), times.cpu_ms.end());
  std::sort(times.wall_ms.begin(), times.wall_ms.end());
  return times;
}

void print(const Row& row, const Times& times) {
  const std::vector<double>& cpu = times.cpu_ms;
  double sum = 0.0;
  for (const double t : cpu) sum += t;
  std::printf(
      "{\"name\": \"%s\", \"median_cpu_ms\": %.3f, \"mean_cpu_ms\": %.3f, \"p99_cpu_ms\": %.3f, "
      "\"median_wall_ms\": %.3f}\n",
      row.name, cpu[cpu.size() / 2], sum / static_cast<double>(cpu.size()),
      cpu[cpu.size() * 99 / 100], times.wall_ms[times.wall_ms.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 200;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--rounds") == 0) rounds = std::max(1, std::atoi(argv[i + 1]));
  }
  for (const Row& row : kRows) print(row, measure(row, rounds));
  return 0;
}
