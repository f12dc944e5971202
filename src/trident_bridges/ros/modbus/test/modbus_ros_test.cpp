// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Float64MultiArray.h>
#include <visualization_msgs/MarkerArray.h>

#include "trident_base/error.h"
#include "trident_bridges/modbus/message_fields.h"
#include "trident_bridges_ros/modbus/message_lookup.h"
#include "trident_bridges_ros/modbus/modbus_node_params.h"
#include "trident_ros/node_params.h"

namespace trident::bridges::modbus {
namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
Message message_of(std::vector<std::uint8_t> bytes) {
  Message message;
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, message);
  return message;
}

/// The definition that a publisher of the type sends.
template <class Message>
MessageDefinition definition_of() {
  return {ros::message_traits::datatype<Message>(), ros::message_traits::definition<Message>()};
}

template <class Message>
class MessageTypes : public testing::Test {};
using Types = testing::Types<sensor_msgs::BatteryState, sensor_msgs::PointCloud2,
                             nav_msgs::Odometry, geometry_msgs::PoseWithCovarianceStamped,
                             std_msgs::Float64MultiArray, visualization_msgs::MarkerArray>;
TYPED_TEST_SUITE(MessageTypes, Types);

TYPED_TEST(MessageTypes, DefinitionsHaveTheSumsOfRoscpp) {
  const std::string expected = ros::message_traits::md5sum<TypeParam>();
  EXPECT_EQ(definition_of<TypeParam>().md5sum(), expected);
  MessageLookup lookup;
  EXPECT_EQ(lookup.get(ros::message_traits::datatype<TypeParam>()).md5sum(), expected);
}

TYPED_TEST(MessageTypes, AnEmptyMessageIsThatOfRoscpp) {
  std::vector<std::uint8_t> bytes;
  MessageWriter(definition_of<TypeParam>(), {}).write({}, 0, 0, bytes);
  EXPECT_EQ(bytes, bytes_of(TypeParam()));
}

TEST(MessageFieldsOfRos, AFieldBehindTextsAndArraysIsRead) {
  sensor_msgs::BatteryState battery;
  battery.header.frame_id = "base";
  battery.voltage = 25.5F;
  battery.cell_voltage = {4.0F, 4.25F, 4.5F};
  battery.location = "bow";
  const auto bytes = bytes_of(battery);
  const MessageDefinition definition = definition_of<sensor_msgs::BatteryState>();
  Value value;
  ASSERT_TRUE(FieldReader(definition, "voltage").read(bytes, value));
  EXPECT_EQ(as_double(value.numbers.at(0)), 25.5);
  ASSERT_TRUE(FieldReader(definition, "cell_voltage[2]").read(bytes, value));
  EXPECT_EQ(as_double(value.numbers.at(0)), 4.5);
  ASSERT_TRUE(FieldReader(definition, "location").read(bytes, value));
  EXPECT_EQ(value.text, "bow");
}

TEST(MessageFieldsOfRos, AWrittenMessageIsReadByRoscpp) {
  std::vector<std::uint8_t> bytes;
  const std::vector<Value> values{{{Number{1.5}}, ""}, {{Number{-0.25}}, ""}, {{}, "odom"}};
  MessageWriter(definition_of<nav_msgs::Odometry>(),
                {"pose.pose.position.x", "pose.covariance[7]", "child_frame_id"})
      .write(values, 12, 34, bytes);
  const auto odometry = message_of<nav_msgs::Odometry>(bytes);
  EXPECT_EQ(odometry.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(odometry.pose.pose.position.x, 1.5);
  EXPECT_EQ(odometry.pose.covariance[7], -0.25);
  EXPECT_EQ(odometry.child_frame_id, "odom");
}

TEST(MessageLookup, AnUnknownTypeIsRefusedWithTheNearestOne) {
  MessageLookup lookup;
  try {
    lookup.get("std_msgs/Flaot64");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'Float64'"), std::string::npos);
  }
  EXPECT_THROW(lookup.get("no_such_package/Type"), Error);
}

TEST(ModbusNodeParams, TheReferenceIsThatOfTheStructs) {
  std::vector<config_detail::DocumentRow> rows;
  config_detail::ConfigDocumenter registers("registers[]", &rows);
  RegisterSpec().visit(registers);
  const std::string page = ros_utils::params_page(
      "Modbus nodes and maps",
      "Private parameters of modbus_server_node and modbus_client_node, and keys of their map "
      "files, printed from the structs.",
      "## Parameters\n\n" + ros_utils::document_params<ModbusNodeParams>() + "\n## Map\n\n" +
          document<MapSpec>() + "\n## Registers of a map\n\n" +
          config_detail::markdown_table(rows));
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/modbus_nodes.md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

}  // namespace
}  // namespace trident::bridges::modbus
