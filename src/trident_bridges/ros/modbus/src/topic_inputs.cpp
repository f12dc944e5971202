// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/topic_inputs.h"

#include <map>
#include <utility>

#include "trident_base/error.h"
#include "trident_ros/topic_peers.h"

namespace trident::bridges::modbus {
namespace {

constexpr std::uint32_t kQueueSize = 10;

}  // namespace

/// One topic, and how the values in its messages are found.
class TopicInputs::Topic {
 public:
  Topic(ros::NodeHandle& node, Context& context, std::vector<TopicBinding> bindings)
      : context_(context), bindings_(std::move(bindings)) {
    name_ = node.resolveName(bindings_[0].topic);
    // Publishers of any type are heard, so that one of a wrong type is named with the map's line.
    subscription_ =
        context_.loop.subscribe_bytes(node, name_, kQueueSize, {bindings_[0].message, "*"},
                                      [this](Span<const std::uint8_t> bytes) { receive(bytes); });
  }

  const std::string& name() const { return name_; }
  bool is_silent() const { return subscription_->publishers() == 0; }

  void look_at_publishers() {
    if (is_silent()) return;
    const ros_utils::TopicType type = ros_utils::topic_type(name_);
    if (!type.md5sum.empty() && type.md5sum != md5sum_) learn(type);
  }
  /// A publisher that is not in another process is this one.
  void learn_own_type() {
    const MessageDefinition& own = context_.lookup.get(bindings_[0].message);
    learn({own.type(), own.md5sum(), own.text(), false});
  }

 private:
  void receive(Bytes bytes);
  void learn(const ros_utils::TopicType& type);
  void read(Bytes bytes);
  void report(std::size_t index);

  Context& context_;
  std::vector<TopicBinding> bindings_;
  std::string name_;
  std::string md5sum_;                ///< of the type that the readers are for
  std::vector<FieldReader> readers_;  ///< of each binding; none: the type is not used
  std::vector<std::uint8_t> first_;   ///< a message that waits for its type
  Value value_;
  std::unique_ptr<ros_utils::DirectSubscription> subscription_;
};

/// roscpp must not be asked within the inbox: the type is looked up behind the first message.
void TopicInputs::Topic::receive(Bytes bytes) {
  if (!md5sum_.empty()) return read(bytes);
  const bool is_asked = !first_.empty();
  first_.assign(bytes.begin(), bytes.end());
  if (is_asked) return;
  context_.loop.loop().post([this] {
    look_at_publishers();
    if (md5sum_.empty()) learn_own_type();
    read(std::exchange(first_, {}));
  });
}

void TopicInputs::Topic::learn(const ros_utils::TopicType& type) {
  md5sum_ = type.md5sum;
  readers_.clear();
  const RegisterMap& map = context_.map;
  try {
    if (type.name != bindings_[0].message) {
      throw Error("it is of type " + type.name + ", legal: " + bindings_[0].message + " (" +
                  map.file + ":" + std::to_string(map.entries[bindings_[0].entry].line) + ")");
    }
    const MessageDefinition definition(type.name, type.definition);
    for (const TopicBinding& binding : bindings_) readers_.emplace_back(definition, binding.field);
  } catch (const Error& error) {
    readers_.clear();
    context_.events.refused("topic type", "topic " + name_ + ": " + error.what());
  }
}

void TopicInputs::Topic::read(Bytes bytes) {
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    if (readers_[i].read(bytes, value_)) {
      report(i);
    } else {
      context_.events.refused("message", "topic " + name_ + ": a message of " +
                                             std::to_string(bytes.size()) +
                                             " bytes has no field '" + bindings_[i].field + "'");
    }
  }
}

void TopicInputs::Topic::report(std::size_t index) {
  const TopicBinding& binding = bindings_[index];
  if (binding.bit != TopicBinding::kWhole && !value_.numbers.empty()) {
    std::uint64_t& word = context_.words[binding.entry];
    const std::uint64_t bit = std::uint64_t{1} << binding.bit;
    word = as_double(value_.numbers[0]) != 0.0 ? word | bit : word & ~bit;
    value_.numbers[0] = word;
  }
  context_.events.value(binding.entry, value_);
}

TopicInputs::TopicInputs(ros::NodeHandle& node, NodePollLoop& loop, const RegisterMap& map,
                         const std::vector<TopicBinding>& bindings, MessageLookup& lookup,
                         InputEvents events)
    : context_{loop, map, lookup, std::move(events), {}} {
  context_.words.resize(map.entries.size());
  std::map<std::string, std::vector<TopicBinding>> by_topic;
  for (const TopicBinding& binding : bindings) by_topic[binding.topic].push_back(binding);
  for (auto& [topic, own] : by_topic) {
    topics_.push_back(std::make_unique<Topic>(node, context_, std::move(own)));
  }
}

TopicInputs::~TopicInputs() = default;

void TopicInputs::look_at_publishers() {
  for (const auto& topic : topics_) topic->look_at_publishers();
}

std::vector<std::string> TopicInputs::silent_topics() const {
  std::vector<std::string> silent;
  for (const auto& topic : topics_) {
    if (topic->is_silent()) silent.push_back(topic->name());
  }
  return silent;
}

}  // namespace trident::bridges::modbus
