// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Messages whose type is known as the program runs only, by their bytes. Each is copied once: out
// of the buffer that it was received in, or into the one that it is sent from.
#pragma once

#include <ros/ros.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "trident_base/span.h"

namespace trident::ros_utils {

/// To be published on a topic that was advertised by its TopicType.
struct BytesMessage {
  Span<const std::uint8_t> bytes;  ///< serialized, of the topic's type; valid during publish()
};

/// Hands the bytes of each message, and what its publisher says of itself (callerid, type, md5sum,
/// message_definition, latching), to a function. All such subscriptions of a topic in a process
/// share the bytes. A publisher in this process serializes its message once; subscriptions that
/// take its object get that, as ever.
class AnySubscriptionHelper : public ros::SubscriptionCallbackHelper {
 public:
  using Bytes = std::shared_ptr<const std::string>;  ///< never nullptr
  using Handler = std::function<void(const Bytes&, const ros::M_string& publisher)>;

  /// `handler` is called in the thread that receives.
  explicit AnySubscriptionHelper(Handler handler) : handler_(std::move(handler)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& p) override {
    return boost::make_shared<Bytes>(
        std::make_shared<std::string>(reinterpret_cast<const char*>(p.buffer), p.length));
  }
  void call(ros::SubscriptionCallbackHelperCallParams& p) override {
    handler_(*boost::static_pointer_cast<Bytes const>(p.event.getConstMessage()),
             p.event.getConnectionHeader());
  }
  const std::type_info& getTypeInfo() override { return typeid(Bytes); }
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
