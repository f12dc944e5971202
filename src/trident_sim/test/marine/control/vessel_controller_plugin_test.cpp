// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../boat_world.h"
#include "controlled_boat.h"
#include "plugin_conformance.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/commands.h"

namespace trident::sim {
namespace {

std::string control_file(const std::string& name) {
  return std::string(TRIDENT_REPOSITORY) + "/config/controllers/" + name + ".yaml";
}

PluginSpec controller_plugin(const std::string& vessel, const std::string& ns) {
  return make_plugin("controller", "libtrident_vessel_controller.so",
                     {{"robotNamespace", ns},
                      {"vessel", vessel_file(vessel)},
                      {"controller", control_file(vessel)}});
}

/// A shipped vessel, its odometry and its controller.
ModelSpec make_controlled(const std::string& vessel, const std::string& model = "boat") {
  ModelSpec spec = make_boat(vessel, model);
  spec.plugins[0].params.children.push_back({"commandTopic", "command/motor_speed", {}, {}});
  spec.plugins.push_back(make_plugin("odometry", "libgazebo_ros_p3d.so",
                                     {{"robotNamespace", model},
                                      {"bodyName", "base_link"},
                                      {"topicName", "odometry"},
                                      {"twistFrame", "child"}}));
  spec.plugins.push_back(controller_plugin(vessel, model));
  return spec;
}

class ControlledWorld {
 public:
  explicit ControlledWorld(LoopTiming timing = LoopTiming::kDirect,
                           const std::string& vessel = "otter")
      : world_(ocean({make_sea({{"waves", {{"spectrum", "none"}}}})}), with_timing(timing)) {
    control::register_control_plugins(world_.registry);
    boat_ = &world_.add(make_controlled(vessel));
  }

  template <class Sample>
  void write(const std::string& topic, const Sample& sample) {
    auto* const port = world_->ports().find_in<Sample>("boat/" + topic);
    ASSERT_NE(port, nullptr) << topic;
    port->write(sample);
  }
  void run(double duration_s) { world_->step(static_cast<int>(duration_s / 0.01)); }
  World& world() { return *world_; }
  const std::vector<Report>& reports() const { return world_.reports; }
  std::size_t report_count(Severity severity, const std::string& text) const {
    return world_.report_count(severity, text);
  }
  SE3 pose() const { return boat_->T_world_model(); }

 private:
  TestWorld world_;
  Model* boat_ = nullptr;
};

TEST(VesselControllerPlugin, MovesTheBoatAsTheCoreWould) {
  ControlledWorld world;
  world.write("command/heading", ScalarSample{{}, 0.7});
  ControlledBoat core("otter", shipped_control("otter"));
  core.command(towards(control::VesselCommand::Kind::kHeading, 0.7));
  world.run(30.0);
  core.run(30.0);
  EXPECT_NEAR(world.pose().rpy().z(), core.heading(), 0.01);
  EXPECT_NEAR(world.pose().p.x(), core.x(), 0.2);
  EXPECT_NEAR(world.pose().p.y(), core.y(), 0.2);
}

class EveryTiming : public testing::TestWithParam<LoopTiming> {};

TEST_P(EveryTiming, FollowsAPathAndKeepsStation) {
  ControlledWorld world(GetParam());
  world.write("command/path", PathCommand{{}, {{30, 0, 0}, {30, 25, 0}}});
  world.run(90.0);
  EXPECT_LT((world.pose().p - Eigen::Vector3d(30, 25, 0)).norm(), 3.0);
  world.write("command/pose", PoseSample{{}, "world", at(20, 20, 0)});
  world.run(120.0);
  EXPECT_LT((world.pose().p - Eigen::Vector3d(20, 20, 0)).norm(), 1.5);
  world.write("cmd_vel", TwistCommand{{}, {1.0, 0, 0}, {0, 0, 0}});
  world.run(0.4);
  EXPECT_TRUE(world.reports().empty()) << world.reports().front().text;
}

INSTANTIATE_TEST_SUITE_P(Timings, EveryTiming,
                         testing::Values(LoopTiming::kRotors, LoopTiming::kDirect));

TEST(VesselControllerPlugin, BadCommandsAreReportedOnceAndChangeNothing) {
  ControlledWorld world;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3; ++i) {
    world.write("cmd_vel", TwistCommand{{}, {nan, 0, 0}, {0, 0, 0}});
    world.write("command/path", PathCommand{{}, {}});
    world.write("command/heading", ScalarSample{{}, nan});
    world.run(1.0);
  }
  EXPECT_LT(world.pose().p.head<2>().norm(), 0.05);
  EXPECT_EQ(world.report_count(Severity::kError, "surge speed = nan m/s, legal is a number up to"),
            1U);
  EXPECT_EQ(world.report_count(Severity::kError, "0 waypoints, legal is 1 to 10000"), 1U);
  EXPECT_EQ(world.report_count(Severity::kError, "heading = nan rad, legal is a number up to"), 1U);
  world.write("cmd_vel", TwistCommand{{}, {9.0, 0, 0}, {0, 0, 1.0}});
  world.run(0.1);
  EXPECT_EQ(world.report_count(Severity::kWarning,
                               "surge speed = 9 m/s is cut to 2.5, legal is [-0.8, 2.5] m/s"),
            1U);
  EXPECT_EQ(world.report_count(Severity::kWarning, "yaw rate = 1 rad/s is cut to 0.4"), 1U);
}

TEST(VesselPluginCommands, OfTheWrongNumberOrNotFiniteAreRefused) {
  TestWorld world(ocean());
  ModelSpec spec = make_boat("otter");
  spec.plugins[0].params.children.push_back({"commandTopic", "command/motor_speed", {}, {}});
  Model& boat = world.add(std::move(spec));
  auto* const port = world->ports().find_in<ActuatorCommand>("boat/command/motor_speed");
  ASSERT_NE(port, nullptr);
  EXPECT_EQ(world->ports().find("boat/thrusters/left_thrust_cmd", PortDirection::kIn), nullptr);
  ActuatorCommand command;
  command.angular_velocities.assign(std::vector<double>{50.0});
  port->write(command);
  world->step(10);
  EXPECT_EQ(world.report_count(Severity::kError, "1 commands, legal is 2"), 1U);
  command.angular_velocities.assign(
      std::vector<double>{std::numeric_limits<double>::infinity(), 500.0});
  port->write(command);
  world->step(10);
  EXPECT_EQ(world.report_count(Severity::kError, "is refused, the last good one stays"), 1U);
  EXPECT_EQ(world.report_count(Severity::kWarning, "is cut to the nearest"), 1U);
  EXPECT_GT(boat.T_world_model().rpy().z(), 0.0);  // by the right propeller alone
}

TEST(VesselControllerPlugin, ContinuesFromASnapshotAndRepeats) {
  ControlledWorld world;
  world.write("command/path", PathCommand{{}, {{30, 0, 0}, {30, 25, 0}}});
  world.run(10.0);
  const auto snapshot = world.world().save_snapshot();
  world.run(5.0);
  const std::string first = world.world().state_hash();
  world.world().restore_snapshot(snapshot);
  world.run(5.0);
  EXPECT_EQ(world.world().state_hash(), first);
}

TEST(VesselControllerPlugin, NamesWhatIsMissing) {
  TestWorld world(ocean());
  control::register_control_plugins(world.registry);
  const auto refused = [&](ModelSpec spec) {
    return error_of([&] { world.add(std::move(spec)); });
  };
  ModelSpec alone = make_boat("otter");
  alone.plugins.push_back(controller_plugin("otter", "boat"));
  EXPECT_TRUE(contains(refused(alone), "odometryTopic"));
  ModelSpec uncommanded = make_controlled("otter");
  uncommanded.plugins[0].params.children.pop_back();
  EXPECT_TRUE(contains(refused(uncommanded), "commandTopic"));
  ModelSpec nameless = make_controlled("otter");
  nameless.plugins[2] = make_plugin("controller", "libtrident_vessel_controller.so",
                                    {{"robotNamespace", "boat"},
                                     {"vessel", vessel_file("otter")},
                                     {"controller", "no_such.yaml"}});
  EXPECT_TRUE(contains(refused(nameless), "no_such.yaml"));
}

}  // namespace
}  // namespace trident::sim
