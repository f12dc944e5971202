// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>
#include <utility>

#include "trident_base/span.h"

namespace trident::ros_utils {

/// Hands the serialised bytes of each message to a function, without building a message object: an
/// Odometry would cost an allocation, two strings and 600 bytes of covariance that no controller
/// reads.
class RawSubscriptionHelper : public ros::SubscriptionCallbackHelper {
 public:
  /// The bytes are valid during the call only.
  using Handler = std::function<void(Span<const std::uint8_t>)>;

  /// `handler` is called in the thread that receives.
  explicit RawSubscriptionHelper(Handler handler) : handler_(std::move(handler)) {}

  /// Returns no message, so that roscpp does not call call().
  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& p) override {
    handler_({p.buffer, p.length});
    return {};
  }
  void call(ros::SubscriptionCallbackHelperCallParams&) override {}
  const std::type_info& getTypeInfo() override { return typeid(void); }
  bool isConst() override { return true; }
  bool hasHeader() override { return true; }

 private:
  Handler handler_;
};

/// The same, and from publishers in this process takes the message object itself.
template <class Message>
class ObjectSubscriptionHelper : public RawSubscriptionHelper {
 public:
  /// Gets the publisher's own object.
  using ObjectHandler = std::function<void(const boost::shared_ptr<Message const>&)>;

  /// `on_bytes`: for publishers in other processes; `on_object`: for those in this one.
  ObjectSubscriptionHelper(Handler on_bytes, ObjectHandler on_object)
      : RawSubscriptionHelper(std::move(on_bytes)), on_object_(std::move(on_object)) {}

  void call(ros::SubscriptionCallbackHelperCallParams& p) override {
    on_object_(boost::static_pointer_cast<Message const>(p.event.getConstMessage()));
  }
  const std::type_info& getTypeInfo() override { return typeid(Message); }

 private:
  ObjectHandler on_object_;
};

/// A type of messages that is known only when the program runs.
struct MessageType {
  std::string name;    ///< "std_msgs/Float64", which the master is given
  std::string md5sum;  ///< of its definition; "*": publishers of any type are heard
};

/// Options of a subscription to a type whose bytes go to `handler`. TCP_NODELAY is asked for:
/// without it every other message of a publisher waits for an acknowledgement (up to 40 ms).
inline ros::SubscribeOptions raw_subscription(const std::string& topic, std::uint32_t queue_size,
                                              const MessageType& type,
                                              RawSubscriptionHelper::Handler handler,
                                              ros::CallbackQueueInterface* queue) {
  ros::SubscribeOptions options(topic, queue_size, type.md5sum, type.name);
  options.helper = boost::make_shared<RawSubscriptionHelper>(std::move(handler));
  options.callback_queue = queue;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return options;
}

/// The same for a type that is known to the compiler.
template <typename Message>
ros::SubscribeOptions raw_subscription(const std::string& topic, std::uint32_t queue_size,
                                       RawSubscriptionHelper::Handler handler,
                                       ros::CallbackQueueInterface* queue) {
  return raw_subscription(
      topic, queue_size,
      {ros::message_traits::datatype<Message>(), ros::message_traits::md5sum<Message>()},
      std::move(handler), queue);
}

/// The same, and publishers in this process hand their objects to `on_object`.
template <typename Message>
ros::SubscribeOptions object_subscription(
    const std::string& topic, std::uint32_t queue_size, RawSubscriptionHelper::Handler on_bytes,
    typename ObjectSubscriptionHelper<Message>::ObjectHandler on_object,
    ros::CallbackQueueInterface* queue) {
  auto options = raw_subscription<Message>(topic, queue_size, {}, queue);
  options.helper = boost::make_shared<ObjectSubscriptionHelper<Message>>(std::move(on_bytes),
                                                                         std::move(on_object));
  return options;
}

/// The same for whole messages that come seldom.
template <typename Message>
ros::SubscribeOptions inline_subscription(
    const std::string& topic,
    const boost::function<void(const boost::shared_ptr<Message const>&)>& handler,
    ros::CallbackQueueInterface* queue) {
  auto options = ros::SubscribeOptions::create<Message>(topic, 1, handler, {}, queue);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return options;
}

}  // namespace trident::ros_utils
