// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "allocation_count.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"

namespace trident::bridges {
namespace {

// Two endpoints that pass a block to and fro, and how often it has arrived.
struct Rally {
  Rally(EpollLoop& loop, const std::string& server_url, const std::string& client_scheme)
      : server(open(loop, server_url, server_owner)) {
    client = open(loop, client_scheme + std::to_string(server->port()), client_owner);
    while (client_owner.joined == 0) loop.run_once(0.01);
    client->send(client_owner.joined, block);
    server_owner.endpoint = server.get();
    client_owner.endpoint = client.get();
  }
  struct Owner {
    Endpoint* endpoint = nullptr;
    PeerId joined = 0;
    int count = 0;
  };
  static std::unique_ptr<Endpoint> open(EpollLoop& loop, const std::string& url, Owner& owner) {
    EndpointOptions options;
    options.url = url;
    EndpointEvents events;
    events.joined = [&owner](PeerId peer, const std::string&) { owner.joined = peer; };
    events.received = [&owner](PeerId peer, Bytes bytes) {
      ++owner.count;
      owner.endpoint->send(peer, bytes);
    };
    return open_endpoint(options, loop, std::move(events));
  }
  std::array<std::uint8_t, 300> block{};
  Owner server_owner, client_owner;
  std::unique_ptr<Endpoint> server, client;
};

std::size_t allocations_of_a_rally(const std::string& server_url, const std::string& client) {
  EpollLoop loop;
  Rally rally(loop, server_url, client);
  const auto play = [&](int until) {
    while (rally.client_owner.count < until) loop.run_once(0.01);
  };
  play(100);
  return allocations_of([&] { play(1100); });
}

TEST(TransportAllocation, ADatagramTakesNoMemory) {
  EXPECT_EQ(allocations_of_a_rally("udp://@", "udp://@127.0.0.1:"), 0U);
}

TEST(TransportAllocation, ABlockOfTcpTakesNoMemory) {
  EXPECT_EQ(allocations_of_a_rally("tcp-l://", "tcp://127.0.0.1:"), 0U);
}

TEST(TransportAllocation, ADelayedCallTakesNoMemory) {
  EpollLoop loop;
  int calls = 0;
  const auto wait = [&] {
    const int before = calls;
    loop.call_after(0.0, [&calls] { ++calls; });
    while (calls == before) loop.run_once(0.01);
  };
  wait();
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 100; ++i) wait();
            }),
            0U);
}

}  // namespace
}  // namespace trident::bridges
