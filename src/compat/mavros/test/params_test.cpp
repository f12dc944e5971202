// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "core/mavros_params.h"
#include "core/vehicle_list.h"
#include "trident_base/error.h"

namespace trident::mavros {
namespace {

/// A map of parameters, as the parameter server has it.
XmlRpc::XmlRpcValue upstream_parameters() {
  XmlRpc::XmlRpcValue all;
  all["fcu_url"] = "udp://:14540@localhost:14580";
  all["sys"]["min_voltage"] = 10.0;
  all["imu"]["angular_velocity_stdev"] = "0.0003490659 // 0.02 degrees";
  all["time"]["timesync_mode"] = "MAVLINK";
  all["fake_gps"]["gps_rate"] = 5.0;
  all["mission"]["enable_partial_push"] = true;
  all["safety_area"]["p1"]["x"] = 1.0;
  all["px4flow"]["ranger_fov"] = 0.118682;
  return all;
}

TEST(MavrosParams, FilesOfUpstreamAreReadAsTheyAre) {
  ros_utils::NodeParams params(upstream_parameters(), "/mavros");
  const MavrosParams values = read_mavros_params(params, "/mavros");
  EXPECT_EQ(values.sys.min_voltage, std::vector<double>{10.0});
  EXPECT_DOUBLE_EQ(values.imu.angular_velocity_stdev, 0.0003490659);
  EXPECT_TRUE(params.warnings().empty());
}

TEST(MavrosParams, TheSourceOfTimeMayStandAlone) {
  XmlRpc::XmlRpcValue all;
  all["time"] = "wall";
  ros_utils::NodeParams params(all, "/mavros");
  EXPECT_EQ(read_mavros_params(params, "/mavros").time.source, "wall");
  all["time"] = "mars";
  ros_utils::NodeParams wrong(all, "/mavros");
  EXPECT_THROW(read_mavros_params(wrong, "/mavros"), Error);
}

TEST(MavrosParams, APrefixStandsBeforeAllFrames) {
  XmlRpc::XmlRpcValue all;
  all["frame_prefix"] = "uav1/";
  ros_utils::NodeParams params(all, "/mavros");
  const MavrosParams values = read_mavros_params(params, "/mavros");
  EXPECT_EQ(values.local_position.tf.child_frame_id, "uav1/base_link");
  EXPECT_EQ(values.global_position.frame_id, "uav1/map");
  EXPECT_EQ(values.imu.frame_id, "uav1/base_link");
}

TEST(MavrosParams, TheNamespaceIsThePrefixWhereNoneIsSet) {
  const auto frame = [](const std::string& node_name, const char* prefix) {
    XmlRpc::XmlRpcValue all;
    all["target_system_id"] = 1;
    if (prefix != nullptr) all["frame_prefix"] = prefix;
    ros_utils::NodeParams params(all, node_name);
    return read_mavros_params(params, node_name).imu.frame_id;
  };
  EXPECT_EQ(frame("/mavros", nullptr), "base_link");
  EXPECT_EQ(frame("/uav1/mavros", nullptr), "uav1/base_link");
  EXPECT_EQ(frame("/coast/uav1/mavros", nullptr), "coast/uav1/base_link");
  EXPECT_EQ(frame("/uav1/mavros", ""), "base_link");
  EXPECT_EQ(frame("/uav1/mavros", "boat/"), "boat/base_link");
}

TEST(MavrosParams, TheReferencePageIsTheirs) {
  const std::string text = ros_utils::params_page(
      "mavros_node",
      "Private parameters of mavros' node; upstream's names. "
      "docs/howto/mavros.md says how it is used.",
      ros_utils::document_params<VehicleListParams>() + '\n' +
          ros_utils::document_params<MavrosParams>() +
          "\nEach section of `~distance_sensor`, by the name of its topic:\n\n" +
          ros_utils::document_params<DistanceSensorParams>());
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/mavros_node.md", text), text);
}

MavrosParams read(const XmlRpc::XmlRpcValue& all) {
  ros_utils::NodeParams params(all, "/uav1/mavros");
  MavrosParams result = read_mavros_params(params, "/uav1/mavros");
  EXPECT_TRUE(params.warnings().empty());
  return result;
}

TEST(MavrosParams, SensorsAreReadByTheirNamesAndHavePrefixedFrames) {
  XmlRpc::XmlRpcValue all;
  auto& sonar = all["distance_sensor"]["sonar"];
  sonar["id"] = 2;
  sonar["frame_id"] = "sonar";
  sonar["orientation"] = "PITCH_270";
  sonar["send_tf"] = true;
  sonar["sensor_position"]["z"] = -0.1;
  all["distance_sensor"]["base_frame_id"] = "base_link";
  const MavrosParams params = read(all);
  ASSERT_EQ(params.distance_sensor.size(), 1U);
  const DistanceSensorParams& sensor = params.distance_sensor.at("sonar");
  EXPECT_EQ(sensor.frame_id, "uav1/sonar");
  EXPECT_EQ(sensor.orientation, kDownward);
  EXPECT_TRUE(params.problems.empty());
}

TEST(MavrosParams, ASensorOfAWrongTypeIsOneErrorAndTheOthersStay) {
  XmlRpc::XmlRpcValue all;
  all["distance_sensor"]["good"]["id"] = 1;
  all["distance_sensor"]["bad"]["id"] = 2;
  all["distance_sensor"]["bad"]["subscriber"] = "yes";
  all["distance_sensor"]["number"] = 5;
  const MavrosParams params = read(all);
  EXPECT_EQ(params.distance_sensor.size(), 1U);
  ASSERT_EQ(params.problems.size(), 2U);
  EXPECT_NE(params.problems[0].find("/uav1/mavros/distance_sensor/bad/subscriber"),
            std::string::npos);
  EXPECT_NE(params.problems[1].find("/uav1/mavros/distance_sensor/number"), std::string::npos);
}

TEST(MavrosParams, WheelsOfUpstreamsFileAreRead) {
  XmlRpc::XmlRpcValue all;
  auto& wheels = all["wheel_odometry"];
  wheels["count"] = 4;
  for (const char* const name : {"wheel0", "wheel1", "wheel2", "wheel3"}) wheels[name]["x"] = 0.0;
  wheels["wheel0"]["y"] = -0.15;
  wheels["wheel1"]["y"] = 0.15;
  wheels["tf"]["send"] = true;
  const WheelOdometryParams params = read(all).wheel_odometry;
  EXPECT_EQ(params.wheel1->y, 0.15);
  EXPECT_EQ(params.frame_id, "uav1/odom");
  EXPECT_EQ(params.tf.child_frame_id, "uav1/base_link");
}

TEST(MavrosParams, AWheelWhoseParametersWereDeletedIsNoWheel) {
  XmlRpc::XmlRpcValue all;
  int offset = 0;
  const XmlRpc::XmlRpcValue empty("<value><struct></struct></value>", &offset);
  all["wheel_odometry"]["wheel0"] = empty;
  all["wheel_odometry"]["wheel1"] = empty;
  EXPECT_FALSE(read(all).wheel_odometry.wheel0);
}

/// The vehicles of a node /fleet/mavros with these parameters.
std::vector<VehicleParams> vehicles_of(const XmlRpc::XmlRpcValue& node,
                                       const std::map<std::string, XmlRpc::XmlRpcValue>& others) {
  ros_utils::NodeParams params(node, "/fleet/mavros");
  return read_vehicles(params, [&](const std::string& name) {
    const auto found = others.find(name);
    return ros_utils::NodeParams(found == others.end() ? XmlRpc::XmlRpcValue() : found->second,
                                 name);
  });
}

XmlRpc::XmlRpcValue two_names() {
  XmlRpc::XmlRpcValue all;
  all["vehicles"][0] = "uav1";
  all["vehicles"][1] = "usv1";
  all["conn"]["timeout"] = 5.0;
  all["conn"]["timesync_rate"] = 2.0;
  return all;
}

TEST(VehicleList, EachHasItsParametersOverThoseOfTheNode) {
  XmlRpc::XmlRpcValue uav, usv;
  uav["fcu_url"] = "udp://:14540@";
  usv["fcu_url"] = "udp://:14541@";
  usv["conn"]["timeout"] = 7.0;
  const auto vehicles =
      vehicles_of(two_names(), {{"/fleet/uav1/mavros", uav}, {"/fleet/usv1/mavros", usv}});
  ASSERT_EQ(vehicles.size(), 2U);
  EXPECT_EQ(vehicles[0].name, "/fleet/uav1/mavros");
  EXPECT_EQ(vehicles[0].params.fcu_url, "udp://:14540@");
  EXPECT_EQ(vehicles[0].params.conn.timeout, 5.0);
  EXPECT_EQ(vehicles[1].params.conn.timeout, 7.0);
  EXPECT_EQ(vehicles[1].params.conn.timesync_rate, 2.0);
  EXPECT_EQ(vehicles[1].params.imu.frame_id, "fleet/usv1/base_link");
}

TEST(VehicleList, WithoutNamesTheNodeIsTheVehicle) {
  const auto vehicles = vehicles_of(XmlRpc::XmlRpcValue(), {});
  ASSERT_EQ(vehicles.size(), 1U);
  EXPECT_EQ(vehicles[0].name, "/fleet/mavros");
}

std::string error_of(const XmlRpc::XmlRpcValue& node,
                     const std::map<std::string, XmlRpc::XmlRpcValue>& others) {
  try {
    vehicles_of(node, others);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(VehicleList, AClashNamesBothVehicles) {
  XmlRpc::XmlRpcValue node = two_names();
  const std::string both =
      "parameter /fleet/mavros/vehicles: vehicles /fleet/uav1/mavros and "
      "/fleet/usv1/mavros have one ";
  XmlRpc::XmlRpcValue uav, usv;
  uav["fcu_url"] = "udp://:14540@127.0.0.1:14580";
  usv["fcu_url"] = "tcp://127.0.0.1:5760";
  usv["gcs_url"] = "udp://:14540@";
  EXPECT_EQ(error_of(node, {{"/fleet/uav1/mavros", uav}, {"/fleet/usv1/mavros", usv}}),
            both + "endpoint: 'UDP port 14540'");
  node["fcu_url"] = "tcp://127.0.0.1:14445";  // a router, to which each connects
  EXPECT_EQ(error_of(node, {}), "");
  node["frame_prefix"] = "boat/";
  EXPECT_EQ(error_of(node, {}), both + "frame_prefix: 'boat/'");
  node["vehicles"][1] = "uav1";
  EXPECT_NE(error_of(node, {}).find("have one name"), std::string::npos);
  node["vehicles"][1] = "no name";
  EXPECT_NE(error_of(node, {}).find("'no name' is no namespace"), std::string::npos);
}

}  // namespace
}  // namespace trident::mavros
