// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cstring>

#include "latency_record.h"
#include "parts.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/subscriptions.h"

namespace trident::bridges {
namespace {

constexpr std::size_t kHeaderBytes = 12;  // number, seconds, nanoseconds
constexpr double kLook_s = 0.05;

struct AnyMessage {};

}  // namespace
}  // namespace trident::bridges

namespace ros::message_traits {

template <>
struct MD5Sum<trident::bridges::AnyMessage> {
  static const char* value() { return "*"; }
};
template <>
struct DataType<trident::bridges::AnyMessage> {
  static const char* value() { return "*"; }
};

}  // namespace ros::message_traits

namespace trident::bridges {

int run_listener(const ProbeOptions& options) {
  LatencyRecord record(options.record);
  ros::NodeHandle node;
  ros_utils::InlineCallbackQueue queue;
  std::uint64_t number = 0;
  ros::SubscribeOptions subscription = ros_utils::raw_subscription<AnyMessage>(
      options.topic, 1000,
      [&](Span<const std::uint8_t> bytes) {
        // Before the first /clock there is no time to compare with.
        if (!ros::Time::isValid()) return;
        const auto now_ns = static_cast<std::int64_t>(ros::Time::now().toNSec());
        if (bytes.size() < kHeaderBytes || number >= record.capacity()) return;
        std::uint32_t stamp[2];
        std::memcpy(stamp, bytes.data() + 4, sizeof(stamp));
        record.note_sent(number, static_cast<std::int64_t>(ros::Time(stamp[0], stamp[1]).toNSec()));
        record.note_received(number++, now_ns);
      },
      &queue);
  const ros::Subscriber subscriber = node.subscribe(subscription);
  const std::int64_t limit_ns = monotonic_ns() + static_cast<std::int64_t>(1e9 * options.limit_s);
  while (ros::ok() && record.received() < record.capacity() && monotonic_ns() < limit_ns) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLook_s));
  }
  record.set_state(LatencyRecord::kDone);
  return 0;
}

}  // namespace trident::bridges
