// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {

Slam2dSetup::Slam2dSetup(const std::string& config_file) : source(config_file) {
  if (config_file.empty()) {
    config.kind = ConfigNode::Kind::kMap;
  } else {
    config = parse_yaml(read_config_file(config_file), config_file);
  }
}

void Slam2dSetup::set(const std::string& key, const std::string& text) {
  ConfigNode value;
  value.kind = ConfigNode::Kind::kScalar;
  value.scalar = text;
  for (std::size_t i = 0; i < config.keys.size(); ++i) {
    if (config.keys[i] != key) continue;
    config.items[i] = value;
    return;
  }
  config.keys.push_back(key);
  config.key_lines.push_back(0);
  config.items.push_back(value);
}

Registry<Slam2dFactory> builtin_slam_2d() {
  Registry<Slam2dFactory> registry("SLAM method");
  register_builtin_slam_2d(registry);
  return registry;
}

}  // namespace trident::slam
