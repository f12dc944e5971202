// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/relay.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace trident::sim {
namespace {

/// What is left of a message's time [s]; 0: it has no end; negative: it is over.
double time_left_s(const RelayRule& rule, const RelayMessage& message, SimTime now) {
  if (rule.deadline_s <= 0.0) return 0.0;
  const double left_s = rule.deadline_s - (now - message.born).seconds();
  return left_s > 0.0 ? left_s : -1.0;
}

template <class Flows>
void drop_flows_of_others(const std::vector<std::string>& robots, Flows* flows) {
  const auto is_there = [&robots](const std::string& name) {
    return name == Radio::kAll || std::binary_search(robots.begin(), robots.end(), name);
  };
  for (auto flow = flows->begin(); flow != flows->end();) {
    const bool stays = is_there(flow->first.source) && is_there(flow->first.destination);
    flow = stays ? std::next(flow) : flows->erase(flow);
  }
}

}  // namespace

bool Relay::Key::operator<(const Key& other) const {
  return std::tie(rule, source, destination) <
         std::tie(other.rule, other.source, other.destination);
}

bool Relay::Key::operator==(const Key& other) const {
  return std::tie(rule, source, destination) ==
         std::tie(other.rule, other.source, other.destination);
}

Relay::Relay(std::vector<RelayRule> rules, Report report, bool has_routing)
    : rules_(std::move(rules)), report_(std::move(report)), network_(has_routing) {}

void Relay::set_robots(const std::vector<std::string>& robots) {
  robots_ = robots;
  network_.set_robots(robots);
  drop_flows_of_others(robots_, &senders_);
  drop_flows_of_others(robots_, &reliable_);
  drop_flows_of_others(robots_, &best_effort_);
  for (auto topic = topics_.begin(); topic != topics_.end();) {
    const bool stays = std::binary_search(robots_.begin(), robots_.end(), topic->first.second);
    topic = stays ? std::next(topic) : topics_.erase(topic);
  }
}

void Relay::reset() {
  network_.reset();
  topics_.clear();
  senders_.clear();
  reliable_.clear();
  best_effort_.clear();
  counts_.clear();
}

bool Relay::is_thinned(std::size_t rule, const std::string& source, SimTime at) const {
  const auto topic = topics_.find({rule, source});
  return rules_[rule].max_rate_hz > 0.0 && topic != topics_.end() && at < topic->second.due;
}

/// The mean rate is the limit; after a pause there is no burst.
bool Relay::thin(const RelayRule& rule, Topic* topic, SimTime now) {
  if (rule.max_rate_hz <= 0.0) return false;
  if (now < topic->due) return true;
  const SimTime period = SimTime::from_seconds(1.0 / rule.max_rate_hz);
  // The next due time is a period after the last one as long as messages come regularly.
  topic->due = now - topic->due < period ? topic->due + period : now + period;
  return false;
}

std::vector<std::string> Relay::destinations(const RelayRule& rule,
                                             const std::string& source) const {
  if (rule.is_broadcast()) return {Radio::kAll};
  std::vector<std::string> result;
  for (const std::string& robot : robots_) {
    if (robot != source && rule.is_to(robot)) result.push_back(robot);
  }
  return result;
}

void Relay::offer(std::size_t rule_index, const std::string& source, const RelayMessage& message,
                  SimTime now, Radio& radio) {
  const RelayRule& rule = rules_[rule_index];
  const std::pair<std::size_t, std::string> topic_key{rule_index, source};
  Topic& topic = topics_[topic_key];
  const bool thinned = message.data == nullptr || thin(rule, &topic, now);
  const std::size_t bytes = thinned ? 0 : message.data->size();
  if (!thinned) check_rate(topic_key, &topic, bytes, now, radio);
  const bool too_large = !thinned && is_too_large(topic_key, &topic, bytes, radio);
  const std::uint64_t number = topic.next_number++;
  for (const std::string& destination : destinations(rule, source)) {
    const Key key{rule_index, source, destination};
    RelayCounts& counts = counts_[key];
    ++counts.offered;
    counts.thinned += thinned ? 1 : 0;
    counts.refused += too_large ? 1 : 0;
    if (!thinned && !too_large) send_to(key, message, number, now, radio);
  }
}

void Relay::send_to(const Key& key, const RelayMessage& message, std::uint64_t number, SimTime now,
                    Radio& radio) {
  RelayCounts& counts = counts_[key];
  if (counts.first_s < 0.0) counts.first_s = now.seconds();
  if (rules_[key.rule].is_reliable()) {
    sender(key).add(message, passed(key), &counts);
  } else {
    send_once(key, message, number, now, radio);
  }
}

void Relay::offer_again(const Key& key, const RelayMessage& message, SimTime now, Radio& radio) {
  const std::pair<std::size_t, std::string> topic_key{key.rule, key.source};
  Topic& topic = topics_[topic_key];
  if (is_too_large(topic_key, &topic, message.data->size(), radio)) return;
  ++counts_[key].offered;
  send_to(key, message, topic.next_number++, now, radio);
}

/// Of calls none has to go for newer ones: who waits for one would never hear of it.
ReliableSender& Relay::sender(const Key& key) {
  const RelayRule& rule = rules_[key.rule];
  const int depth = rule.is_service() ? std::numeric_limits<int>::max() : rule.depth;
  return senders_
      .try_emplace(key, static_cast<std::uint16_t>(key.rule), depth,
                   SimTime::from_seconds(rule.deadline_s))
      .first->second;
}

/// Both ends are here, so that no message is counted at both of them.
std::uint64_t Relay::passed(const Key& key) const {
  const auto receiver = reliable_.find(key);
  return receiver == reliable_.end() ? 0 : receiver->second.next();
}

bool Relay::post(const Key& key, std::string data, SimTime born) {
  if (data.size() > kMaxBytes) return false;
  RelayCounts& counts = counts_[key];
  ++counts.offered;
  sender(key).add({born, std::make_shared<const std::string>(std::move(data))}, passed(key),
                  &counts);
  return true;
}

void Relay::send_once(const Key& key, const RelayMessage& message, std::uint64_t number,
                      SimTime now, Radio& radio) {
  const RelayRule& rule = rules_[key.rule];
  RelayCounts& counts = counts_[key];
  RadioQos qos;
  qos.port = kRelayPort;
  qos.priority = rule.priority;
  // The radio drops what has become too late in its queue.
  qos.deadline_s = time_left_s(rule, message, now);
  if (qos.deadline_s < 0.0) {
    ++counts.expired;
    return;
  }
  // By the destination: on their path to the next hop those of several would be one flow.
  std::uint32_t& flow = topics_[{key.rule, key.source}].flows[key.destination];
  if (flow == 0) flow = next_flow_++;
  qos.history = {flow, rule.depth, number, true};
  PartDatagram part;
  part.rule = static_cast<std::uint16_t>(key.rule);
  part.number = number;
  part.born = message.born;
  part.parts = static_cast<std::uint16_t>(part_count(message.data->size()));
  bool is_sent = true;
  // Without acknowledgements a message of which one part is lost is lost, so that the rest of one
  // that the queue refuses is not sent.
  for (; part.part < part.parts && is_sent; ++part.part) {
    part.data = std::string_view(*message.data).substr(part.part * kPartBytes, kPartBytes);
    qos.history.is_begin = part.part == 0;
    is_sent = network_.send(key.source, key.destination, encode(part), qos, now, radio);
    counts.datagrams += is_sent ? 1 : 0;
  }
  if (!is_sent) ++counts.refused;
}

void Relay::send(SimTime now, Radio& radio) {
  network_.send_hellos(now, radio);
  for (auto& [key, sender] : senders_) {
    if (sender.is_idle()) continue;
    RelayCounts& counts = counts_[key];
    RadioQos qos;
    qos.port = kRelayPort;
    qos.priority = rules_[key.rule].priority;
    while (const auto part = sender.next(now, passed(key), &counts)) {
      // A full queue is not a loss: it is tried again in the next step.
      if (!network_.send(key.source, key.destination, encode(*part), qos, now, radio)) break;
      sender.sent(now, &counts);
    }
  }
}

void Relay::take_part(const Key& key, const PartDatagram& part, SimTime now,
                      std::vector<RelayDelivery>* deliveries) {
  const RelayRule& rule = rules_[key.rule];
  RelayCounts& counts = counts_[key];
  const SimTime deadline = SimTime::from_seconds(rule.deadline_s);
  std::vector<RelayMessage> messages;
  if (rule.is_reliable()) {
    const auto sender = senders_.find(key);
    const std::uint64_t given_up = sender == senders_.end() ? 0 : sender->second.first();
    reliable_.try_emplace(key, part.rule, deadline)
        .first->second.take(part, now, given_up, &messages, &counts);
  } else if (auto message =
                 best_effort_.try_emplace(key, deadline).first->second.take(part, now, &counts)) {
    messages.push_back(std::move(*message));
  }
  for (RelayMessage& message : messages) {
    ++counts.delivered;
    const double delay_s = (now - message.born).seconds();
    counts.delay_s += delay_s;
    counts.max_delay_s = std::max(counts.max_delay_s, delay_s);
    deliveries->push_back({key.rule, key.source, key.destination, std::move(message), now});
  }
}

/// Of a service both ends hear the other one.
bool Relay::is_for(const PartDatagram& part, const std::string& receiver) const {
  if (part.rule >= rules_.size()) return false;
  const RelayRule& rule = rules_[part.rule];
  return rule.is_to(receiver) || (rule.is_service() && rule.is_from(receiver));
}

/// What is no datagram of ours came from somebody who uses the port for other things.
void Relay::take(const std::string& receiver, const RadioMessage& packet,
                 std::vector<RelayDelivery>* deliveries) {
  if (const auto part = decode_part(packet.data)) {
    // Broadcasts reach robots that a rule does not name.
    if (!is_for(*part, receiver)) return;
    take_part({part->rule, packet.source, receiver}, *part, packet.received, deliveries);
  } else if (const auto ack = decode_ack(packet.data)) {
    const auto flow = senders_.find({ack->rule, receiver, packet.source});
    if (flow != senders_.end()) flow->second.acknowledge(*ack, packet.received);
  }
}

void Relay::acknowledge(SimTime now, Radio& radio) {
  for (auto& [key, receiver] : reliable_) {
    const auto ack = receiver.take_ack();
    if (!ack) continue;
    RadioQos qos;
    qos.port = kRelayPort;
    qos.priority = rules_[key.rule].priority;
    // One that is lost is followed by the next, at the latest when its parts are sent again.
    network_.send(key.destination, key.source, encode(*ack), qos, now, radio);
  }
}

std::vector<RelayDelivery> Relay::receive(SimTime now, Radio& radio) {
  std::vector<RelayDelivery> deliveries;
  for (const std::string& robot : robots_) {
    for (const RadioMessage& packet : network_.receive(robot, radio)) {
      take(robot, packet, &deliveries);
    }
  }
  // After all of a step's packets: one acknowledgement stands for them.
  acknowledge(now, radio);
  std::stable_sort(deliveries.begin(), deliveries.end(),
                   [](const auto& a, const auto& b) { return a.received < b.received; });
  return deliveries;
}

}  // namespace trident::sim
