// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What a world keeps of problems that do not stop it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cart.h"

namespace trident::sim {
namespace {

Diagnostic make(const std::string& subject, const std::string& kind, const std::string& value) {
  return {Severity::kWarning, subject, kind, "is " + value, {{"value", value}}};
}

const DiagnosticEntry* find(World& world, const std::string& name) {
  const auto& entries = world.diagnostics().entries();
  const auto it = entries.find(name);
  return it == entries.end() ? nullptr : &it->second;
}

TEST(Diagnostics, OneThatOccursAgainIsCountedAndTheNewestIsKept) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.add(make("model 'a'", "k", "1"), SimTime{5}));
  EXPECT_FALSE(diagnostics.add(make("model 'a'", "k", "2"), SimTime{9}));
  EXPECT_TRUE(diagnostics.add(make("model 'a'", "other", "3"), SimTime{9}));
  ASSERT_EQ(diagnostics.entries().size(), 2u);
  const DiagnosticEntry& entry = diagnostics.entries().at("model 'a': k");
  EXPECT_EQ(entry.count, 2u);
  EXPECT_EQ(entry.first.ns, 5);
  EXPECT_EQ(entry.last.ns, 9);
  EXPECT_EQ(entry.newest.values[0].second, "2");
}

TEST(Diagnostics, AModelTakesItsOwnWithIt) {
  Diagnostics diagnostics;
  for (const char* subject : {"model 'a'", "model 'a' plugin 'p'", "model 'ab'", "model"}) {
    diagnostics.add(make(subject, "k", "1"), {});
  }
  diagnostics.forget_model("a");
  ASSERT_EQ(diagnostics.entries().size(), 2u);
  EXPECT_EQ(diagnostics.entries().count("model 'ab': k"), 1u);
}

TEST(Diagnostics, AClampedVelocityIsOneEntryWithItsLegalRange) {
  CartOptions options;
  options.velocity_limit_rad_s = 5.0;
  CartWorld cart(options);
  for (int i = 0; i < 4; ++i) {
    cart.command(1.0, 0.0);
    cart.run(0.3);
  }
  const auto* entry = find(*cart.world, "model 'cart' plugin 'drive': velocity command clamped");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->count, 4u) << "by command, not by step";
  EXPECT_EQ(entry->newest.values[0],
            std::make_pair(std::string("value"), std::string("1.000000 m/s")));
  EXPECT_EQ(entry->newest.values[1],
            std::make_pair(std::string("legal"), std::string("[-0.500000, 0.500000] m/s")));
  EXPECT_GT(entry->last.seconds(), 0.8);
  cart.world->remove("cart");
  EXPECT_TRUE(cart.world->diagnostics().entries().empty());
}

TEST(Diagnostics, EveryRefusedCommandCounts) {
  CartWorld cart;
  for (int i = 0; i < 3; ++i) cart.command(std::nan(""), 0.0);
  cart.run(0.1);
  const auto* entry = find(*cart.world, "model 'cart' plugin 'drive': velocity command refused");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->count, 3u);
  EXPECT_EQ(entry->newest.severity, Severity::kError);
  EXPECT_EQ(entry->newest.values[1].second, "finite, up to 1e5 m/s and 1e4 rad/s");
}

TEST(Diagnostics, WhereThereIsASinkOfTheirOwnTheyGoThere) {
  std::vector<std::string> reported;
  WorldOptions options;
  options.diagnosed = [&reported](Severity, const std::string& text) { reported.push_back(text); };
  TestWorld world(world_spec(), options);
  world->diagnose(make("model 'a'", "k", "1"));
  world->diagnose(make("model 'a'", "k", "2"));
  world->note(make("model 'b'", "k", "2"));
  EXPECT_EQ(reported, std::vector<std::string>{"model 'a': is 1"});
  EXPECT_TRUE(world.reports.empty());
  EXPECT_EQ(world->diagnostics().entries().size(), 2u);
}

TEST(IgnoredElements, AreNamedOnceForAFleet) {
  TestWorld world;
  for (const char* name : {"a", "b"}) {
    CartOptions options;
    options.params = {{"robotNamespace", name}, {"wheelSeperation", "0.3"}, {"color", "red"}};
    ModelSpec spec = make_cart(options);
    spec.name = name;
    world.add(std::move(spec));
  }
  EXPECT_EQ(world.report_count(Severity::kWarning, "<wheelSeperation>, <color>"), 1u);
  EXPECT_EQ(world.report_count(Severity::kWarning, "have no effect"), 1u);
  EXPECT_NE(find(*world, "model 'a' plugin 'drive': elements without effect"), nullptr);
}

TEST(UnknownPlugins, AreNamedOnceOfEachModel) {
  TestWorld world;
  for (const char* name : {"a", "b"}) {
    ModelSpec spec = make_cart(CartOptions());
    spec.name = name;
    spec.plugins = {make_plugin("light", "libno_such_light.so", {}),
                    make_plugin("light", "libno_such_light.so", {})};
    world.add(std::move(spec));
  }
  EXPECT_EQ(
      world.report_count(Severity::kWarning, "model 'a': plugin 'light' (libno_such_light.so)"),
      1u);
  EXPECT_EQ(
      world.report_count(Severity::kWarning, "model 'b': plugin 'light' (libno_such_light.so)"),
      1u);
}

TEST(IgnoredElements, NoneOfACompletePluginIs) {
  CartWorld cart;
  EXPECT_TRUE(cart.world.reports.empty());
}

ModelSpec make_wall() { return make_static("wall", BoxShape{{0.2, 4.0, 1.0}}, at(0, 0, 0.5)); }

/// The cart's wheels are balls of 0.1 m at y +-0.2.
TEST(SpawnedInside, AWallIsNamedWithTheDepth) {
  TestWorld world(world_spec(0.001));
  world.add(make_ground());
  world.add(make_wall());
  CartOptions options;
  options.T_world_model = at(0.15, 0, 0);
  world.add(make_cart(options));
  const auto* entry = find(*world, "model 'cart': spawned inside");
  ASSERT_NE(entry, nullptr);
  EXPECT_TRUE(contains(entry->newest.message, "'wall::link::"));
  EXPECT_TRUE(contains(entry->newest.message, "'cart::"));
  EXPECT_EQ(entry->newest.values[2].first, "depth_m");
  EXPECT_NEAR(std::stod(entry->newest.values[2].second), 0.05, 0.03);
  EXPECT_EQ(world.report_count(Severity::kWarning, "was spawned with"), 1u);
}

TEST(SpawnedInside, AnotherModelCountsAndThoseThatTouchDoNot) {
  TestWorld world(world_spec(0.001));
  world.add(make_ground());
  world.add(make_body("low", BoxShape{{0.4, 0.4, 0.4}}, at(0, 0, 0.195)));
  world.add(make_body("on_top", BoxShape{{0.4, 0.4, 0.4}}, at(0, 0, 0.595)));
  EXPECT_TRUE(world.reports.empty());
  world.add(make_body("inside", BoxShape{{0.2, 0.2, 0.2}}, at(0.1, 0, 0.4)));
  EXPECT_EQ(world.report_count(Severity::kWarning, "model 'inside'"), 1u);
  EXPECT_EQ(world.report_count(Severity::kWarning, "was spawned with"), 1u);
}

TEST(SpawnedInside, AWorldIsLookedAtWhenItIsComplete) {
  WorldSpec spec = world_spec(0.001);
  spec.models = {make_body("box", BoxShape{{0.4, 0.4, 0.4}}, at(0, 0, 0.3)), make_wall()};
  TestWorld world(spec);
  EXPECT_EQ(world.report_count(Severity::kWarning, "model 'box'"), 1u);
}

/// It is pushed out at the world's speed at most, and then drives as ever.
TEST(SpawnedInside, AWallPushesARobotOutWithoutAnExplosion) {
  TestWorld world(world_spec(0.001));
  world.add(make_ground());
  world.add(make_wall());
  CartOptions options;
  options.T_world_model = at(0.15, 0, 0);
  Model& cart = world.add(make_cart(options));
  double fastest = 0.0, highest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    world->step();
    for (const auto& body : cart.bodies) fastest = std::max(fastest, body->velocity().norm());
    highest = std::max(highest, cart.T_world_model().p.z());
  }
  EXPECT_LT(fastest, 2.0);
  EXPECT_LT(highest, 0.1);
  EXPECT_GT(cart.T_world_model().p.x(), 0.19) << "outside";
  const double x = cart.T_world_model().p.x();
  world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {0.5, 0, 0}, {0, 0, 0}});
  world->step(2000);
  EXPECT_GT(cart.T_world_model().p.x(), x + 0.8);
}

}  // namespace
}  // namespace trident::sim
