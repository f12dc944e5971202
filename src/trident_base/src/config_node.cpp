// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/config_node.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "trident_base/shown_text.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

/// Of a value in an error text.
constexpr std::size_t kMaxShownBytes = 60;
constexpr off_t kLargestFile = off_t{1} << 26;

std::string located(const std::string& file, int line, const std::string& key,
                    const std::string& problem) {
  std::string text = file;
  if (line > 0) text += ':' + std::to_string(line);
  // The name of a ROS parameter continues its label: "parameter /node/name: ...".
  text += starts_with(key, "/") ? " " : ": ";
  if (!key.empty()) text += key + ": ";
  return with_short_words(text + problem);
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string shortened(const std::string& text) {
  return text.size() > kMaxShownBytes ? text.substr(0, kMaxShownBytes) + "..." : text;
}

/// Devices are endless, and nobody writes so much by hand.
void refuse_device_and_large_file(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) return;
  if (S_ISCHR(about.st_mode) || S_ISBLK(about.st_mode)) {
    throw ConfigError(path, 0, "", "is a device, legal: a file of YAML");
  }
  if (S_ISREG(about.st_mode) && about.st_size > kLargestFile) {
    throw ConfigError(path, 0, "",
                      "has " + std::to_string(about.st_size) + " bytes, legal: at most " +
                          std::to_string(kLargestFile));
  }
}

}  // namespace

ConfigError::ConfigError(std::string file, int line, std::string key, const std::string& problem)
    : Error(located(file, line, key, problem)),
      file_(std::move(file)),
      line_(line),
      key_(std::move(key)) {}

/// Linear: maps have few keys, and keep them in the order of the file for errors.
const ConfigNode* ConfigNode::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

std::string ConfigNode::describe() const {
  switch (kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kSequence:
      return "a list of " + counted(items.size(), "item");
    case Kind::kMap:
      return "a map of " + counted(items.size(), "key");
    case Kind::kScalar:
      break;
  }
  const std::string shown = shortened(scalar);
  return quoted ? "the text '" + shown + '\'' : shown;
}

std::string read_config_file(const std::string& path) {
  refuse_device_and_large_file(path);
  // Streams do not say why they fail; errno does where a system call has failed.
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  // Inserting a stream buffer without a single byte sets failbit, so an empty file is let through.
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
  if (!stream.is_open() || stream.bad() || text.bad()) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "read error";
    throw ConfigError(path, 0, "", "cannot read the file: " + reason);
  }
  return text.str();
}

}  // namespace trident
