// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "radio_relay.h"

#include <ros/serialization.h>
#include <topic_tools/shape_shifter.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "any_messages.h"

namespace trident::sim {
namespace {

/// A topic of bytes, advertised when its type is known.
class BytesTopic : public OutputBinding {
 public:
  BytesTopic(TopicAdvertiser& advertiser, OutPort<BytesSample>& port)
      : OutputBinding(port), advertiser_(advertiser), port_(port) {}

  void advertise(const ros_utils::TopicType& type) {
    is_latched_ = type.is_latched;
    constexpr const char* kNoLatch = "";
    message_.morph(type.md5sum, type.name, type.definition, kNoLatch);
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
    // The stream does not write, and its interface does not say so.
    auto* const bytes = reinterpret_cast<std::uint8_t*>(const_cast<char*>(sample.data->data()));
    ros::serialization::IStream stream(bytes, static_cast<std::uint32_t>(sample.data->size()));
    message_.read(stream);
    publisher_.publish(message_);
  }

  TopicAdvertiser& advertiser_;
  OutPort<BytesSample>& port_;
  ros::Publisher publisher_;
  topic_tools::ShapeShifter message_;
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
    const bool is_same = known != taps_.end() && known->second.topic == topic;
    taps[port.name()] = {topic, input, is_same ? known->second.seen : count,
                         begins_with_header(topic->type().definition)};
  });
  taps_ = std::move(taps);
  look_for_types();
}

void RadioRelay::take_outputs() {
  for (auto& [name, tap] : taps_) {
    const std::uint64_t count = tap.topic->port().count();
    if (count == tap.seen) continue;
    tap.seen = count;
    tap.topic->each_message([&, &name = name, &tap = tap](ros_utils::DirectMessage& message) {
      const auto frame = message.frame(sequences_[name]++);
      constexpr std::size_t kLengthBytes = 4;
      auto bytes = std::make_shared<const std::string>(
          reinterpret_cast<const char*>(frame.data()) + kLengthBytes, frame.size() - kLengthBytes);
      tap.input->write({tap.has_header ? header_stamp(*bytes) : SimTime{}, bytes, {}});
    });
  }
}

ros_utils::TopicType RadioRelay::type_of(const std::string& input) const {
  if (const auto tap = taps_.find(input); tap != taps_.end()) return tap->second.topic->type();
  const InputBinding* const binding = inputs_.find(input);
  return binding == nullptr ? ros_utils::TopicType{} : binding->type();
}

void RadioRelay::look_for_types() {
  const auto advertise = [this](const std::string& name) {
    auto* const topic = dynamic_cast<BytesTopic*>(outputs_.find(name));
    if (topic == nullptr || topic->is_advertised()) return true;
    const std::string& origin = static_cast<OutPort<BytesSample>&>(topic->port()).value.origin;
    const ros_utils::TopicType type = type_of(origin);
    if (!type.name.empty()) topic->advertise(type);
    return topic->is_advertised();
  };
  untyped_.erase(std::remove_if(untyped_.begin(), untyped_.end(), advertise), untyped_.end());
}

}  // namespace trident::sim
