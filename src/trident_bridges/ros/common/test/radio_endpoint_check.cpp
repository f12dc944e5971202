// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// A part of node_poll_loop_check: partner_node.py is the air between the radios of a and b.
#include "trident_bridges_ros/radio_endpoint.h"

#include <gtest/gtest.h>
#include <trident_msgs/RadioPacket.h>

#include <map>
#include <vector>

#include "poll_loop_test.h"
#include "trident_base/error.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {
namespace {

std::string refusal_of(const std::string& url) {
  try {
    parse_radio_url(url);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RadioUrl, RobotDestinationTopicAndQueryAreRead) {
  const RadioUrl url = parse_radio_url("radio://uav1@gcs/mavlink?priority=2&deadline=0.5");
  EXPECT_EQ(url.robot, "uav1");
  EXPECT_EQ(url.destination, "gcs");
  EXPECT_EQ(url.topic, "mavlink");
  EXPECT_EQ(url.priority, 2);
  EXPECT_DOUBLE_EQ(url.deadline_s, 0.5);
  EXPECT_EQ(parse_radio_url("radio://uav1@all").destination, "");
  const RadioUrl own = parse_radio_url("radio:gcs");
  EXPECT_EQ(own.robot, "");
  EXPECT_EQ(own.destination, "gcs");
  EXPECT_EQ(own.topic, "bridge");
}

TEST(RadioUrl, AnErrorNamesTheFieldAndItsRange) {
  EXPECT_NE(refusal_of("radio://@gcs").find("robot is missing"), std::string::npos);
  EXPECT_NE(refusal_of("radio:gcs?priority=4").find("[0, 3]"), std::string::npos);
  EXPECT_NE(refusal_of("radio:gcs?dead_line=1").find("did you mean 'deadline'"), std::string::npos);
}

struct Radio {
  Radio(const std::string& url, NodePollLoop& loop, ros::NodeHandle& node,
        std::uint32_t max_peers = 16) {
    EndpointOptions options;
    options.url = url;
    options.max_peers = max_peers;
    EndpointEvents events;
    events.joined = [this](PeerId peer, const std::string& robot) { joined[robot] = peer; };
    events.received = [this](PeerId, Bytes bytes) { heard.assign(bytes.begin(), bytes.end()); };
    events.warning = [this](const std::string& text) { warnings.push_back(text); };
    endpoint = open_node_endpoint(options, loop, node, events);
  }
  void send(const std::string& text) const {
    endpoint->send_to_all({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  std::map<std::string, PeerId> joined;
  std::string heard;
  std::vector<std::string> warnings;
  std::unique_ptr<Endpoint> endpoint;
};

class RadioEndpointTest : public PollLoopTest {};

TEST_F(RadioEndpointTest, ARobotAnswersTheOneThatItHasHeard) {
  Radio a("radio://a@b/mavlink", loop_, node_);
  Radio b("radio://b/mavlink", loop_, node_);
  ASSERT_TRUE(spin([&] {
    if (b.heard.empty()) a.send("question");  // the air may still be connecting
    return b.heard == "question";
  }));
  EXPECT_EQ(a.joined, (std::map<std::string, PeerId>{{"b", 1}}));
  ASSERT_EQ(b.joined, (std::map<std::string, PeerId>{{"a", 1}}));
  const std::string answer = "answer";
  ASSERT_TRUE(spin([&] {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(answer.data());
    if (a.heard.empty()) EXPECT_TRUE(b.endpoint->send(1, {data, answer.size()}));
    return a.heard == "answer";
  }));
  EXPECT_GE(a.endpoint->counts().received, 1U);
}

TEST_F(RadioEndpointTest, ABlockThatIsTooLongIsCut) {
  Radio a("radio://a@b/nmea", loop_, node_);
  a.send(std::string(9'997, 'x'));
  ASSERT_EQ(a.warnings.size(), 1U);
  EXPECT_NE(a.warnings[0].find("legal: up to 9996"), std::string::npos);
  EXPECT_EQ(a.endpoint->counts().cut, 1U);
}

TEST_F(RadioEndpointTest, PacketsOfAnotherTopicAndPeersBeyondTheLimitAreNotHeard) {
  Radio c("radio://c/mavlink", loop_, node_, 1);
  NodePublisher<trident_msgs::RadioPacket> air(node_, "/c/radio/receive");
  const auto deliver = [&](const std::string& source, const std::string& topic,
                           const std::string& text) {
    trident_msgs::RadioPacket packet;
    packet.source = source;
    packet.topic = topic;
    packet.data.assign(text.begin(), text.end());
    air.publish(packet);
  };
  ASSERT_TRUE(spin([&] { return air.subscribers() > 0; }));
  deliver("a", "nmea", "another topic");
  deliver("a", "mavlink", "first");
  deliver("b", "mavlink", "refused");
  deliver("a", "mavlink", "last");
  ASSERT_TRUE(spin([&] { return c.heard == "last"; }));
  EXPECT_EQ(c.endpoint->counts().received, 2U);
  EXPECT_EQ(c.endpoint->counts().refused_peers, 1U);
  EXPECT_EQ(c.joined, (std::map<std::string, PeerId>{{"a", 1}}));
}

}  // namespace
}  // namespace trident::bridges
