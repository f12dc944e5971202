// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "carriers.h"
#include "latency_record.h"
#include "parts.h"

namespace trident::bridges {
namespace {

constexpr double kLookAtState_s = 0.05;

template <class Message, class Handler>
ros::Subscriber subscribe_without_delay(ros::NodeHandle& node, const std::string& topic,
                                        Handler handler) {
  return node.subscribe<Message>(
      topic, kProbeQueue, boost::function<void(const boost::shared_ptr<Message const>&)>(handler),
      {}, ros::TransportHints().tcpNoDelay());
}

template <class Carrier>
int sink(const ProbeOptions& options) {
  using Message = typename Carrier::Message;
  LatencyRecord record(options.record);
  auto carrier = make_carrier<Carrier>(options);
  ros::NodeHandle node;
  const ros::Subscriber subscriber = subscribe_without_delay<Message>(
      node, options.topic, [&record, &carrier](const boost::shared_ptr<Message const>& message) {
        const std::int64_t now_ns = monotonic_ns();
        record.note_received(carrier.number(*message), now_ns);
      });
  while (ros::ok() && record.state() != LatencyRecord::kDone) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookAtState_s));
  }
  return 0;
}

template <class Message>
int relay(const ProbeOptions& options) {
  ros::NodeHandle node;
  const ros::Publisher publisher = node.advertise<Message>(options.out, kProbeQueue);
  const ros::Subscriber subscriber = subscribe_without_delay<Message>(
      node, options.in, [&publisher](const boost::shared_ptr<Message const>& message) {
        publisher.publish(message);
      });
  ros::spin();
  return 0;
}

}  // namespace

int run_sink(const ProbeOptions& options) {
  return with_carrier(options.message, [&](auto carrier) {
    return sink<typename decltype(carrier)::type>(options);
  });
}

int run_relay(const ProbeOptions& options) {
  return with_carrier(options.message, [&](auto carrier) {
    return relay<typename decltype(carrier)::type::Message>(options);
  });
}

}  // namespace trident::bridges
