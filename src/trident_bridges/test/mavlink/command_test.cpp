// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mavlink/lossy_link.h"
#include "mavlink/packets.h"
#include "trident_bridges/mavlink/command_client.h"
#include "trident_bridges/mavlink/command_server.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

using testing::kGround;
using testing::kVehicle;

/// A vehicle that notes what it executes.
struct CommandedVehicle {
  CommandedVehicle()
      : server(
            kVehicle, [this](const Message& m) { sent.push_back(m); },
            [this](const Command& command, SimTime) {
              executed.push_back(command);
              return reply;
            },
            [this](const std::string& reason) { reasons.push_back(reason); }) {}

  void receive(std::uint16_t command, std::uint8_t confirmation = 0, float param1 = 0.0F) {
    mavlink_command_long_t payload{};
    payload.target_system = 1;
    payload.command = command;
    payload.confirmation = confirmation;
    payload.param1 = param1;
    Message message = pack(payload, kGround);
    message.sequence = sequence++;
    server.handle(message, now);
  }
  mavlink_command_ack_t last_ack() const { return unpack<mavlink_command_ack_t>(sent.back()); }

  std::vector<Message> sent;
  std::vector<Command> executed;
  std::vector<std::string> reasons;
  CommandReply reply;
  CommandServer server;
  SimTime now;
  std::uint8_t sequence = 0;
};

TEST(CommandServer, ARepeatedConfirmationIsAnsweredButNotExecutedAgain) {
  CommandedVehicle vehicle;
  vehicle.receive(MAV_CMD_NAV_TAKEOFF, 0);
  vehicle.receive(MAV_CMD_NAV_TAKEOFF, 1);
  vehicle.receive(MAV_CMD_NAV_TAKEOFF, 2);
  EXPECT_EQ(vehicle.executed.size(), 1U);
  EXPECT_EQ(vehicle.sent.size(), 3U);
  EXPECT_EQ(vehicle.last_ack().target_system, kGround.system);
  vehicle.receive(MAV_CMD_NAV_TAKEOFF, 0);
  EXPECT_EQ(vehicle.executed.size(), 2U);
  vehicle.receive(MAV_CMD_NAV_TAKEOFF, 1, 5.0F);  // another command: the first one got lost
  EXPECT_EQ(vehicle.executed.size(), 3U);
}

TEST(CommandServer, ThePacketThatComesTwiceIsExecutedOnce) {
  CommandedVehicle vehicle;
  vehicle.receive(MAV_CMD_COMPONENT_ARM_DISARM);
  --vehicle.sequence;
  vehicle.receive(MAV_CMD_COMPONENT_ARM_DISARM);
  EXPECT_EQ(vehicle.executed.size(), 1U);
  EXPECT_EQ(vehicle.sent.size(), 2U);
}

TEST(CommandServer, ProgressAndEndAreAnsweredToWhoAsked) {
  CommandedVehicle vehicle;
  vehicle.reply = {CommandResult::kInProgress, "", 0};
  vehicle.receive(MAV_CMD_NAV_LAND);
  EXPECT_EQ(vehicle.last_ack().result, MAV_RESULT_IN_PROGRESS);
  vehicle.receive(MAV_CMD_NAV_LAND);
  EXPECT_EQ(vehicle.executed.size(), 1U);
  vehicle.server.progress(MAV_CMD_NAV_LAND, {CommandResult::kInProgress, "", 60}, vehicle.now);
  EXPECT_EQ(vehicle.last_ack().progress, 60);
  EXPECT_TRUE(vehicle.server.is_in_progress(MAV_CMD_NAV_LAND));
  vehicle.server.progress(MAV_CMD_NAV_LAND, {CommandResult::kFailed, "no ground below", 0},
                          vehicle.now);
  EXPECT_EQ(vehicle.last_ack().result, MAV_RESULT_FAILED);
  EXPECT_FALSE(vehicle.server.is_in_progress(MAV_CMD_NAV_LAND));
  EXPECT_EQ(vehicle.reasons, std::vector<std::string>{"no ground below"});
}

TEST(CommandServer, RefusalsComeWithTheirReason) {
  CommandedVehicle vehicle;
  vehicle.reply = {CommandResult::kDenied, "arming refused: battery 12 %, legal: > 20 %", 0};
  vehicle.receive(MAV_CMD_COMPONENT_ARM_DISARM, 0, 1.0F);
  EXPECT_EQ(vehicle.last_ack().result, MAV_RESULT_DENIED);
  EXPECT_EQ(vehicle.reasons[0], "arming refused: battery 12 %, legal: > 20 %");
}

TEST(CommandServer, PlacesOfACommandIntAreDegreesAndMeters) {
  CommandedVehicle vehicle;
  mavlink_command_int_t payload{};
  payload.target_system = 1;
  payload.command = MAV_CMD_DO_REPOSITION;
  payload.frame = MAV_FRAME_GLOBAL;
  payload.x = 473'977'418;
  payload.y = std::numeric_limits<std::int32_t>::max();
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_NEAR(vehicle.executed[0].params[4], 47.3977418, 1e-12);
  EXPECT_TRUE(std::isnan(vehicle.executed[0].params[5]));
  payload.frame = MAV_FRAME_LOCAL_NED;
  payload.x = -25'000;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_EQ(vehicle.executed[1].params[4], -2.5);
  payload.command = MAV_CMD_COMPONENT_ARM_DISARM;
  payload.x = 21196;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_EQ(vehicle.executed[2].params[4], 21196.0);
}

TEST(CommandServer, CommandsForOthersAreNotItsOwn) {
  CommandedVehicle vehicle;
  mavlink_command_long_t payload{};
  payload.target_system = 2;
  EXPECT_FALSE(vehicle.server.handle(pack(payload, kGround), vehicle.now));
  payload.target_system = 0;
  EXPECT_TRUE(vehicle.server.handle(pack(payload, kGround), vehicle.now));
}

/// Both ends and a radio.
struct CommandPair {
  explicit CommandPair(double loss, const std::string& name)
      : link(loss, 0.01, name),
        server(kVehicle, link.from(0),
               [this](const Command& command, SimTime) {
                 executed.push_back(command);
                 return reply;
               },
               {}),
        client(kGround, link.from(1)) {}

  void send(std::uint16_t number) {
    Command command;
    command.command = number;
    command.params[6] = 20.0;
    client.send(kVehicle, command, link.now(),
                [this](const CommandOutcome& end) { outcome = end; });
  }
  double run(double limit_s) {
    return link.run(
        limit_s, [this] { return outcome.has_value(); },
        [this](int end, const Message& message) {
          end == 0 ? server.handle(message, link.now()) : client.handle(message, link.now());
        },
        [this] { client.update(link.now()); });
  }

  testing::LossyLink link;
  std::vector<Command> executed;
  CommandReply reply;
  CommandServer server;
  CommandClient client;
  std::optional<CommandOutcome> outcome;
};

TEST(CommandClient, CommandsAreExecutedOnceUnder30PercentLoss) {
  for (int run = 0; run < 100; ++run) {
    CommandPair pair(0.3, "commands " + std::to_string(run));
    pair.send(MAV_CMD_NAV_TAKEOFF);
    pair.run(20.0);
    ASSERT_TRUE(pair.outcome && pair.outcome->is_answered) << run;
    EXPECT_EQ(pair.outcome->reply.result, CommandResult::kAccepted);
    ASSERT_EQ(pair.executed.size(), 1U) << run;
    EXPECT_EQ(pair.executed[0].params[6], 20.0);
  }
}

TEST(CommandClient, AVehicleThatIsSilentIsNamed) {
  CommandPair pair(1.0, "dead");
  pair.send(MAV_CMD_NAV_LAND);
  EXPECT_NEAR(pair.run(60.0), 5.0, 0.1);
  ASSERT_TRUE(pair.outcome);
  EXPECT_FALSE(pair.outcome->is_answered);
  EXPECT_EQ(pair.outcome->reply.reason, "system 1 did not answer for 5 s");
}

TEST(CommandClient, ACommandInProgressMayTakeLong) {
  CommandPair pair(0.0, "progress");
  pair.reply = {CommandResult::kInProgress, "", 255};
  pair.send(MAV_CMD_NAV_LAND);
  pair.run(20.0);
  EXPECT_FALSE(pair.outcome);
  pair.server.progress(MAV_CMD_NAV_LAND, {}, pair.link.now());
  pair.run(1.0);
  ASSERT_TRUE(pair.outcome);
  EXPECT_EQ(pair.outcome->reply.result, CommandResult::kAccepted);
  EXPECT_EQ(pair.executed.size(), 1U);
}

}  // namespace
}  // namespace trident::bridges::mavlink
