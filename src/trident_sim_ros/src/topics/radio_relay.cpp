// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "radio_relay.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "any_messages.h"
#include "trident_ros/any_message.h"
#include "trident_sim/comms/radio.h"

namespace trident::sim {
namespace {

/// A topic of bytes, advertised when its type is known.
class BytesTopic : public OutputBinding {
 public:
  BytesTopic(TopicAdvertiser& advertiser, OutPort<BytesSample>& port)
      : OutputBinding(port), advertiser_(advertiser), port_(port) {}

  void advertise(const ros_utils::TopicType& type) {
    is_latched_ = type.is_latched;
    publisher_ = advertiser_.advertise("/" + port_.name(), type);
  }
  bool is_advertised() const { return static_cast<bool>(publisher_); }

  void publish() override {
    if (!is_advertised()) return;
    for (const BytesSample& sample : port_.earlier()) publish(sample);
    publish(port_.value);
  }
  std::unique_ptr<ros_utils::DirectMessage> message() override { return nullptr; }
  std::uint32_t subscribers() const override {
    return is_advertised() ? publisher_.getNumSubscribers() : 0;
  }
  const ros::Publisher& publisher() const override { return publisher_; }
  bool is_latched() const override { return is_latched_; }

 private:
  void publish(const BytesSample& sample) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(sample.data->data());
    // Bytes cross the simulator as they were serialized, so that any type can be relayed.
    publisher_.publish(ros_utils::BytesMessage{{bytes, sample.data->size()}});
  }

  TopicAdvertiser& advertiser_;
  OutPort<BytesSample>& port_;
  ros::Publisher publisher_;
  bool is_latched_ = false;
};

struct BytesTopicRegistrar {
  BytesTopicRegistrar() {
    const auto make = [](TopicAdvertiser& advertiser, PortBase& port,
                         const OutputTopicOptions&) -> std::unique_ptr<OutputBinding> {
      return std::make_unique<BytesTopic>(advertiser, static_cast<OutPort<BytesSample>&>(port));
    };
    OutputTopics::instance().add(typeid(OutPort<BytesSample>), make, {});
  }
};
const BytesTopicRegistrar kBytesTopic;

}  // namespace

void RadioRelay::sync() {
  if (board_.version() == version_) return;
  version_ = board_.version();
  std::map<std::string, Tap> taps;
  untyped_.clear();
  board_.for_each([&](PortBase& port) {
    if (dynamic_cast<OutPort<BytesSample>*>(&port) != nullptr) untyped_.push_back(port.name());
    auto* const input = dynamic_cast<InPort<BytesSample>*>(&port);
    if (input == nullptr || inputs_.find(port.name()) != nullptr) return;
    OutputBinding* const topic = outputs_.tap(port.name());
    if (topic == nullptr) return;
    const auto known = taps_.find(port.name());
    const std::uint64_t count = topic->port().count();
    // A tap that stays continues after the last message that it has taken.
    const bool is_same = known != taps_.end() && known->second.topic == topic;
    taps[port.name()] = {topic, input, is_same ? known->second.seen : count,
                         begins_with_header(topic->type().definition)};
  });
  taps_ = std::move(taps);
  const auto* const radio = board_.find_out<RadioSample>(kRadioPort);
  relay_ = radio == nullptr ? nullptr : radio->value.relay;
  const auto is_advertised = [this](const std::string& name) { return advertise(name); };
  untyped_.erase(std::remove_if(untyped_.begin(), untyped_.end(), is_advertised), untyped_.end());
}

void RadioRelay::take_outputs(SimTime end) {
  for (auto& [name, tap] : taps_) {
    const std::uint64_t count = tap.topic->port().count();
    if (count == tap.seen) continue;
    tap.seen = count;
    take(name, tap, end);
  }
  const auto has_crossed = [this](const std::string& name) {
    const PortBase* const port = board_.find(name, PortDirection::kOut);
    return port != nullptr && port->count() > 0 && advertise(name);
  };
  const auto typed = std::remove_if(untyped_.begin(), untyped_.end(), has_crossed);
  if (typed == untyped_.end()) return;
  untyped_.erase(typed, untyped_.end());
  outputs_.scan_subscribers();  // so that a latched one is published in this step
}

/// They count in this step, whatever their stamp says: what max_rate leaves out needs no bytes.
void RadioRelay::take(const std::string& name, Tap& tap, SimTime end) {
  if (relay_ != nullptr && relay_->is_thinned(name, end)) {
    for (std::size_t i = 0; i < tap.topic->message_count(); ++i) tap.input->write({end, {}, {}});
    return;
  }
  tap.topic->each_message([&](ros_utils::DirectMessage& message) {
    BytesSample sample;
    sample.data = std::make_shared<const std::string>(message.unframed(sequences_[name]++));
    if (tap.has_header) sample.stamp = std::min(header_stamp(*sample.data), end);
    sample.is_latched = tap.topic->is_latched();
    tap.input->write(sample);
  });
}

ros_utils::TopicType RadioRelay::type_of(const std::string& input) const {
  if (const auto tap = taps_.find(input); tap != taps_.end()) return tap->second.topic->type();
  const InputBinding* const binding = inputs_.find(input);
  return binding == nullptr ? ros_utils::TopicType{} : binding->type();
}

/// True: it needs no look any more.
bool RadioRelay::advertise(const std::string& output) {
  auto* const topic = dynamic_cast<BytesTopic*>(outputs_.find(output));
  if (topic == nullptr || topic->is_advertised()) return true;
  const std::string& origin = static_cast<OutPort<BytesSample>&>(topic->port()).value.origin;
  const ros_utils::TopicType type = type_of(origin);
  if (!type.name.empty()) topic->advertise(type);
  return topic->is_advertised();
}

void RadioRelay::look_for_types(SimTime now) {
  if (untyped_.empty() || !looks_.is_due(now)) return;
  const auto is_advertised = [this](const std::string& name) { return advertise(name); };
  untyped_.erase(std::remove_if(untyped_.begin(), untyped_.end(), is_advertised), untyped_.end());
}

}  // namespace trident::sim
