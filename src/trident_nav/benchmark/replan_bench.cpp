// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_replan_bench [--size CELLS] [--queries N]: plans of navfn between random places of an office
// with cells of 0.05 m: the first to a goal, and those after the robot has moved or a hundredth of
// the cells has changed. A line of JSON per case with CPU times.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench_maps.h"
#include "trident_base/random_stream.h"
#include "trident_nav/planning/navfn_planner.h"

namespace {

using trident::nav::Cell;
using trident::nav::Failure;
using trident::nav::Pose2;
using trident::nav::bench::BenchMap;

constexpr int kBox = 10;            // cells a side
constexpr double kClear_m = 1.0;    // of boxes, about the robot and the goal
constexpr std::size_t kAhead = 10;  // poses that the robot has moved by

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// An office in which boxes come and go.
class ChangingOffice {
 public:
  explicit ChangingOffice(int size)
      : map_(trident::nav::bench::office_map(size, size, 5)),
        empty_(map_.cost),
        random_(2, "boxes") {
    map_.row_revisions.assign(static_cast<std::size_t>(size), map_.revision);
  }
  const BenchMap& map() const { return map_; }

  /// Boxes all over the map, until a hundredth of the cells has changed; none near two places.
  void add_boxes(const Pose2& robot, const Pose2& goal) {
    const std::vector<std::uint8_t> before = map_.cost;
    std::size_t changed = 0;
    for (int count = 1; 100 * changed < map_.geometry.size(); ++count) {
      const Cell c{draw(map_.geometry.width), draw(map_.geometry.height)};
      if (is_near(c, robot) || is_near(c, goal)) continue;
      trident::nav::bench::add_box(map_, c, kBox);
      if (count % 16 == 0) changed = differences(before);
    }
    note(before);
  }
  void clear() {
    const std::vector<std::uint8_t> before = map_.cost;
    map_.cost = empty_;
    note(before);
  }

 private:
  int draw(int below) { return static_cast<int>(random_.uniform(next_++, 0) * below); }
  bool is_near(Cell c, const Pose2& pose) const {
    const auto p = map_.geometry.center(c);
    return trident::nav::distance(p.x, p.y, pose.x, pose.y) < kClear_m;
  }
  std::size_t differences(const std::vector<std::uint8_t>& before) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < before.size(); ++i) count += before[i] != map_.cost[i] ? 1 : 0;
    return count;
  }
  void note(const std::vector<std::uint8_t>& before) {
    ++map_.revision;
    for (std::size_t y = 0; y < map_.row_revisions.size(); ++y) {
      const std::size_t first = y * static_cast<std::size_t>(map_.geometry.width);
      const auto* now = map_.cost.data() + first;
      if (!std::equal(now, now + map_.geometry.width, before.data() + first)) {
        map_.row_revisions[y] = map_.revision;
      }
    }
  }

  BenchMap map_;
  std::vector<std::uint8_t> empty_;
  trident::RandomStream random_;
  std::uint64_t next_ = 0;
};

/// Times by case, in the order in which the cases came.
class Times {
 public:
  void add(const std::string& name, double time_ms) {
    for (auto& [known, times] : cases_) {
      if (known == name) {
        times.push_back(time_ms);
        return;
      }
    }
    cases_.push_back({name, {time_ms}});
  }
  void print(int size) {
    for (auto& [name, times] : cases_) {
      std::sort(times.begin(), times.end());
      double sum = 0.0;
      for (const double t : times) sum += t;
      std::printf(
          "{\"name\": \"navfn, office %dx%d: %s\", \"median_cpu_ms\": %.3f, \"mean_cpu_ms\": %.3f, "
          "\"p99_cpu_ms\": %.3f, \"plans\": %zu}\n",
          size, size, name.c_str(), times[times.size() / 2],
          sum / static_cast<double>(times.size()), times[times.size() * 99 / 100], times.size());
    }
  }

 private:
  std::vector<std::pair<std::string, std::vector<double>>> cases_;
};

class Bench {
 public:
  explicit Bench(int size) : office_(size) {}

  void run(int queries) {
    const auto pairs = trident::nav::bench::random_queries(office_.map(), queries, 5.0, 3);
    for (const auto& [start, goal] : pairs) drive(pose(start), pose(goal));
    times_.print(office_.map().geometry.width);
  }

 private:
  Pose2 pose(Cell c) const {
    const auto p = office_.map().geometry.center(c);
    return {p.x, p.y, 0.0};
  }
  /// The plan, or an empty path.
  trident::nav::Path plan(const char* name, const Pose2& start, const Pose2& goal) {
    trident::nav::Footprint robot;
    robot.inscribed_radius = robot.circumscribed_radius = 0.165;
    const double begin_ms = cpu_ms();
    auto outcome = planner_.plan(office_.map().view(), robot, start, goal, {}, running_);
    times_.add(name, cpu_ms() - begin_ms);
    return std::move(outcome.path);
  }
  void drive(const Pose2& start, const Pose2& goal) {
    const auto path = plan("first plan to a goal", start, goal);
    if (path.size() <= kAhead) return;
    const Pose2 robot = path[kAhead];
    plan("the robot has moved", robot, goal);
    office_.add_boxes(robot, goal);
    plan("boxes on 1 % of the cells", robot, goal);
    office_.clear();
    plan("boxes on 1 % of the cells gone", robot, goal);
  }

  ChangingOffice office_;
  trident::nav::NavfnPlanner planner_{trident::nav::NavfnParams{}};
  const trident::nav::CancelFlag running_{false};
  Times times_;
};

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, int> options{{"--size", 4000}, {"--queries", 20}};
  for (int i = 1; i + 1 < argc; i += 2) {
    const auto option = options.find(argv[i]);
    if (option == options.end() || std::atoi(argv[i + 1]) < 1) {
      std::fprintf(stderr, "nav_replan_bench: %s %s; legal: --size, --queries, at least 1\n",
                   argv[i], argv[i + 1]);
      return 2;
    }
    option->second = std::atoi(argv[i + 1]);
  }
  Bench(options["--size"]).run(options["--queries"]);
  return 0;
}
