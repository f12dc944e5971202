// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/sitl/px4_link.h"

#include <gtest/gtest.h>

#include <vector>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/packet.h"

namespace trident::bridges::sitl {
namespace {

using mavlink::Message;

SimTime ms(std::int64_t n) { return {n * 1'000'000}; }

/// A link and PX4's end of it.
struct Px4Rig {
  std::vector<Message> sent;
  mavlink::PacketParser parser;
  Px4Link link;

  explicit Px4Rig(bool lockstep = true)
      : link(lockstep, 0.004, [this](mavlink::Bytes bytes) {
          parser.feed(bytes);
          while (const auto packet = parser.next()) sent.push_back(to_message(*packet));
        }) {}

  void answer(std::uint64_t time_us, float value = 0.5F, bool is_armed = true) {
    mavlink_hil_actuator_controls_t out{};
    out.time_usec = time_us;
    for (float& control : out.controls) control = value;
    out.mode = is_armed ? MAV_MODE_FLAG_SAFETY_ARMED : 0;
    out.flags = 1;
    mavlink::PacketWriter writer;
    link.received(writer.write(mavlink::pack(out, {1, 1})));
  }
  mavlink_hil_sensor_t newest_sensor() const {
    return mavlink::unpack<mavlink_hil_sensor_t>(sent.back());
  }
};

TEST(Px4Link, WaitsForAConnectionThenForOneAnswerToEachSensor) {
  Px4Rig rig;
  EXPECT_TRUE(rig.link.is_awaited(0.0));
  rig.link.connected();
  EXPECT_FALSE(rig.link.is_awaited(0.0));
  for (int i = 1; i < 5; ++i) {
    rig.link.send_sensor(ms(4 * i), {}, 0.0);
    EXPECT_TRUE(rig.link.is_awaited(1.0));
    rig.answer(4000U * static_cast<unsigned>(i));
    EXPECT_FALSE(rig.link.is_awaited(1.0));
  }
  EXPECT_EQ(rig.link.controls().count, 4U);
  EXPECT_TRUE(rig.link.controls().is_armed);
}

TEST(Px4Link, ALockstepThatHasBegunWaitsWhateverTheWallClockSays) {
  Px4Rig rig;
  rig.link.connected();
  rig.link.send_sensor(ms(4), {}, 0.0);
  rig.answer(4000);
  rig.link.send_sensor(ms(8), {}, 0.0);
  EXPECT_TRUE(rig.link.is_awaited(1e6));
}

TEST(Px4Link, AProgramThatBootsGetsSensorsAtThePaceOfTheWallClock) {
  Px4Rig rig;
  rig.link.connected();
  rig.link.send_sensor(ms(4), {}, 10.0);
  EXPECT_TRUE(rig.link.is_awaited(10.0 + Px4Link::kFirstPatience_s - 0.01));
  EXPECT_FALSE(rig.link.is_awaited(10.0 + Px4Link::kFirstPatience_s + 0.01));
  EXPECT_FALSE(rig.link.runs_free());
  rig.link.send_sensor(ms(8), {}, 12.0);
  EXPECT_TRUE(rig.link.is_awaited(12.003));
  EXPECT_FALSE(rig.link.is_awaited(12.005));
  EXPECT_TRUE(rig.link.runs_free());
  rig.answer(8000);
  EXPECT_FALSE(rig.link.runs_free());
}

TEST(Px4Link, AnAnswerToAnEarlierSensorDoesNotCount) {
  Px4Rig rig;
  rig.link.connected();
  rig.link.send_sensor(ms(4), {}, 0.0);
  rig.answer(4000, 0.1F);
  rig.link.send_sensor(ms(8), {}, 0.0);
  rig.answer(4000, 0.9F);
  EXPECT_TRUE(rig.link.is_awaited(0.0));
  EXPECT_EQ(rig.link.stale_answers(), 1U);
  EXPECT_FLOAT_EQ(rig.link.controls().values[0], 0.1F);
  rig.answer(8000, 0.2F);
  EXPECT_FALSE(rig.link.is_awaited(0.0));
}

TEST(Px4Link, OneThatIsGoneIsWaitedForAndJoinsAgain) {
  Px4Rig rig;
  rig.link.connected();
  rig.link.send_sensor(ms(4), {}, 0.0);
  rig.answer(4000);
  rig.link.disconnected();
  EXPECT_TRUE(rig.link.is_awaited(0.0));
  rig.link.give_up();
  EXPECT_FALSE(rig.link.is_awaited(0.0));
  rig.link.connected();
  rig.link.send_sensor(ms(8), {}, 0.0);
  rig.answer(8000);
  EXPECT_TRUE(rig.link.has_answered());
  EXPECT_FALSE(rig.link.is_awaited(0.0));
}

TEST(Px4Link, TimeGrowsThoughTheWorldsReturnsAndTheSensorSaysSo) {
  Px4Rig rig;
  rig.link.connected();
  rig.link.send_sensor(ms(400), {}, 0.0);
  EXPECT_EQ(rig.newest_sensor().fields_updated & HilSensor::kReset, 0U);
  rig.link.send_sensor(ms(4), {}, 0.0);
  EXPECT_EQ(rig.newest_sensor().time_usec, 401'000U);
  EXPECT_NE(rig.newest_sensor().fields_updated & HilSensor::kReset, 0U);
  rig.link.send_sensor(ms(8), {}, 0.0);
  EXPECT_EQ(rig.newest_sensor().time_usec, 405'000U);
}

TEST(Px4Link, ValuesBeyondTheWiresRangeAreCutToIt) {
  Px4Rig rig;
  rig.link.connected();
  HilGps gps;
  gps.latitude_deg = 47.5;
  gps.longitude_deg = -8.5;
  gps.altitude_m = 500.25;
  gps.v_ned = {-1.5, 0.0, 1000.0};
  rig.link.send_gps(ms(120), gps);
  const auto out = mavlink::unpack<mavlink_hil_gps_t>(rig.sent.back());
  EXPECT_EQ(out.lat, 475000000);
  EXPECT_EQ(out.lon, -85000000);
  EXPECT_EQ(out.alt, 500250);
  EXPECT_EQ(out.vn, -150);
  EXPECT_EQ(out.vd, 32767);
  EXPECT_EQ(out.cog, 18000);
}

TEST(Px4Link, WithoutLockstepNothingIsWaitedFor) {
  Px4Rig rig(false);
  EXPECT_FALSE(rig.link.is_awaited(0.0));
  rig.link.connected();
  rig.link.send_sensor(ms(4), {}, 0.0);
  EXPECT_FALSE(rig.link.is_awaited(0.0));
}

}  // namespace
}  // namespace trident::bridges::sitl
