// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>

#include "trident_sim/samples/bytes_sample.h"

namespace trident::sim {

/// Whether messages of a type begin with a std_msgs/Header.
bool begins_with_header(const std::string& definition);

/// The stamp of a message that begins with a header; zero where its bytes have no place for one.
SimTime header_stamp(const std::string& bytes);

/// What a publisher says of itself under a key of TCPROS; "" where it says nothing.
std::string publisher_field(const ros::M_string& publisher, const std::string& key);

/// Makes samples of the messages of a topic, which seldom change their type.
class BytesReader {
 public:
  /// `publisher`: what it says of itself; see AnySubscriptionHelper.
  BytesSample read(const std::shared_ptr<const std::string>& bytes, const ros::M_string& publisher);

 private:
  std::string md5sum_;
  bool has_header_ = false;
};

}  // namespace trident::sim
