// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "comms/links/obstacles.h"
#include "comms/links/path_loss.h"
#include "comms/phy/propagation.h"
#include "models.h"
#include "test_world.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/samples/radio_samples.h"

namespace trident::sim {
namespace {

constexpr double kWave_m = 0.0577;

SE3 at(const Eigen::Vector3d& p) {
  SE3 pose;
  pose.p = p;
  return pose;
}

PluginSpec medium(const ParamList& params = {{"path", "free_space"}, {"shadowing_sigma", "0"}}) {
  return make_plugin("air", "libtrident_radio_medium.so", params);
}

WorldSpec with_air(const PluginSpec& air = medium()) {
  WorldSpec spec = weightless(0.01);
  spec.plugins.push_back(air);
  return spec;
}

/// A box with a radio on it.
ModelSpec robot(const std::string& name, const Eigen::Vector3d& p, ParamList params = {}) {
  ModelSpec spec = make_body(name, BoxShape{{0.2, 0.2, 0.2}}, at(p));
  spec.plugins.push_back(make_plugin("radio", "libtrident_radio.so", params));
  return spec;
}

struct TwoRobots {
  explicit TwoRobots(double distance_m, const ParamList& params = {},
                     const PluginSpec& air = medium())
      : world(with_air(air)) {
    world.add(robot("a", {0, 0, 1}, params));
    world.add(robot("b", {distance_m, 0, 1}, params));
    radio = find_radio(*world);
  }
  TestWorld world;
  std::shared_ptr<Radio> radio;
};

std::vector<std::string> texts(const std::vector<RadioMessage>& messages) {
  std::vector<std::string> result;
  for (const RadioMessage& message : messages) result.push_back(message.data);
  return result;
}

TEST(RadioPlugins, AMessageArrivesInItsTime) {
  TwoRobots two(50.0);
  ASSERT_NE(two.radio, nullptr);
  EXPECT_EQ(two.radio->names(), (std::vector<std::string>{"a", "b"}));
  two.world->step(3);
  ASSERT_TRUE(two.radio->send("a", "b", std::string("x\0y", 3), {}));
  EXPECT_TRUE(two.radio->receive("b").empty());
  two.world->step();
  const auto messages = two.radio->receive("b");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].data, std::string("x\0y", 3));
  EXPECT_EQ(messages[0].source, "a");
  EXPECT_EQ(messages[0].sent, SimTime::from_seconds(0.03));
  const double delay_s = (messages[0].received - messages[0].sent).seconds();
  EXPECT_GT(delay_s, 0.0002);
  EXPECT_LT(delay_s, 0.0005);
  EXPECT_TRUE(two.radio->receive("b").empty());
  EXPECT_TRUE(two.radio->receive("a").empty());
}

TEST(RadioPlugins, LinksAreThoseOfTheClosedForm) {
  TwoRobots two(50.0, {{"height", "0.5"}});
  const auto links = two.radio->links();
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[0].source, "a");
  EXPECT_NEAR(links[0].distance_m, 50.0, 1e-9);
  const double lambda = wavelength_m(channel_frequency_hz(36));
  EXPECT_NEAR(links[0].loss_db, free_space_loss_db(50.0, lambda) - 4.0, 1e-9);
  EXPECT_NEAR(links[0].snr_db, 20.0 - links[0].loss_db + 94.0, 0.02);
  EXPECT_EQ(links[0].loss_db, links[1].loss_db);
}

TEST(RadioPlugins, NobodyHearsFromTooFar) {
  TwoRobots two(20000.0);
  two.radio->send("a", "b", "far", {});
  two.world->step(100);
  EXPECT_TRUE(two.radio->receive("b").empty());
  EXPECT_EQ(two.radio->links()[0].lost, 1u);
}

TEST(RadioPlugins, ADipoleOverheadIsDeaf) {
  TestWorld world(with_air());
  world.add(robot("low", {0, 0, 1}, {{"antenna", "dipole"}, {"height", "0"}}));
  world.add(robot("above", {0, 0, 51}, {{"antenna", "dipole"}, {"height", "0"}}));
  world.add(robot("aside", {50, 0, 1}, {{"antenna", "dipole"}, {"height", "0"}}));
  const auto links = find_radio(*world)->links();  // above-next to, above-low, ..., low-next to
  const auto loss = [&links](const std::string& a, const std::string& b) {
    for (const RadioLink& link : links) {
      if (link.source == a && link.destination == b) return link.loss_db;
    }
    return 0.0;
  };
  EXPECT_NEAR(loss("low", "above") - loss("low", "aside"), 40.0, 0.01);
}

TEST(RadioPlugins, OutagesByScheduleAndByCommand) {
  TwoRobots two(10.0, {{"outages", "1 2"}});
  const auto arrives = [&two] {
    two.radio->send("a", "b", "?", {});
    two.world->step(20);
    return !two.radio->receive("b").empty();
  };
  EXPECT_TRUE(arrives());
  two.world->step(90);
  EXPECT_FALSE(arrives());
  two.world->step(90);
  EXPECT_TRUE(arrives());
  two.radio->set_outage("b", "", SimTime::from_seconds(1e6));
  EXPECT_FALSE(arrives());
  EXPECT_TRUE(std::isinf(two.radio->links()[0].loss_db));
  two.radio->set_outage("b", "", SimTime());
  EXPECT_TRUE(arrives());
}

/// Robot b listens to packets, robot a's port takes them.
struct Ports {
  explicit Ports(TwoRobots& two)
      : send(two.world->ports().find_in<RadioPacketSample>("a/radio/send")),
        received(two.world->ports().find_out<RadioPacketSample>("b/radio/receive")) {
    received->add_listener();
  }
  InPort<RadioPacketSample>* send;
  OutPort<RadioPacketSample>* received;
};

RadioPacketSample packet(const std::string& destination, const std::string& data) {
  RadioPacketSample result;
  result.destination = destination;
  result.topic = "poses";
  result.qos = 1;
  result.id = 0x0102030405060708;
  result.data = data;
  return result;
}

TEST(RadioPorts, PacketsGoOverTheAirWithTheirFields) {
  TwoRobots two(10.0);
  Ports ports(two);
  for (const char* data : {"one", "two", "three"}) ports.send->write(packet("b", data));
  two.world->step();
  ASSERT_EQ(ports.received->count(), 1u);
  std::vector<std::string> data;
  for (const auto& earlier : ports.received->earlier()) data.push_back(earlier.data);
  const RadioPacketSample& last = ports.received->value;
  data.push_back(last.data);
  EXPECT_EQ(data, (std::vector<std::string>{"one", "two", "three"}));
  EXPECT_EQ(last.source, "a");
  EXPECT_EQ(last.destination, "b");
  EXPECT_EQ(last.topic, "poses");
  EXPECT_EQ(last.qos, 1);
  EXPECT_EQ(last.id, 0x0102030405060708u);
  EXPECT_GT(last.stamp, SimTime());
  two.radio->send("a", "b", "not a packet", {});
  two.world->step();
  EXPECT_EQ(ports.received->value.data, "not a packet");
  EXPECT_EQ(ports.received->value.topic, "");
}

TEST(RadioPorts, BadPacketsAreReportedAndTheRestRuns) {
  TwoRobots two(10.0);
  Ports ports(two);
  ports.send->write(packet("nobody", "x"));
  ports.send->write(packet("b", std::string(10001, 'x')));
  RadioPacketSample late = packet("b", "x");
  late.deadline_s = -1.0;
  ports.send->write(late);
  ports.send->write(packet("", "to all"));
  two.world->step();
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "a/radio/send: radio 'nobody'"), 1u);
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "10006 bytes with its topic"), 1u);
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "deadline is -1 s"), 1u);
  EXPECT_EQ(ports.received->value.data, "to all");
  for (int i = 0; i < 20; ++i) ports.send->write(packet("b", "x"));
  two.world->step();
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "12 packets came in one step too many"), 1u);
}

TEST(RadioPorts, LinkStatusCountsOverItsPeriod) {
  TwoRobots two(10.0);
  Ports ports(two);
  auto* status = two.world->ports().find_out<LinkStatusArraySample>("a/link_status");
  auto* all = two.world->ports().find_out<LinkStatusArraySample>("radio/links");
  status->add_listener();
  all->add_listener();
  for (int i = 0; i < 50; ++i) {
    ports.send->write(packet("b", std::string(1000, 'x')));
    two.world->step();
  }
  ASSERT_EQ(status->count(), 1u);
  EXPECT_EQ(all->value.links.size(), 2u);
  ASSERT_EQ(status->value.links.size(), 1u);
  const LinkStatusSample& sample = status->value.links[0];
  const RadioLink& link = sample.link;
  EXPECT_EQ(link.source + link.destination, "ab");
  EXPECT_TRUE(link.is_up);
  EXPECT_TRUE(link.has_line_of_sight);
  EXPECT_EQ(link.delivered, 50u);
  EXPECT_NEAR(sample.goodput_bit_s, 8.0 * 1020.0 * 50.0 / 0.5, 1.0);  // 15 + 5 bytes more
  EXPECT_GT(sample.latency_s, 0.0002);
  EXPECT_LT(sample.latency_s, 0.003);
  EXPECT_GT(sample.jitter_s, 0.0);
  EXPECT_GT(sample.airtime_share, 0.01);
  EXPECT_LT(sample.airtime_share, 0.2);
  EXPECT_NEAR(link.rssi_dbm - link.snr_db, -94.0, 0.02);
  two.world->step(50);
  EXPECT_EQ(status->value.links[0].goodput_bit_s, 0.0);
  EXPECT_TRUE(std::isnan(status->value.links[0].latency_s));
}

TEST(RadioPorts, ACutLinkLeavesTheOthers) {
  TwoRobots two(10.0);
  two.world.add(robot("c", {5, 5, 1}));
  two.radio->set_outage("b", "a", SimTime::from_seconds(0.5));
  two.radio->send("a", "b", "cut", {});
  two.radio->send("a", "c", "free", {});
  two.world->step(40);
  EXPECT_TRUE(two.radio->receive("b").empty());
  EXPECT_EQ(texts(two.radio->receive("c")), (std::vector<std::string>{"free"}));
  two.world->step(20);
  two.radio->send("a", "b", "again", {});
  two.world->step(5);
  EXPECT_EQ(texts(two.radio->receive("b")), (std::vector<std::string>{"again"}));
}

TEST(RadioPlugins, NoRadioWorksInAnOutageRegion) {
  TwoRobots two(10.0, {}, medium({{"path", "free_space"}, {"outage_regions", "10 0 2  50 50 3"}}));
  two.radio->send("a", "b", "inside", {});
  two.world->step(20);
  EXPECT_TRUE(two.radio->receive("b").empty());
  two.world->set_model_pose(*two.world->find_model("b"), at({15, 0, 1}));
  two.radio->send("a", "b", "outside", {});
  two.world->step(20);
  EXPECT_EQ(texts(two.radio->receive("b")), (std::vector<std::string>{"outside"}));
  EXPECT_NE(error_of([] {
              TestWorld world(with_air(medium({{"outage_regions", "1 2"}})));
            }).find("x, y and radius"),
            std::string::npos);
}

TEST(RadioPlugins, ASnapshotBringsBackWhatIsOnTheAir) {
  TwoRobots two(900.0, {{"tx_power", "10"}});
  const auto run = [&two] {
    std::vector<std::string> result;
    for (int i = 0; i < 50; ++i) {
      for (int k = 0; k < 5; ++k) two.radio->send("a", "b", std::to_string(10 * i + k), {});
      two.world->step();
      for (const std::string& text : texts(two.radio->receive("b"))) result.push_back(text);
    }
    return result;
  };
  run();
  for (int k = 0; k < 30; ++k) two.radio->send("a", "b", std::string(1400, 'x'), {});
  two.world->step();
  const Snapshot snapshot = two.world->save_snapshot();
  const auto first = run();
  const std::string hash = two.world->state_hash();
  EXPECT_GT(first.size(), 100u);
  two.world->restore_snapshot(snapshot);
  EXPECT_EQ(run(), first);
  EXPECT_EQ(two.world->state_hash(), hash);
}

TEST(RadioPlugins, WhoAsksChangesNothing) {
  const auto hash = [](bool asks) {
    TwoRobots two(1500.0, {}, medium({{"path", "free_space"}}));
    for (int i = 0; i < 100; ++i) {
      two.world->set_model_twist(*two.world->find_model("b"), {3.0, 0.0, 0.0},
                                 Eigen::Vector3d::Zero());
      two.radio->send("a", "b", "x", {});
      two.world->step();
      if (!asks) continue;
      two.radio->links();
      two.radio->receive("b");
    }
    return two.world->state_hash();
  };
  EXPECT_EQ(hash(true), hash(false));
}

TEST(RadioPlugins, AnInboxThatNobodyReadsKeepsTheNewest) {
  TwoRobots two(10.0, {{"queue_bytes", "1000000"}});
  for (int i = 0; i < 500; ++i) {
    two.radio->send("a", "b", std::to_string(i) + " " + std::string(10000, 'x'), {});
    two.world->step();
  }
  const auto messages = two.radio->receive("b");
  ASSERT_GT(messages.size(), 390u);
  EXPECT_LT(messages.size(), 400u);  // of 4 MB
  EXPECT_EQ(messages.back().data.substr(0, 4), "499 ");
}

TEST(RadioPlugins, ResetAndReplacedRobotsBeginAgain) {
  TwoRobots two(10.0);
  two.radio->send("a", "b", "before", {});
  two.world->reset();
  two.world->step(5);
  EXPECT_TRUE(two.radio->receive("b").empty());
  two.world->remove("b");
  EXPECT_EQ(two.radio->names(), (std::vector<std::string>{"a"}));
  two.world.add(robot("b", {5, 0, 1}));
  two.radio->send("a", "b", "after", {});
  two.world->step(5);
  EXPECT_EQ(texts(two.radio->receive("b")), (std::vector<std::string>{"after"}));
}

TEST(RadioPlugins, BadInputIsOneClearError) {
  TwoRobots two(10.0);
  const auto send = [&two](const std::string& a, const std::string& b, const RadioQos& qos) {
    return error_of([&] { two.radio->send(a, b, "x", qos); });
  };
  EXPECT_EQ(send("a", "bb", {}), "radio 'bb'; did you mean 'b'? Known: a, b");
  EXPECT_NE(send("a", "a", {}).find("sends to itself"), std::string::npos);
  EXPECT_NE(send("a", "b", {4, 0.0}).find("priority is 4, legal: 0 to 3"), std::string::npos);
  EXPECT_NE(send("a", "b", {1, NAN}).find("deadline is nan s"), std::string::npos);
  EXPECT_NE(error_of([&] {
              two.radio->send("a", "b", std::string(11001, 'x'), {});
            }).find("11001 bytes, legal: at most 11000"),
            std::string::npos);
  const auto refusal = [&two](const ParamList& params) {
    return error_of([&] { two.world.add(robot("c", {0, 5, 1}, params)); });
  };
  EXPECT_NE(refusal({{"rate", "9"}}).find("an MCS, 0 to 8"), std::string::npos);
  EXPECT_NE(refusal({{"width", "30"}}).find("20 or 40 or 80"), std::string::npos);
  EXPECT_NE(refusal({{"gain", "nan"}}).find("gain"), std::string::npos);
  EXPECT_NE(refusal({{"outages", "3 2"}}).find("each begin before its end"), std::string::npos);
  EXPECT_NE(refusal({{"linkName", "nolink"}}).find("nolink"), std::string::npos);
  EXPECT_NE(refusal({{"robotNamespace", "a"}}).find("a/radio"), std::string::npos);
  EXPECT_EQ(two.radio->names().size(), 2u);
}

TEST(RadioPlugins, ARadioWithoutAirIsNamedOnce) {
  TestWorld world(weightless(0.01));
  world.add(robot("a", {0, 0, 1}));
  world->step(3);
  EXPECT_EQ(world.report_count(Severity::kWarning, "no air for radios"), 1u);
  EXPECT_EQ(find_radio(*world), nullptr);
}

/// The loss by what is in the path, in a world of static boxes.
struct Scene {
  Scene() : world(weightless(0.01)) {}
  double loss_db(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ObstacleParams params = {}) {
    rays(*world, RayGeometry::kCollision).refresh();
    return Obstacles(*world, std::move(params)).loss_db({a, nullptr}, {b, nullptr}, kWave_m);
  }
  void add(const std::string& name, const Eigen::Vector3d& size, const Eigen::Vector3d& p) {
    world.add(make_static(name, BoxShape{size}, at(p)));
  }
  TestWorld world;
};

TEST(RadioObstacles, FreePathCostsNothing) {
  Scene scene;
  scene.world.add(make_ground());
  EXPECT_EQ(scene.loss_db({0, 0, 0.3}, {100, 0, 0.3}), 0.0);
}

TEST(RadioObstacles, AWallCostsItsPenetrationAndTwoCostTwice) {
  Scene scene;
  scene.add("wall", {0.2, 40, 40}, {10, 0, 0});
  EXPECT_NEAR(scene.loss_db({0, 0, 1}, {20, 0, 1}), 12.0, 1e-9);  // in the middle of the path, too
  EXPECT_NEAR(scene.loss_db({0, 0, 1}, {30, 0, 1}), 12.0, 1e-9);
  scene.add("glass", {0.2, 40, 40}, {13, 0, 0});
  EXPECT_NEAR(scene.loss_db({0, 0, 1}, {30, 0, 1}), 24.0, 1e-9);
  EXPECT_NEAR(scene.loss_db({0, 0, 1}, {30, 0, 1}, {12.0, {{"glass", 3.0}}}), 15.0, 1e-9);
}

TEST(RadioObstacles, AWallThatTakesThePlaceOfAnotherHasItsOwnLoss) {
  Scene scene;
  Obstacles obstacles(*scene.world, {12.0, {{"glass", 3.0}}});
  const auto loss_db = [&] {
    rays(*scene.world, RayGeometry::kCollision).refresh();
    return obstacles.loss_db({{0, 0, 1}, nullptr}, {{30, 0, 1}, nullptr}, kWave_m);
  };
  scene.add("wall", {0.2, 40, 40}, {10, 0, 0});
  EXPECT_NEAR(loss_db(), 12.0, 1e-9);
  scene.world->remove("wall");
  scene.add("glass", {0.2, 40, 40}, {10, 0, 0});
  EXPECT_NEAR(loss_db(), 3.0, 1e-9);
}

TEST(RadioObstacles, AnEdgeIsAKnifeEdge) {
  for (const double height_m : {0.0, 0.2, 1.0, 3.0}) {
    for (const double place_m : {5.0, 20.0, 60.0}) {
      Scene scene;
      scene.add("edge", {0.002, 400, 10}, {place_m, 0, height_m - 5.0});
      const double v = diffraction_parameter(height_m, place_m, 80.0 - place_m, kWave_m);
      EXPECT_NEAR(scene.loss_db({0, 0, 1e-6}, {80, 0, 1e-6}, {200.0, {}}), knife_edge_loss_db(v),
                  0.05)
          << height_m << " m at " << place_m << " m";
    }
  }
}

TEST(RadioObstacles, TheGroundCannotBeGoneThrough) {
  Scene scene;
  scene.world.add(make_ground());
  EXPECT_GT(scene.loss_db({0, 0, 1}, {20, 0, -1}), 30.0);
}

TEST(RadioObstacles, LossHasNoStepsPastCornersAndSills) {
  Scene scene;
  scene.world.add(make_ground());
  scene.add("house", {6, 6, 4}, {12, 3, 2});
  scene.add("shed", {2, 2, 2}, {20, -3, 1});
  scene.add("sill", {0.2, 20, 0.15}, {5, 0, 0.075});
  double worst_db = 0.0;
  for (int path = 0; path < 20; ++path) {
    const double y = -8.0 + 0.8 * path;
    double before_db = scene.loss_db({0, 0, 0.4}, {30, y, 0.5});
    for (int i = 1; i <= 400; ++i) {
      const double here_db = scene.loss_db({0, 0, 0.4}, {30.0 - 0.01 * i, y + 0.01 * i, 0.5});
      worst_db = std::max(worst_db, std::abs(here_db - before_db));
      before_db = here_db;
    }
  }
  EXPECT_LT(worst_db, 1.0);
}

}  // namespace
}  // namespace trident::sim
