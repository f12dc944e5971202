// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>

#include "trident_base/span.h"
#include "trident_sim/bytes_sample.h"

namespace trident::sim {

/// Whether messages of a type begin with a std_msgs/Header.
bool begins_with_header(const std::string& definition);

/// The stamp of a message that begins with a header; zero where its bytes have no place for one.
SimTime header_stamp(const std::string& bytes);

/// Makes samples of the messages of a topic, which seldom change their type.
class BytesReader {
 public:
  /// `publisher`: what it says of itself; see AnySubscriptionHelper.
  BytesSample read(Span<const std::uint8_t> bytes, ros::M_string& publisher);

 private:
  std::string md5sum_;
  bool has_header_ = false;
};

}  // namespace trident::sim
