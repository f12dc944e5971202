// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"
#include "trident_sim/radio.h"

namespace trident::sim {

/// What is done for a message that does not arrive.
enum class Reliability {
  kBestEffort,  ///< nothing: the next one is newer
  kReliable     ///< it is sent again until its deadline, and those after it wait
};

/// Names of the choices in rules.
constexpr auto enum_names(Reliability /*tag*/) {
  return std::array{EnumName<Reliability>{Reliability::kBestEffort, "best_effort"},
                    EnumName<Reliability>{Reliability::kReliable, "reliable"}};
}

/// A topic that crosses from robots to robots: T of A is heard by B as B/from/A/T.
struct RelayRule {
  std::string topic;                     ///< below a robot's namespace
  std::vector<std::string> from{"all"};  ///< names of radios, or "all" alone
  std::vector<std::string> to{"all"};    ///< the same
  Reliability reliability = Reliability::kBestEffort;
  int depth = 10;            ///< messages that wait at most; the oldest goes
  double deadline_s = 0.0;   ///< after its stamp a message is not worth delivering; 0: never
  double max_rate_hz = 0.0;  ///< what is faster is left out; 0: nothing is
  int priority = 1;          ///< 0 (first) to 3

  /// Lists the fields for the reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("topic", topic, "below a robot's namespace, without a leading slash");
    ar.field("from", from, "names of robots, or all");
    ar.field("to", to, "names of robots, or all");
    ar.field("reliability", reliability, "best_effort is sent once, reliable until it is there");
    ar.field("depth", depth, Range{1, 100000}, "messages that wait; the oldest goes");
    ar.field("deadline", deadline_s, Range{0.0, 1e6}, "age at which one is dropped; 0: none [s]");
    ar.field("max_rate", max_rate_hz, Range{0.0, 1e6}, "what is faster is left out; 0: none [Hz]");
    ar.field("priority", priority, Range{0, 3}, "0 goes first");
  }
  /// Throws Error for a topic or names that cannot be.
  void validate() const;

  bool is_from(const std::string& robot) const { return includes(from, robot); }
  bool is_to(const std::string& robot) const { return includes(to, robot); }
  bool is_reliable() const { return reliability == Reliability::kReliable; }
  /// One transmission for everybody in reach, which nobody acknowledges.
  bool is_broadcast() const { return !is_reliable() && to.front() == Radio::kAll; }
  /// As it is called in reports: "rule 2 (detections)".
  std::string text(std::size_t index) const;

 private:
  static bool includes(const std::vector<std::string>& names, const std::string& robot);
};

/// A file of config/links.
struct RelayFile {
  /// Elements of libtrident_radio.so, for all radios of the world in place of their own.
  std::map<std::string, std::string> radio;
  /// Elements of libtrident_radio_medium.so, in place of the world's.
  std::map<std::string, std::string> model;
  bool has_routing = false;  ///< what is for one robot may go over others
  std::vector<RelayRule> rules;

  /// Lists the fields for the reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("routing", has_routing, "whether robots pass on what is for others");
    ar.field("radio", radio, "elements of libtrident_radio.so, for all radios");
    ar.field("model", model, "elements of libtrident_radio_medium.so");
    ar.field("rules", rules, "what crosses");
  }
  /// Throws Error for two rules that relay one topic of a robot to the same one.
  void validate() const;
};

/// Throws ConfigError with file, line, key and what is legal.
RelayFile parse_relay_file(const std::string& text, const std::string& file_label);
/// The same from a file.
RelayFile load_relay_file(const std::string& path);

}  // namespace trident::sim
