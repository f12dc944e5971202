// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "running_loop.h"
#include "transport/udp_peers.h"

namespace trident::bridges {
namespace {

std::string url_to(const Recorded& server) {
  return "udp://@127.0.0.1:" + std::to_string(server.endpoint->port());
}

EndpointOptions learning() { return Recorded::options_of("udp://@"); }

SocketAddress address(std::uint16_t port) { return resolve("", "127.0.0.1", port); }

TEST(Udp, DatagramsGoToTheGivenPeerAndBackToTheLearntOne) {
  EpollLoop loop;
  Recorded server(loop, "udp://127.0.0.1@");
  Recorded client(loop, url_to(server));
  ASSERT_TRUE(run_until(loop, [&] { return client.has_joined(); }));
  EXPECT_EQ(client.endpoint->send_to_all(bytes_of("question")), 1);
  ASSERT_TRUE(run_until(loop, [&] { return !server.blocks.empty(); }));
  EXPECT_EQ(server.blocks[0], "question");
  EXPECT_EQ(server.joined.at(server.newest),
            "127.0.0.1:" + std::to_string(client.endpoint->port()));
  EXPECT_TRUE(server.endpoint->send(server.newest, bytes_of("answer")));
  ASSERT_TRUE(run_until(loop, [&] { return !client.blocks.empty(); }));
  EXPECT_EQ(client.text.at(1), "answer");
  EXPECT_EQ(client.joined.size(), 1U);
  EXPECT_EQ(server.endpoint->peers().size(), 1U);
}

TEST(Udp, ABatchArrivesInOrderAndIsCounted) {
  EpollLoop loop;
  Recorded server(loop, "udp://@");
  Recorded client(loop, url_to(server));
  std::vector<std::string> texts;
  for (int i = 0; i < 100; ++i) texts.push_back("datagram " + std::to_string(i));
  std::vector<Bytes> blocks;
  for (const std::string& text : texts) blocks.push_back(bytes_of(text));
  EXPECT_EQ(client.endpoint->send_batch(1, blocks), 100);
  ASSERT_TRUE(run_until(loop, [&] { return server.blocks.size() == 100; }));
  EXPECT_EQ(server.blocks, texts);
  EXPECT_EQ(client.endpoint->counts().sent, 100U);
  EXPECT_EQ(server.endpoint->counts().received, 100U);
  EXPECT_EQ(server.endpoint->counts().received_bytes, client.endpoint->counts().sent_bytes);
}

TEST(Udp, TheLongestDatagramPassesAndALongerOneIsCut) {
  EpollLoop loop;
  Recorded server(loop, "udp://@");
  Recorded client(loop, url_to(server));
  const std::string longest(65'507, 'x');
  EXPECT_FALSE(client.endpoint->send(1, bytes_of(longest + "x")));
  EXPECT_TRUE(client.endpoint->send(1, bytes_of(longest)));
  ASSERT_TRUE(run_until(loop, [&] { return !server.blocks.empty(); }));
  EXPECT_EQ(server.blocks[0].size(), longest.size());
  EXPECT_EQ(client.endpoint->counts().cut, 1U);
  EXPECT_NE(client.warnings.at(0).find("65508 bytes"), std::string::npos);
}

TEST(Udp, PeersBeyondTheLimitAreRefusedAndCounted) {
  EpollLoop loop;
  EndpointOptions options = learning();
  options.max_peers = 2;
  Recorded server(loop, options);
  std::vector<std::unique_ptr<Recorded>> clients;
  for (int i = 0; i < 4; ++i) {
    clients.push_back(std::make_unique<Recorded>(loop, url_to(server)));
    clients.back()->endpoint->send(1, bytes_of(std::to_string(i)));
  }
  ASSERT_TRUE(run_until(loop, [&] { return server.endpoint->counts().refused_peers == 2; }));
  EXPECT_EQ(server.blocks, (std::vector<std::string>{"0", "1"}));
  EXPECT_EQ(server.warnings.size(), 1U);
  EXPECT_EQ(server.endpoint->send_to_all(bytes_of("all")), 2);
}

TEST(Udp, ASilentPeerThatWasLearntIsForgotten) {
  EpollLoop loop;
  EndpointOptions options = learning();
  options.peer_timeout_s = 0.02;
  Recorded server(loop, options);
  Recorded client(loop, url_to(server));
  client.endpoint->send(1, bytes_of("x"));
  ASSERT_TRUE(run_until(loop, [&] { return !server.left.empty(); }));
  EXPECT_EQ(server.left.at(1), "silent for longer than its limit");
  EXPECT_FALSE(server.endpoint->send(1, bytes_of("y")));
}

TEST(Udp, AFloodIsLimitedPerPeer) {
  EpollLoop loop;
  EndpointOptions options = learning();
  options.max_peer_rate = 10.0;
  Recorded server(loop, options);
  Recorded flood(loop, url_to(server)), calm(loop, url_to(server));
  for (int i = 0; i < 200; ++i) flood.endpoint->send(1, bytes_of("flood"));
  calm.endpoint->send(1, bytes_of("calm"));
  ASSERT_TRUE(run_until(loop, [&] { return server.text.size() == 2; }));
  const EndpointCounts counts = server.endpoint->counts();
  EXPECT_GE(counts.limited, 1U);
  EXPECT_EQ(counts.limited + counts.received, 201U);
  EXPECT_EQ(counts.lost(), counts.limited);
}

TEST(Udp, WhatTheKernelDropsIsCounted) {
  EpollLoop loop;
  EndpointOptions options = learning();
  options.socket_buffer = 4096;
  Recorded server(loop, options);
  Recorded client(loop, url_to(server));
  const std::string block(500, 'x');
  for (int i = 0; i < 300; ++i) client.endpoint->send(1, bytes_of(block));
  ASSERT_TRUE(run_until(loop, [&] { return !server.blocks.empty(); }));
  client.endpoint->send(1, bytes_of("last"));
  ASSERT_TRUE(run_until(loop, [&] { return server.blocks.back() == "last"; }));
  EXPECT_GT(server.endpoint->counts().kernel_drops, 0U);
  EXPECT_EQ(server.endpoint->counts().received + server.endpoint->counts().lost(), 301U);
}

TEST(Udp, OnlyLoopbackIsBoundOrSentToUnlessRemoteIsAllowed) {
  EXPECT_EQ(refusal_of(Recorded::options_of("udp://0.0.0.0:0@")),
            "url 'udp://0.0.0.0:0@': bind 0.0.0.0:0 is not loopback; legal: 127.0.0.0/8 or ::1, "
            "unless allow_remote is true");
  EXPECT_NE(refusal_of(Recorded::options_of("udp://@10.0.0.1:14550")).find("host 10.0.0.1:14550"),
            std::string::npos);
  EXPECT_NE(refusal_of(Recorded::options_of("udp-b://@:14550")).find("255.255.255.255"),
            std::string::npos);
  EpollLoop loop;
  EndpointOptions options = Recorded::options_of("udp://0.0.0.0:0@10.0.0.1:14550");
  options.allow_remote = true;
  const Recorded remote(loop, options);
  ASSERT_EQ(remote.notices.size(), 1U);
  EXPECT_NE(remote.notices[0].find("sends to 10.0.0.1:14550"), std::string::npos);
  EXPECT_NE(remote.notices[0].find("other machines can reach it"), std::string::npos);
  EXPECT_NE(remote.notices[0].find("receive buffer"), std::string::npos);
}

TEST(Udp, BroadcastLastsUntilAPeerAnswers) {
  // Broadcast of the loopback network. A socket that is bound to 127.0.0.1 does not hear it.
  EpollLoop loop;
  EndpointOptions all = Recorded::options_of("udp://0.0.0.0:0@");
  all.allow_remote = true;
  Recorded server(loop, all);
  const std::string port = std::to_string(server.endpoint->port());
  Recorded client(loop, "udp-b://@127.255.255.255:" + port);
  EXPECT_EQ(client.endpoint->send_to_all(bytes_of("who")), 1);
  ASSERT_TRUE(run_until(loop, [&] { return !server.blocks.empty(); }));
  EXPECT_TRUE(server.endpoint->send(server.newest, bytes_of("me")));
  ASSERT_TRUE(run_until(loop, [&] { return !client.blocks.empty(); }));
  EXPECT_EQ(client.endpoint->peers().size(), 2U);
  EXPECT_EQ(client.endpoint->send_to_all(bytes_of("you")), 1);
  ASSERT_TRUE(run_until(loop, [&] { return server.blocks.size() == 2; }));
}

TEST(Udp, AHostNeedsAPort) {
  EXPECT_NE(refusal_of(Recorded::options_of("udp://@127.0.0.1")).find("host port is missing"),
            std::string::npos);
  EndpointOptions options = Recorded::options_of("udp://@127.0.0.1");
  options.default_port = 14557;
  EXPECT_EQ(refusal_of(options), "");
}

TEST(Udp, APortThatIsTakenIsAnError) {
  EpollLoop loop;
  const Recorded first(loop, "udp://@");
  const std::string url = "udp://:" + std::to_string(first.endpoint->port()) + "@";
  EXPECT_NE(refusal_of(Recorded::options_of(url)).find("Address already in use"),
            std::string::npos);
}

TEST(UdpPeers, TheRateIsThatOfASecond) {
  TokenBucket bucket(10.0);
  int taken = 0;
  for (int i = 0; i < 100; ++i) taken += bucket.take(100.0) ? 1 : 0;
  EXPECT_EQ(taken, 10);
  EXPECT_FALSE(bucket.take(100.05));
  EXPECT_TRUE(bucket.take(100.11));
  EXPECT_FALSE(bucket.take(100.11));
}

TEST(UdpPeers, AGivenPeerIsNeverForgotten) {
  UdpPeers peers({2, 10.0, 5.0});
  const PeerId given = peers.add(address(1));
  ASSERT_NE(peers.learn(address(2), 1.0), nullptr);
  EXPECT_EQ(peers.learn(address(3), 1.0), nullptr);
  std::vector<PeerId> gone;
  peers.expire(6.0, [&](PeerId id) { gone.push_back(id); });
  EXPECT_TRUE(gone.empty());
  peers.expire(6.1, [&](PeerId id) { gone.push_back(id); });
  EXPECT_EQ(gone, std::vector<PeerId>{2});
  EXPECT_NE(peers.find(given), nullptr);
  ASSERT_NE(peers.learn(address(2), 7.0), nullptr);
  EXPECT_EQ(peers.find(address(2))->id, 3U);
}

}  // namespace
}  // namespace trident::bridges
