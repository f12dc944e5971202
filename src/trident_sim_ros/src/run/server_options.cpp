// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "server_options.h"

#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "server_params.h"
#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_ros/node_params.h"

namespace trident::sim {
namespace {

constexpr std::int64_t kMaxCount = 9'000'000'000'000'000;  // below 2^53

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool to_flag(const std::string& text) { return text == "1" || text == "true" || text == "yes"; }

/// The parts of a text between commas.
std::vector<std::string> names_of(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

void read_environment(ServerOptions& options) {
  if (const auto text = environment("TRIDENT_REAL_TIME_FACTOR"); !text.empty()) {
    options.real_time_factor = option_number("TRIDENT_REAL_TIME_FACTOR", text, 0.0, 1e6);
  }
  if (const auto text = environment("TRIDENT_END_TIME"); !text.empty()) {
    options.end_time_s = option_number("TRIDENT_END_TIME", text, 0.0, 1e9);
  }
  if (const auto text = environment("TRIDENT_WAIT_FOR"); !text.empty()) {
    options.wait_for = static_cast<int>(option_count("TRIDENT_WAIT_FOR", text, 0, 10000));
  }
  options.wait_for_spawned = names_of(environment("TRIDENT_WAIT_FOR_MODELS"));
  options.wait_for_controllers = names_of(environment("TRIDENT_WAIT_FOR_CONTROLLERS"));
  if (const auto text = environment("TRIDENT_SEED"); !text.empty()) {
    options.seed = static_cast<std::uint64_t>(option_count("TRIDENT_SEED", text, 0, kMaxCount));
  }
  options.end_on_finish = to_flag(environment("TRIDENT_END"));
  options.strict = to_flag(environment("TRIDENT_STRICT"));
  options.out_dir = environment("TRIDENT_OUT");
}

/// The policy of that name. Throws Error naming where it comes from.
LossPolicy policy_of(const char* variable, const std::string& text) {
  for (const auto& [policy, name] : enum_names(LossPolicy{})) {
    if (text == name) return policy;
  }
  throw Error(std::string(variable) + " is '" + text + "', must be free_run, wait or pause");
}

void set_policy(std::optional<LossPolicy> asked, ServerOptions& options) {
  constexpr const char* kVariable = "TRIDENT_LOCKSTEP_POLICY";
  const std::string text = environment(kVariable);
  if (!asked && !text.empty()) asked = policy_of(kVariable, text);
  options.has_default_policy = !asked;
  options.loss.policy = asked.value_or(LossPolicy::kWait);
}

/// Returns one thread per core, limited by what rendering an image is worth; they sleep when idle.
std::size_t default_sensor_threads() {
  constexpr unsigned kMaxThreads = 8;
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads);
}

/// wait_for may be a list of names, and lockstep_policy an empty text that asks for nothing.
void normalize(ros_utils::NodeParams& params) {
  const ConfigNode* wait_for = params.find("wait_for");
  if (wait_for != nullptr && wait_for->kind == ConfigNode::Kind::kSequence) {
    params.set("wait_for_models", *params.take("wait_for"));
  }
  const ConfigNode* policy = params.find("lockstep_policy");
  if (policy != nullptr && policy->quoted && policy->scalar.empty()) {
    params.take("lockstep_policy");
  }
}

/// The launch file has read this switch already, and takes a value that is no truth value as true.
void warn_of_odd_sim_time(ros_utils::NodeParams& params) {
  params.accept({"use_sim_time", "enable_ros_network"});
  const ConfigNode* value = params.find("use_sim_time");
  if (value == nullptr || (value->kind == ConfigNode::Kind::kScalar && !value->quoted)) return;
  params.add_warning("argument use_sim_time of the launch file is " + value->describe() +
                     ", legal: true or false; taken as true");
}

template <class Value, class Target>
void set_if(const std::optional<Value>& value, Target& target) {
  if (value) target = static_cast<Target>(*value);
}

void read_parameters(ros_utils::NodeParams params, ServerOptions& options) {
  normalize(params);
  const auto own = params.read<ServerParams>();
  set_if(own.real_time_factor, options.real_time_factor);
  set_if(own.end_time_s, options.end_time_s);
  set_if(own.end_on_finish, options.end_on_finish);
  set_if(own.strict, options.strict);
  set_if(own.seed, options.seed);
  set_if(own.out_dir, options.out_dir);
  options.wait_for_models = own.wait_for_models;
  // Names say how many vehicles there are.
  if (params.find("wait_for_models") != nullptr) {
    options.wait_for = static_cast<int>(own.wait_for_models.size());
  } else if (params.find("wait_for") != nullptr) {
    options.wait_for = own.wait_for;
  }
  options.wait_for_sources = own.wait_for_sources;
  options.timing = own.timing;
  options.loss = own.loss;
  set_policy(own.lockstep_policy, options);
  options.pin_controllers = own.pin_controllers;
  for (const auto& [node, answer] : own.answers) options.answers[node] = answer.options();
  options.max_clock_rate_hz = own.max_clock_rate_hz;
  options.pub_clock_frequency_hz = own.pub_clock_frequency_hz;
  options.radio_rules = own.radio_rules;
  options.plugin_libraries = own.plugin_libraries;
  options.sensor_threads = default_sensor_threads();
  set_if(own.sensor_threads, options.sensor_threads);
  warn_of_odd_sim_time(params);
  for (std::string& text : params.warnings()) options.warnings.push_back(std::move(text));
}

/// The name of a topic's port: without leading slashes.
std::string port_name(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

using Flags = std::map<std::string, void (*)(ServerOptions&)>;
using Values = std::map<std::string, void (*)(const std::string& option, const std::string& value,
                                              ServerOptions&)>;

void pause(ServerOptions& options) { options.paused = true; }
void ignore_flag(ServerOptions& /*options*/) {}

const Flags& known_flags() {
  static const Flags kFlags = {
      {"-u", pause},
      {"--pause", pause},
      {"--verbose", [](ServerOptions& options) { options.verbose = true; }},
      // Runs are recorded by other means; launch files for Gazebo shall start all the same.
      {"-r", ignore_flag},
      {"--record", ignore_flag},
      {"--lockstep", ignore_flag},
      {"", ignore_flag},
  };
  return kFlags;
}

void require_ode(const std::string& /*option*/, const std::string& engine,
                 ServerOptions& /*options*/) {
  if (engine != "ode") throw Error("option -e is '" + engine + "', must be ode");
}
void ignore_value(const std::string& /*option*/, const std::string& /*value*/,
                  ServerOptions& /*options*/) {}
void set_seed(const std::string& option, const std::string& value, ServerOptions& options) {
  options.seed = static_cast<std::uint64_t>(option_count(option, value, 0, kMaxCount));
}
void set_iterations(const std::string& option, const std::string& value, ServerOptions& options) {
  options.iterations = static_cast<std::uint64_t>(option_count(option, value, 1, kMaxCount));
}

const Values& known_values() {
  // gazebo_ros' own system plugins are built in.
  static const Values kValues = {
      {"-e", require_ode},
      {"--physics", require_ode},
      {"-s", ignore_value},
      {"--server-plugin", ignore_value},
      {"-g", ignore_value},
      {"--gui-plugin", ignore_value},
      {"--record_path", ignore_value},
      {"--seed", set_seed},
      {"--iters", set_iterations},
  };
  return kValues;
}

/// gzserver's command line, as far as it has a meaning here.
void read_arguments(const std::vector<std::string>& arguments, ServerOptions& options) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (const auto flag = known_flags().find(argument); flag != known_flags().end()) {
      flag->second(options);
    } else if (const auto taker = known_values().find(argument); taker != known_values().end()) {
      if (++i == arguments.size()) throw Error("option " + argument + " needs a value");
      taker->second(argument, arguments[i], options);
    } else if (argument[0] == '-') {
      throw Error(
          "option " + argument +
          " is unknown; known: -u, --verbose, -e ode, -s, -r, --seed N, --iters N, --lockstep");
    } else {
      options.world_file = argument;
    }
  }
}

}  // namespace

void AnswerParams::validate() const {
  std::vector<std::string> topics = commands;
  topics.push_back(state);
  bool is_named = !commands.empty();
  for (const std::string& topic : topics) {
    is_named = is_named && !port_name(topic).empty();
    std::string why;
    if (!ros::names::validate(topic, why)) throw Error("topic '" + topic + "': " + why);
  }
  if (!is_named) throw Error("state and commands must name topics, at least one each");
}

AnswerOptions AnswerParams::options() const {
  AnswerOptions result;
  result.state = port_name(state);
  for (const std::string& command : commands) result.commands.push_back(port_name(command));
  if (!reader.empty()) result.reader = "/" + port_name(reader);
  result.delay_s = delay_s;
  return result;
}

ServerOptions server_options_of(const std::string& root, const XmlRpc::XmlRpcValue& parameters,
                                const std::vector<std::string>& arguments) {
  ServerOptions options;
  // A later source overrides an earlier one: environment, parameters, command line.
  read_environment(options);
  read_parameters(ros_utils::NodeParams(parameters, root), options);
  read_arguments(arguments, options);
  return options;
}

ServerOptions read_server_options(const ros::NodeHandle& private_node,
                                  const std::vector<std::string>& arguments) {
  XmlRpc::XmlRpcValue parameters;
  if (!private_node.getParam("", parameters)) parameters = XmlRpc::XmlRpcValue();
  return server_options_of(private_node.getNamespace(), parameters, arguments);
}

}  // namespace trident::sim
