// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <topic_tools/shape_shifter.h>

#include <string>

#include "trident_sim/bytes_sample.h"

namespace trident::sim {

/// Whether messages of a type begin with a std_msgs/Header.
bool begins_with_header(const std::string& definition);

/// The stamp of a message that begins with a header; zero where its bytes have no place for one.
SimTime header_stamp(const std::string& bytes);

/// begins_with_header() of the messages of a topic, which seldom change their type.
class HeaderCheck {
 public:
  bool has_header(const topic_tools::ShapeShifter& message);

 private:
  std::string md5sum_;
  bool has_header_ = false;
};

BytesSample to_bytes(const topic_tools::ShapeShifter& message, HeaderCheck& headers);

}  // namespace trident::sim
