// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mavlink/lossy_link.h"
#include "mavlink/packets.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/mission_client.h"
#include "trident_bridges/mavlink/mission_server.h"

namespace trident::bridges::mavlink {
namespace {

using testing::kGround;
using testing::kVehicle;

constexpr Address kOther{254, 190};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Mission waypoints(std::size_t count, std::int32_t first_x = 0) {
  Mission mission(count);
  for (std::size_t i = 0; i < count; ++i) {
    mission[i].command = MAV_CMD_NAV_WAYPOINT;
    mission[i].frame = MAV_FRAME_GLOBAL_RELATIVE_ALT;
    mission[i].params[3] = kNan;
    mission[i].x = first_x + static_cast<std::int32_t>(i);
    mission[i].z = 20.0F + static_cast<float>(i);
  }
  return mission;
}

/// A vehicle and a ground station, with a radio between them.
struct MissionPair {
  explicit MissionPair(double loss = 0.0, const std::string& name = "pair", double repeat = 0.0,
                       double delay_s = 0.01)
      : link(loss, delay_s, name, repeat),
        server(kVehicle, link.from(0),
               {{}, {}, {}, {}, [this](const std::string& reason) { reasons.push_back(reason); }}),
        client(kGround, link.from(1), [this](const MissionOutcome& end) { outcome = end; }) {}

  /// Until the transfer has ended; how long it took [s].
  double run(double limit_s = 60.0) {
    return link.run(
        limit_s, [this] { return outcome.has_value(); },
        [this](int end, const Message& message) {
          end == 0 ? server.handle(message, link.now()) : client.handle(message, link.now());
        },
        [this] {
          server.update(link.now());
          client.update(link.now());
        });
  }

  testing::LossyLink link;
  MissionServer server;
  MissionClient client;
  std::vector<std::string> reasons;
  std::optional<MissionOutcome> outcome;
};

TEST(Mission, AnUploadedListIsTheOneThatIsDownloaded) {
  MissionPair pair;
  Mission sent = waypoints(12, -338'000'000);
  sent[3].command = MAV_CMD_DO_JUMP;
  sent[3].frame = MAV_FRAME_MISSION;
  sent[3].params = {2.0F, 3.0F, 0.0F, 0.0F};
  sent[5].is_current = true;
  sent[6].autocontinue = false;
  for (const MissionType type : {MissionType::kMission, MissionType::kRally}) {
    pair.outcome.reset();
    pair.client.upload(kVehicle, type, sent, pair.link.now());
    pair.run();
    ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted());
    EXPECT_EQ(pair.server.mission(type), sent);
    pair.outcome.reset();
    pair.client.download(kVehicle, type, pair.link.now());
    pair.run();
    ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted());
    EXPECT_EQ(pair.outcome->mission, sent);
  }
  EXPECT_TRUE(pair.server.mission(MissionType::kFence).empty());
}

TEST(Mission, EmptyListsPassInBothDirections) {
  MissionPair pair;
  pair.server.set_mission(MissionType::kMission, waypoints(3));
  pair.client.upload(kVehicle, MissionType::kMission, {}, pair.link.now());
  pair.run();
  ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted());
  EXPECT_TRUE(pair.server.mission(MissionType::kMission).empty());
  pair.outcome.reset();
  pair.client.download(kVehicle, MissionType::kMission, pair.link.now());
  pair.run();
  EXPECT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted());
}

TEST(Mission, UploadsAreWholeAndWithin12SecondsUnder30PercentLossInBothDirections) {
  const Mission sent = waypoints(100);
  double longest_s = 0.0;
  for (int run = 0; run < 200; ++run) {
    MissionPair pair(0.3, "lossy " + std::to_string(run), 0.02);
    pair.client.upload(kVehicle, MissionType::kMission, sent, pair.link.now());
    longest_s = std::max(longest_s, pair.run());
    ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted()) << run;
    ASSERT_EQ(pair.server.mission(MissionType::kMission), sent) << run;
  }
  EXPECT_LE(longest_s, 12.0);
}

TEST(Mission, DownloadsAreWholeUnder30PercentLossInBothDirections) {
  for (int run = 0; run < 20; ++run) {
    MissionPair pair(0.3, "download " + std::to_string(run), 0.02);
    pair.server.set_mission(MissionType::kFence, waypoints(100));
    pair.client.download(kVehicle, MissionType::kFence, pair.link.now());
    EXPECT_LE(pair.run(), 12.0);
    ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted()) << run;
    EXPECT_EQ(pair.outcome->mission, waypoints(100)) << run;
  }
}

TEST(Mission, ALongDelayIsNoReasonToAskAllTheTime) {
  MissionPair pair(0.0, "slow", 0.0, 0.4);
  pair.client.upload(kVehicle, MissionType::kMission, waypoints(50), pair.link.now());
  pair.run(120.0);
  ASSERT_TRUE(pair.outcome && pair.outcome->verdict.is_accepted());
  EXPECT_LT(pair.link.sent(), 2 * 102U + 100U);
}

/// A vehicle alone, fed by hand.
struct MissionVehicle {
  explicit MissionVehicle(MissionServerEvents events = {})
      : server(
            kVehicle, [this](const Message& m) { sent.push_back(m); }, with_reasons(events)) {}
  MissionServerEvents with_reasons(MissionServerEvents events) {
    events.refused = [this](const std::string& reason) { reasons.push_back(reason); };
    events.changed = [this](MissionType) { ++changes; };
    return events;
  }

  void count(std::uint16_t items, Address from = kGround, std::uint8_t type = 0) {
    mavlink_mission_count_t payload{};
    payload.target_system = kVehicle.system;
    payload.count = items;
    payload.mission_type = type;
    server.handle(pack(payload, from), now);
  }
  void item(std::uint16_t sequence, std::int32_t x = 1, Address from = kGround,
            std::uint8_t type = 0, float z = 10.0F) {
    mavlink_mission_item_int_t payload{};
    payload.target_system = kVehicle.system;
    payload.seq = sequence;
    payload.command = MAV_CMD_NAV_WAYPOINT;
    payload.frame = MAV_FRAME_GLOBAL_INT;
    payload.x = x;
    payload.z = z;
    payload.mission_type = type;
    server.handle(pack(payload, from), now);
  }
  void partial(std::int16_t first, std::int16_t last) {
    mavlink_mission_write_partial_list_t payload{};
    payload.target_system = kVehicle.system;
    payload.start_index = first;
    payload.end_index = last;
    server.handle(pack(payload, kGround), now);
  }
  void wait(double seconds) {
    for (int i = 0; i < 20 * seconds; ++i) {
      now = now + SimTime::from_seconds(0.05);
      server.update(now);
    }
  }
  /// Result of the last message, if it is a MISSION_ACK.
  std::optional<MissionResult> last_ack() const {
    if (sent.empty() || !is<mavlink_mission_ack_t>(sent.back())) return std::nullopt;
    return static_cast<MissionResult>(unpack<mavlink_mission_ack_t>(sent.back()).type);
  }
  const Mission& mission() const { return server.mission(MissionType::kMission); }

  std::vector<Message> sent;
  std::vector<std::string> reasons;
  int changes = 0;
  MissionServer server;
  SimTime now;
};

TEST(MissionServer, AfterACountAndSilenceTheOldMissionStays) {
  MissionVehicle vehicle;
  vehicle.server.set_mission(MissionType::kMission, waypoints(3));
  vehicle.count(5);
  vehicle.item(0);
  vehicle.wait(6.0);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kCancelled);
  EXPECT_FALSE(vehicle.server.is_busy());
  EXPECT_EQ(vehicle.mission(), waypoints(3));
  EXPECT_EQ(vehicle.changes, 0);
  ASSERT_EQ(vehicle.reasons.size(), 1U);
  EXPECT_EQ(vehicle.reasons[0],
            "upload ended: mission item 1 of 5 did not come for 5 s; the old one stays");
}

TEST(MissionServer, ItemsOfAnotherListOrPartnerDoNotGetIn) {
  MissionVehicle vehicle;
  vehicle.count(2);
  vehicle.item(0, 11, kGround, 1);
  vehicle.item(0, 12, kOther);
  vehicle.item(0, 13);
  vehicle.item(0, 14);
  vehicle.item(1, 15);
  ASSERT_EQ(vehicle.mission().size(), 2U);
  EXPECT_EQ(vehicle.mission()[0].x, 13);
  EXPECT_EQ(vehicle.mission()[1].x, 15);
  EXPECT_EQ(vehicle.changes, 1);
}

TEST(MissionServer, ASecondPartnerWaitsUntilTheFirstHasEnded) {
  MissionVehicle vehicle;
  vehicle.count(2);
  vehicle.count(1, kOther);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kDenied);
  vehicle.item(0);
  vehicle.item(1);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kAccepted);
  vehicle.count(1, kOther);
  vehicle.item(0, 9, kOther);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kAccepted);
  EXPECT_EQ(vehicle.mission().size(), 1U);
}

TEST(MissionServer, NegativeAndTooLargeIndicesAreRefused) {
  MissionVehicle vehicle;
  vehicle.server.set_mission(MissionType::kMission, waypoints(3));
  vehicle.count(2);
  vehicle.item(static_cast<std::uint16_t>(-1));
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kInvalidSequence);
  for (const auto& [first, last] : {std::pair{-1, 1}, std::pair{2, 1}, std::pair{1, 3}}) {
    vehicle.partial(static_cast<std::int16_t>(first), static_cast<std::int16_t>(last));
    EXPECT_EQ(vehicle.last_ack(), MissionResult::kInvalidSequence) << first << ' ' << last;
  }
  EXPECT_EQ(vehicle.mission(), waypoints(3));
}

TEST(MissionServer, APartOfAListIsReplacedWholeOrNotAtAll) {
  MissionVehicle vehicle;
  vehicle.server.set_mission(MissionType::kMission, waypoints(4));
  vehicle.partial(1, 2);
  vehicle.item(1, 77);
  EXPECT_EQ(vehicle.mission(), waypoints(4));
  vehicle.item(2, 78);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kAccepted);
  ASSERT_EQ(vehicle.mission().size(), 4U);
  EXPECT_EQ(vehicle.mission()[0].x, 0);
  EXPECT_EQ(vehicle.mission()[1].x, 77);
  EXPECT_EQ(vehicle.mission()[2].x, 78);
  EXPECT_EQ(vehicle.mission()[3].x, 3);
}

TEST(MissionServer, PlacesThatAreNoPlacesAreRefused) {
  struct Row {
    std::int32_t x;
    float z;
    MissionResult result;
  };
  for (const Row& row : {Row{1, kNan, MissionResult::kInvalidParam7},
                         Row{1, INFINITY, MissionResult::kInvalidParam7},
                         Row{900'000'001, 1.0F, MissionResult::kInvalidParam5},
                         Row{INT32_MAX, 1.0F, MissionResult::kInvalidParam5},
                         Row{INT32_MIN, 1.0F, MissionResult::kInvalidParam5}}) {
    MissionVehicle vehicle;
    vehicle.count(1);
    vehicle.item(0, row.x, kGround, 0, row.z);
    EXPECT_EQ(vehicle.last_ack(), row.result);
    EXPECT_TRUE(vehicle.mission().empty());
  }
  MissionVehicle vehicle;
  vehicle.count(1);
  mavlink_mission_item_t payload{};
  payload.target_system = kVehicle.system;
  payload.command = MAV_CMD_NAV_WAYPOINT;
  payload.y = kNan;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kInvalidParam6);
}

TEST(MissionServer, ListsOfUpTo2000ItemsHavePlace) {
  MissionVehicle vehicle;
  vehicle.count(2001);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kNoSpace);
  EXPECT_EQ(vehicle.reasons.back(), "mission of 2001 items, legal: up to 2000");
  vehicle.count(2000);
  EXPECT_TRUE(vehicle.server.is_busy());
  vehicle.count(1, kGround, 7);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kUnsupported);
}

TEST(MissionServer, WhatTheVehicleRefusesKeepsTheOldList) {
  MissionServerEvents events;
  events.check_item = [](MissionType, std::size_t, const MissionItem& item) {
    return item.x == 66 ? MissionVerdict{MissionResult::kUnsupported, "66 is not flown"}
                        : MissionVerdict{};
  };
  events.check_mission = [](MissionType, const Mission& mission) {
    return mission.size() == 2 ? MissionVerdict{MissionResult::kInvalid, "2 are no mission"}
                               : MissionVerdict{};
  };
  MissionVehicle vehicle(events);
  vehicle.server.set_mission(MissionType::kMission, waypoints(5));
  vehicle.count(3);
  vehicle.item(0);
  vehicle.item(1, 66);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kUnsupported);
  EXPECT_EQ(vehicle.reasons.back(), "mission item 1: 66 is not flown");
  vehicle.count(2);
  vehicle.item(0);
  vehicle.item(1);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kInvalid);
  EXPECT_EQ(vehicle.mission(), waypoints(5));
}

TEST(MissionServer, AReaderGetsTheListThatWasThereWhenHeBegan) {
  MissionVehicle vehicle;
  vehicle.server.set_mission(MissionType::kMission, waypoints(2, 100));
  mavlink_mission_request_list_t list{};
  list.target_system = kVehicle.system;
  vehicle.server.handle(pack(list, kGround), vehicle.now);
  vehicle.server.set_mission(MissionType::kMission, waypoints(1, 500));
  mavlink_mission_request_int_t request{};
  request.target_system = kVehicle.system;
  request.seq = 1;
  vehicle.server.handle(pack(request, kGround), vehicle.now);
  ASSERT_TRUE(is<mavlink_mission_item_int_t>(vehicle.sent.back()));
  EXPECT_EQ(unpack<mavlink_mission_item_int_t>(vehicle.sent.back()).x, 101);
  vehicle.server.handle(pack(request, kOther), vehicle.now);
  EXPECT_EQ(vehicle.last_ack(), MissionResult::kInvalidSequence);
}

TEST(MissionServer, APartnerWithoutItemIntIsAskedInTheOldForm) {
  MissionVehicle vehicle;
  vehicle.count(2);
  vehicle.wait(1.2);
  const auto asked_old =
      std::count_if(vehicle.sent.begin(), vehicle.sent.end(),
                    [](const Message& m) { return is<mavlink_mission_request_t>(m); });
  EXPECT_GE(asked_old, 1);
  mavlink_mission_item_t payload{};
  payload.target_system = kVehicle.system;
  payload.command = MAV_CMD_NAV_WAYPOINT;
  payload.frame = MAV_FRAME_GLOBAL;
  payload.x = 47.5F;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_TRUE(is<mavlink_mission_request_t>(vehicle.sent.back()));
  payload.seq = 1;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  ASSERT_EQ(vehicle.mission().size(), 2U);
  EXPECT_EQ(vehicle.mission()[0].x, 475'000'000);
}

TEST(MissionServer, ClearingOneListLeavesTheOthers) {
  MissionVehicle vehicle;
  for (const MissionType type : {MissionType::kMission, MissionType::kFence}) {
    vehicle.server.set_mission(type, waypoints(2));
  }
  mavlink_mission_clear_all_t payload{};
  payload.target_system = kVehicle.system;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_TRUE(vehicle.mission().empty());
  EXPECT_EQ(vehicle.server.mission(MissionType::kFence).size(), 2U);
  payload.mission_type = kAllMissionTypes;
  vehicle.server.handle(pack(payload, kGround), vehicle.now);
  EXPECT_TRUE(vehicle.server.mission(MissionType::kFence).empty());
}

TEST(MissionServer, MessagesForOthersAreNotItsOwn) {
  MissionVehicle vehicle;
  mavlink_mission_count_t payload{};
  payload.target_system = 2;
  EXPECT_FALSE(vehicle.server.handle(pack(payload, kGround), vehicle.now));
  EXPECT_FALSE(vehicle.server.handle(pack(mavlink_heartbeat_t{}, kGround), vehicle.now));
  payload.target_system = 1;
  payload.target_component = MAV_COMP_ID_MISSIONPLANNER;
  EXPECT_TRUE(vehicle.server.handle(pack(payload, kGround), vehicle.now));
}

TEST(MissionClient, AVehicleThatIsSilentIsNamed) {
  MissionPair pair(1.0, "dead");
  pair.client.upload({9, 1}, MissionType::kFence, waypoints(2), pair.link.now());
  EXPECT_NEAR(pair.run(), 10.0, 0.1);
  ASSERT_TRUE(pair.outcome);
  EXPECT_EQ(pair.outcome->verdict.reason, "fence: the first answer: system 9 was silent for 10 s");
}

TEST(MissionClient, ARefusalEndsAnUploadWithTheVehiclesAnswer) {
  MissionPair pair;
  Mission mission = waypoints(4);
  mission[2].x = 950'000'000;
  pair.client.upload(kVehicle, MissionType::kMission, mission, pair.link.now());
  pair.run();
  ASSERT_TRUE(pair.outcome);
  EXPECT_EQ(pair.outcome->verdict.result, MissionResult::kInvalidParam5);
  EXPECT_EQ(pair.reasons.back(), "mission item 2: latitude 95.000000 deg, legal: +-90");
}

}  // namespace
}  // namespace trident::bridges::mavlink
