// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/topic_outputs.h"

#include <cstring>
#include <map>
#include <utility>

#include "trident_base/error.h"

namespace trident::bridges::modbus {
namespace {

constexpr std::size_t kLengthBytes = 4;  // in front of a message on a connection of ROS

/// A message that there is as bytes alone.
class BytesMessage : public ros_utils::DirectMessage {
 public:
  BytesMessage(std::vector<std::uint8_t>& frame, bool has_header)
      : frame_(frame), has_header_(has_header) {}

  Span<const std::uint8_t> frame(std::uint32_t sequence) override {
    if (has_header_) std::memcpy(frame_.data() + kLengthBytes, &sequence, sizeof(sequence));
    return frame_;
  }
  boost::shared_ptr<void const> object() override { return {}; }
  const std::type_info& type() const override { return typeid(void); }

 private:
  std::vector<std::uint8_t>& frame_;
  bool has_header_;
};

ros::Publisher advertise(ros::NodeHandle& node, const std::string& topic,
                         const MessageDefinition& definition) {
  constexpr std::uint32_t kQueueSize = 100;
  ros::AdvertiseOptions options(topic, kQueueSize, definition.md5sum(), definition.type(),
                                definition.text());
  options.has_header = definition.has_header();
  return node.advertise(options);
}

}  // namespace

/// One topic, its fields and its newest message.
class TopicOutputs::Topic {
 public:
  Topic(ros::NodeHandle& node, const std::string& topic, const MessageDefinition& definition,
        const std::vector<std::string>& fields)
      : writer_(definition, fields),
        has_header_(definition.has_header()),
        values_(fields.size()),
        publisher_(advertise(node, topic, definition)),
        publication_(publisher_) {}

  void set(std::size_t field, const Value& value) {
    values_[field] = value;
    is_due_ = true;
  }
  void publish() {
    if (!is_due_) return;
    is_due_ = false;
    const ros::Time now = ros::Time::now();
    frame_.assign(kLengthBytes, 0);
    writer_.write(values_, now.sec, now.nsec, frame_);
    const auto length = static_cast<std::uint32_t>(frame_.size() - kLengthBytes);
    std::memcpy(frame_.data(), &length, sizeof(length));
    send(0);
  }
  /// Connections are counted from 0, which is also the number after which all are served: with
  /// that one alone, their count says whether there is a later one.
  void serve_late_subscribers() {
    if (frame_.empty() || (newest_ == 0 && publication_.subscribers() == served_)) return;
    send(newest_);
  }

 private:
  /// To connections that are later than `after`; 0: to all.
  void send(int after) {
    served_ = publication_.subscribers();
    if (served_ == 0) return;
    BytesMessage message(frame_, has_header_);
    newest_ = std::max(newest_, publication_.send(message, after));
  }

  MessageWriter writer_;
  bool has_header_;
  std::vector<Value> values_;
  bool is_due_ = false;
  int newest_ = 0;            ///< connection that has the newest message
  std::uint32_t served_ = 0;  ///< connections when it was sent last
  std::vector<std::uint8_t> frame_;
  ros::Publisher publisher_;
  ros_utils::DirectPublication publication_;
};

TopicOutputs::TopicOutputs(ros::NodeHandle& node, const RegisterMap& map,
                           const std::vector<TopicBinding>& bindings, MessageLookup& lookup)
    : targets_(map.entries.size()) {
  std::map<std::string, std::vector<const TopicBinding*>> by_topic;
  for (const TopicBinding& binding : bindings) by_topic[binding.topic].push_back(&binding);
  for (const auto& [topic, fields] : by_topic) {
    std::vector<std::string> paths;
    for (const TopicBinding* field : fields) paths.push_back(field->field);
    try {
      topics_.push_back(
          std::make_unique<Topic>(node, topic, lookup.get(fields[0]->message), paths));
    } catch (const ConfigError&) {
      throw;
    } catch (const Error& error) {
      const RegisterEntry& entry = map.entries[fields[0]->entry];
      throw ConfigError(map.file, entry.line, "topic " + topic, error.what());
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      targets_[fields[i]->entry].push_back({topics_.back().get(), i, fields[i]->bit});
    }
  }
}

TopicOutputs::~TopicOutputs() = default;

void TopicOutputs::set(std::size_t entry, const Value& value) {
  for (const Target& target : targets_[entry]) {
    if (target.bit == TopicBinding::kWhole) {
      target.topic->set(target.field, value);
      continue;
    }
    const auto word = static_cast<std::uint64_t>(as_double(value.numbers.at(0)));
    target.topic->set(target.field, {{Number{(word >> target.bit) & 1U}}, ""});
  }
}

void TopicOutputs::publish() {
  for (const auto& topic : topics_) topic->publish();
}

void TopicOutputs::serve_late_subscribers() {
  for (const auto& topic : topics_) topic->serve_late_subscribers();
}

}  // namespace trident::bridges::modbus
