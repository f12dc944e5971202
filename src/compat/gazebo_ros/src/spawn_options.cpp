// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "spawn_options.h"

#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <stdexcept>

namespace trident::sim {

const char* const kSpawnUsage =
    R"(usage: spawn_model (-urdf | -sdf) (-file FILE | -param NAME | -database MODEL | -stdin) -model NAME
                   [-reference_frame FRAME] [-gazebo_namespace NS] [-robot_namespace NS]
                   [-x M] [-y M] [-z M] [-R RAD] [-P RAD] [-Y RAD] [-J JOINT POSITION]...
                   [-wait MODEL] [-unpause] [-package_to_model] [-b]
Puts a model into the running simulation.
  -urdf, -sdf         the form of the model text
  -file, -param, -database, -stdin
                      where the text comes from
  -model              its name in the world
  -reference_frame    model or model::link that the pose refers to (default: the world)
  -gazebo_namespace   namespace of the simulator's services (default: /gazebo)
  -robot_namespace    namespace of the model's plugins (default: that of this node)
  -x -y -z            position [m]
  -R -P -Y            roll, pitch, yaw [rad]
  -J                  initial position of a joint [rad or m], may be repeated
  -wait               wait until this model exists, then spawn
  -unpause            start physics afterwards
  -package_to_model   read package:// of mesh file names as model://
  -b                  stay, and delete the model when this process ends
)";

namespace {

/// The words of the command line with a place in them; flags take their values from it.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) : words_(words) {}

  bool at_end() const { return next_ >= words_.size(); }

  /// The next flag, '-' included; a value glued on with '=' is kept for value().
  std::string flag() {
    const std::string word = words_[next_++];
    const auto equals = word.find('=');
    if (word.empty() || word[0] != '-' || equals == std::string::npos) return word;
    glued_ = word.substr(equals + 1);
    return word.substr(0, equals);
  }

  std::string value(const std::string& flag) {
    if (glued_) return *std::exchange(glued_, std::nullopt);
    if (at_end()) throw std::invalid_argument(flag + " needs a value after it");
    return words_[next_++];
  }

  double number(const std::string& flag) {
    const std::string text = value(flag);
    try {
      std::size_t used = 0;
      const double number = std::stod(text, &used);
      if (used == text.size() && std::isfinite(number)) return number;
    } catch (const std::logic_error&) {  // not a number, or out of range: the error below
    }
    throw std::invalid_argument(flag + " is '" + text + "': it must be a finite number");
  }

  void expect_no_glued_value(const std::string& flag) {
    if (glued_) throw std::invalid_argument(flag + " takes no value, but has '" + *glued_ + "'");
  }

 private:
  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
  std::optional<std::string> glued_;
};

/// Fills the options flag by flag and notes which of the exclusive ones came.
class Parser {
 public:
  explicit Parser(const std::vector<std::string>& arguments) : words_(arguments) {
    add_formats_and_sources();
    add_values();
    add_switches();
  }

  SpawnOptions parse() {
    while (!words_.at_end()) {
      const std::string flag = words_.flag();
      const auto handler = handlers_.find(flag);
      if (handler == handlers_.end()) {
        throw std::invalid_argument("'" + flag +
                                    "' is not an option of spawn_model; -h lists them");
      }
      handler->second(flag);
      words_.expect_no_glued_value(flag);
    }
    if (!options_.help) require_complete();
    return options_;
  }

 private:
  using Handler = std::function<void(const std::string& flag)>;

  void add_formats_and_sources() {
    for (const auto& [flag, format] :
         {std::pair{"-urdf", ModelFormat::urdf}, {"-sdf", ModelFormat::sdf}}) {
      handlers_[flag] = [this, format = format](const std::string& f) {
        choose(format_flag_, f);
        options_.format = format;
      };
    }
    for (const auto& [flag, source] : {std::pair{"-file", ModelSource::file},
                                       {"-param", ModelSource::parameter},
                                       {"-database", ModelSource::database},
                                       {"-stdin", ModelSource::standard_input}}) {
      handlers_[flag] = [this, source = source](const std::string& f) {
        choose(source_flag_, f);
        options_.source = source;
        if (source != ModelSource::standard_input) options_.source_name = words_.value(f);
      };
    }
  }

  void add_values() {
    SpawnOptions& o = options_;
    for (const auto& [flag, target] :
         {std::pair<const char*, std::string*>{"-model", &o.model_name},
          {"-reference_frame", &o.reference_frame},
          {"-gazebo_namespace", &o.gazebo_namespace},
          {"-wait", &o.wait_for_model}}) {
      handlers_[flag] = [this, target = target](const std::string& f) {
        *target = words_.value(f);
      };
    }
    for (const auto& [flag, target] : {std::pair<const char*, double*>{"-x", &o.x},
                                       {"-y", &o.y},
                                       {"-z", &o.z},
                                       {"-R", &o.roll},
                                       {"-P", &o.pitch},
                                       {"-Y", &o.yaw}}) {
      handlers_[flag] = [this, target = target](const std::string& f) {
        *target = words_.number(f);
      };
    }
    handlers_["-robot_namespace"] = [this](const std::string& f) {
      options_.robot_namespace = words_.value(f);
    };
    handlers_["-J"] = [this](const std::string& f) {
      const std::string joint = words_.value(f);
      options_.joint_positions.emplace_back(joint, words_.number(f + " " + joint));
    };
  }

  void add_switches() {
    SpawnOptions& o = options_;
    for (const auto& [flag, target] : {std::pair<const char*, bool*>{"-unpause", &o.unpause},
                                       {"-package_to_model", &o.package_to_model},
                                       {"-b", &o.delete_on_exit},
                                       {"-h", &o.help},
                                       {"--help", &o.help}}) {
      handlers_[flag] = [target = target](const std::string&) { *target = true; };
    }
  }

  static void choose(std::string& chosen, const std::string& flag) {
    if (!chosen.empty()) throw std::invalid_argument(flag + " does not go together with " + chosen);
    chosen = flag;
  }

  void require_complete() const {
    if (format_flag_.empty()) throw std::invalid_argument("one of -urdf, -sdf is needed");
    if (source_flag_.empty()) {
      throw std::invalid_argument("one of -file, -param, -database, -stdin is needed");
    }
    if (options_.model_name.empty()) throw std::invalid_argument("-model NAME is needed");
  }

  Words words_;
  SpawnOptions options_;
  std::string format_flag_;
  std::string source_flag_;
  std::map<std::string, Handler> handlers_;
};

}  // namespace

SpawnOptions parse_spawn_options(const std::vector<std::string>& arguments) {
  return Parser(arguments).parse();
}

std::string meshes_from_package_to_model(const std::string& xml) {
  static const std::regex mesh_of_package(R"((<\s*mesh\s[^>]*filename\s*=\s*["'])package://)");
  return std::regex_replace(xml, mesh_of_package, "$1model://");
}

std::string database_model_sdf(const std::string& model) {
  return "<sdf version=\"1.6\"><world name=\"default\"><include><uri>model://" + model +
         "</uri></include></world></sdf>";
}

}  // namespace trident::sim
