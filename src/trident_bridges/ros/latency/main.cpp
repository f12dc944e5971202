// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// latency_probe PART --name value ...: the ends of a measurement of latency and throughput, and the
// two plainest things to measure between them, a relay and a bridge.
#include <ros/ros.h>

#include <cstdio>
#include <functional>
#include <map>

#include "parts.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace {

using trident::Error;
using trident::bridges::ProbeOptions;

int run(int argc, char** argv) {
  using namespace trident::bridges;
  // Other arguments are roscpp's: remappings, the node's name.
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  std::vector<char*> own;
  for (std::string& word : words) own.push_back(word.data());
  const ProbeOptions options = parse_probe_options(static_cast<int>(own.size()), own.data());
  const std::map<std::string, std::function<int(const ProbeOptions&)>> parts{
      {"source", run_source},
      {"sink", run_sink},
      {"listener", run_listener},
      {"relay", run_relay},
      {"bridge", run_bridge}};
  const auto part = parts.find(options.part);
  if (part == parts.end()) {
    throw Error("part " + trident::unknown_name_text(
                              options.part, {"source", "sink", "listener", "relay", "bridge"}));
  }
  const std::string name = "latency_" + options.part;
  if (options.part == "bridge") {
    init_node(argc, argv, name);
  } else {
    ros::init(argc, argv, name, ros::init_options::AnonymousName);
  }
  return part->second(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "latency_probe: %s\n", error.what());
    return 2;
  }
}
