// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "models.h"
#include "test_world.h"
#include "trident_base/error.h"
#include "trident_bridges/sitl/px4_link.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"
#include "trident_bridges_sim/register_plugins.h"
#include "trident_sim/outside_autopilots.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

const std::string kChannel =
    "<control_channels><channel name='rotor1'><input_index>0</input_index>"
    "<input_scaling>1000</input_scaling><zero_position_armed>100</zero_position_armed>"
    "</channel></control_channels>";
const std::string kControl =
    "<control channel='0'><jointName>rotor_0_joint</jointName><multiplier>800</multiplier>"
    "</control>";

/// A port of loopback that was free a moment ago.
int free_port(const std::string& url) {
  bridges::EpollLoop loop;
  bridges::EndpointOptions options;
  options.url = url;
  return bridges::open_endpoint(options, loop, {})->port();
}
std::string tcp_port() {
  return "<mavlink_tcp_port>" + std::to_string(free_port("tcp-l://127.0.0.1:0")) +
         "</mavlink_tcp_port>";
}
std::string udp_port() {
  return "<fdm_port_in>" + std::to_string(free_port("udp://127.0.0.1:0@")) + "</fdm_port_in>";
}

/// A quadrotor with one of the plugins.
class Vehicle {
 public:
  Vehicle(const std::string& filename, const std::string& elements) {
    bridges::register_sitl_plugins(world_.registry);
    ModelSpec spec = make_quad();
    spec.plugins = {plugin_of(filename, elements)};
    for (int i = 0; i < 4; ++i) {
      spec.plugins.push_back(make_plugin("motor" + std::to_string(i),
                                         "librotors_gazebo_motor_model.so", motor_params({}, i)));
    }
    world_.add(std::move(spec));
  }

  static PluginSpec plugin_of(const std::string& filename, const std::string& elements) {
    const std::string sdf =
        "<sdf version='1.6'><model name='m'><link name='l'/><plugin name='sitl' "
        "filename='" +
        filename + "'>" + elements + "</plugin></model></sdf>";
    return load_model_string(sdf, "test", Resources(std::vector<std::string>{}), [](const auto&) {})
        .plugins.at(0);
  }
  World* operator->() { return &*world_; }
  std::size_t warnings(const std::string& fragment) const {
    return world_.report_count(Severity::kWarning, fragment);
  }
  OutsideAutopilots& autopilots() { return world_->extensions().get<OutsideAutopilots>(*world_); }

 private:
  TestWorld world_;
};

std::string refusal(const std::string& filename, const std::string& elements) {
  return error_of([&] { const Vehicle vehicle(filename, elements); });
}
std::string px4_refusal(const std::string& elements) {
  return refusal("libgazebo_mavlink_interface.so", elements);
}
std::string ardupilot_refusal(const std::string& elements) {
  return refusal("libArduPilotPlugin.so", elements);
}

TEST(MavlinkInterface, BadElementsAreRefusedWithValueAndRange) {
  EXPECT_TRUE(contains(px4_refusal(tcp_port()), "<control_channels> is ''"));
  EXPECT_TRUE(contains(px4_refusal(kChannel + "<mavlink_tcp_port>70000</mavlink_tcp_port>"),
                       "<mavlink_tcp_port> is '70000'"));
  EXPECT_TRUE(contains(px4_refusal(kChannel + "<use_tcp>false</use_tcp>"),
                       "<use_tcp> is 'false', expected true"));
  EXPECT_TRUE(contains(px4_refusal(kChannel + "<hil_mode>true</hil_mode>"), "<hil_mode>"));
  EXPECT_TRUE(
      contains(px4_refusal(kChannel + tcp_port() + "<imu_rate>0</imu_rate>"), "<imu_rate> is '0'"));
  const std::string type = "<channel><joint_control_type>magic</joint_control_type></channel>";
  EXPECT_TRUE(contains(px4_refusal("<control_channels>" + type + "</control_channels>"),
                       "<joint_control_type> is 'magic', expected velocity, position"));
  const std::string index = "<channel><input_index>16</input_index></channel>";
  EXPECT_TRUE(contains(px4_refusal("<control_channels>" + index + "</control_channels>"),
                       "<input_index> is '16'"));
}

TEST(MavlinkInterface, APortInUseIsNamed) {
  bridges::EpollLoop loop;
  bridges::EndpointOptions options;
  options.url = "tcp-l://127.0.0.1:0";
  const auto owner = bridges::open_endpoint(options, loop, {});
  const std::string port = std::to_string(owner->port());
  const std::string error =
      px4_refusal(kChannel + "<mavlink_tcp_port>" + port + "</mavlink_tcp_port>");
  EXPECT_TRUE(
      contains(error, "<mavlink_tcp_port> is '" + port + "', expected a port that is free"));
}

TEST(MavlinkInterface, AJointOfAnotherVehicleIsOneWarningWithTheKnownOnes) {
  const std::string elements =
      tcp_port() +
      "<control_channels><channel name='flap'><joint_name>zephyr::flap</joint_name>"
      "</channel></control_channels>";
  Vehicle vehicle("libgazebo_mavlink_interface.so", elements);
  EXPECT_EQ(vehicle.warnings("channel 'flap': <joint_name> is 'zephyr::flap', expected"), 1U);
}

TEST(MavlinkInterface, TheNextStepWaitsForPx4) {
  Vehicle vehicle("libgazebo_mavlink_interface.so", kChannel + tcp_port());
  OutsideAutopilot* const awaited = vehicle.autopilots().first_awaited();
  ASSERT_NE(awaited, nullptr);
  EXPECT_EQ(awaited->awaited(), "has not connected");
  EXPECT_FALSE(awaited->is_gone());
  EXPECT_TRUE(contains(awaited->who(), "PX4 at tcp-l 127.0.0.1:"));
  awaited->give_up();
  EXPECT_EQ(vehicle.autopilots().first_awaited(), nullptr);
  vehicle->step(5);
}

TEST(MavlinkInterface, WithoutLockstepTheWorldContinuesAndHearsWhoConnects) {
  const int port = free_port("tcp-l://127.0.0.1:0");
  Vehicle vehicle("libgazebo_mavlink_interface.so",
                  kChannel + "<mavlink_tcp_port>" + std::to_string(port) +
                      "</mavlink_tcp_port><enable_lockstep>false</enable_lockstep>");
  vehicle->step(5);
  EXPECT_EQ(vehicle->step_count(), 5U);
  EXPECT_FALSE(vehicle.autopilots().all().front()->is_gone());
  bridges::EpollLoop loop;
  bridges::EndpointOptions options;
  options.url = "tcp://127.0.0.1:" + std::to_string(port);
  {
    bool is_there = false;
    bridges::EndpointEvents events;
    events.joined = [&](bridges::PeerId, const std::string&) { is_there = true; };
    const auto px4 = bridges::open_endpoint(options, loop, std::move(events));
    while (!is_there) loop.run_once(1.0);
    vehicle->step(1);
  }
  vehicle->step(1);
  EXPECT_TRUE(vehicle.autopilots().all().front()->is_gone());  // so it had been there
}

TEST(ArduPilotPlugin, BadElementsAreRefusedWithValueAndRange) {
  EXPECT_TRUE(contains(ardupilot_refusal(udp_port()), "<control> is ''"));
  EXPECT_TRUE(contains(
      ardupilot_refusal(udp_port() + "<control channel='0'><jointName>elbow</jointName></control>"),
      "control channel '0': <jointName> is 'elbow', expected a joint of the model"));
  EXPECT_TRUE(contains(
      ardupilot_refusal(udp_port() + "<control channel='40'><jointName>x</jointName></control>"),
      "<control channel> is '40', expected an integer in [0, 31]"));
  EXPECT_TRUE(contains(ardupilot_refusal(kControl + "<fdm_port_in>0</fdm_port_in>"),
                       "<fdm_port_in> is '0'"));
  EXPECT_TRUE(
      contains(ardupilot_refusal(udp_port() + kControl + "<gazeboXYZToNED>0 0 x</gazeboXYZToNED>"),
               "<gazeboXYZToNED> is '0 0 x', expected six numbers"));
}

TEST(ArduPilotPlugin, TheNextStepWaitsForAServoPacket) {
  Vehicle vehicle("libArduPilotPlugin.so", kControl + udp_port());
  OutsideAutopilot* const awaited = vehicle.autopilots().first_awaited();
  ASSERT_NE(awaited, nullptr);
  EXPECT_EQ(awaited->awaited(), "has not sent a servo packet");
}

TEST(ArduPilotPlugin, ABadPacketIsCountedAndNamesFieldValueAndRange) {
  const int port = free_port("udp://127.0.0.1:0@");
  Vehicle vehicle("libArduPilotPlugin.so",
                  kControl + "<fdm_port_in>" + std::to_string(port) + "</fdm_port_in>");
  bridges::EpollLoop loop;
  bridges::EndpointOptions options;
  options.url = "udp://@127.0.0.1:" + std::to_string(port);
  const auto sender = bridges::open_endpoint(options, loop, {});
  std::vector<std::uint8_t> packet(40, 1);
  const auto entries = [&] { return vehicle->diagnostics().entries().size(); };
  for (int i = 0; i < 2; ++i) sender->send_to_all({packet.data(), packet.size()});
  OutsideAutopilot& autopilot = *vehicle.autopilots().all().front();
  for (int i = 0; i < 1000 && entries() == 0; ++i) autopilot.receive(0.01);
  ASSERT_EQ(entries(), 1U);
  const auto& entry = vehicle->diagnostics().entries().begin()->second;
  EXPECT_EQ(entry.newest.message, "servo packet: magic is 257, legal: 18458 or 29569");
  EXPECT_TRUE(autopilot.is_awaited());
}

}  // namespace
}  // namespace trident::sim
