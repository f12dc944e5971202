// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/plugins/relay_ports.h"

#include <algorithm>
#include <iterator>

#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

// A rule of which nothing was heard by then is a mistake, most likely.
constexpr SimTime kIdle{5'000'000'000};

}  // namespace

RelayPorts::RelayPorts(World& world, const RelayFile& rules, std::string file)
    : world_(world),
      file_(std::move(file)),
      relay_(
          rules.rules, [this](const std::string& text) { report(text); }, rules.has_routing) {}

void RelayPorts::report(const std::string& text) {
  world_.report(Severity::kWarning, file_ + ": " + text);
}

/// Who reads it takes values of its own type.
bool RelayPorts::is_command(const std::string& input) const {
  const PortBoard& board = world_.ports();
  return board.find(input, PortDirection::kIn) != nullptr &&
         board.find_in<BytesSample>(input) == nullptr;
}

void RelayPorts::add_inputs(const std::vector<std::string>& robots) {
  const std::vector<RelayRule>& rules = relay_.rules();
  for (const std::string& robot : robots) {
    for (std::size_t i = 0; i < rules.size(); ++i) {
      if (rules[i].is_service() || !rules[i].is_from(robot)) continue;
      const std::string name = robot + "/" + rules[i].topic;
      // The simulator's own port has this name already, with another type.
      if (is_command(name)) {
        if (!reported_commands_.insert(name).second) continue;
        report(rules[i].text(i) + ": " + name + " is a command that the simulator reads itself, " +
               "legal: a topic that it does not read");
        continue;
      }
      Input& input = inputs_[name];
      if (!input.port) {
        PortBoard& board = world_.ports();
        input.port = {board, board.subscribe<BytesSample>(name)};
        input.seen = input.port->count();
        input.robot = robot;
      }
      input.rules.push_back(i);
    }
  }
}

void RelayPorts::add_outputs(const std::vector<std::string>& robots) {
  for (const auto& [name, input] : inputs_) {
    for (const std::size_t rule : input.rules) {
      for (const std::string& receiver : robots) {
        if (receiver == input.robot || !relay_.rules()[rule].is_to(receiver)) continue;
        OutHandle<BytesSample>& output = outputs_[{rule, input.robot, receiver}];
        if (output) continue;
        PortBoard& board = world_.ports();
        const std::string topic = join({receiver, "from", name}, "/");
        output = {board, board.advertise<BytesSample>(topic, PortRank::kSensor)};
        output->value.origin = name;
      }
    }
  }
}

void RelayPorts::set_robots(const std::vector<std::string>& robots) {
  if (robots == robots_) return;
  // Newcomers get what is latched; everything of robots that have gone is dropped.
  std::set_difference(robots.begin(), robots.end(), robots_.begin(), robots_.end(),
                      std::back_inserter(newcomers_));
  robots_ = robots;
  relay_.set_robots(robots);
  calls_.set_robots(robots, relay_.rules());
  const auto is_gone = [&robots](const std::string& name) {
    return !std::binary_search(robots.begin(), robots.end(), name);
  };
  later_.erase(std::remove_if(later_.begin(), later_.end(),
                              [&](const Later& later) { return is_gone(later.robot); }),
               later_.end());
  newcomers_.erase(std::remove_if(newcomers_.begin(), newcomers_.end(), is_gone), newcomers_.end());
  for (auto kept = latched_.begin(); kept != latched_.end();) {
    kept = is_gone(kept->first.second) ? latched_.erase(kept) : std::next(kept);
  }
  for (auto output = outputs_.begin(); output != outputs_.end();) {
    const auto& [rule, source, receiver] = output->first;
    output = is_gone(source) || is_gone(receiver) ? outputs_.erase(output) : std::next(output);
  }
  for (auto input = inputs_.begin(); input != inputs_.end();) {
    input->second.rules.clear();
    input = is_gone(input->second.robot) ? inputs_.erase(input) : std::next(input);
  }
  add_inputs(robots);
  add_outputs(robots);
}

void RelayPorts::offer(std::size_t rule, const std::string& robot, const BytesSample& sample,
                       SimTime now, Radio& radio) {
  // The deadline counts from the stamp, never from a time to come.
  const SimTime born = sample.stamp.ns > 0 ? std::min(sample.stamp, now) : now;
  if (sample.is_latched && sample.data != nullptr) latched_[{rule, robot}] = sample;
  relay_.offer(rule, robot, {born, sample.data}, now, radio);
}

/// As a subscriber that comes late has the newest message of a latched topic, so has a robot.
void RelayPorts::offer_latched(SimTime now, Radio& radio) {
  for (const std::string& robot : newcomers_) {
    for (const auto& [key, sample] : latched_) {
      const auto& [rule, source] = key;
      if (source == robot || !relay_.rules()[rule].is_to(robot)) continue;
      relay_.offer_again({rule, source, robot}, {now, sample.data}, now, radio);
    }
  }
  newcomers_.clear();
}

void RelayPorts::read(Input& input, SimTime now, Radio& radio) {
  const std::uint64_t kept = std::max(input.port->oldest(), input.seen);
  if (kept > input.seen && !std::exchange(input.has_reported_loss, true)) {
    report(input.port->name() + ": " + std::to_string(kept - input.seen) +
           " messages came in one step too many, legal: at most " +
           std::to_string(InPort<BytesSample>::kDepth));
  }
  for (input.seen = kept; input.seen < input.port->count(); ++input.seen) {
    const BytesSample& sample = input.port->at(input.seen);
    const StampUse use = stamp_use(sample.stamp, now);
    if (use == StampUse::kOfOtherClock && !std::exchange(input.has_reported_stamp, true)) {
      report(input.port->name() + ": a stamp is " + number_text((sample.stamp - now).seconds()) +
             " s ahead of the simulated time, legal: at most " + number_text(kFarAhead.seconds()) +
             "; its messages count as they come, so that a run with them does not repeat");
    }
    for (const std::size_t rule : input.rules) {
      // A message of the next moments waits for its stamp, so that when it came in does not matter.
      if (use == StampUse::kAtItsStamp) {
        later_.push_back({rule, input.robot, sample});
      } else {
        offer(rule, input.robot, sample, now, radio);
      }
    }
  }
}

void RelayPorts::offer_due(SimTime now, Radio& radio) {
  if (later_.empty()) return;
  const auto rest = std::stable_partition(later_.begin(), later_.end(), [now](const Later& later) {
    return later.sample.stamp <= now;
  });
  std::vector<Later> due(std::make_move_iterator(later_.begin()), std::make_move_iterator(rest));
  later_.erase(later_.begin(), rest);
  // By stamp, and of one stamp by arrival: a repeatable order.
  std::stable_sort(due.begin(), due.end(),
                   [](const Later& a, const Later& b) { return a.sample.stamp < b.sample.stamp; });
  for (const Later& later : due) offer(later.rule, later.robot, later.sample, now, radio);
}

void RelayPorts::send(SimTime begin, Radio& radio) {
  offer_latched(begin, radio);
  offer_due(begin, radio);
  for (auto& [name, input] : inputs_) read(input, begin, radio);
  relay_.send(begin, radio);
}

void RelayPorts::publish(const RelayDelivery& delivery) {
  const auto output = outputs_.find({delivery.rule, delivery.source, delivery.destination});
  if (output == outputs_.end()) return;
  OutPort<BytesSample>* const port = output->second.get();
  if (std::find(fresh_.begin(), fresh_.end(), port) == fresh_.end()) {
    fresh_.push_back(port);
    // Several messages of one flow may arrive in a step: all but the last are buffered.
    port->clear_buffered();
  } else {
    port->buffer_sample();
  }
  port->value.stamp = delivery.message.born;
  port->value.data = delivery.message.data;
}

void RelayPorts::receive(SimTime end, Radio& radio) {
  fresh_.clear();
  for (const RelayDelivery& delivery : relay_.receive(end, radio)) {
    if (relay_.rules()[delivery.rule].is_service()) {
      calls_.take(delivery, end, relay_.rules());
    } else {
      publish(delivery);
    }
  }
  calls_.expire(end, relay_.rules());
  for (OutPort<BytesSample>* port : fresh_) port->publish();
  if (!has_looked_for_idle_ && end >= kIdle) report_idle_rules();
}

std::vector<std::string> RelayPorts::missing_radios(const RelayRule& rule) const {
  std::vector<std::string> names = rule.from, missing;
  names.insert(names.end(), rule.to.begin(), rule.to.end());
  std::copy_if(names.begin(), names.end(), std::back_inserter(missing), [this](const auto& name) {
    return name != Radio::kAll && !std::binary_search(robots_.begin(), robots_.end(), name);
  });
  return missing;
}

bool RelayPorts::has_heard(std::size_t rule) const {
  return std::any_of(inputs_.begin(), inputs_.end(), [rule](const auto& entry) {
    const std::vector<std::size_t>& own = entry.second.rules;
    return entry.second.seen > 0 && std::find(own.begin(), own.end(), rule) != own.end();
  });
}

void RelayPorts::report_idle_rules() {
  has_looked_for_idle_ = true;
  const std::string after = " after " + number_text(kIdle.seconds()) + " s";
  for (std::size_t i = 0; i < relay_.rules().size(); ++i) {
    const RelayRule& rule = relay_.rules()[i];
    const std::vector<std::string> missing = missing_radios(rule);
    if (!missing.empty()) {
      report(rule.text(i) + ": there is no radio '" + join(missing, "', '") + "'" + after +
             ", radios: " + join(robots_));
    } else if (!rule.is_service() && !has_heard(i)) {
      report(rule.text(i) + ": no robot of " + join(rule.from) + " has sent a message on its " +
             rule.topic + after);
    }
  }
}

void RelayPorts::reset() {
  relay_.reset();
  calls_.reset(relay_.rules());
  later_.clear();
  newcomers_ = robots_;  // nobody sends a latched message again, and a run begins with it
  has_looked_for_idle_ = false;
  for (auto& [name, input] : inputs_) {
    input.port->clear();
    input.seen = 0;
  }
}

void RelayPorts::state(StateArchive& archive) {
  archive(relay_, calls_, later_, latched_, newcomers_, has_looked_for_idle_);
  for (auto& [name, input] : inputs_) archive(input.seen);
}

std::vector<RelayFlow> RelayPorts::flows() const {
  std::vector<RelayFlow> result;
  for (const auto& [key, counts] : relay_.counts()) {
    const RelayRule& rule = relay_.rules()[key.rule];
    if (rule.is_service()) continue;
    result.push_back({rule.text(key.rule), rule.is_reliable(), rule.deadline_s, key.source,
                      key.destination, counts});
  }
  return result;
}

bool RelayPorts::is_thinned(const std::string& topic, SimTime at) const {
  const auto input = inputs_.find(topic);
  if (input == inputs_.end()) return false;
  const std::vector<std::size_t>& rules = input->second.rules;
  return std::all_of(rules.begin(), rules.end(), [&](std::size_t rule) {
    return relay_.is_thinned(rule, input->second.robot, at);
  });
}

std::map<std::string, std::uint64_t> RelayPorts::heard(const std::string& robot) const {
  std::map<std::string, std::uint64_t> result;
  for (const auto& [key, counts] : relay_.counts()) {
    if (key.destination != robot || counts.delivered == 0) continue;
    result[join({"from", key.source, relay_.rules()[key.rule].topic}, "/")] += counts.delivered;
  }
  return result;
}

}  // namespace trident::sim
