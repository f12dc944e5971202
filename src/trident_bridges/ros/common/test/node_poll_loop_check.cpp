// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Talks to partner_node.py; run by test_node_poll_loop.py.
#include <gtest/gtest.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <trident_msgs/WindReading.h>

#include <atomic>
#include <thread>
#include <vector>

#include "poll_loop_test.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {
namespace {

class NodePollLoopTest : public PollLoopTest {};

TEST_F(NodePollLoopTest, ATopicAndAnEndpointAreServedByOneThread) {
  const auto thread = std::this_thread::get_id();
  EndpointOptions options;
  options.url = "udp://@";
  EndpointEvents server_events;
  std::string heard;
  server_events.received = [&](PeerId, Bytes bytes) {
    EXPECT_EQ(std::this_thread::get_id(), thread);
    heard.assign(bytes.begin(), bytes.end());
  };
  const auto server = open_endpoint(options, loop_.loop(), server_events);
  options.url = "udp://@127.0.0.1:" + std::to_string(server->port());
  const auto client = open_endpoint(options, loop_.loop(), {});
  NodePublisher<std_msgs::String> question(node_, "question");
  const auto answer =
      loop_.subscribe<std_msgs::String>(node_, "answer", 10, [&](const std_msgs::String& message) {
        EXPECT_EQ(std::this_thread::get_id(), thread);
        const auto* const data = reinterpret_cast<const std::uint8_t*>(message.data.data());
        client->send_to_all({data, message.data.size()});
      });
  ASSERT_TRUE(spin([&] { return question.subscribers() > 0 && answer->publishers() > 0; }));
  std_msgs::String message;
  message.data = "to and fro";
  ASSERT_TRUE(spin([&] {
    if (heard.empty()) question.publish(message);  // the echo may still be connecting
    return heard == message.data;
  }));
}

TEST_F(NodePollLoopTest, AServiceIsServedByTheLoop) {
  ros::NodeHandle rare = loop_.served(node_);
  const auto thread = std::this_thread::get_id();
  using Service = std_srvs::SetBool;
  const ros::ServiceServer server = rare.advertiseService<Service::Request, Service::Response>(
      "switch", [&](Service::Request& request, Service::Response& response) {
        response.success = request.data != 0 && std::this_thread::get_id() == thread;
        return true;
      });
  std::atomic<bool> has_answer{false}, is_good{false};
  std::thread caller([&] {
    Service service;
    service.request.data = 1;
    is_good = ros::service::call("switch", service) && service.response.success != 0;
    has_answer = true;
  });
  EXPECT_TRUE(spin([&] { return has_answer.load(); }));
  caller.join();
  EXPECT_TRUE(is_good);
}

TEST_F(NodePollLoopTest, TheTimeFollowsTheClock) {
  ros::Time seen;
  ASSERT_TRUE(loop_.follow_clock(node_, [&](const ros::Time& time) { seen = time; }));
  ASSERT_TRUE(spin([&] { return seen > ros::Time(5, 0); }));
  EXPECT_EQ(ros::Time::now(), seen);
}

TEST_F(NodePollLoopTest, APublisherNumbersItsMessages) {
  std::vector<std::uint32_t> numbers;
  const auto back = loop_.subscribe<std_msgs::UInt32>(
      node_, "numbers", 100,
      [&](const std_msgs::UInt32& message) { numbers.push_back(message.data); });
  NodePublisher<trident_msgs::WindReading> numbered(node_, "numbered");
  EXPECT_EQ(numbered.topic(), "/numbered");
  ASSERT_TRUE(spin([&] { return numbered.subscribers() > 0 && back->publishers() > 0; }));
  // The answering end may still be connecting.
  ASSERT_TRUE(spin([&] {
    if (numbers.empty()) numbered.publish(trident_msgs::WindReading());
    return !numbers.empty();
  }));
  const std::uint32_t first = numbers.front();
  ASSERT_TRUE(spin([&] {
    numbered.publish(trident_msgs::WindReading());
    return numbers.size() >= 5;
  }));
  for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], first + i);
}

TEST_F(NodePollLoopTest, NothingIsSentForNobody) {
  NodePublisher<std_msgs::String> nobody(node_, "nobody");
  EXPECT_EQ(nobody.subscribers(), 0U);
  nobody.publish(std_msgs::String());
}

}  // namespace
}  // namespace trident::bridges

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  trident::bridges::init_node(argc, argv, "node_poll_loop_check");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
