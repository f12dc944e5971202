// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "answered_inputs.h"

#include <algorithm>
#include <cstdio>

namespace trident {
namespace {

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", seconds);
  return text;
}

}  // namespace

AnsweredInputs::AnsweredInputs(const ServerOptions& options, PortBoard& board, PortBinder& outputs,
                               InputBinder& inputs, ReportSink report)
    : options_(options),
      board_(board),
      outputs_(outputs),
      inputs_(inputs),
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

std::string AnsweredInputs::missing_for_start() const {
  std::string missing;
  const auto add = [&](const std::string& what) {
    missing += (missing.empty() ? "" : ", ") + what;
  };
  for (const Driver& driver : drivers_) {
    const std::string& state = driver.options.state;
    if (board_.find(state, PortDirection::kOut) == nullptr) {
      add("a model that publishes /" + state + " for " + driver.name);
    } else if (outputs_.subscribers(state) == 0) {
      add("a reader of /" + state + " for " + driver.name);
    }
    for (const std::string& command : driver.options.commands) {
      if (board_.find(command, PortDirection::kIn) == nullptr) {
        add("a model that reads /" + command + " for " + driver.name);
      } else if (inputs_.publishers(command) == 0) {
        add("a publisher of /" + command);
      }
    }
  }
  return missing;
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
      driver.since = {};
    } else if (driver.since == Clock::time_point{}) {
      driver.since = Clock::now();
    }
    allowed = allowed && !waits;
  }
  return allowed;
}

void AnsweredInputs::check_losses() {
  const auto now = Clock::now();
  for (Driver& driver : drivers_) {
    if (driver.since == Clock::time_point{}) continue;
    const double waited_s = std::chrono::duration<double>(now - driver.since).count();
    if (waited_s >= options_.lockstep_timeout_s) lose(driver, waited_s);
  }
}

void AnsweredInputs::lose(Driver& driver, double waited_s) {
  const bool is_waited_for = options_.loss_policy == LossPolicy::kWait;
  driver.since = Clock::now();
  driver.is_lost = !is_waited_for;
  report_(Severity::kWarning,
          "the driver of " + driver.name + " has not answered /" + driver.options.state + " for " +
              seconds_text(waited_s) +
              (is_waited_for ? "; the world waits" : "; the world goes on without it"));
}

void AnsweredInputs::deliver(SimTime begin) {
  for (Driver& driver : drivers_) {
    if (!is_due(driver, begin)) continue;
    // One that was lost is back with its first answer in time.
    if (is_answered(driver)) driver.is_lost = false;
    driver.is_open = false;
    for (const std::string& command : driver.options.commands) inputs_.deliver_held(command);
  }
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
    driver.wanted[command] = inputs_.received(command) + 1;
  }
}

void AnsweredInputs::clear() {
  for (Driver& driver : drivers_) {
    driver.is_open = driver.is_lost = false;
    driver.since = {};
  }
  sync();
}

}  // namespace trident
