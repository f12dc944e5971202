// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_planning_bench [--map office|hall] [--size CELLS] [--queries N] [--planner NAME]
// [--params YAML]: plans between random poses of a map with cells of 0.05 m; a line of JSON per
// planner with the times of all plans of which a path came, the failures and the lengths.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "bench_maps.h"
#include "planning/curves/footprint_contact.h"
#include "planning/grids/path_points.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/planning/planner_registry.h"

namespace {

using trident::nav::CostGrid;
using trident::nav::Footprint;
using trident::nav::FootprintContact;
using trident::nav::MotionLimits;
using trident::nav::Path;
using trident::nav::PlanOutcome;
using trident::nav::Pose2;

struct Options {
  std::map<std::string, std::string> values{{"map", "office"}, {"size", "632"}, {"queries", "200"},
                                            {"seed", "1"},     {"least", "5"},  {"planner", ""},
                                            {"params", "{}"}};
  int number(const char* name) const { return std::atoi(values.at(name).c_str()); }
};

Footprint robot() {
  Footprint footprint;
  footprint.points = {{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}};
  return trident::nav::completed(footprint);
}

struct Query {
  Pose2 start, goal;
};

// Random cells with random headings at which the robot fits with any heading.
std::vector<Query> draw_queries(const trident::nav::bench::BenchMap& map, const Options& options) {
  const trident::RandomStream random(static_cast<std::uint64_t>(options.number("seed")), "yaw");
  const auto pairs = trident::nav::bench::random_queries(map, 4 * options.number("queries"),
                                                         options.number("least"), 3);
  std::vector<Query> queries;
  std::uint64_t n = 0;
  const auto pose = [&](trident::nav::Cell c) {
    const auto p = map.geometry.center(c);
    return Pose2{p.x, p.y, 6.28 * random.uniform(n++, 0)};
  };
  const float free_m = static_cast<float>(robot().circumscribed_radius) + 0.05F;
  for (const auto& [a, b] : pairs) {
    if (map.distance_m[map.geometry.index(a)] < free_m) continue;
    if (map.distance_m[map.geometry.index(b)] < free_m) continue;
    if (static_cast<int>(queries.size()) < options.number("queries")) {
      queries.push_back({pose(a), pose(b)});
    }
  }
  return queries;
}

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// Poses at 1 cm along the straight lines between those of the path at which the robot is in
// contact.
int contacts(const FootprintContact& contact, const Path& path) {
  int count = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose2& a = path[i - 1];
    const Pose2& b = path[i];
    const double turn = trident::nav::wrap_angle(b.yaw - a.yaw);
    const int parts = 1 + static_cast<int>(trident::nav::distance(a.x, a.y, b.x, b.y) / 0.01);
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const Pose2 p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.yaw + t * turn};
      count += contact.in_contact(p) ? 1 : 0;
    }
  }
  return count;
}

void measure(const std::string& name, const trident::nav::bench::BenchMap& map,
             const Options& options) {
  const auto planner = trident::nav::builtin_planners().get(name)(
      trident::parse_yaml(options.values.at("params"), "--params"), "--params");
  const CostGrid grid = map.view();
  const FootprintContact contact(grid, robot(), FootprintContact::Unknown::kFree);
  const trident::nav::CancelFlag cancel{false};
  std::vector<double> times_ms;
  double sum_ms = 0.0, length_m = 0.0, longest_m = 0.0, longest_ms = 0.0, failed_ms = 0.0;
  int failures = 0, contact_poses = 0;
  for (const Query& query : draw_queries(map, options)) {
    const double before_ms = cpu_ms();
    const PlanOutcome outcome =
        planner->plan(grid, robot(), query.start, query.goal, MotionLimits{}, cancel);
    const double time_ms = cpu_ms() - before_ms;
    if (outcome.failure != trident::nav::Failure::kNone) {
      ++failures;
      failed_ms = std::max(failed_ms, time_ms);
      continue;
    }
    times_ms.push_back(time_ms);
    sum_ms += time_ms;
    const double path_m = trident::nav::path_length(outcome.path);
    length_m += path_m;
    if (path_m > longest_m) {
      longest_m = path_m;
      longest_ms = time_ms;
    }
    contact_poses += contacts(contact, outcome.path);
  }
  if (times_ms.empty()) times_ms.push_back(0.0);
  std::sort(times_ms.begin(), times_ms.end());
  const auto count = static_cast<double>(times_ms.size());
  std::printf(
      "{\"planner\": \"%s\", \"paths\": %zu, \"failures\": %d, \"mean_ms\": %.2f, \"median_ms\": "
      "%.2f, \"p99_ms\": %.2f, \"worst_ms\": %.2f, \"mean_length_m\": %.2f, \"longest_m\": %.1f, "
      "\"longest_ms\": %.2f, \"slowest_failure_ms\": %.2f, \"poses_in_contact\": %d}\n",
      name.c_str(), times_ms.size(), failures, sum_ms / count, times_ms[times_ms.size() / 2],
      times_ms[times_ms.size() * 99 / 100], times_ms.back(), length_m / count, longest_m,
      longest_ms, failed_ms, contact_poses);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string key = std::string(argv[i]).substr(2);
    if (options.values.count(key) == 0) {
      std::fprintf(stderr, "nav_planning_bench: unknown option %s\n", argv[i]);
      return 2;
    }
    options.values[key] = argv[i + 1];
  }
  const int size = options.number("size");
  const auto map = options.values.at("map") == "hall"
                       ? trident::nav::bench::hall_map(size, size, 5)
                       : trident::nav::bench::office_map(size, size, 5);
  const std::string& only = options.values.at("planner");
  for (const std::string& name : trident::nav::builtin_planners().names()) {
    if (only.empty() || name == only) measure(name, map, options);
  }
  return 0;
}
