// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "any_messages.h"

#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <sstream>

namespace trident::sim {

// The first line that is neither empty, a comment nor a constant is the first field.
bool begins_with_header(const std::string& definition) {
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type, name;
    if (!(words >> type >> name) || line.find('=') < line.find('#')) continue;
    return type == "Header" || type == "std_msgs/Header";
  }
  return false;
}

SimTime header_stamp(const std::string& bytes) {
  std::uint32_t fields[3];  // seq, sec, nsec
  if (bytes.size() < sizeof(fields)) return {};
  std::memcpy(fields, bytes.data(), sizeof(fields));
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {kSecond_ns * fields[1] + fields[2]};
}

bool HeaderCheck::has_header(const topic_tools::ShapeShifter& message) {
  if (md5sum_ != message.getMD5Sum()) {
    md5sum_ = message.getMD5Sum();
    has_header_ = begins_with_header(message.getMessageDefinition());
  }
  return has_header_;
}

BytesSample to_bytes(const topic_tools::ShapeShifter& message, HeaderCheck& headers) {
  auto bytes = std::make_shared<std::string>(message.size(), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes->data()),
                                     message.size());
  message.write(stream);
  const SimTime stamp = headers.has_header(message) ? header_stamp(*bytes) : SimTime{};
  return {stamp, std::move(bytes), {}};
}

}  // namespace trident::sim
