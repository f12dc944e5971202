// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Polygon.h>
#include <ros/node_handle.h>
#include <ros/serialization.h>
#include <ros/subscriber.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace trident::nav {

/// The bytes of a message of any type: costmap_2d takes polygons on the very topic on which it
/// publishes its footprint as another type.
struct AnyMessage {
  std::vector<std::uint8_t> bytes;  ///< Serialized, without its length.
};

/// Takes footprints of other nodes from a topic: geometry_msgs/Polygon or PolygonStamped, whose
/// frame is the robot's base in either case.
class FootprintInput {
 public:
  /// `take`: called with each polygon, in the thread of callbacks. Other types are reported to
  /// `refuse` with a sentence.
  FootprintInput(ros::NodeHandle& node, const std::string& topic,
                 std::function<void(const geometry_msgs::Polygon& polygon)> take,
                 std::function<void(const std::string& problem)> refuse);

 private:
  ros::Subscriber subscriber_;
};

}  // namespace trident::nav

namespace ros::message_traits {

template <>
struct MD5Sum<trident::nav::AnyMessage> {
  static const char* value() { return "*"; }
  static const char* value(const trident::nav::AnyMessage& /*message*/) { return value(); }
};

template <>
struct DataType<trident::nav::AnyMessage> {
  static const char* value() { return "*"; }
  static const char* value(const trident::nav::AnyMessage& /*message*/) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<trident::nav::AnyMessage> {
  template <class Stream>
  static void read(Stream& stream, trident::nav::AnyMessage& message) {
    const std::uint8_t* const begin = stream.getData();
    message.bytes.assign(begin, begin + stream.getLength());
  }
};

}  // namespace ros::serialization
