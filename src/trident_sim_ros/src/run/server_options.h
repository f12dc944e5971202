// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// What the world does when an enrolled controller or source does not answer in time.
enum class LossPolicy { kFreeRun, kWait, kPause };

/// The rules of a loss; see LossWatch.
struct LossRules {
  LossPolicy policy = LossPolicy::kWait;
  double timeout_s = 2.0;            ///< wall time without an answer that is reported
  double restart_patience_s = 10.0;  ///< wall time in which one that died may be started again
};

/// A node that answers each sample of one topic with a message on each of some others, which carry
/// no stamp. Names are those of ports: without the leading slash.
struct AnswerOptions {
  std::string state;
  std::vector<std::string> commands;
  std::string reader;     ///< node that reads the state; "": one that gives the commands
  double delay_s = 0.01;  ///< an answer acts so long after its sample
};

/// How the server runs: command line, then private parameters (see ServerParams), then the
/// environment that `./trident run` sets, then these defaults.
struct ServerOptions {
  std::string world_file = "worlds/empty.world";
  bool paused = false;
  bool verbose = false;
  std::uint64_t seed = 0;
  LoopTiming timing = LoopTiming::kRotors;
  double real_time_factor = -1.0;  ///< 0: as fast as possible; < 0: what the world file asks for
  std::uint64_t iterations = 0;    ///< end after so many steps; 0: do not
  double end_time_s = 0.0;         ///< end at this simulated time; 0: do not
  bool end_on_finish = false;      ///< end when the last set-point source has ended
  int wait_for = 0;                ///< vehicles with controllers before time zero is left
  std::vector<std::string> wait_for_models;       ///< the same by name
  int wait_for_sources = 0;                       ///< set-point sources before time zero is left
  std::vector<std::string> wait_for_spawned;      ///< models of any kind before time zero is left
  std::vector<std::string> wait_for_controllers;  ///< of those the topics of their motor speeds
  LossRules loss;
  /// Nobody has asked for a policy: it waits when it is as fast as possible, else it continues.
  bool has_default_policy = true;
  /// As fast as possible: keeps a controller's process on one core.
  bool pin_controllers = true;
  std::map<std::string, AnswerOptions> answers;  ///< nodes that are waited for, by name
  double max_clock_rate_hz = 50.0;               ///< wall rate of /clock and of the state topics
  double pub_clock_frequency_hz = 0.0;           ///< simulated rate of /clock; 0: every step
  std::string out_dir;                           ///< where results go; "": none are written
  std::string radio_rules;                       ///< a file of config/links; "": the world's own
  std::vector<std::string> plugin_libraries;
  std::size_t sensor_threads = 1;     ///< that share the work of lidars and cameras
  bool strict = false;                ///< odd elements of files are refused, not left out
  bool shares_process = false;        ///< it is one of the nodelets of a manager
  std::vector<std::string> warnings;  ///< about the options themselves

  /// Whether anything was declared that time zero is held for, but for `answers`.
  bool holds_time_zero() const {
    return wait_for > 0 || wait_for_sources > 0 || !wait_for_spawned.empty();
  }
};

/// The same from parameters (a struct) that no master has yet; `root` names them in messages.
ServerOptions server_options_of(const std::string& root, const XmlRpc::XmlRpcValue& parameters,
                                const std::vector<std::string>& arguments);

/// Reads all of it; `arguments` without ROS' own. Throws Error naming the option.
ServerOptions read_server_options(const ros::NodeHandle& private_node,
                                  const std::vector<std::string>& arguments);

}  // namespace trident::sim
