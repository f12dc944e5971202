// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "answered_inputs.h"

#include <algorithm>

#include "trident_ros/topic_peers.h"

namespace trident::sim {
AnsweredInputs::AnsweredInputs(const ServerOptions& options, PortBoard& board, PortBinder& outputs,
                               InputBinder& inputs, LossWatch& losses, NodeProbe& probe,
                               ReportSink report)
    : options_(options),
      board_(board),
      outputs_(outputs),
      inputs_(inputs),
      losses_(losses),
      probe_(probe),
      report_(std::move(report)) {
  for (const auto& [name, answers] : options.answers) {
    Driver driver;
    driver.name = name;
    driver.options = answers;
    drivers_.push_back(std::move(driver));
  }
}

void AnsweredInputs::sync() {
  for (Driver& driver : drivers_) {
    const PortBase* const state = board_.find(driver.options.state, PortDirection::kOut);
    driver.seen = state == nullptr ? 0 : state->count();
    // Its model has gone, and with it the question.
    if (state == nullptr) driver.is_open = false;
    for (const std::string& command : driver.options.commands) inputs_.hold(command);
  }
}

/// Who answers has to hear the first sample: that somebody reads it is not enough, for a display
/// may. "" when nobody is missing.
std::string AnsweredInputs::missing_node(Driver& driver) {
  const std::string state = "/" + driver.options.state;
  std::set<std::string> readers;
  for (const ros_utils::TopicPeer& reader : ros_utils::topic_readers(state))
    readers.insert(reader.node);
  driver.nodes.clear();
  for (const std::string& command : driver.options.commands) {
    const std::vector<std::string> writers = ros_utils::topic_writers("/" + command);
    for (const std::string& writer : writers) {
      // A connection counts when the node at its other end
      // confirms it: this process knows only its own end.
      if (!probe_.sends(writer, "/" + command)) return "a publisher of /" + command;
      if (readers.count(writer) > 0) driver.nodes.insert(writer);
    }
    if (!driver.nodes.empty() || !driver.options.reader.empty()) continue;
    return "a reader of " + state + " for " + driver.name + " (" + join(writers) +
           " gives the commands and does not read it; if another node does, name it: reader)";
  }
  if (const std::string& named = driver.options.reader; !named.empty()) {
    if (readers.count(named) == 0) return named + " to read " + state;
    driver.nodes.insert(named);
  }
  return {};
}

bool AnsweredInputs::has_lost_node(const Driver& driver) const {
  if (driver.nodes.empty()) return false;
  for (const ros_utils::TopicPeer& reader : ros_utils::topic_readers("/" + driver.options.state)) {
    if (driver.nodes.count(reader.node) > 0) return false;
  }
  return true;
}

std::vector<std::string> AnsweredInputs::missing_connections(const Driver& driver) const {
  std::vector<std::string> missing;
  const std::string& state = driver.options.state;
  if (board_.find(state, PortDirection::kOut) == nullptr) {
    missing.push_back("a model that publishes /" + state + " for " + driver.name);
  } else if (outputs_.subscribers(state) == 0) {
    missing.push_back("a reader of /" + state + " for " + driver.name);
  }
  for (const std::string& command : driver.options.commands) {
    if (board_.find(command, PortDirection::kIn) == nullptr) {
      missing.push_back("a model that reads /" + command + " for " + driver.name);
    } else if (inputs_.publishers(command) == 0) {
      missing.push_back("a publisher of /" + command);
    }
  }
  return missing;
}

std::string AnsweredInputs::missing_for_start() {
  std::vector<std::string> missing;
  for (Driver& driver : drivers_) {
    const std::vector<std::string> connections = missing_connections(driver);
    missing.insert(missing.end(), connections.begin(), connections.end());
    if (!connections.empty()) continue;
    if (std::string node = missing_node(driver); !node.empty()) missing.push_back(std::move(node));
  }
  return join(missing);
}

bool AnsweredInputs::is_due(const Driver& driver, SimTime begin) const {
  return driver.is_open && begin >= driver.sample + SimTime::from_seconds(driver.options.delay_s);
}

bool AnsweredInputs::is_answered(const Driver& driver) const {
  return std::all_of(driver.wanted.begin(), driver.wanted.end(), [&](const auto& entry) {
    return inputs_.received(entry.first) >= entry.second;
  });
}

bool AnsweredInputs::allows_step(SimTime begin) {
  bool allowed = true;
  for (Driver& driver : drivers_) {
    const bool waits = is_due(driver, begin) && !driver.is_lost && !is_answered(driver);
    if (!waits) {
      driver.waiting.end();
    } else if (driver.waiting.since == 0) {
      driver.waiting.since = wall_now();
    }
    allowed = allowed && !waits;
  }
  return allowed;
}

void AnsweredInputs::check_timeouts(SimTime time) {
  const WallTime now = wall_now();
  losses_.clear();
  for (Driver& driver : drivers_) {
    if (driver.waiting.since == 0) continue;
    const auto nodes = [&driver] {
      return std::vector<std::string>(driver.nodes.begin(), driver.nodes.end());
    };
    driver.is_lost = losses_.gives_up(
        {"the driver of " + driver.name, "has not answered /" + driver.options.state,
         has_lost_node(driver), 1.0, time, nodes},
        driver.waiting, now);
  }
}

void AnsweredInputs::deliver(SimTime begin) {
  for (Driver& driver : drivers_) {
    if (!is_due(driver, begin)) continue;
    // One that was lost is back with its first answer in time.
    if (is_answered(driver)) driver.is_lost = false;
    driver.is_open = false;
    for (const std::string& command : driver.options.commands) {
      // Held until the step in which the answer is due, whenever it came.
      inputs_.deliver_held(command, begin);
      note_surplus(command, driver.wanted[command], begin);
      driver.handed_over[command] = inputs_.received(command);
    }
  }
}

/// One message a sample is an answer; more come from a node that the world does not wait for.
void AnsweredInputs::note_surplus(const std::string& command, std::uint64_t expected,
                                  SimTime time) {
  if (inputs_.received(command) <= expected || !losses_.repeatability().running()) return;
  losses_.repeatability().spoil(join(ros_utils::topic_writers("/" + command)), time,
                                "more than one message on /" + command + " a sample");
}

void AnsweredInputs::look_for_samples(SimTime now) {
  for (Driver& driver : drivers_) {
    const PortBase* const state = board_.find(driver.options.state, PortDirection::kOut);
    if (state == nullptr || state->count() == driver.seen) continue;
    driver.seen = state->count();
    open(driver, now);
  }
}

void AnsweredInputs::open(Driver& driver, SimTime now) {
  if (driver.is_open) {
    report_(Severity::kWarning, "/" + driver.options.state +
                                    " has a sample before the last one had to be answered: "
                                    "/gazebo/answers/" +
                                    driver.name + "/delay is " +
                                    seconds_text(driver.options.delay_s) +
                                    ", must be less than the time between two samples");
  }
  driver.is_open = true;
  driver.sample = now;
  for (const std::string& command : driver.options.commands) {
    const auto last = driver.handed_over.find(command);
    if (last != driver.handed_over.end()) note_surplus(command, last->second, now);
    // The next message on each of its commands is the answer.
    driver.wanted[command] = inputs_.received(command) + 1;
  }
}

void AnsweredInputs::clear() {
  for (Driver& driver : drivers_) {
    driver.is_open = driver.is_lost = false;
    driver.handed_over.clear();
    driver.waiting.end();
  }
  sync();
}

}  // namespace trident::sim
