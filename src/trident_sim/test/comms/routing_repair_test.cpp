// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What routers do when a relay is gone, what they prefer, and what hellos are made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "routing_mesh.h"

namespace trident::sim {
namespace {

using Nodes = std::vector<std::size_t>;

/// A mesh with one chain of nodes after the other, all links alike.
RoutingMesh chains(const std::vector<Nodes>& chains, double delivery, std::uint64_t seed,
                   const RouterParams& params = {}) {
  std::size_t size = 0;
  for (const Nodes& chain : chains) {
    size = std::max(size, *std::max_element(chain.begin(), chain.end()) + 1);
  }
  RoutingMesh mesh(std::vector<RouterParams>(size, params), seed);
  for (const Nodes& chain : chains) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      mesh.set_link(chain[i], chain[i + 1], {delivery, 52e6});
    }
  }
  return mesh;
}

/// How long there is no route that avoids a node that dies [s]; 10: for good.
double repair_s(RoutingMesh* mesh, std::size_t from, std::size_t to, std::size_t dead) {
  mesh->set_on(dead, false);
  const SimTime death = mesh->now(), limit{10'000'000'000};
  while (!mesh->path(from, to) && mesh->now() - death < limit) {
    mesh->step();
    EXPECT_TRUE(mesh->is_loop_free());
  }
  return (mesh->now() - death).seconds();
}

/// The largest; the others are printed.
double worst(const std::string& what, std::vector<double> times_s) {
  std::sort(times_s.begin(), times_s.end());
  const std::size_t count = times_s.size();
  std::cout << what << ": median " << times_s[count / 2] << " s, 99 % " << times_s[count * 99 / 100]
            << " s, largest " << times_s.back() << " s of " << count << '\n';
  return times_s.back();
}

/// Of the route from the first node to another, the node at that place dies.
struct Death {
  std::size_t to = 0, place = 1;
};

double worst_repair_s(const std::string& what, const std::vector<Nodes>& links, Death death,
                      double delivery, const RouterParams& params = {}) {
  std::vector<double> times_s;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RoutingMesh mesh = chains(links, delivery, seed, params);
    mesh.run(Dice(seed, "death").uniform(3.0, 4.0));
    while (!mesh.path(0, death.to)) mesh.step();
    const std::size_t dead = mesh.path(0, death.to)->at(death.place);
    times_s.push_back(repair_s(&mesh, 0, death.to, dead));
  }
  return worst(what + ", delivery " + std::to_string(delivery), times_s);
}

TEST(RoutingRepair, TakesUpToASecondWithASecondRelay) {
  const std::vector<Nodes> two_relays{{0, 1, 3}, {0, 2, 3}};
  EXPECT_LE(worst_repair_s("two relays", two_relays, {3, 1}, 1.0), 1.0);
  EXPECT_LE(worst_repair_s("two relays", two_relays, {3, 1}, 0.9), 1.0);
  const std::vector<Nodes> in_chain{{0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 5, 6}};
  EXPECT_LE(worst_repair_s("two relays in a chain", in_chain, {6, 2}, 1.0), 1.0);
  EXPECT_LE(worst_repair_s("two relays in a chain", in_chain, {6, 2}, 0.9), 1.0);
}

TEST(RoutingRepair, TakesUpToASecondOverALongerPath) {
  const std::vector<Nodes> longer{{0, 1, 2}, {0, 3, 4, 5, 2}};
  EXPECT_LE(worst_repair_s("longer path", longer, {2, 1}, 1.0), 1.0);
  const std::vector<Nodes> from_afar{{0, 1, 2, 3, 4}, {0, 5, 6, 7, 8, 9, 4}};
  EXPECT_LE(worst_repair_s("longer path from afar", from_afar, {4, 3}, 1.0), 1.0);
}

/// The first node of the longer path is farther from the destination than the node that asks.
TEST(RoutingRepair, OfAPathThatTheLabelForbidsIsRequested) {
  RouterParams params;
  params.sequence_period_s = 1e6;
  const std::vector<Nodes> longer{{0, 1, 2}, {0, 3, 4, 5, 2}};
  EXPECT_LE(worst_repair_s("longer path on request", longer, {2, 1}, 1.0, params), 1.0);
}

TEST(RoutingRepair, BeginsAtOnceIfTheRadioReportsALostNeighbor) {
  RoutingMesh mesh = chains({{0, 1, 3}, {0, 2, 3}}, 1.0, 1);
  mesh.run(3.0);
  const std::string destination = RoutingMesh::name(3);
  const std::string before = mesh.router(0).next_hop(destination).value();
  mesh.router(0).lost(before);
  const auto after = mesh.router(0).next_hop(destination);
  ASSERT_TRUE(after);
  EXPECT_NE(*after, before);
}

TEST(RoutingRepair, AfterAPartitionFindsEverybodyAgain) {
  RoutingMesh mesh = chains({{0, 1, 2, 3, 4}}, 1.0, 1);
  mesh.run(3.0);
  mesh.set_on(2, false);
  mesh.run(2.0);
  EXPECT_FALSE(mesh.router(0).next_hop(RoutingMesh::name(4)));
  EXPECT_EQ(mesh.router(0).destinations(), std::vector<std::string>{RoutingMesh::name(1)});
  mesh.set_on(2, true);
  mesh.run(2.0);
  EXPECT_TRUE(mesh.path(0, 4));
  EXPECT_TRUE(mesh.path(4, 0));
}

TEST(RoutingRepair, FindsARobotThatBeginsAgainWithANewRouter) {
  RoutingMesh mesh = chains({{0, 1, 2}}, 1.0, 1);
  mesh.run(20.0);
  mesh.set_on(2, false);
  mesh.run(1.0);
  mesh.router(2) = Router(RoutingMesh::name(2), {});
  mesh.set_on(2, true);
  mesh.run(2.0);
  EXPECT_TRUE(mesh.path(0, 2));
  EXPECT_TRUE(mesh.path(2, 0));
}

/// Relay 1 is an ordinary robot, relay 2 a base station whose links have that share of its rate.
std::size_t relay_chosen(double rate_share, std::uint64_t seed) {
  std::vector<RouterParams> params(4);
  params[2].is_base_station = true;
  RoutingMesh mesh(params, seed);
  for (const std::size_t end : {0, 3}) {
    mesh.set_link(end, 1, {1.0, 52e6});
    mesh.set_link(end, 2, {1.0, rate_share * 52e6});
  }
  mesh.run(3.0);
  return mesh.path(0, 3).value().at(1);
}

TEST(Routing, PrefersABaseStationAsARelay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(relay_chosen(1.0, seed), 2U);
    EXPECT_EQ(relay_chosen(0.6, seed), 2U);
    EXPECT_EQ(relay_chosen(0.4, seed), 1U);
  }
}

TEST(Routing, CountsEachLinkByItsExpectedTransmissionTime) {
  RoutingMesh mesh = chains({{0, 1, 2}}, 1.0, 1);
  mesh.set_link(1, 2, {1.0, 26e6}, {1.0, 13e6});
  mesh.run(3.0);
  const double bits = 8.0 * RouterParams().packet_bytes;
  EXPECT_NEAR(mesh.router(0).metric_s(RoutingMesh::name(2)).value(), bits / 52e6 + bits / 26e6,
              1e-8);
  EXPECT_NEAR(mesh.router(2).metric_s(RoutingMesh::name(0)).value(), bits / 52e6 + bits / 13e6,
              1e-8);
  EXPECT_NEAR(mesh.router(2).link_metric_s(RoutingMesh::name(1)).value(), bits / 13e6, 1e-8);
}

TEST(Routing, UsesNoLinkOnWhichOnlyOneHears) {
  RoutingMesh mesh = chains({{0, 1}}, 1.0, 1);
  mesh.set_link(0, 1, {1.0, 52e6}, {0.0, 52e6});
  mesh.run(3.0);
  EXPECT_TRUE(mesh.router(0).destinations().empty());
  EXPECT_TRUE(mesh.router(1).destinations().empty());
}

TEST(Routing, HearsAHelloOnce) {
  Router one("one", {}), other("other", {});
  const std::string hello = one.due_hello({1'000'000'000}).value();
  EXPECT_TRUE(other.hear(hello, "one", 52e6, {1'000'000'000}));
  EXPECT_FALSE(other.hear(hello, "one", 52e6, {1'010'000'000}));
  EXPECT_FALSE(one.hear(hello, "one", 52e6, {1'010'000'000}));
}

TEST(RoutingHelloWindow, IsTheShareOfTheLastSixteen) {
  HelloWindow window;
  window.add(7);
  EXPECT_EQ(window.share(), 16);  // one of four
  for (const std::uint32_t number : {8, 9, 10}) window.add(number);
  EXPECT_EQ(window.share(), kHeardAll);
  window.add(14);
  EXPECT_EQ(window.share(), (5 * kHeardAll + 4) / 8);
  for (std::uint32_t number = 16; number <= 100; number += 2) window.add(number);
  EXPECT_EQ(window.share(), (8 * kHeardAll + 8) / 16);
  window.add(3);
  EXPECT_EQ(window.share(), 16);
}

TEST(Routing, OfACopyIsTheSame) {
  RoutingMesh mesh = chains({{0, 1, 2}}, 1.0, 1);
  mesh.run(3.0);
  RoutingMesh copy = mesh;
  mesh.run(1.0);
  copy.run(1.0);
  const SimTime later = mesh.now() + SimTime{1'000'000'000};
  EXPECT_EQ(mesh.router(0).due_hello(later), copy.router(0).due_hello(later));
}

/// All hear each other, and have run long enough for numbers that take more bytes.
std::string hello_of_many(std::size_t robots) {
  RoutingMesh mesh(std::vector<RouterParams>(robots), 1);
  for (std::size_t a = 0; a < robots; ++a) {
    for (std::size_t b = 0; b < a; ++b) mesh.set_link(a, b, {0.9, 6.5e6});
  }
  mesh.run(60.0);
  std::cout << robots << " robots, names of " << RoutingMesh::name(0).size()
            << " characters: " << mesh.hello_bytes() / mesh.hellos() << " bytes in the mean, "
            << static_cast<double>(mesh.hellos()) / static_cast<double>(robots) / 60.0
            << " hellos a second from each\n";
  return mesh.router(0).due_hello(mesh.now() + SimTime{200'000'000}).value();
}

TEST(RoutingHello, OfTwentyRobotsFitsIntoAFrame) {
  const std::string hello = hello_of_many(20);
  EXPECT_EQ(decode_hello(hello).value().entries.size(), 19U);
  EXPECT_LT(hello.size(), 500U);
  Hello largest;
  largest.number = largest.sequence = kNoMetric;
  std::vector<std::string> names;
  for (char letter = 'a'; letter < 'a' + 19; ++letter) names.emplace_back(48, letter);
  for (const std::string& name : names) {
    largest.entries.push_back(
        {name, kHeardAll, {{kNoMetric, kNoMetric - 1}, kNoMetric - 1}, kNoMetric});
  }
  EXPECT_LT(encode(largest).size(), 1400U);
  EXPECT_EQ(encode(decode_hello(encode(largest)).value()), encode(largest));
}

/// What can be decoded is what encode() makes; a router takes anything.
void expect_exact(const std::string& bytes, Router* router) {
  router->hear(bytes, "other", 1e6, {});
  const auto hello = decode_hello(bytes);
  if (hello) {
    EXPECT_EQ(encode(*hello), bytes);
  }
}

TEST(RoutingHello, OfAnyBytesIsRefusedOrExact) {
  const std::string hello = hello_of_many(5);
  ASSERT_TRUE(decode_hello(hello));
  Router router("robot_99", {});
  for (std::size_t size = 0; size < hello.size(); ++size) {
    expect_exact(hello.substr(0, size), &router);
  }
  EXPECT_FALSE(decode_hello(hello.substr(0, hello.size() - 1)));
  EXPECT_FALSE(decode_hello(hello + "x"));
  Dice dice(1, "bytes");
  for (int i = 0; i < 20000; ++i) {
    std::string changed = hello;
    const std::size_t changes = 1 + dice.below(4);
    for (std::size_t k = 0; k < changes; ++k) {
      changed[dice.below(changed.size())] = static_cast<char>(dice.below(256));
    }
    expect_exact(changed.substr(0, dice.below(changed.size() + 1)), &router);
    expect_exact(changed, &router);
    std::string random(dice.below(64), 'H');
    for (char& one : random) one = dice.uniform() < 0.1 ? 'H' : static_cast<char>(dice.below(256));
    expect_exact(random, &router);
    expect_exact("H" + std::string(1, '\0') + random, &router);
  }
  router.due_hello({1'000'000'000});
}

}  // namespace
}  // namespace trident::sim
