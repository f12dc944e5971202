// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "server_options.h"

#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/option_number.h"

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

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.10g", value);
  return text;
}

/// A value as its user has written it; lists and structs as XML-RPC has them.
std::string plain_text(XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpc::XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return short_text(static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      return "'" + static_cast<std::string>(value) + "'";
    default:
      return value.toXml();
  }
}

/// The private parameters, fetched in one call.
class Parameters {
 public:
  Parameters(std::string root, const XmlRpc::XmlRpcValue& tree)
      : root_(std::move(root)), tree_(tree) {
    if (tree_.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
      tree_ = XmlRpc::XmlRpcValue();
      tree_[kNothing] = 0;
    }
  }
  void number(const char* name, double& value, double lo, double hi) {
    if (!has(name)) return;
    XmlRpc::XmlRpcValue& entry = tree_[name];
    if (entry.getType() == XmlRpc::XmlRpcValue::TypeDouble) {
      value = static_cast<double>(entry);
    } else if (entry.getType() == XmlRpc::XmlRpcValue::TypeInt) {
      value = static_cast<int>(entry);
    } else {
      refuse(name, entry, "a number");
    }
    if (!(value >= lo && value <= hi)) {
      refuse(name, entry, "in [" + short_text(lo) + ", " + short_text(hi) + "]");
    }
  }
  template <class Integer>
  void integer(const char* name, Integer& value, double hi) {
    double number_value = static_cast<double>(value);
    number(name, number_value, 0, hi);
    value = static_cast<Integer>(number_value);
  }
  void flag(const char* name, bool& value) {
    if (!has(name)) return;
    XmlRpc::XmlRpcValue& entry = tree_[name];
    if (entry.getType() == XmlRpc::XmlRpcValue::TypeBoolean) {
      value = static_cast<bool>(entry);
    } else if (entry.getType() == XmlRpc::XmlRpcValue::TypeInt) {
      value = static_cast<int>(entry) != 0;
    } else {
      refuse(name, entry, "true or false");
    }
  }
  /// A switch that the launch file has read already: a value that is none counts as true there.
  void tell_odd_flag(const char* name, std::vector<std::string>& warnings) {
    if (!has(name)) return;
    XmlRpc::XmlRpcValue& entry = tree_[name];
    if (entry.getType() == XmlRpc::XmlRpcValue::TypeBoolean) return;
    if (entry.getType() == XmlRpc::XmlRpcValue::TypeInt) return;
    warnings.push_back("argument " + std::string(name) + " of the launch file is " + plain(entry) +
                       ", legal: true or false; taken as true");
  }
  void text(const char* name, std::string& value) {
    if (!has(name)) return;
    if (tree_[name].getType() != XmlRpc::XmlRpcValue::TypeString) refuse(name, tree_[name], "text");
    value = static_cast<std::string>(tree_[name]);
  }
  void names(const char* name, std::vector<std::string>& values) {
    if (!has(name)) return;
    XmlRpc::XmlRpcValue& entry = tree_[name];
    if (entry.getType() != XmlRpc::XmlRpcValue::TypeArray) refuse(name, entry, "a list of names");
    for (int i = 0; i < entry.size(); ++i) values.push_back(static_cast<std::string>(entry[i]));
  }
  /// /gazebo/answers: by name, what a node reads and what it answers with.
  void answers(const char* name, std::map<std::string, AnswerOptions>& values) {
    if (!has(name)) return;
    XmlRpc::XmlRpcValue& entry = tree_[name];
    if (entry.getType() != XmlRpc::XmlRpcValue::TypeStruct) refuse(name, entry, "names of nodes");
    for (auto& [node, fields] : entry)
      values[node] = answer(std::string(name) + "/" + node, fields);
  }
  bool is_list(const char* name) {
    return has(name) && tree_[name].getType() == XmlRpc::XmlRpcValue::TypeArray;
  }
  [[noreturn]] void refuse(const std::string& name, XmlRpc::XmlRpcValue& value,
                           const std::string& legal) const {
    throw Error("parameter " + root_ + "/" + name + " is " + plain_text(value) + ", must be " +
                legal);
  }

  /// One sentence per parameter that nothing has asked for.
  std::vector<std::string> unknown() {
    std::string known;
    for (const std::string& name : asked_for_) known += (known.empty() ? "" : ", ") + name;
    std::vector<std::string> result;
    for (const auto& entry : tree_) {
      const std::string& name = entry.first;
      const bool is_foreign = name == kNothing || name == "enable_ros_network";
      if (is_foreign || asked_for_.count(name) > 0) continue;
      std::string& sentence = result.emplace_back("parameter ");
      sentence.append(root_).append("/").append(name);
      sentence.append(" is unknown and has no effect; known: ").append(known);
    }
    return result;
  }

 private:
  /// A value without XML around it.
  static std::string plain(XmlRpc::XmlRpcValue& value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }
  AnswerOptions answer(const std::string& name, XmlRpc::XmlRpcValue& fields) {
    const std::string legal =
        "{state: TOPIC, commands: [TOPIC, ...], delay: seconds in [0, 10]}, delay may be left out, "
        "reader: NODE be added";
    using Value = XmlRpc::XmlRpcValue;
    if (fields.getType() != Value::TypeStruct) refuse(name, fields, legal);
    AnswerOptions result;
    bool is_legal = fields.hasMember("state") && fields.hasMember("commands");
    for (auto& [key, value] : fields) {
      if (key == "state") {
        result.state = port_name(value);
      } else if (key == "commands" && value.getType() == Value::TypeArray && value.size() > 0) {
        for (int i = 0; i < value.size(); ++i) result.commands.push_back(port_name(value[i]));
      } else if (key == "reader" && value.getType() == Value::TypeString) {
        result.reader = "/" + port_name(value);
      } else if (key == "delay" && value.getType() == Value::TypeDouble) {
        result.delay_s = static_cast<double>(value);
      } else if (key == "delay" && value.getType() == Value::TypeInt) {
        result.delay_s = static_cast<int>(value);
      } else {
        is_legal = false;
      }
    }
    const bool has_names =
        !result.state.empty() &&
        std::find(result.commands.begin(), result.commands.end(), "") == result.commands.end();
    is_legal = is_legal && has_names && result.delay_s >= 0.0 && result.delay_s <= 10.0;
    if (!is_legal) refuse(name, fields, legal);
    return result;
  }
  static std::string port_name(XmlRpc::XmlRpcValue& topic) {
    const std::string name = topic.getType() == XmlRpc::XmlRpcValue::TypeString
                                 ? static_cast<std::string>(topic)
                                 : std::string();
    return name.substr(std::min(name.find_first_not_of('/'), name.size()));
  }
  static constexpr const char* kNothing = "_";  ///< keeps an empty tree a struct
  bool has(const std::string& name) {
    asked_for_.insert(name);
    return tree_.hasMember(name);
  }

  std::string root_;
  XmlRpc::XmlRpcValue tree_;
  std::set<std::string> asked_for_;
};

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

void read_policy(Parameters& parameters, ServerOptions& options) {
  std::string name = "TRIDENT_LOCKSTEP_POLICY", policy = environment("TRIDENT_LOCKSTEP_POLICY");
  std::string given;
  parameters.text("lockstep_policy", given);
  if (!given.empty()) name = "parameter /gazebo/lockstep_policy", policy = given;
  options.has_default_policy = policy.empty();
  if (policy == "wait" || policy.empty()) {
    options.loss.policy = LossPolicy::kWait;
  } else if (policy == "pause") {
    options.loss.policy = LossPolicy::kPause;
  } else if (policy == "free_run") {
    options.loss.policy = LossPolicy::kFreeRun;
  } else {
    throw Error(name + " is '" + policy + "', must be free_run, wait or pause");
  }
}

void read_timing(Parameters& parameters, ServerOptions& options) {
  std::string timing = "rotors";
  parameters.text("timing", timing);
  if (timing != "rotors" && timing != "direct") {
    throw Error("parameter /gazebo/timing is '" + timing + "', must be rotors or direct");
  }
  options.timing = timing == "rotors" ? LoopTiming::kRotors : LoopTiming::kDirect;
  read_policy(parameters, options);
}

/// As many as there are cores, up to what a camera's picture is worth; they sleep when not needed.
std::size_t default_sensor_threads() {
  constexpr unsigned kMost = 8;
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMost);
}

void read_parameters(Parameters parameters, ServerOptions& options) {
  parameters.number("real_time_factor", options.real_time_factor, 0.0, 1e6);
  parameters.number("end_time", options.end_time_s, 0.0, 1e9);
  parameters.flag("end_on_finish", options.end_on_finish);
  parameters.flag("strict", options.strict);
  if (parameters.is_list("wait_for")) {
    parameters.names("wait_for", options.wait_for_models);
    options.wait_for = static_cast<int>(options.wait_for_models.size());
  } else {
    parameters.integer("wait_for", options.wait_for, 10000);
  }
  parameters.integer("wait_for_sources", options.wait_for_sources, 10000);
  parameters.integer("seed", options.seed, 9e15);
  parameters.number("lockstep_timeout", options.loss.timeout_s, 0.01, 1e6);
  parameters.number("restart_patience", options.loss.restart_patience_s, 0.0, 1e6);
  parameters.flag("pin_controllers", options.pin_controllers);
  parameters.answers("answers", options.answers);
  parameters.number("max_clock_rate", options.max_clock_rate_hz, 1.0, 1e5);
  parameters.number("pub_clock_frequency", options.pub_clock_frequency_hz, 0.0, 1e5);
  parameters.text("out_dir", options.out_dir);
  parameters.names("plugin_libraries", options.plugin_libraries);
  options.sensor_threads = default_sensor_threads();
  parameters.integer("sensor_threads", options.sensor_threads, 256);
  if (options.sensor_threads < 1) {
    throw Error("parameter /gazebo/sensor_threads is 0, must be in [1, 256]");
  }
  read_timing(parameters, options);
  parameters.tell_odd_flag("use_sim_time", options.warnings);
  for (std::string& text : parameters.unknown()) options.warnings.push_back(std::move(text));
}

/// gzserver's command line, as far as it has a meaning here.
void read_arguments(const std::vector<std::string>& arguments, ServerOptions& options) {
  const auto value_of = [&](std::size_t& i) -> const std::string& {
    if (i + 1 >= arguments.size()) throw Error("option " + arguments[i] + " needs a value");
    return arguments[++i];
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "-u" || argument == "--pause") {
      options.paused = true;
    } else if (argument == "--verbose") {
      options.verbose = true;
    } else if (argument == "-e" || argument == "--physics") {
      if (const auto& engine = value_of(i); engine != "ode") {
        throw Error("option -e is '" + engine + "', must be ode");
      }
    } else if (argument == "-s" || argument == "--server-plugin" || argument == "-g" ||
               argument == "--gui-plugin" || argument == "--record_path") {
      value_of(i);  // gazebo_ros' own system plugins are built in
    } else if (argument == "--seed") {
      options.seed = static_cast<std::uint64_t>(option_count(argument, value_of(i), 0, kMaxCount));
    } else if (argument == "--iters") {
      options.iterations =
          static_cast<std::uint64_t>(option_count(argument, value_of(i), 1, kMaxCount));
    } else if (argument == "-r" || argument == "--record" || argument == "--lockstep" ||
               argument.empty()) {
      continue;
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

ServerOptions server_options_of(const std::string& root, const XmlRpc::XmlRpcValue& parameters,
                                const std::vector<std::string>& arguments) {
  ServerOptions options;
  read_environment(options);
  read_parameters(Parameters(root, parameters), options);
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
