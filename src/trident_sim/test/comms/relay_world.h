// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "models.h"
#include "scratch_folder.h"
#include "test_world.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/samples/bytes_sample.h"

namespace trident::sim {

/// A world of robots "a" and "b" with radios, whose topics cross by the rules of a file.
class RelayWorld {
 public:
  explicit RelayWorld(const std::string& rules, double distance_m = 50.0,
                      const ParamList& air = {{"path", "log_distance"}},
                      const WorldOptions& options = {})
      : world(spec(rules, air), options) {
    add("a", 0.0);
    add("b", distance_m);
  }

  void add(const std::string& name, double x) {
    ModelSpec robot =
        make_body(name, BoxShape{{0.2, 0.2, 0.2}}, SE3::from_xyz_rpy({x, 0.0, 1.0}, 0.0, 0.0, 0.0));
    robot.plugins.push_back(make_plugin("radio", "libtrident_radio.so", {{"tx_power", "20"}}));
    world.add(robot);
  }
  /// As a node outside would.
  void write(const std::string& topic, const std::string& data, SimTime stamp = {},
             bool is_latched = false) {
    InPort<BytesSample>* const port = world->ports().find_in<BytesSample>(topic);
    ASSERT_NE(port, nullptr) << topic;
    port->write({stamp, std::make_shared<const std::string>(data), {}, is_latched});
  }
  void latch(const std::string& topic, const std::string& data) { write(topic, data, {}, true); }
  /// Steps and appends what `topic` has.
  void step(int steps, const std::string& topic, std::vector<std::string>* heard) {
    const OutPort<BytesSample>* const port = world->ports().find_out<BytesSample>(topic);
    ASSERT_NE(port, nullptr) << topic;
    for (int i = 0; i < steps; ++i) {
      const std::uint64_t before = port->count();
      world->step();
      if (port->count() == before) continue;
      for (const BytesSample& sample : port->earlier()) heard->push_back(*sample.data);
      heard->push_back(*port->value.data);
    }
  }

 private:
  WorldSpec spec(const std::string& rules, ParamList air) {
    air.emplace_back("rules", folder.write("team.yaml", rules));
    WorldSpec result = weightless(0.01);
    result.plugins.push_back(make_plugin("air", "libtrident_radio_medium.so", air));
    return result;
  }

  ScratchFolder folder;

 public:
  TestWorld world;
};

}  // namespace trident::sim
