// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"
#include "trident_sim/comms/radio.h"

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

/// What crosses from robots to robots: topic T of A is heard by B as B/from/A/T, or service S of A
/// is called by B as B/to/A/S.
struct RelayRule {
  std::string topic;                     ///< below a robot's namespace; "": it is of a service
  std::string service;                   ///< the same; "": it is of a topic
  std::vector<std::string> from{"all"};  ///< names of radios, or "all" alone; of a service: callers
  std::vector<std::string> to{"all"};    ///< the same; of a service: those that are called
  Reliability reliability = Reliability::kBestEffort;  ///< of a topic
  /// Messages that wait at most, the oldest is dropped; of a service: calls in progress, the next
  /// one is refused.
  int depth = 10;
  /// Of a topic: after its stamp a message is not worth delivering, 0: never. Of a service: after
  /// it began a call ends with an error.
  double deadline_s = 0.0;
  double max_rate_hz = 0.0;  ///< of a topic: what is faster is left out; 0: nothing is
  double delay_s = 0.0;      ///< of a service: from a request's arrival to its answer's departure
  int priority = 1;          ///< 0 (first) to 3

  /// Lists the fields for the reader and the reference. Those of topics and of services differ.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("service", service, "below a robot's namespace, in place of a topic");
    if (is_service()) {
      visit_service(ar);
    } else {
      visit_topic(ar);
    }
    ar.field("from", from, "names of robots, or all");
    ar.field("to", to, "names of robots, or all");
    ar.field("priority", priority, Range{0, 3}, "0 goes first");
  }
  /// Throws Error for a topic or names that cannot be.
  void validate() const;

  bool is_from(const std::string& robot) const { return includes(from, robot); }
  bool is_to(const std::string& robot) const { return includes(to, robot); }
  bool is_service() const { return !service.empty(); }
  const std::string& name() const { return is_service() ? service : topic; }  ///< of either
  bool is_reliable() const { return is_service() || reliability == Reliability::kReliable; }
  /// One transmission for everybody in reach, which nobody acknowledges.
  bool is_broadcast() const { return !is_reliable() && to.front() == Radio::kAll; }
  /// As it is called in reports: "rule 2 (detections)".
  std::string text(std::size_t index) const;

 private:
  static bool includes(const std::vector<std::string>& names, const std::string& robot);
  template <class Archive>
  void visit_topic(Archive& ar) {
    ar.required("topic", topic, "below a robot's namespace, without a leading slash");
    ar.field("reliability", reliability, "best_effort is sent once, reliable until it is there");
    ar.field("depth", depth, kDepths, "messages that wait; the oldest is dropped");
    ar.field("deadline", deadline_s, Range{0.0, 1e6}, "age at which one is dropped; 0: none [s]");
    ar.field("max_rate", max_rate_hz, Range{0.0, 1e6}, "what is faster is left out; 0: none [Hz]");
  }
  template <class Archive>
  void visit_service(Archive& ar) {
    ar.field("depth", depth, kDepths, "calls in progress; the next one is refused");
    ar.required("deadline", deadline_s, Range{0.001, 1e6}, "after which a call is an error [s]");
    ar.field("delay", delay_s, Range{0.0, 1e6}, "simulated time that a server takes [s]");
  }
  static constexpr Range kDepths{1, 100000};
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
