// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Messages whose type is known as the program runs only, by their bytes. Each is copied once: out
// of the buffer that it was received in, or into the one that it is sent from.
#pragma once

#include <ros/ros.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "trident_base/span.h"

namespace trident::ros_utils {

/// To be published on a topic that was advertised by its TopicType.
struct BytesMessage {
  Span<const std::uint8_t> bytes;  ///< serialized, of the topic's type; valid during publish()
};

/// Hands the bytes of each message, and what its publisher says of itself (callerid, type, md5sum,
/// message_definition, latching), to a function. A publisher in this process serializes its message
/// once for all subscriptions that take bytes; those that take the object are not concerned.
class AnySubscriptionHelper : public ros::SubscriptionCallbackHelper {
 public:
  /// The bytes are valid during the call only.
  using Handler = std::function<void(Span<const std::uint8_t>, ros::M_string& publisher)>;

  /// `handler` is called in the thread that receives.
  explicit AnySubscriptionHelper(Handler handler) : handler_(std::move(handler)) {}

  /// Returns no message, so that roscpp does not call call().
  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& p) override {
    handler_({p.buffer, p.length}, *p.connection_header);
    return {};
  }
  void call(ros::SubscriptionCallbackHelperCallParams&) override {}
  const std::type_info& getTypeInfo() override { return typeid(void); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  Handler handler_;
};

/// Options of a subscription to a topic of any type.
inline ros::SubscribeOptions any_subscription(const std::string& topic, std::uint32_t queue_size,
                                              AnySubscriptionHelper::Handler handler,
                                              ros::CallbackQueueInterface* queue) {
  ros::SubscribeOptions options(topic, queue_size, "*", "*");
  options.helper = boost::make_shared<AnySubscriptionHelper>(std::move(handler));
  options.callback_queue = queue;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return options;
}

}  // namespace trident::ros_utils

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<trident::ros_utils::BytesMessage> {
  static const char* value() { return "*"; }
  static const char* value(const trident::ros_utils::BytesMessage&) { return value(); }
};
template <>
struct DataType<trident::ros_utils::BytesMessage> {
  static const char* value() { return "*"; }
  static const char* value(const trident::ros_utils::BytesMessage&) { return value(); }
};
template <>
struct Definition<trident::ros_utils::BytesMessage> {
  static const char* value() { return ""; }
  static const char* value(const trident::ros_utils::BytesMessage&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<trident::ros_utils::BytesMessage> {
  template <class Stream>
  static void write(Stream& stream, const trident::ros_utils::BytesMessage& message) {
    std::copy(message.bytes.begin(), message.bytes.end(),
              stream.advance(serializedLength(message)));
  }
  static std::uint32_t serializedLength(const trident::ros_utils::BytesMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros
