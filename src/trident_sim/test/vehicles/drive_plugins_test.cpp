// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What the drives of gazebo_plugins take and refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cart.h"

namespace trident::sim {
namespace {

CartOptions cart_with(ParamList params) {
  CartOptions options;
  options.params = std::move(params);
  return options;
}

std::string plugin_refusal(ParamList params, bool four_wheels = false) {
  CartOptions options = cart_with(std::move(params));
  options.four_wheels = four_wheels;
  return error_of([&] { CartWorld cart(options); });
}

TEST(DrivePlugins, BadValuesAreRefusedWithTheLegalOnes) {
  EXPECT_TRUE(contains(plugin_refusal({{"wheelSeparation", "0"}}), "<wheelSeparation> is '0'"));
  EXPECT_TRUE(contains(plugin_refusal({{"wheelDiameter", "-0.1"}}), "<wheelDiameter> is '-0.1'"));
  EXPECT_TRUE(contains(plugin_refusal({{"wheelTorque", "-1"}}), "<wheelTorque> is '-1'"));
  EXPECT_TRUE(contains(plugin_refusal({{"updateRate", "-5"}}), "<updateRate> is '-5'"));
  EXPECT_TRUE(contains(plugin_refusal({{"odometrySource", "gps"}}),
                       "<odometrySource> is 'gps', expected world or encoder"));
  EXPECT_TRUE(
      contains(plugin_refusal({{"leftJoint", "knee"}}), "a joint of the model: left, right"));
  EXPECT_TRUE(contains(plugin_refusal({{"leftJoint", "right"}}), "another joint than leftJoint"));
  EXPECT_TRUE(contains(plugin_refusal({{"publishTf", "maybe"}}), "<publishTf> is 'maybe'"));
  EXPECT_TRUE(
      contains(plugin_refusal({{"leftRearJoint", "tail"}}, true), "model 'cart' plugin 'drive'"));
}

TEST(DrivePlugins, AFixedJointCannotBeDriven) {
  ModelSpec spec = make_cart();
  for (JointSpec& joint : spec.joints) joint.type = JointType::kFixed;
  TestWorld world;
  EXPECT_TRUE(contains(error_of([&] { world.add(std::move(spec)); }),
                       "<leftJoint> is 'left', expected a revolute or continuous joint"));
}

TEST(DrivePlugins, ACommandThatIsNotFiniteIsReportedOnceAndTheLastOneStays) {
  CartWorld cart;
  cart.command(0.5, 0.0);
  cart.run(1.0);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    cart.command(bad, 0.0);
    cart.run(0.5);
    cart.command(0.0, bad);
    cart.run(0.5);
  }
  EXPECT_NEAR(cart.speed(), 0.5, 1e-3);
  EXPECT_EQ(cart.world.report_count(Severity::kError, "must be finite; such commands are refused"),
            1u);
  cart.command(0.2, 0.0);
  cart.run(1.0);
  EXPECT_NEAR(cart.speed(), 0.2, 1e-3);
}

TEST(DrivePlugins, ASpeedBeyondTheWheelsLimitIsScaledWithItsTurn) {
  CartOptions options;
  options.velocity_limit_rad_s = 5.0;  // 0.5 m/s at the rim
  CartWorld cart(options);
  cart.command(1.0, 1.25);  // rims at 0.75 and 1.25 m/s: 2.5 times too fast
  cart.run(3.0);
  EXPECT_NEAR(cart.speed(), 1.0 / 2.5, 0.005);
  EXPECT_NEAR(cart.model->canonical_link()->w_world().z(), 1.25 / 2.5, 0.01);
  EXPECT_EQ(cart.world.report_count(Severity::kWarning, "2.500000 times its limit"), 1u);
}

TEST(DrivePlugins, WithoutLegacyModeThePlacesOfTheWheelsDecide) {
  for (const bool swapped : {false, true}) {
    CartOptions options = cart_with(
        {{"leftJoint", swapped ? "right" : "left"}, {"rightJoint", swapped ? "left" : "right"}});
    ModelSpec spec = make_cart(options);
    auto& params = spec.plugins[0].params.children;
    params.erase(std::remove_if(params.begin(), params.end(),
                                [](const ParamNode& node) { return node.name == "legacyMode"; }),
                 params.end());
    TestWorld world(world_spec(0.001));
    world.add(make_ground());
    Model& model = world.add(std::move(spec));
    EXPECT_EQ(world.report_count(Severity::kWarning, swapped ? "taken as true" : "taken as false"),
              1u);
    world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {0, 0, 0}, {0, 0, 0.5}});
    world->step(1000);
    EXPECT_GT(model.canonical_link()->w_world().z(), 0.4);
  }
}

TEST(DrivePlugins, FlagsSayWhatIsPublished) {
  CartWorld silent(cart_with({{"publishTf", "false"}}));
  EXPECT_EQ(silent.odometry, nullptr);
  EXPECT_EQ(silent.world->ports().find_out<FrameSample>("tf/base_footprint"), nullptr);
  CartWorld without_frame(cart_with({{"publishOdomTF", "false"}}));
  EXPECT_NE(without_frame.odometry, nullptr);
  EXPECT_EQ(without_frame.world->ports().find_out<FrameSample>("tf/base_footprint"), nullptr);
  CartWorld all(cart_with({{"publishWheelTF", "true"}, {"publishWheelJointState", "true"}}));
  EXPECT_NE(all.world->ports().find_out<FrameSample>("tf/left_wheel"), nullptr);
  EXPECT_NE(all.world->ports().find_out<JointStateSample>("joint_states"), nullptr);
}

TEST(DrivePlugins, JointStatesCountTurnsAndReportRates) {
  CartWorld cart(cart_with({{"publishWheelJointState", "true"}, {"wheelAcceleration", "1"}}));
  auto* states = cart.world->ports().find_out<JointStateSample>("joint_states");
  ASSERT_NE(states, nullptr);
  states->add_listener();
  cart.command(1.0, 0.0);
  cart.run(2.0);
  EXPECT_EQ(states->value.names, (std::vector<std::string>{"left", "right"}));
  EXPECT_NEAR(states->value.positions[0], cart.truth().p.x() / 0.1, 0.1);
  EXPECT_GT(states->value.positions[0], 14.5);
  EXPECT_NEAR(states->value.velocities[1], 10.0, 0.05);
}

TEST(DrivePlugins, TwoPluginsMayShareTheJointStates) {
  ModelSpec spec = make_cart(cart_with({{"publishWheelJointState", "true"}}));
  spec.plugins.push_back(make_plugin("states", "libgazebo_ros_joint_state_publisher.so",
                                     {{"jointName", "right, left"}, {"updateRate", "50"}}));
  TestWorld world;
  world.add(std::move(spec));
  auto* states = world->ports().find_out<JointStateSample>("joint_states");
  ASSERT_NE(states, nullptr);
  states->add_listener();
  world->step(10);
  EXPECT_EQ(states->value.names, (std::vector<std::string>{"left", "right"}));
}

TEST(DrivePlugins, FramesAreResolvedAsUpstreamResolvesThem) {
  const auto frame = [](const std::string& prefix, const std::string& name) {
    WorldOptions options;
    options.tf_prefix = [prefix](const std::string& space) {
      return space == "r1" ? prefix : "of another namespace";
    };
    TestWorld world(world_spec(), options);
    world.add(make_cart(cart_with({{"robotNamespace", "/r1/"}, {"odometryFrame", name}})));
    return world->ports().find_out<OdometrySample>("r1/odom")->value.parent_frame;
  };
  EXPECT_EQ(frame("", "odom"), "r1/odom") << "the namespace in place of a prefix";
  EXPECT_EQ(frame("/robot", "odom"), "robot/odom");
  EXPECT_EQ(frame("robot", "/odom"), "odom");
}

TEST(PlanarMove, OfTwoRobotsWithOneFrameTheFirstGivesItsTransform) {
  TestWorld world(world_spec(0.001));
  for (const char* const name : {"a", "b"}) {
    ModelSpec spec = make_body(name, BoxShape{{0.4, 0.4, 0.1}}, SE3());
    spec.plugins = {
        make_plugin("move", "libgazebo_ros_planar_move.so", {{"robotNamespace", name}})};
    world.add(std::move(spec));
    world->ports().find_out<OdometrySample>(std::string(name) + "/odom")->add_listener();
  }
  EXPECT_EQ(world.report_count(Severity::kWarning, "'base_footprint' has a transform already"), 1u);
  world->step(100);
  for (const char* const topic : {"a/odom", "b/odom"}) {
    EXPECT_GT(world->ports().find_out<OdometrySample>(topic)->value.stamp.ns, 0) << topic;
  }
}

TEST(DrivePlugins, ASecondRunAfterAResetIsTheFirst) {
  CartOptions options = cart_with({{"odometrySource", "encoder"}, {"wheelAcceleration", "0.7"}});
  CartWorld cart(options);
  const auto run = [&cart] {
    cart.command(0.6, 0.4);
    cart.run(1.5);
    return cart.world->state_hash();
  };
  const std::string first = run();
  cart.world->reset();
  EXPECT_EQ(run(), first);
}

TEST(PlanarMove, GoesSidewaysAndStopsAfterItsTimeout) {
  TestWorld world(world_spec(0.001));
  world.add(make_ground());
  ModelSpec spec = make_body("m", BoxShape{{0.4, 0.4, 0.1}},
                             SE3::from_xyz_rpy({0, 0, 0.05}, 0, 0, std::acos(0.0)));
  spec.plugins = {make_plugin("move", "libgazebo_ros_planar_move.so", {{"cmdTimeout", "0.5"}})};
  Model& model = world.add(std::move(spec));
  world->ports().find_in<TwistCommand>("cmd_vel")->write({{}, {0.2, 0.4, 0}, {0, 0, 0}});
  world->step(400);
  // Heading along y: ahead is y, to the left is -x.
  EXPECT_NEAR(model.T_world_model().p.y(), 0.2 * 0.4, 0.02);
  EXPECT_NEAR(model.T_world_model().p.x(), -0.4 * 0.4, 0.02);
  world->step(1000);
  const Eigen::Vector3d stood = model.T_world_model().p;
  EXPECT_NEAR(stood.y(), 0.2 * 0.5, 0.02);
  world->step(500);
  EXPECT_TRUE(is_near(model.T_world_model().p, stood, 1e-3));
}

TEST(P3d, ReportsTheLinkInTheWorldOrAgainstAnother) {
  for (const char* frame : {"world", "chassis"}) {
    ModelSpec spec = make_cart();
    spec.plugins.push_back(
        make_plugin("truth", "libgazebo_ros_p3d.so",
                    {{"bodyName", "left_wheel"}, {"topicName", "truth"}, {"frameName", frame}}));
    spec.T_world_model = at(1, 2, 0);
    TestWorld world;
    world.add(make_ground());
    Model& model = world.add(std::move(spec));
    auto* truth = world->ports().find_out<OdometrySample>("truth");
    ASSERT_NE(truth, nullptr);
    truth->add_listener();
    world->step(50);
    const SE3 T_world_wheel = model.find_link("left_wheel")->T_world_link();
    const SE3 expected = std::string(frame) == "world"
                             ? T_world_wheel
                             : model.find_link("chassis")->T_world_link().inverse() * T_world_wheel;
    EXPECT_TRUE(is_near(truth->value.T_parent_child, expected, 1e-12));
    EXPECT_EQ(truth->value.parent_frame, frame);
    EXPECT_EQ(truth->value.child_frame, "left_wheel");
  }
}

}  // namespace
}  // namespace trident::sim
