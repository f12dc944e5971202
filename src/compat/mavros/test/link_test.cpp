// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "allocation_count.h"
#include "core/link.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/transport/epoll_loop.h"

namespace trident::mavros {
namespace {

using bridges::EpollLoop;

constexpr double kLimit_s = 20.0;

/// A link on UDP, and a second one as its vehicle.
struct Pair {
  /// `max_peer_rate`: of the second link.
  explicit Pair(double max_peer_rate)
      : far(options("udp://127.0.0.1:0@", max_peer_rate), loop, far_events()),
        near(options("udp://127.0.0.1:0@127.0.0.1:" + port(), 1e6), loop, {}) {}

  LinkOptions options(const std::string& url, double max_peer_rate) {
    LinkOptions result;
    result.fcu_url = url;
    result.max_peer_rate = max_peer_rate;
    return result;
  }
  Link::Events far_events() {
    Link::Events events;
    events.received = [this](const Packet&) { ++heard; };
    events.notice = [this](const std::string& text) { notice = text; };
    return events;
  }
  /// Of "udp 127.0.0.1:PORT: receive buffer ...".
  std::string port() const {
    const std::size_t begin = notice.find(':') + 1;
    return notice.substr(begin, notice.find(':', begin) - begin);
  }
  void send(const Message& message) {
    near.send(message);
    ++sent;
  }
  /// Waits until the second one has heard so many.
  void await(int count) {
    const double begin_s = loop.now_s();
    while (heard < count && loop.now_s() < begin_s + kLimit_s) loop.run_once(kLimit_s);
  }
  /// Sends until something is heard: what is sent before the loop runs has nowhere to go.
  void connect(const Message& message) {
    const double begin_s = loop.now_s();
    while (heard == 0 && loop.now_s() < begin_s + kLimit_s) {
      send(message);
      loop.run_once(0.01);
    }
  }

  EpollLoop loop;
  int sent = 0, heard = 0;
  std::string notice;
  Link far, near;
};

Message odometry() {
  mavlink_odometry_t payload{};
  payload.x = 1.0F;
  payload.estimator_type = MAV_ESTIMATOR_TYPE_VISION;
  return bridges::mavlink::pack(payload, {1, 1});
}

TEST(Link, SaysWhichBuffersItHas) {
  const Pair pair(1e6);
  EXPECT_NE(pair.notice.find("receive buffer"), std::string::npos) << pair.notice;
}

TEST(Link, NothingIsAllocatedForAMessage) {
  Pair pair(1e6);
  const Message message = odometry();
  pair.connect(message);
  const auto exchange = [&](int count) {
    for (int i = 0; i < count; ++i) {
      pair.send(message);
      pair.await(pair.heard + 1);
    }
  };
  exchange(100);
  const int before = pair.heard;
  EXPECT_EQ(allocations_of([&] { exchange(1000); }), 0U);
  EXPECT_EQ(pair.heard, before + 1000);
}

TEST(Link, WhatAPeerSendsTooFastIsDropped) {
  Pair pair(3.0);
  const Message message = odometry();
  pair.connect(message);
  for (int i = 0; i < 50; ++i) pair.send(message);
  for (int i = 0; i < 10; ++i) pair.loop.run_once(0.0);
  EXPECT_GE(pair.heard, 1);
  EXPECT_LT(pair.heard, pair.sent);
}

}  // namespace
}  // namespace trident::mavros
