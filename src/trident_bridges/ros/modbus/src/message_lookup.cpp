// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/message_lookup.h"

#include <ros/package.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> types_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder, ignored)) {
    if (file.path().extension() == ".msg") names.push_back(file.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The text of one type's file.
std::string text_of(const std::string& type) {
  const std::size_t slash = type.find('/');
  const std::string package = type.substr(0, slash), name = type.substr(slash + 1);
  const std::string path = ros::package::getPath(package);
  if (path.empty()) throw Error("unknown message type '" + type + "': no package " + package);
  const fs::path folder = fs::path(path) / "msg";
  std::ifstream file(folder / (name + ".msg"));
  if (!file) {
    throw Error("unknown message type of package " + package + ": " +
                unknown_name_text(name, types_in(folder)));
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

const MessageDefinition& MessageLookup::get(const std::string& type) {
  if (const auto found = known_.find(type); found != known_.end()) return found->second;
  std::string all = text_of(type);
  std::vector<std::string> done{type}, waiting = used_types(type, all);
  while (!waiting.empty()) {
    const std::string next = waiting.back();
    waiting.pop_back();
    if (std::find(done.begin(), done.end(), next) != done.end()) continue;
    done.push_back(next);
    const std::string text = text_of(next);
    all += "\n" + std::string(80, '=') + "\nMSG: " + next + "\n" + text;
    for (const std::string& used : used_types(next, text)) waiting.push_back(used);
  }
  return known_.emplace(type, MessageDefinition(type, all)).first->second;
}

}  // namespace trident::bridges::modbus
