// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Messages that carry a number through a bridge. A protocol rounds what it carries, so each number
/// stands in a field in steps that survive.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt8MultiArray.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "probe_options.h"
#include "tlog_carrier.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {

/// The number nearest to `value`; kNoNumber: it is no whole one within 0.1 (of its step).
inline std::uint64_t number_near(double value) {
  const double number = std::round(value);
  if (!(number >= 0.0) || number > 1e15 || std::abs(value - number) > 0.1) return kNoNumber;
  return static_cast<std::uint64_t>(number);
}

/// Any bytes; the number is in the first eight.
struct BytesCarrier {
  using Message = std_msgs::UInt8MultiArray;
  /// A message of `size` bytes; size >= 8.
  static void put(std::uint64_t number, std::size_t size, Message& message) {
    message.data.resize(size);
    std::memcpy(message.data.data(), &number, sizeof(number));
  }
  static std::uint64_t number(const Message& message) {
    std::uint64_t result = kNoNumber;
    if (message.data.size() >= sizeof(result)) {
      std::memcpy(&result, message.data.data(), sizeof(result));
    }
    return result;
  }
};

/// One number; as float32 it counts to 2^24.
template <class Type>
struct FloatCarrier {
  using Message = Type;
  static void put(std::uint64_t number, std::size_t, Message& message) {
    message.data = static_cast<decltype(message.data)>(number);
  }
  static std::uint64_t number(const Message& message) { return number_near(message.data); }
};

/// Pose and twist; x is the number [m], which MAVLink's ODOMETRY carries as float32: to 2^24.
struct OdometryCarrier {
  using Message = nav_msgs::Odometry;
  static void put(std::uint64_t number, std::size_t, Message& message) {
    message.header.stamp = ros::Time::now();
    message.header.frame_id = "odom";
    message.child_frame_id = "base_link";
    message.pose.pose.position.x = static_cast<double>(number);
    message.pose.pose.orientation.w = 1.0;
  }
  static std::uint64_t number(const Message& message) {
    return number_near(message.pose.pose.position.x);
  }
};

/// A position; the longitude is the number in steps of 1e-5 degrees from -180, about a meter: a GGA
/// sentence resolves 1.7e-7 degrees (five decimals of a minute).
struct NavSatFixCarrier {
  using Message = sensor_msgs::NavSatFix;
  static void put(std::uint64_t number, std::size_t, Message& message) {
    message.header.stamp = ros::Time::now();
    message.header.frame_id = "gps";
    message.latitude = 59.0;
    message.longitude = 1e-5 * static_cast<double>(number) - 180.0;
    message.altitude = 10.0;
  }
  static std::uint64_t number(const Message& message) {
    return number_near(1e5 * (message.longitude + 180.0));
  }
};

/// A carrier of these options. Throws Error as its constructor does.
template <class Carrier>
Carrier make_carrier(const ProbeOptions& options) {
  if constexpr (std::is_constructible_v<Carrier, const ProbeOptions&>) {
    return Carrier(options);
  } else {
    return Carrier();
  }
}

/// A type as an argument.
template <class Type>
struct TypeOf {
  using type = Type;
};

/// Calls `work` with the TypeOf of the carrier of this name. Throws Error for an unknown one.
template <class Work>
int with_carrier(const std::string& name, Work work) {
  if (name == "bytes") return work(TypeOf<BytesCarrier>());
  if (name == "float32") return work(TypeOf<FloatCarrier<std_msgs::Float32>>());
  if (name == "float64") return work(TypeOf<FloatCarrier<std_msgs::Float64>>());
  if (name == "odometry") return work(TypeOf<OdometryCarrier>());
  if (name == "nav_sat_fix") return work(TypeOf<NavSatFixCarrier>());
  if (name == "tlog") return work(TypeOf<TlogCarrier>());
  throw Error("--message " + unknown_name_text(name, {"bytes", "float32", "float64", "odometry",
                                                      "nav_sat_fix", "tlog"}));
}

}  // namespace trident::bridges
