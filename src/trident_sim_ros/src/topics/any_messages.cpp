// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "any_messages.h"

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

std::string publisher_field(const ros::M_string& publisher, const std::string& key) {
  const auto field = publisher.find(key);
  return field == publisher.end() ? "" : field->second;
}

BytesSample BytesReader::read(const std::shared_ptr<const std::string>& bytes,
                              const ros::M_string& publisher) {
  if (const std::string md5sum = publisher_field(publisher, "md5sum"); md5sum_ != md5sum) {
    md5sum_ = md5sum;
    has_header_ = begins_with_header(publisher_field(publisher, "message_definition"));
  }
  BytesSample sample;
  sample.data = bytes;
  sample.is_latched = publisher_field(publisher, "latching") == "1";
  if (has_header_) sample.stamp = header_stamp(*sample.data);
  return sample;
}

}  // namespace trident::sim
