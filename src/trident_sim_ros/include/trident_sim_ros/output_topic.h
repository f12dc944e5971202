// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// How a sample type of an output port becomes a topic: one OutputTopicRegistrar, next to the
/// sample's `convert()`. A plugin library outside of this package may hold one, too.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeindex>

#include "trident_ros/direct_message.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/topic_peers.h"
#include "trident_sim/port.h"

namespace trident::sim {

/// How the topic of a sample type is advertised.
struct OutputTopicOptions {
  /// Messages that wait for a subscriber. Deep: a recorder that falls behind for a moment must not
  /// lose anything.
  std::uint32_t queue_size = 1000;
  bool is_latched = false;      ///< who subscribes later gets the newest value
  bool is_for_display = false;  ///< of use to displays only: keeps to a wall rate
};

/// Of samples of megabytes, of which a deep queue would fill the memory.
inline OutputTopicOptions large_topic() { return {10, false, false}; }
/// Of what changes seldom.
inline OutputTopicOptions latched_topic() { return {OutputTopicOptions{}.queue_size, true, false}; }
/// Of what only displays read.
inline OutputTopicOptions display_topic() { return {OutputTopicOptions{}.queue_size, false, true}; }

/// An output port and its topic.
class OutputBinding {
 public:
  /// `port` must outlive the binding. What it holds already is not published as new.
  explicit OutputBinding(PortBase& port) : port_(&port), seen_(port.count()) {}
  virtual ~OutputBinding() = default;
  OutputBinding(const OutputBinding&) = delete;
  OutputBinding& operator=(const OutputBinding&) = delete;

  /// Converts the present value and publishes it.
  virtual void publish() = 0;
  /// Converts the present value into a message that may wait to be sent; nullptr when the topic
  /// takes no single messages.
  virtual std::unique_ptr<ros_utils::DirectMessage> message() = 0;
  /// How many values the last step has.
  virtual std::size_t message_count() const { return 1; }
  /// Calls take(DirectMessage&) for each value of the last step, oldest first.
  virtual void each_message(const std::function<void(ros_utils::DirectMessage&)>& take) {
    if (const auto newest = message()) take(*newest);
  }
  /// Of its messages; with an empty name: not known.
  virtual ros_utils::TopicType type() const { return {}; }
  /// Of the topic now; the port is wanted while it is > 0.
  virtual std::uint32_t subscribers() const = 0;
  /// Valid as long as the binding.
  virtual const ros::Publisher& publisher() const = 0;
  /// Joint states: of use to displays only.
  virtual bool is_for_display() const { return false; }
  /// Who subscribes later gets the newest value, so that every value is sent.
  virtual bool is_latched() const { return false; }

  PortBase& port() const { return *port_; }  ///< as constructed
  /// Sets whether the port has a listener.
  void set_wanted(bool wanted) {
    if (wanted == wanted_) return;
    wanted_ = wanted;
    if (wanted) {
      port_->add_listener();
    } else {
      port_->remove_listener();
    }
  }
  bool wanted() const { return wanted_; }  ///< as last set
  bool is_tapped = false;  ///< this process takes the messages, with and without subscribers
  bool is_late = false;    ///< a value was not published yet, for the wall rate of displays
  /// True once per new value.
  bool take_fresh() {
    if (port_->count() == seen_) return false;
    seen_ = port_->count();
    return true;
  }

 private:
  PortBase* port_;
  std::uint64_t seen_;
  bool wanted_ = false;
};

/// Advertises topics and notes when a subscriber comes or goes.
class TopicAdvertiser {
 public:
  /// `node` must outlive it; its namespace is that of the topics.
  explicit TopicAdvertiser(ros::NodeHandle& node) : node_(node) {}

  /// The queue and the latch are those of `topic_options`; connections are noted by the network's
  /// thread, see take_change().
  template <class Message>
  ros::Publisher advertise(const std::string& topic, const OutputTopicOptions& topic_options = {}) {
    const auto note = [this](const ros::SingleSubscriberPublisher&) { has_changed_ = true; };
    ros::AdvertiseOptions options;
    options.init<Message>(topic, topic_options.queue_size, note, note);
    options.callback_queue = &queue_;
    options.latch = topic_options.is_latched;
    has_changed_ = true;
    return node_.advertise(options);
  }
  /// The same of a type that is known as the program runs only.
  ros::Publisher advertise(const std::string& topic, const ros_utils::TopicType& type) {
    const auto note = [this](const ros::SingleSubscriberPublisher&) { has_changed_ = true; };
    ros::AdvertiseOptions options(topic, OutputTopicOptions{}.queue_size, type.md5sum, type.name,
                                  type.definition, note, note);
    options.callback_queue = &queue_;
    options.latch = type.is_latched;
    has_changed_ = true;
    return node_.advertise(options);
  }
  /// Who is wanted is to be looked at once more.
  void note_change() { has_changed_ = true; }
  /// True once after a change.
  bool take_change() { return has_changed_.exchange(false); }

 private:
  ros::NodeHandle& node_;
  ros_utils::InlineCallbackQueue queue_;
  std::atomic<bool> has_changed_{true};
};

/// A port whose samples `convert(const Sample&, Message&)`, found next to the sample, makes
/// messages of. The message is reused from call to call.
template <class Sample, class Message>
class OutputTopic : public OutputBinding {
 public:
  /// Advertises at once. A latched port that has a value already publishes it.
  OutputTopic(TopicAdvertiser& advertiser, OutPort<Sample>& port, const OutputTopicOptions& options)
      : OutputBinding(port),
        port_(port),
        options_(options),
        publisher_(advertiser.advertise<Message>("/" + port.name(), options)) {
    if (options.is_latched && port.count() > 0) publisher_.publish(converted(port.value));
  }

  void publish() override {
    for (const Sample& sample : port_.earlier()) publisher_.publish(converted(sample));
    publisher_.publish(converted(port_.value));
  }
  std::unique_ptr<ros_utils::DirectMessage> message() override {
    return std::make_unique<ros_utils::ObjectMessage<Message>>(converted(port_.value));
  }
  std::size_t message_count() const override { return port_.earlier().size() + 1; }
  void each_message(const std::function<void(ros_utils::DirectMessage&)>& take) override {
    const auto take_one = [&](const Sample& sample) {
      ros_utils::ObjectMessage<Message> message(converted(sample));
      take(message);
    };
    for (const Sample& sample : port_.earlier()) take_one(sample);
    take_one(port_.value);
  }
  ros_utils::TopicType type() const override {
    namespace traits = ros::message_traits;
    return {traits::datatype<Message>(), traits::md5sum<Message>(), traits::definition<Message>(),
            options_.is_latched};
  }
  std::uint32_t subscribers() const override { return publisher_.getNumSubscribers(); }
  const ros::Publisher& publisher() const override { return publisher_; }
  bool is_for_display() const override { return options_.is_for_display; }
  bool is_latched() const override { return options_.is_latched; }

 private:
  boost::shared_ptr<Message> converted(const Sample& sample) {
    const auto message = pool_.take();
    convert(sample, *message);
    return message;
  }

  OutPort<Sample>& port_;
  OutputTopicOptions options_;
  ros::Publisher publisher_;
  ros_utils::MessagePool<Message> pool_;
};

/// The sample types that have a topic.
class OutputTopics {
 public:
  /// Makes the binding of a port whose type is known to fit.
  using MakeFunction = std::unique_ptr<OutputBinding> (*)(TopicAdvertiser&, PortBase&,
                                                          const OutputTopicOptions&);

  /// Those of this process.
  static OutputTopics& instance() {
    static OutputTopics topics;
    return topics;
  }
  /// The first of a type stays: registrars run as a library is loaded, where an exception would end
  /// the process, and a copy of a plugin's library brings the same type again.
  void add(std::type_index port_type, MakeFunction make, const OutputTopicOptions& options) {
    entries_.emplace(port_type, Entry{make, options});
  }
  /// Returns nullptr for a port of another type.
  std::unique_ptr<OutputBinding> bind(TopicAdvertiser& advertiser, PortBase& port) const {
    const auto found = entries_.find(typeid(port));
    if (found == entries_.end()) return nullptr;
    return found->second.make(advertiser, port, found->second.options);
  }

 private:
  struct Entry {
    MakeFunction make;
    OutputTopicOptions options;
  };
  std::map<std::type_index, Entry> entries_;
};

/// As a static object next to convert(const Sample&, Message&): output ports of this sample type
/// are published as this message.
template <class Sample, class Message>
struct OutputTopicRegistrar {
  /// Throws std::logic_error, which ends the program as it starts, when the sample type has a
  /// topic.
  explicit OutputTopicRegistrar(const OutputTopicOptions& options = {}) {
    const auto make = [](TopicAdvertiser& advertiser, PortBase& port,
                         const OutputTopicOptions& topic) -> std::unique_ptr<OutputBinding> {
      auto& typed = static_cast<OutPort<Sample>&>(port);
      return std::make_unique<OutputTopic<Sample, Message>>(advertiser, typed, topic);
    };
    OutputTopics::instance().add(typeid(OutPort<Sample>), make, options);
  }
};

}  // namespace trident::sim
