// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Within this process; run by test_direct_inbox.py, which has a master.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "trident_ros/any_message.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/topic_peers.h"

namespace trident::ros_utils {
namespace {

/// A message that counts how often one is written and read.
struct Counted {
  std::string data;
  static inline int writes = 0, reads = 0;
};
constexpr const char* kMd5 = "0123456789abcdef0123456789abcdef";
constexpr const char* kType = "trident_test/Counted";
constexpr const char* kDefinition = "string data\n";

}  // namespace
}  // namespace trident::ros_utils

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<trident::ros_utils::Counted> {
  static const char* value() { return trident::ros_utils::kMd5; }
  static const char* value(const trident::ros_utils::Counted&) { return value(); }
};
template <>
struct DataType<trident::ros_utils::Counted> {
  static const char* value() { return trident::ros_utils::kType; }
  static const char* value(const trident::ros_utils::Counted&) { return value(); }
};
template <>
struct Definition<trident::ros_utils::Counted> {
  static const char* value() { return trident::ros_utils::kDefinition; }
  static const char* value(const trident::ros_utils::Counted&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<trident::ros_utils::Counted> {
  template <class Stream>
  static void write(Stream& stream, const trident::ros_utils::Counted& message) {
    ++trident::ros_utils::Counted::writes;
    stream.next(message.data);
  }
  template <class Stream>
  static void read(Stream& stream, trident::ros_utils::Counted& message) {
    ++trident::ros_utils::Counted::reads;
    stream.next(message.data);
  }
  static std::uint32_t serializedLength(const trident::ros_utils::Counted& message) {
    return ros::serialization::serializationLength(message.data);
  }
};

}  // namespace serialization
}  // namespace ros

namespace trident::ros_utils {
namespace {

/// Two subscriptions to bytes and one to objects, all in this process.
class AnyMessageTest : public testing::Test {
 protected:
  AnyMessageTest() {
    Counted::writes = Counted::reads = 0;
    node_.setCallbackQueue(&objects_queue_);
    for (int i = 0; i < 2; ++i) {
      ros::SubscribeOptions options = any_subscription(
          "any_message", 10,
          [this](const AnySubscriptionHelper::Bytes& bytes, const ros::M_string& publisher) {
            bytes_.push_back(bytes);
            publisher_ = publisher;
          },
          &bytes_queue_);
      subscribers_.push_back(node_.subscribe(options));
    }
    subscribers_.push_back(node_.subscribe<Counted>(
        "any_message", 10,
        [this](const boost::shared_ptr<Counted const>& message) { objects_.push_back(message); }));
  }
  bool spin(const std::function<bool()>& condition) {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition() && std::chrono::steady_clock::now() < limit) {
      objects_queue_.callAvailable(ros::WallDuration(0.002));
      bytes_queue_.callAvailable();
    }
    return condition();
  }
  bool has_all() const { return bytes_.size() == 2 && objects_.size() == 1; }

  ros::CallbackQueue objects_queue_, bytes_queue_;
  ros::NodeHandle node_;
  std::vector<AnySubscriptionHelper::Bytes> bytes_;
  ros::M_string publisher_;
  std::vector<boost::shared_ptr<Counted const>> objects_;
  std::vector<ros::Subscriber> subscribers_;
};

const std::string kBytes("\x03\0\0\0abc", 7);

TEST_F(AnyMessageTest, AnObjectIsSerializedOnceForAllThatTakeBytes) {
  ros::Publisher publisher = node_.advertise<Counted>("any_message", 10);
  ASSERT_TRUE(spin([&] { return publisher.getNumSubscribers() == 1; }));
  auto message = boost::make_shared<Counted>();
  message->data = "abc";
  publisher.publish(message);
  ASSERT_TRUE(spin([this] { return has_all(); }));
  EXPECT_EQ(*bytes_[0], kBytes);
  EXPECT_EQ(bytes_[1], bytes_[0]) << "shared";
  EXPECT_EQ(objects_[0], message) << "the object itself";
  EXPECT_EQ(Counted::writes, 1);
  EXPECT_EQ(Counted::reads, 0);
  EXPECT_EQ(publisher_.at("md5sum"), kMd5);
  EXPECT_EQ(publisher_.at("message_definition"), kDefinition);
  EXPECT_EQ(publisher_.at("callerid"), ros::this_node::getName());
}

TEST_F(AnyMessageTest, BytesArePublishedAsTheyAre) {
  const TopicType type{kType, kMd5, kDefinition, true};
  ros::AdvertiseOptions options("any_message", 10, type.md5sum, type.name, type.definition);
  options.latch = type.is_latched;
  ros::Publisher publisher = node_.advertise(options);
  ASSERT_TRUE(spin([&] { return publisher.getNumSubscribers() == 1; }));
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(kBytes.data());
  publisher.publish(BytesMessage{{bytes, kBytes.size()}});
  ASSERT_TRUE(spin([this] { return has_all(); }));
  EXPECT_EQ(*bytes_[0], kBytes);
  EXPECT_EQ(bytes_[1], bytes_[0]) << "shared";
  EXPECT_EQ(objects_[0]->data, "abc");
  EXPECT_EQ(Counted::writes, 0);
  EXPECT_EQ(Counted::reads, 1);
  EXPECT_EQ(publisher_.at("latching"), "1");
}

TEST_F(AnyMessageTest, TheTypeOfAPublisherInThisProcessIsKnown) {
  const ros::Publisher publisher = node_.advertise<Counted>("any_message", 10, true);
  ASSERT_TRUE(spin([&] { return !topic_type("/any_message").name.empty(); }));
  const TopicType type = topic_type("/any_message");
  EXPECT_EQ(type.name, kType);
  EXPECT_EQ(type.md5sum, kMd5);
  EXPECT_EQ(type.definition, kDefinition);
  EXPECT_TRUE(type.is_latched);
}

}  // namespace
}  // namespace trident::ros_utils
