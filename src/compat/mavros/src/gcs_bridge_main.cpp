// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// gcs_bridge: a ground station at a link of its own, by the topics mavlink/from and mavlink/to of a
// mavros_node that runs elsewhere.
#include <mavros_msgs/Mavlink.h>
#include <ros/ros.h>

#include "core/packet_topics.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::mavros {
namespace {

constexpr std::uint32_t kQueue = 100;
constexpr std::uint16_t kStationsPort = 14550, kOwnPort = 14555;

class GcsBridge {
 public:
  GcsBridge(ros::NodeHandle& node, const ros::NodeHandle& own, bridges::NodePollLoop& loop)
      : to_(node, "mavlink/to", kQueue), parser_(true) {
    bridges::EndpointOptions options;
    options.url = own.param<std::string>("gcs_url", "udp://@127.0.0.1");
    options.allow_remote = own.param("allow_remote", false);
    options.default_bind_port = kOwnPort;
    options.default_port = kStationsPort;
    bridges::EndpointEvents events;
    events.received = [this](bridges::PeerId, bridges::Bytes bytes) { pass_on(bytes); };
    events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
    endpoint_ = bridges::open_endpoint(options, loop.loop(), std::move(events));
    from_ = loop.subscribe<mavros_msgs::Mavlink>(
        node, "mavlink/from", kQueue, [this](const mavros_msgs::Mavlink& message) {
          to_packet(message, packet_);
          if (!packet_.empty()) endpoint_->send_to_all(bridges::Bytes(packet_));
        });
    ROS_INFO("gcs_bridge: %s", endpoint_->name().c_str());
  }

 private:
  void pass_on(bridges::Bytes bytes) {
    parser_.feed(bytes);
    while (const auto packet = parser_.next()) {
      to_ros(*packet, message_);
      to_.publish(message_);
    }
  }

  bridges::NodePublisher<mavros_msgs::Mavlink> to_;
  bridges::mavlink::PacketParser parser_;
  mavros_msgs::Mavlink message_;
  std::vector<std::uint8_t> packet_;
  std::unique_ptr<bridges::Endpoint> endpoint_;
  std::unique_ptr<ros_utils::DirectSubscription> from_;
};

}  // namespace
}  // namespace trident::mavros

int main(int argc, char** argv) {
  using trident::bridges::NodePollLoop;
  trident::bridges::init_node(argc, argv, "gcs_bridge");
  ros::NodeHandle node;
  const ros::NodeHandle own("~");
  try {
    NodePollLoop loop;
    loop.follow_clock(node, [](const ros::Time& /*now*/) {});
    const trident::mavros::GcsBridge bridge(node, own, loop);
    loop.run();
  } catch (const trident::Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
