// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_movingai_bench MAP [STRIDE]: all queries (or every STRIDE-th) of a MovingAI map and the
// scenario file next to it, through the planner Smac 2D without cost, Theta*, and a plain A* with a
// binary heap, by turns. A line of JSON: mean times [ms], the geometric mean of the speed-ups over
// the plain one, the largest relative error of a length, the mean ratio of Theta*'s lengths to the
// octile optimum. Reading the map has a time of its own, and twenty paths before the first query
// are not counted: what is done once for all queries does not weigh on few of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <queue>
#include <string>
#include <vector>

#include "bench_maps.h"
#include "planning/grids/grid_directions.h"
#include "planning/grids/grid_route.h"
#include "planning/grids/path_points.h"
#include "trident_nav/planning/theta_star_planner.h"

namespace {

using trident::nav::Cell;
using trident::nav::CostGrid;
using trident::nav::Pose2;
using trident::nav::bench::BenchMap;
using trident::nav::bench::Scenario;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// A* with a binary heap and octile distance, arrays kept between queries: the row to compare with.
class PlainAStar {
 public:
  explicit PlainAStar(const CostGrid& grid) : grid_(grid), nodes_(grid.geometry.size()) {}

  double length(Cell start, Cell goal) {
    ++search_;
    goal_ = goal;
    heap_ = {};
    reach(start, 0.0, start);
    while (!heap_.empty()) {
      const Cell c = heap_.top().second;
      heap_.pop();
      Node& at = nodes_[grid_.geometry.index(c)];
      if (at.is_closed) continue;
      at.is_closed = true;
      if (c == goal) return at.length;
      expand(c, at.length);
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  struct Node {
    double length = 0.0;
    Cell parent;
    std::uint32_t search = 0;
    bool is_closed = false;
  };
  using Entry = std::pair<double, Cell>;
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const { return a.first > b.first; }
  };

  bool is_free(int x, int y) const {
    return grid_.geometry.contains({x, y}) && grid_.at(Cell{x, y}) == trident::nav::kFreeCost;
  }
  void expand(Cell c, double length) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!is_free(c.x + dx, c.y + dy) || !is_free(c.x + dx, c.y) || !is_free(c.x, c.y + dy)) {
          continue;
        }
        reach({c.x + dx, c.y + dy}, length + (dx != 0 && dy != 0 ? trident::nav::kDiagonal : 1.0),
              c);
      }
    }
  }
  void reach(Cell c, double length, Cell parent) {
    Node& at = nodes_[grid_.geometry.index(c)];
    if (at.search == search_ && (at.is_closed || at.length <= length)) return;
    at = {length, parent, search_, false};
    const int dx = std::abs(c.x - goal_.x);
    const int dy = std::abs(c.y - goal_.y);
    heap_.push({length + std::abs(dx - dy) + trident::nav::kDiagonal * std::min(dx, dy), c});
  }

  CostGrid grid_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, Later> heap_;
  Cell goal_;
  std::uint32_t search_ = 0;
};

trident::nav::GridRouteOptions equal_costs() {
  trident::nav::GridRouteOptions options;
  options.costs.step[trident::nav::kFreeCost] = 1.0F;
  options.taut = false;
  options.jumps = true;
  return options;
}

struct Totals {
  double route_ms = 0.0, plain_ms = 0.0, theta_ms = 0.0;
  double log_speedup = 0.0, worst_error = 0.0, theta_ratio = 0.0, theta_worst = 0.0;
  double read_ms = 0.0;
  int queries = 0, measured_ratios = 0, failures = 0;
};

class Bench {
 public:
  explicit Bench(const BenchMap& map)
      : map_(map), grid_(map.view()), route_(equal_costs()), plain_(grid_), theta_({}) {}

  /// Both searches take in the map, and the memory that they keep from then on.
  void warm_up(const std::vector<Scenario>& scenarios) {
    constexpr std::size_t kPaths = 20;
    const std::size_t stride = scenarios.size() / kPaths + 1;
    for (std::size_t i = 0; i < scenarios.size(); i += stride) {
      const Scenario& s = scenarios[i];
      const double begin_ms = cpu_ms();
      route_.find(grid_, {}, pose(s.start), pose(s.goal), running_);
      if (i == 0) totals_.read_ms = cpu_ms() - begin_ms;
      plain_.length(s.start, s.goal);
    }
  }

  void run(const Scenario& s) {
    const Pose2 start = pose(s.start);
    const Pose2 goal = pose(s.goal);
    const double begin_ms = cpu_ms();
    const auto found = route_.find(grid_, {}, start, goal, running_);
    const double route_ms = cpu_ms() - begin_ms;
    const double plain = plain_.length(s.start, s.goal);
    const double plain_ms = cpu_ms() - begin_ms - route_ms;
    const auto theta = theta_.plan(grid_, {}, start, goal, {}, running_);
    totals_.theta_ms += cpu_ms() - begin_ms - route_ms - plain_ms;
    totals_.route_ms += route_ms;
    totals_.plain_ms += plain_ms;
    totals_.log_speedup += std::log(plain_ms / route_ms);
    ++totals_.queries;
    compare(s, found.cost, plain);
    if (found.failure != trident::nav::Failure::kNone) ++totals_.failures;
    if (theta.failure != trident::nav::Failure::kNone) ++totals_.failures;
    if (s.length > 0.0) compare_theta(trident::nav::path_length(theta.path) / s.length);
  }
  const Totals& totals() const { return totals_; }

 private:
  Pose2 pose(Cell c) const {
    const auto p = map_.geometry.center(c);
    return {p.x, p.y, 0.0};
  }
  void compare(const Scenario& s, double found, double plain) {
    for (const double length : {found, plain}) {
      const double error = std::abs(length - s.length) / std::max(s.length, 1.0);
      totals_.worst_error = std::max(totals_.worst_error, error);
    }
  }
  void compare_theta(double ratio) {
    totals_.theta_ratio += ratio;
    totals_.theta_worst = std::max(totals_.theta_worst, ratio);
    ++totals_.measured_ratios;
  }

  const BenchMap& map_;
  CostGrid grid_;
  trident::nav::GridRoute route_;
  PlainAStar plain_;
  trident::nav::ThetaStarPlanner theta_;
  const trident::nav::CancelFlag running_{false};
  Totals totals_;
};

void measure(const std::string& path, std::size_t stride) {
  const BenchMap map = trident::nav::bench::load_movingai_map(path);
  const auto scenarios = trident::nav::bench::load_movingai_scenarios(path + ".scen");
  Bench bench(map);
  bench.warm_up(scenarios);
  for (std::size_t i = 0; i < scenarios.size(); i += stride) bench.run(scenarios[i]);
  const Totals& t = bench.totals();
  const double count = std::max(t.queries, 1);
  std::printf(
      "{\"queries\": %d, \"failures\": %d, \"read_ms\": %.4f, \"mean_ms\": %.4f, "
      "\"plain_a_star_ms\": %.4f, "
      "\"speed_up\": %.3f, \"worst_length_error\": %.3g, \"theta_star_ms\": %.4f, "
      "\"theta_star_ratio\": %.4f, \"theta_star_worst_ratio\": %.6f}\n",
      t.queries, t.failures, t.read_ms, t.route_ms / count, t.plain_ms / count,
      std::exp(t.log_speedup / count), t.worst_error, t.theta_ms / count,
      t.theta_ratio / std::max(t.measured_ratios, 1), t.theta_worst);
}

}  // namespace

int main(int argc, char** argv) {
  const int stride = argc > 2 ? std::atoi(argv[2]) : 1;
  if (argc < 2 || stride < 1) {
    std::fprintf(stderr, "usage: nav_movingai_bench MAP [STRIDE], STRIDE at least 1\n");
    return 2;
  }
  try {
    measure(argv[1], static_cast<std::size_t>(stride));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nav_movingai_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
