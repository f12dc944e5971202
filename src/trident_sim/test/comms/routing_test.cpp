// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "routing_mesh.h"

namespace trident::sim {
namespace {

constexpr double kRates_bit_s[] = {6.5e6, 13e6, 26e6, 52e6, 78e6, 200e6, 433e6};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RoutingMesh::Link random_link(double min_delivery, Dice* dice) {
  const double delivery = min_delivery < 1.0 ? dice->uniform(min_delivery, 1.0) : 1.0;
  return {delivery, kRates_bit_s[dice->below(std::size(kRates_bit_s))]};
}

/// The pair's link is there by chance, and with its own quality in each direction.
void set_random_link(std::size_t a, std::size_t b, double density, double min_delivery,
                     RoutingMesh* mesh, Dice* dice) {
  const bool is_link = dice->uniform() < density;
  const auto one = is_link ? random_link(min_delivery, dice) : RoutingMesh::Link{};
  mesh->set_link(a, b, one, is_link ? random_link(min_delivery, dice) : RoutingMesh::Link{});
}

RoutingMesh random_mesh(std::uint64_t seed, double min_delivery, Dice* dice) {
  const std::size_t size = 3 + dice->below(18);
  std::vector<RouterParams> params(size);
  for (RouterParams& one : params) one.is_base_station = dice->uniform() < 0.1;
  RoutingMesh mesh(params, seed);
  const double density = std::min(1.0, dice->uniform(1.5, 6.0) / static_cast<double>(size));
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      set_random_link(a, b, density, min_delivery, &mesh, dice);
    }
  }
  return mesh;
}

/// Links change, nodes go off and on again, and radios report failures, all at any time.
void disturb(RoutingMesh* mesh, Dice* dice) {
  const std::size_t a = dice->below(mesh->size()), b = dice->below(mesh->size());
  const double what = dice->uniform();
  if (what < 0.15) {
    mesh->set_on(a, !mesh->is_on(a));
  } else if (what < 0.25) {
    mesh->router(a).lost(RoutingMesh::name(b));
  } else if (a != b) {
    set_random_link(a, b, 0.5, 0.1, mesh, dice);
  }
}

std::uint64_t graph_count(std::uint64_t usual) {
  const char* const wanted = std::getenv("TRIDENT_ROUTING_GRAPHS");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : usual;
}

TEST(Routing, HasNoLoopAtAnyStep) {
  const std::uint64_t graphs = graph_count(1000);
  std::size_t routes = 0, pairs = 0;
  for (std::uint64_t seed = 0; seed < graphs; ++seed) {
    Dice dice(seed, "graph");
    RoutingMesh mesh = random_mesh(seed, 0.2, &dice);
    mesh.set_max_delay(dice.below(12));
    const double events_per_step = dice.uniform(0.0, 0.2);
    for (int step = 0; step < 400; ++step) {
      if (dice.uniform() < events_per_step) disturb(&mesh, &dice);
      mesh.step();
      ASSERT_TRUE(mesh.is_loop_free()) << "graph " << seed << ", step " << step;
    }
    pairs += mesh.size() * (mesh.size() - 1);
    for (std::size_t i = 0; i < mesh.size(); ++i) routes += mesh.router(i).destinations().size();
  }
  std::cout << graphs << " graphs, at the end routes for " << 100 * routes / pairs
            << " % of pairs\n";
  EXPECT_GT(2 * routes, pairs);
}

using Cost = std::function<double(std::size_t from, std::size_t to)>;

/// Of all nodes to `to`, with full knowledge (Bellman and Ford).
std::vector<double> best_costs(std::size_t size, std::size_t to, const Cost& cost) {
  std::vector<double> best(size, kInfinity);
  best[to] = 0.0;
  for (std::size_t round = 0; round < size; ++round) {
    for (std::size_t a = 0; a < size; ++a) {
      for (std::size_t b = 0; b < size; ++b) {
        if (a != b) best[a] = std::min(best[a], cost(a, b) + best[b]);
      }
    }
  }
  return best;
}

double path_cost(const std::vector<std::size_t>& path, const Cost& cost) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += cost(path[i], path[i + 1]);
  return sum;
}

/// For each pair with a path: cost of the route chosen over that of the best path.
std::vector<double> excesses(const RoutingMesh& mesh, const Cost& cost) {
  std::vector<double> result;
  for (std::size_t to = 0; to < mesh.size(); ++to) {
    const std::vector<double> best = best_costs(mesh.size(), to, cost);
    for (std::size_t from = 0; from < mesh.size(); ++from) {
      if (from == to || best[from] == kInfinity) continue;
      const auto path = mesh.path(from, to);
      result.push_back(path ? path_cost(*path, cost) / best[from] : kInfinity);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// By the links' real quality.
double real_cost(const RoutingMesh& mesh, std::size_t a, std::size_t b) {
  const RoutingMesh::Link there = mesh.link(a, b), back = mesh.link(b, a);
  const double shares = there.delivery * back.delivery;
  if (shares <= 0.0) return kInfinity;
  const bool is_base = mesh.is_base_station(a) || mesh.is_base_station(b);
  const double factor = is_base ? RouterParams().base_station_factor : 1.0;
  return factor * 8.0 * RouterParams().packet_bytes / (there.rate_bit_s * shares);
}

TEST(Routing, OverLinksWithoutLossIsWithinTenPercentOfTheBestAfterThreeSeconds) {
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Dice dice(seed, "static graph");
    RoutingMesh mesh = random_mesh(seed, 1.0, &dice);
    mesh.run(3.0);
    const auto found =
        excesses(mesh, [&](std::size_t a, std::size_t b) { return real_cost(mesh, a, b); });
    if (!found.empty()) worst = std::max(worst, found.back());
    ASSERT_LE(worst, 1.1) << "graph " << seed;
  }
  std::cout << "worst route: " << worst << " of the best path's metric\n";
}

void print(const std::string& what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto part = [&values](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const auto within = std::upper_bound(values.begin(), values.end(), 1.1) - values.begin();
  std::cout << what << ": median " << part(0.5) << ", 90 % " << part(0.9) << ", 99 % " << part(0.99)
            << ", largest " << values.back() << "; up to 1.1: "
            << 100.0 * static_cast<double>(within) / static_cast<double>(values.size()) << " %\n";
}

/// A router cannot know more than its window shows: its routes are compared with the best paths
/// over the links as routers estimate them at that moment, and with the best over the real ones.
TEST(Routing, OverLossyLinksIsNearTheBestAfterThreeSeconds) {
  std::vector<double> by_estimates, by_real;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Dice dice(seed, "lossy graph");
    RoutingMesh mesh = random_mesh(seed, 0.7, &dice);
    mesh.run(3.0);
    const auto estimated = excesses(mesh, [&](std::size_t a, std::size_t b) {
      return mesh.router(a).link_metric_s(RoutingMesh::name(b)).value_or(kInfinity);
    });
    const auto real =
        excesses(mesh, [&](std::size_t a, std::size_t b) { return real_cost(mesh, a, b); });
    by_estimates.insert(by_estimates.end(), estimated.begin(), estimated.end());
    by_real.insert(by_real.end(), real.begin(), real.end());
  }
  print("metric by estimates over the best", by_estimates);
  print("metric by real links over the best", by_real);
  const auto count_within = [](const std::vector<double>& values, double limit) {
    return std::count_if(values.begin(), values.end(),
                         [limit](double value) { return value <= limit; });
  };
  const auto pairs = static_cast<double>(by_real.size());
  EXPECT_GT(static_cast<double>(count_within(by_estimates, 1.1)),
            0.9 * static_cast<double>(by_estimates.size()));
  EXPECT_GT(static_cast<double>(count_within(by_real, 1.1)), 0.8 * pairs);
}

/// How long a random pair has no route [s] after a relay of it has died; empty: there is no relay,
/// or no other path.
std::optional<double> random_repair_s(std::uint64_t seed, double min_delivery) {
  Dice dice(seed, "relay");
  RoutingMesh mesh = random_mesh(seed, min_delivery, &dice);
  mesh.run(dice.uniform(3.0, 4.0));
  const std::size_t from = dice.below(mesh.size()), to = dice.below(mesh.size());
  const auto path = mesh.path(from, to);
  if (!path || path->size() < 3) return std::nullopt;
  const std::size_t dead = path->at(1 + dice.below(path->size() - 2));
  const auto best = best_costs(mesh.size(), to, [&](std::size_t a, std::size_t b) {
    return a == dead || b == dead ? kInfinity : real_cost(mesh, a, b);
  });
  if (best[from] == kInfinity) return std::nullopt;
  mesh.set_on(dead, false);
  const SimTime death = mesh.now();
  while (!mesh.path(from, to) && (mesh.now() - death).seconds() < 10.0) mesh.step();
  return (mesh.now() - death).seconds();
}

std::vector<double> random_repairs_s(double min_delivery) {
  std::vector<double> result;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    if (const auto repair_s = random_repair_s(seed, min_delivery)) result.push_back(*repair_s);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Routing, InRandomGraphsGoesRoundADeadRelayWithinASecond) {
  const std::vector<double> without_loss_s = random_repairs_s(1.0);
  print("repair without loss [s]", without_loss_s);
  EXPECT_LE(without_loss_s.back(), 1.0);
  const std::vector<double> lossy_s = random_repairs_s(0.7);
  print("repair with up to 30 % loss [s]", lossy_s);
  EXPECT_LE(lossy_s.back(), 1.0);
}

}  // namespace
}  // namespace trident::sim
