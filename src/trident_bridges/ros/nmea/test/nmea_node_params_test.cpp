// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/nmea_node_params.h"

#include <gtest/gtest.h>

#include <string>

#include "trident_bridges_ros/nmea/navsat_drivers.h"

namespace trident::bridges {
namespace {

using XmlRpc::XmlRpcValue;

NmeaNodeParams read(const XmlRpcValue& value) {
  ros_utils::NodeParams params(value, "/boat/nmea");
  return read_nmea_params(params);
}

std::string error_of(const XmlRpcValue& value) {
  try {
    read(value);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(NmeaNodeParams, WithoutParametersItIsATcpServerOnTheRegisteredPort) {
  const NmeaNodeParams params = read(XmlRpcValue());
  ASSERT_EQ(params.links.size(), 1U);
  const EndpointOptions options = params.links[0].options();
  EXPECT_EQ(options.url, "tcp-l://:10110");
  EXPECT_EQ(options.default_bind_port, 10110);
  EXPECT_EQ(options.default_baud, 4800U);
  EXPECT_FALSE(options.allow_remote);
  EXPECT_TRUE(params.framer.require_checksum);
  EXPECT_FALSE(params.navsat.dop_scales_gst);
}

TEST(NmeaNodeParams, LinksAndRatesAreReadFromTheParameterServer) {
  XmlRpcValue value;
  value["links"][0]["url"] = "udp://@127.0.0.1:10110";
  value["links"][0]["listens"] = false;
  value["links"][1]["url"] = "pty:///tmp/gps:38400";
  value["rates"]["GGA"] = 10;
  value["talkers"]["gnss"] = "GN";
  const NmeaNodeParams params = read(value);
  ASSERT_EQ(params.links.size(), 2U);
  EXPECT_FALSE(params.links[0].listens);
  EXPECT_TRUE(params.links[1].sends);
  EXPECT_EQ(params.talker.rates.size(), 1U);
  EXPECT_EQ(params.talker.rates.at("GGA"), 10.0);
  EXPECT_EQ(params.talker.talkers.gnss, "GN");
}

TEST(NmeaNodeParams, WhatIsNotLegalIsNamed) {
  XmlRpcValue rate;
  rate["rates"]["GGS"] = 1.0;
  EXPECT_NE(error_of(rate).find("'GGS'; did you mean 'GGA'?"), std::string::npos) << error_of(rate);
  XmlRpcValue talker;
  talker["talkers"]["gnss"] = "gps";
  EXPECT_NE(error_of(talker).find("gnss is 'gps'"), std::string::npos) << error_of(talker);
  XmlRpcValue length;
  length["max_length"] = 40;
  EXPECT_NE(error_of(length).find("max_length"), std::string::npos) << error_of(length);
}

void expect_page(const std::string& name, const std::string& what, const std::string& tables) {
  const std::string page = ros_utils::params_page(name, what, tables);
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/" + name + ".md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

TEST(NmeaNodeParams, TheReferenceIsThatOfTheStructs) {
  expect_page("nmea_node",
              "Private parameters of nmea_node, or keys of its `~config_file`, printed from the "
              "node's struct.",
              ros_utils::document_params<NmeaNodeParams>());
  expect_page("nmea_navsat_driver",
              "Private parameters of nmea_navsat_driver's nodes, printed from their structs: of "
              "all; of nmea_serial_driver and\nnmea_topic_serial_reader; of nmea_socket_driver.",
              ros_utils::document_params<NavsatDriverParams>() + "\n" +
                  ros_utils::document_params<NavsatSerialParams>() + "\n" +
                  ros_utils::document_params<NavsatSocketParams>());
}

}  // namespace
}  // namespace trident::bridges
