// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Streams, heartbeats, time, texts and the small services.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mavlink/packets.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/heartbeat_monitor.h"
#include "trident_bridges/mavlink/message_streams.h"
#include "trident_bridges/mavlink/small_services.h"
#include "trident_bridges/mavlink/status_text.h"
#include "trident_bridges/mavlink/timesync.h"

namespace trident::bridges::mavlink {
namespace {

using testing::kGround;
using testing::kVehicle;

SimTime at(double seconds) { return SimTime::from_seconds(seconds); }

/// A vehicle's streams, which count what they send.
struct Streams {
  Streams()
      : streams(
            kVehicle, [this](const Message& m) { sent.push_back(m); }, vehicle_stream_rates(false),
            [this](std::uint32_t id) {
              ++emitted[id];
              return id != MAVLINK_MSG_ID_DISTANCE_SENSOR &&
                     id != MAVLINK_MSG_ID_COMPONENT_METADATA;
            }) {}
  /// Counts of what `seconds` of steps of 4 ms send.
  std::map<std::uint32_t, int> run(double seconds) {
    emitted.clear();
    for (int i = 0; i < std::lround(250 * seconds); ++i) {
      streams.update(now);
      now = now + SimTime{4'000'000};
    }
    return emitted;
  }
  CommandReply set(double id, double interval_us) {
    Command command;
    command.command = MAV_CMD_SET_MESSAGE_INTERVAL;
    command.params = {id, interval_us};
    return *streams.execute(command, now);
  }
  std::vector<Message> sent;
  std::map<std::uint32_t, int> emitted;
  MessageStreams streams;
  SimTime now;
};

TEST(MessageStreams, DefaultsAreSentAtTheirRatesInSimulatedTime) {
  Streams vehicle;
  const auto counts = vehicle.run(10.0);
  for (const StreamRate& rate : vehicle_stream_rates(false)) {
    const auto it = counts.find(rate.id);
    EXPECT_EQ(it == counts.end() ? 0 : it->second, static_cast<int>(10 * rate.rate_hz)) << rate.id;
  }
}

TEST(MessageStreams, Px4RepeatsItsHome) {
  for (const bool is_px4 : {true, false}) {
    for (const StreamRate& rate : vehicle_stream_rates(is_px4)) {
      if (rate.id != MAVLINK_MSG_ID_HOME_POSITION) continue;
      EXPECT_EQ(rate.rate_hz, is_px4 ? 0.5 : 0.0);
    }
  }
}

TEST(MessageStreams, IntervalsAreSetReadAndReset) {
  Streams vehicle;
  EXPECT_EQ(vehicle.set(MAVLINK_MSG_ID_ODOMETRY, 20'000).result, CommandResult::kAccepted);
  EXPECT_EQ(vehicle.set(MAVLINK_MSG_ID_ATTITUDE, -1).result, CommandResult::kAccepted);
  auto counts = vehicle.run(2.0);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_ODOMETRY], 100);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_ATTITUDE], 0);
  Command get;
  get.command = MAV_CMD_GET_MESSAGE_INTERVAL;
  get.params[0] = MAVLINK_MSG_ID_ODOMETRY;
  vehicle.streams.execute(get, vehicle.now);
  EXPECT_EQ(unpack<mavlink_message_interval_t>(vehicle.sent.back()).interval_us, 20'000);
  get.params[0] = MAVLINK_MSG_ID_ATTITUDE;
  vehicle.streams.execute(get, vehicle.now);
  EXPECT_EQ(unpack<mavlink_message_interval_t>(vehicle.sent.back()).interval_us, -1);
  vehicle.set(MAVLINK_MSG_ID_ATTITUDE, 0);
  EXPECT_EQ(vehicle.run(1.0)[MAVLINK_MSG_ID_ATTITUDE], 25);
}

TEST(MessageStreams, IntervalsThatCannotBeAreRefused) {
  Streams vehicle;
  EXPECT_EQ(vehicle.set(12345, 1000).reason, "message 12345 is not sent by this vehicle");
  EXPECT_EQ(vehicle.set(30, 10).reason, "message 30: interval 10 us, legal: >= 1000, 0 or -1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(vehicle.set(nan, 1000).result, CommandResult::kDenied);
  EXPECT_EQ(vehicle.set(30, nan).result, CommandResult::kDenied);
}

TEST(MessageStreams, GroupsAreSetByRequestDataStream) {
  Streams vehicle;
  mavlink_request_data_stream_t request{};
  request.target_system = 1;
  request.req_stream_id = MAV_DATA_STREAM_POSITION;
  request.req_message_rate = 2;
  request.start_stop = 1;
  EXPECT_TRUE(vehicle.streams.handle(pack(request, kGround), vehicle.now));
  auto counts = vehicle.run(5.0);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_GLOBAL_POSITION_INT], 10);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_ATTITUDE], 125);
  request.req_stream_id = MAV_DATA_STREAM_ALL;
  request.start_stop = 0;
  vehicle.streams.handle(pack(request, kGround), vehicle.now);
  counts = vehicle.run(5.0);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_ATTITUDE], 0);
  EXPECT_EQ(counts[MAVLINK_MSG_ID_HEARTBEAT], 5);
}

TEST(MessageStreams, AMessageIsSentOnceWhenRequested) {
  Streams vehicle;
  Command request;
  request.command = MAV_CMD_REQUEST_MESSAGE;
  request.params[0] = MAVLINK_MSG_ID_AUTOPILOT_VERSION;
  EXPECT_EQ(vehicle.streams.execute(request, vehicle.now)->result, CommandResult::kAccepted);
  EXPECT_EQ(vehicle.emitted[MAVLINK_MSG_ID_AUTOPILOT_VERSION], 1);
  request.params[0] = MAVLINK_MSG_ID_DISTANCE_SENSOR;
  EXPECT_EQ(vehicle.streams.execute(request, vehicle.now)->result, CommandResult::kDenied);
  request.params[0] = MAVLINK_MSG_ID_COMPONENT_METADATA;
  EXPECT_EQ(vehicle.streams.execute(request, vehicle.now)->result, CommandResult::kUnsupported);
  request.command = MAV_CMD_NAV_LAND;
  EXPECT_FALSE(vehicle.streams.execute(request, vehicle.now));
}

TEST(MessageStreams, AfterTimeWasSetBackTheyContinue) {
  Streams vehicle;
  vehicle.run(10.0);
  vehicle.now = {};
  EXPECT_EQ(vehicle.run(2.0)[MAVLINK_MSG_ID_ATTITUDE], 50);
}

TEST(MessageStreams, AfterAPauseNothingIsMadeUpFor) {
  Streams vehicle;
  vehicle.run(1.0);
  vehicle.now = vehicle.now + at(3600.0);
  EXPECT_EQ(vehicle.run(1.0)[MAVLINK_MSG_ID_ATTITUDE], 25);
}

Message heartbeat(Address source, std::uint8_t type = MAV_TYPE_QUADROTOR) {
  mavlink_heartbeat_t payload{};
  payload.type = type;
  return pack(payload, source);
}

TEST(HeartbeatMonitor, WhoIsSilentIsLostOnceAndMayComeBack) {
  std::vector<std::string> events;
  HeartbeatMonitor monitor(
      3.0, [&](Address, const Heartbeat&) { events.push_back("appeared"); },
      [&](Address, double) { events.push_back("lost"); });
  monitor.handle(heartbeat(kVehicle), {at(1.0), {}});
  monitor.handle(heartbeat(kVehicle), {at(2.0), {}});
  monitor.update({at(4.9), {}});
  monitor.update({at(5.1), {}});
  monitor.update({at(9.0), {}});
  monitor.handle(heartbeat(kVehicle), {at(10.0), {}});
  EXPECT_EQ(events, (std::vector<std::string>{"appeared", "lost", "appeared"}));
  EXPECT_FALSE(monitor.handle(pack(mavlink_attitude_t{}, kVehicle), {at(10.0), {}}));
}

TEST(HeartbeatMonitor, AClientWithWallTimeIsLostByNeitherSpeedNorPause) {
  HeartbeatMonitor monitor(3.0, {}, {});
  monitor.handle(heartbeat(kGround, MAV_TYPE_GCS), {at(0.0), at(100.0)});
  // Twenty times real time: 10 s of the world within half a second.
  EXPECT_NEAR(monitor.age_s(kGround, {at(10.0), at(100.5)}), 0.5, 1e-9);
  // An hour's pause of the world.
  EXPECT_NEAR(monitor.ground_station_age_s({at(0.1), at(3700.0)}), 0.1, 1e-9);
  EXPECT_NEAR(monitor.age_s(kGround, {at(20.0), at(130.0)}), 20.0, 1e-9);
  EXPECT_TRUE(std::isinf(monitor.age_s(kVehicle, {at(1.0), at(101.0)})));
}

TEST(Timesync, TheOffsetOfAPartnerIsFound) {
  const std::int64_t ahead = 5'000'000'000;  // of the vehicle's clock
  TimesyncClient client(kGround, false);
  const auto exchange = [&](std::int64_t now, std::int64_t there, std::int64_t back) {
    const Message request = client.request(now);
    const auto answer = timesync_answer(request, kVehicle, now + there + ahead);
    EXPECT_TRUE(answer);
    EXPECT_FALSE(timesync_answer(*answer, kGround, now));
    return *client.handle(*answer, now + there + back);
  };
  EXPECT_EQ(exchange(1'000'000'000, 10'000'000, 10'000'000).offset_ns, ahead);
  exchange(2'000'000'000, 90'000'000, 10'000'000);  // the slow one does not move the best
  EXPECT_EQ(client.best()->offset_ns, ahead);
  EXPECT_EQ(client.best()->round_trip_ns, 20'000'000);
}

TEST(Timesync, AnAnswerAtTheBeginningOfTimeIsNoRequest) {
  const TimesyncClient client(kGround, true);
  const auto answer = timesync_answer(client.request(0), kVehicle, 0);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(timesync_answer(*answer, kGround, 0));
}

TEST(Timesync, WithOneClockThereIsNoOffset) {
  TimesyncClient client(kGround, true);
  const auto answer = timesync_answer(client.request(1'000), kVehicle, 500'000);
  EXPECT_EQ(client.handle(*answer, 900'000)->offset_ns, 0);
}

TEST(Timesync, AnswersToNoRequestOfOursMeasureNothing) {
  TimesyncClient client(kGround, false);
  mavlink_timesync_t payload{};
  payload.tc1 = 5;
  for (const std::int64_t ts1 : {std::int64_t{2'000}, std::int64_t{-1}, std::int64_t{INT64_MIN}}) {
    payload.ts1 = ts1;
    EXPECT_FALSE(client.handle(pack(payload, kVehicle), 1'000)) << ts1;
  }
  payload.ts1 = 0;
  EXPECT_FALSE(client.handle(pack(payload, kVehicle), 60'000'000'000));
}

TEST(StatusText, TextsOfEachLengthArriveWhole) {
  StatusTextWriter writer(kVehicle);
  StatusTextReader reader;
  for (const std::size_t size : {0U, 1U, 49U, 50U, 51U, 99U, 100U, 101U, 149U, 150U, 777U}) {
    std::string text;
    for (std::size_t i = 0; i < size; ++i) text += static_cast<char>('a' + i % 26);
    std::vector<Message> messages = writer.write(Severity::kWarning, text);
    std::reverse(messages.begin(), messages.end());
    for (std::size_t i = 0; i + 1 < messages.size(); ++i) {
      EXPECT_FALSE(reader.handle(messages[i], at(0.0)));
    }
    const auto whole = reader.handle(messages.back(), at(0.1));
    ASSERT_TRUE(whole) << size;
    EXPECT_EQ(whole->text, text);
    EXPECT_EQ(whole->severity, Severity::kWarning);
    EXPECT_EQ(whole->source, kVehicle);
  }
}

TEST(StatusText, AMissingPartIsMarkedAfterTwoSeconds) {
  StatusTextWriter writer(kVehicle);
  StatusTextReader reader;
  const std::vector<Message> messages =
      writer.write(Severity::kError, std::string(50, 'a') + std::string(50, 'b') + "c");
  reader.handle(messages[0], at(0.0));
  reader.handle(messages[2], at(0.0));
  EXPECT_TRUE(reader.update(at(1.9)).empty());
  const auto texts = reader.update(at(2.1));
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].text, std::string(50, 'a') + "...c");
  EXPECT_TRUE(reader.update(at(9.0)).empty());
}

TEST(SmallServices, FilesAreRefusedWithTheErrorThatMakesClientsAskOtherwise) {
  mavlink_file_transfer_protocol_t request{};
  request.target_system = 1;
  request.payload[0] = 0xFF;  // number 255
  request.payload[3] = MAV_FTP_OPCODE_OPENFILERO;
  const auto answer = file_transfer_answer(pack(request, kGround), kVehicle);
  ASSERT_TRUE(answer);
  const auto nak = unpack<mavlink_file_transfer_protocol_t>(*answer);
  EXPECT_EQ(nak.target_system, kGround.system);
  EXPECT_EQ(nak.payload[0], 0);
  EXPECT_EQ(nak.payload[1], 1);
  EXPECT_EQ(nak.payload[3], MAV_FTP_OPCODE_NAK);
  EXPECT_EQ(nak.payload[4], 1);
  EXPECT_EQ(nak.payload[5], MAV_FTP_OPCODE_OPENFILERO);
  EXPECT_EQ(nak.payload[12], MAV_FTP_ERR_FILENOTFOUND);
  EXPECT_FALSE(file_transfer_answer(*answer, kGround));  // An answer is not answered.
  request.payload[3] = MAV_FTP_OPCODE_RESETSESSION;
  const auto reset = file_transfer_answer(pack(request, kGround), kVehicle);
  EXPECT_EQ(unpack<mavlink_file_transfer_protocol_t>(*reset).payload[3], MAV_FTP_OPCODE_ACK);
}

TEST(SmallServices, ThereAreNoLogs) {
  mavlink_log_request_list_t request{};
  request.target_system = 1;
  const auto answer = log_list_answer(pack(request, kGround), kVehicle);
  ASSERT_TRUE(answer);
  EXPECT_EQ(unpack<mavlink_log_entry_t>(*answer).num_logs, 0);
  request.target_system = 2;
  EXPECT_FALSE(log_list_answer(pack(request, kGround), kVehicle));
}

TEST(SmallServices, VersionsSayWhatIsSpoken) {
  const auto version =
      unpack<mavlink_autopilot_version_t>(autopilot_version_message({true, 1, 14, 3, 9}, kVehicle));
  EXPECT_EQ(version.flight_sw_version, 0x010E03FFU);
  EXPECT_NE(version.capabilities & MAV_PROTOCOL_CAPABILITY_MISSION_INT, 0U);
  EXPECT_EQ(version.capabilities & MAV_PROTOCOL_CAPABILITY_FTP, 0U);
  const auto protocol =
      unpack<mavlink_protocol_version_t>(protocol_version_message(false, kVehicle));
  EXPECT_EQ(protocol.min_version, 200);
}

TEST(SmallServices, ASigningKeyIsTakenFromALoopbackLinkAlone) {
  const Message setup = pack(mavlink_setup_signing_t{}, kGround);
  EXPECT_EQ(signing_setup_refusal(setup, true), "");
  EXPECT_EQ(signing_setup_refusal(setup, false),
            "SETUP_SIGNING of system 255 refused: a key is taken from a loopback link alone");
  EXPECT_EQ(signing_setup_refusal(heartbeat(kGround), false), "");
}

}  // namespace
}  // namespace trident::bridges::mavlink
