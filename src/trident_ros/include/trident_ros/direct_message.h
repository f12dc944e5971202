// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

#include <cstring>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "trident_base/span.h"

namespace trident::ros_utils {

/// A message that is sent in the form that each subscriber takes: bytes to other processes, the
/// object itself to this one. Each form is made when the first subscriber takes it.
class DirectMessage {
 public:
  virtual ~DirectMessage() = default;
  /// The whole message with the 4-byte length that TCPROS puts before it; `sequence` is its
  /// header.seq. Valid until the next call.
  virtual Span<const std::uint8_t> frame(std::uint32_t sequence) = 0;
  /// The message without that length, serialized for the caller alone.
  virtual std::string unframed(std::uint32_t sequence) {
    const Span<const std::uint8_t> whole = frame(sequence);
    const auto* const begin = reinterpret_cast<const char*>(whole.data()) + sizeof(std::uint32_t);
    return std::string(begin, whole.size() - sizeof(std::uint32_t));
  }
  /// Subscribers may keep it, so it does not change any more.
  virtual boost::shared_ptr<void const> object() = 0;
  /// Of the message object; subscribers in this process that want it get the object itself.
  virtual const std::type_info& type() const = 0;
};

/// A message that was made as an object.
template <class Message>
class ObjectMessage : public DirectMessage {
 public:
  /// Shares the message, which must not change any more.
  explicit ObjectMessage(boost::shared_ptr<Message const> message) : message_(std::move(message)) {}

  Span<const std::uint8_t> frame(std::uint32_t sequence) override {
    if (frame_.empty()) serialize();
    if (ros::message_traits::hasHeader<Message>()) {
      std::memcpy(frame_.data() + sizeof(std::uint32_t), &sequence, sizeof(sequence));
    }
    return frame_;
  }
  std::string unframed(std::uint32_t sequence) override {
    const std::uint32_t length = ros::serialization::serializationLength(*message_);
    std::string result(length, '\0');
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(result.data()), length);
    ros::serialization::serialize(stream, *message_);
    if (ros::message_traits::hasHeader<Message>()) {
      std::memcpy(result.data(), &sequence, sizeof(sequence));
    }
    return result;
  }
  boost::shared_ptr<void const> object() override { return message_; }
  const std::type_info& type() const override { return typeid(Message); }

 private:
  void serialize() {
    const std::uint32_t length = ros::serialization::serializationLength(*message_);
    frame_.resize(sizeof(length) + length);
    ros::serialization::OStream stream(frame_.data(), static_cast<std::uint32_t>(frame_.size()));
    ros::serialization::serialize(stream, length);
    ros::serialization::serialize(stream, *message_);
  }

  boost::shared_ptr<Message const> message_;
  std::vector<std::uint8_t> frame_;
};

/// Message objects that are used again once nobody holds them any more. For one thread.
template <class Message>
class MessagePool {
 public:
  boost::shared_ptr<Message> take() {
    for (const boost::shared_ptr<Message>& message : messages_) {
      if (message.use_count() == 1) return message;
    }
    auto message = boost::make_shared<Message>();
    // Subscribers that keep many must not make this a long search.
    if (messages_.size() < kCapacity) messages_.push_back(message);
    return message;
  }

 private:
  static constexpr std::size_t kCapacity = 8;
  std::vector<boost::shared_ptr<Message>> messages_;
};

}  // namespace trident::ros_utils
