// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/router.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "mavlink/packets.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/signing.h"

namespace trident::bridges::mavlink {
namespace {

/// Three peers: two vehicles and a ground station.
struct Net {
  explicit Net(RouterOptions options = {})
      : router(
            options,
            [this](RouterPeer to, Bytes bytes) {
              got[to].push_back({bytes.begin(), bytes.end()});
            },
            [this](const std::string& text) { warnings.push_back(text); }) {
    router.add_peer(1, "udp vehicle 1");
    router.add_peer(2, "udp vehicle 2");
    router.add_peer(9, "tcp ground");
  }
  std::vector<std::uint8_t> send(RouterPeer from, const Message& message) {
    const std::vector<std::uint8_t> packet = testing::packet_of(writers[from], message);
    router.receive(from, packet, true, now);
    return packet;
  }
  void send_command(RouterPeer from, Address target) {
    mavlink_command_long_t payload{};
    payload.target_system = target.system;
    payload.target_component = target.component;
    send(from, pack(payload, {255, 190}));
  }
  void beat() {
    send(1, pack(mavlink_heartbeat_t{}, {1, 1}));
    send(2, pack(mavlink_heartbeat_t{}, {2, 1}));
    send(9, pack(mavlink_heartbeat_t{}, {255, 190}));
    got.clear();
  }
  std::map<RouterPeer, PacketWriter> writers;
  std::map<RouterPeer, std::vector<std::vector<std::uint8_t>>> got;
  std::vector<std::string> warnings;
  Router router;
  SimTime now{1'000'000'000};
};

TEST(Router, WhatIsForAllGoesToAllOthersAsItCame) {
  Net net;
  const auto packet = net.send(1, testing::attitude(1.0F));
  EXPECT_TRUE(net.got[1].empty());
  ASSERT_EQ(net.got[2].size(), 1U);
  EXPECT_EQ(net.got[2][0], packet);
  EXPECT_EQ(net.got[9].size(), 1U);
}

TEST(Router, WhatIsForASystemGoesWhereItWasHeard) {
  Net net;
  net.beat();
  net.send_command(9, {2, 1});
  EXPECT_TRUE(net.got[1].empty());
  EXPECT_EQ(net.got[2].size(), 1U);
  net.send_command(9, {1, 0});
  EXPECT_EQ(net.got[1].size(), 1U);
  net.send_command(9, {1, 154});  // a component that was not heard
  EXPECT_EQ(net.got[1].size(), 2U);
  net.send_command(9, {7, 1});
  EXPECT_EQ(net.router.counts(9)->unknown_target, 1U);
  EXPECT_EQ(net.got[1].size() + net.got[2].size(), 3U);
}

TEST(Router, AListenerAlsoGetsWhatIsForOthersButNothingTwice) {
  Net net;
  net.beat();
  net.router.let_hear_all(2);
  net.got.clear();
  net.send_command(9, {1, 1});
  net.send_command(9, {2, 1});
  net.send_command(9, {7, 1});  // nobody
  net.send_command(2, {1, 1});
  EXPECT_EQ(net.got[2].size(), 3U);
  EXPECT_EQ(net.got[1].size(), 2U);
  net.router.remove_peer(2);
  net.send_command(9, {1, 1});
  EXPECT_EQ(net.got[2].size(), 3U);
}

TEST(Router, IdsExpireAndGoWithTheirPeer) {
  Net net;
  net.beat();
  net.now = net.now + SimTime::from_seconds(50.0);
  net.send(2, pack(mavlink_heartbeat_t{}, {2, 1}));
  net.now = net.now + SimTime::from_seconds(20.0);
  net.router.update(net.now);
  ASSERT_EQ(net.router.routes().size(), 1U);
  EXPECT_EQ(net.router.routes().count({2, 1}), 1U);
  net.router.remove_peer(2);
  EXPECT_TRUE(net.router.routes().empty());
  net.send(2, testing::attitude(1.0F));
  EXPECT_TRUE(net.router.routes().empty());
}

TEST(Router, AnIdThatChangesItsPeerIsNamedButNotAllTheTime) {
  Net net;
  net.beat();
  for (int i = 0; i < 50; ++i) {
    net.send(2, pack(mavlink_heartbeat_t{}, {1, 1}));
    net.send(1, pack(mavlink_heartbeat_t{}, {1, 1}));
  }
  ASSERT_EQ(net.warnings.size(), 1U);
  EXPECT_EQ(net.warnings[0],
            "router: system 1 component 1 was heard from udp vehicle 1, now from udp vehicle 2: "
            "do two have one id?");
}

TEST(Router, SetupSigningGoesNowhereAndSignaturesStay) {
  Net net;
  net.beat();
  mavlink_setup_signing_t setup{};
  setup.target_system = 1;
  net.send(9, pack(setup, {255, 190}));
  setup.target_system = 0;
  net.send(9, pack(setup, {255, 190}));
  EXPECT_TRUE(net.got.empty());
  EXPECT_EQ(net.router.counts(9)->setup_signing, 2U);
  Signing signing({}, nullptr, 5);
  PacketSigner signer(signing, 3);
  net.writers[9] = PacketWriter(&signer);
  const auto packet = net.send(9, testing::attitude(1.0F));
  EXPECT_EQ(net.got[1].back(), packet);
}

TEST(Router, PeersBeyondTheLimitAreRefusedAndNamed) {
  RouterOptions options;
  options.max_peers = 4;
  Net net(options);
  EXPECT_TRUE(net.router.add_peer(10, "tcp fourth"));
  EXPECT_FALSE(net.router.add_peer(10, "tcp fourth again"));
  EXPECT_FALSE(net.router.add_peer(11, "tcp fifth"));
  ASSERT_EQ(net.warnings.size(), 1U);
  EXPECT_EQ(net.warnings[0], "router: tcp fifth is refused: there are 4 peers, legal: up to 4");
}

TEST(Router, PacketsBeyondTheRateAreDroppedAndCounted) {
  RouterOptions options;
  options.max_rate_hz = 100.0;
  Net net(options);
  for (int i = 0; i < 150; ++i) net.send(1, testing::attitude(1.0F));
  EXPECT_EQ(net.router.counts(1)->over_rate, 50U);
  EXPECT_EQ(net.got[9].size(), 100U);
  net.now = net.now + SimTime::from_seconds(0.1);
  for (int i = 0; i < 20; ++i) net.send(1, testing::attitude(1.0F));
  EXPECT_EQ(net.got[9].size(), 110U);
  net.send(2, testing::attitude(1.0F));  // Others have budgets of their own.
  EXPECT_EQ(net.got[9].size(), 111U);
}

TEST(Router, StreamsAreForwardedPacketByPacketAndLossesCounted) {
  Net net;
  PacketWriter writer;
  std::vector<std::uint8_t> stream = testing::packet_of(writer, testing::attitude(1.0F));
  testing::packet_of(writer, testing::attitude(1.0F));  // lost
  testing::append(stream, testing::packet_of(writer, testing::attitude(1.0F)));
  for (const std::uint8_t byte : stream) net.router.receive(1, Bytes(&byte, 1), false, net.now);
  EXPECT_EQ(net.got[9].size(), 2U);
  EXPECT_EQ(net.router.sequences(1)->counts().at({7, 1}).lost, 1U);
  EXPECT_EQ(net.router.parser_counts(1)->packets, 2U);
  EXPECT_EQ(net.router.counts(77), nullptr);
}

}  // namespace
}  // namespace trident::bridges::mavlink
