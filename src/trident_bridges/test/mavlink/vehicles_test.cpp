// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/vehicles.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "trident_base/error.h"

namespace trident::bridges::mavlink {
namespace {

std::string error_of(const std::string& yaml) {
  try {
    load_yaml_string<VehiclesFile>(yaml, "vehicles.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Vehicles, WhatIsNotGivenFollowsFromThePlace) {
  const auto file = load_yaml_string<VehiclesFile>(
      "vehicles: [{vehicle: iris}, {vehicle: boat, namespace: USV1, kind: boat, "
      "autopilot: ardupilot, system_id: 40}]",
      "vehicles.yaml");
  const std::vector<VehicleLinks> all = resolve(file);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].ros_namespace, "iris");
  EXPECT_EQ(all[0].system_id, 1);
  EXPECT_EQ(all[1].ros_namespace, "USV1");
  EXPECT_EQ(all[1].system_id, 40);
  EXPECT_EQ(all[1].offboard_port, 14581);
  EXPECT_EQ(all[1].offboard_remote_port, 14541);
  EXPECT_EQ(all[1].gcs_port, 18571);
  EXPECT_EQ(all[1].tcp_port, 5770);
  EXPECT_EQ(all[1].px4_simulator_port, 4561);
  EXPECT_EQ(all[1].ardupilot_json_port, 9012);
  EXPECT_EQ(file.router_port, 14445);
}

TEST(Vehicles, OdometryIsTheEstimateUnlessTheTruthIsAskedFor) {
  const auto file = load_yaml_string<VehiclesFile>(
      "vehicles: [{vehicle: a}, {vehicle: b, kind: rover}, {vehicle: c, kind: boat}, "
      "{vehicle: d, truth: true}, {vehicle: e, kind: boat, truth: true}, "
      "{vehicle: f, odometry: vio/odometry, max_thrust: 40}]",
      "vehicles.yaml");
  std::vector<std::string> topics;
  for (const VehicleLinks& links : resolve(file)) topics.push_back(links.odometry);
  const std::vector<std::string> expected = {
      "odometry_sensor1/odometry", "odom",        "odometry", "ground_truth/odometry",
      "ground_truth/odom",         "vio/odometry"};
  EXPECT_EQ(topics, expected);
  EXPECT_EQ(resolve(file)[5].max_thrust_N, 40.0);
}

TEST(Vehicles, AClashIsOneErrorThatNamesBoth) {
  const std::string twice = "vehicles: [{vehicle: a, system_id: 2}, {vehicle: b}]";
  EXPECT_NE(error_of(twice).find("'a' and 'b' both have system id 2"), std::string::npos)
      << error_of(twice);
  const std::string ports = "vehicles: [{vehicle: a, gcs_port: 14541}, {vehicle: b}]";
  EXPECT_NE(error_of(ports).find("'a' and 'b' both have UDP port 14541"), std::string::npos)
      << error_of(ports);
  const std::string router = "vehicles: [{vehicle: a, tcp_port: 14445}]";
  EXPECT_NE(error_of(router).find("'the router' and 'a' both have TCP port 14445"),
            std::string::npos)
      << error_of(router);
  const std::string names = "vehicles: [{vehicle: a}, {vehicle: b, namespace: a}]";
  EXPECT_NE(error_of(names).find("'a' and 'b' both have namespace a"), std::string::npos);
  // A TCP server and a UDP socket may have one number.
  EXPECT_EQ(error_of("vehicles: [{vehicle: a, tcp_port: 14580}]"), "");
}

TEST(Vehicles, OddFilesAreErrorsWithTheirPlace) {
  EXPECT_NE(error_of("vehicles: [{vehicle: a, kind: plane}]").find("vehicles[0].kind"),
            std::string::npos);
  EXPECT_NE(error_of("vehicles: [{vehicle: a, sytem_id: 3}]").find("system_id"), std::string::npos);
  EXPECT_NE(error_of("vehicles: [{vehicle: a, system_id: 255}]").find("254"), std::string::npos);
  EXPECT_NE(error_of("router_port: 14445").find("vehicles"), std::string::npos);
  std::string many = "vehicles:\n";
  for (int i = 0; i < 255; ++i) many += "- {vehicle: v" + std::to_string(i) + "}\n";
  EXPECT_NE(error_of(many).find("'v254': system id 255, legal: up to 254"), std::string::npos);
}

TEST(Vehicles, TheShippedFileIsRead) {
  const std::filesystem::path root = std::filesystem::path(__FILE__).parent_path() / "../../../..";
  const auto file = load_yaml<VehiclesFile>((root / "config/bridges/vehicles.yaml").string());
  EXPECT_EQ(resolve(file).size(), 3U);
}

}  // namespace
}  // namespace trident::bridges::mavlink
