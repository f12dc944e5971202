// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "nmea/sentence_log.h"
#include "trident_bridges/nmea/receive/receiver.h"
#include "trident_bridges/nmea/send/ais_transmitter.h"
#include "trident_bridges/nmea/send/guidance_talker.h"

namespace trident::bridges::nmea {
namespace {

using Texts = std::vector<std::string>;

/// What guidance sends along a route.
struct Guided : TalkerSink {
  explicit Guided(const std::map<std::string, double>& rates)
      : sender(params_of(rates), *this), talker(sender, UtcClock()) {}
  static TalkerParams params_of(const std::map<std::string, double>& rates) {
    TalkerParams params;
    params.rates = rates;
    return params;
  }
  /// What is sent at a place at a time.
  Texts at(double at_s, double east_m, double north_m, const GroundVelocity& velocity = {}) {
    sent.clear();
    talker.on_position(SimTime::from_seconds(at_s), east_m, north_m, velocity);
    return sent;
  }
  void on_sentence(std::string_view sentence, SimTime) override { sent.emplace_back(sentence); }
  void on_problem(std::string_view type, const Refusal& refusal) override {
    ADD_FAILURE() << type << ": " << to_text(refusal);
  }

  Texts sent;
  SentenceSender sender;
  GuidanceTalker talker;
};

Waypoint place(const std::string& name, double east_m, double north_m) {
  return {name, 63.0 + north_m / 111'000.0, 10.0 + east_m / 50'000.0, east_m, north_m};
}

TEST(GuidanceTalker, WithoutARouteNothingIsSent) {
  Guided guided({{"APB", 10.0}});
  EXPECT_TRUE(guided.at(0.0, 0.0, 0.0).empty());
}

TEST(GuidanceTalker, AVesselRightOfTheTrackIsSteeredLeft) {
  Guided guided({{"APB", 10.0}, {"APA", 10.0}, {"XTE", 10.0}});
  guided.talker.set_route({place("A", 0.0, 1'852.0)});
  guided.at(0.0, 0.0, 0.0);
  EXPECT_EQ(guided.at(1.0, 20.0, 0.0),
            (Texts{with_checksum("$GPAPB,A,A,0.0108,L,N,V,V,0.00,T,A,359.38,T,315.00,T,A"),
                   with_checksum("$GPAPA,A,A,0.0108,L,N,V,V,0.00,T,A"),
                   with_checksum("$GPXTE,A,A,0.0108,L,N,A")}));
}

TEST(GuidanceTalker, TheDestinationIsSentWithRangeAndClosingSpeed) {
  Guided guided({{"RMB", 10.0}, {"BOD", 10.0}, {"BWC", 10.0}});
  guided.talker.set_route({place("A", 1'852.0, 0.0)});
  const GroundVelocity east{1'852.0 / 3'600.0, 0.0};
  EXPECT_EQ(
      guided.at(0.0, 0.0, 0.0, east),
      (Texts{with_checksum("$GPRMB,A,0.0000,L,,A,6300.00000,N,01002.22240,E,1.000,90.00,1.00,V,A"),
             with_checksum("$GPBOD,90.00,T,90.00,M,A,"),
             with_checksum("$GPBWC,000000.00,6300.00000,N,01002.22240,E,90.0,T,90.0,M,1.000,"
                           "N,A,A")}));
}

TEST(GuidanceTalker, AWaypointIsReachedInItsCircleOrPastIt) {
  Guided guided({{"BOD", 10.0}});
  guided.talker.set_route(
      {place("A", 0.0, 100.0), place("B", 100.0, 100.0), place("C", 100.0, 0.0)});
  EXPECT_EQ(guided.at(0.0, 0.0, 0.0), Texts{with_checksum("$GPBOD,0.00,T,0.00,M,A,")});
  EXPECT_EQ(guided.at(1.0, 3.0, 97.0), Texts{with_checksum("$GPBOD,90.00,T,90.00,M,B,A")});
  EXPECT_EQ(guided.at(2.0, 101.0, 120.0), Texts{with_checksum("$GPBOD,180.00,T,180.00,M,C,B")});
  EXPECT_EQ(guided.at(3.0, 100.0, -50.0), Texts{with_checksum("$GPBOD,180.00,T,180.00,M,C,B")})
      << "the last one stays";
}

/// Keeps routes.
struct RouteLog : ReceiverSink, ProblemSink {
  void on_route(const std::vector<RoutePlace>& places) override { routes.push_back(places); }
  void on_problem(const Refusal& refusal, const Sentence&) override {
    ADD_FAILURE() << to_text(refusal);
  }
  std::vector<std::vector<RoutePlace>> routes;
};

TEST(GuidanceTalker, ARouteIsReadAsItWasSent) {
  Guided guided({{"WPL", 10.0}, {"RTE", 10.0}});
  std::vector<Waypoint> route;
  for (int i = 0; i < 10; ++i) route.push_back(place("WP" + std::to_string(i), 10.0 * i, 5.0 * i));
  guided.talker.set_route(route);
  RouteLog log;
  Receiver receiver({}, log, log);
  for (const std::string& text : guided.at(0.0, 0.0, -20.0)) {
    Sentence sentence;
    Refusal refusal;
    ASSERT_TRUE(sentence.assign(std::string_view(text).substr(0, text.find('*')), &refusal));
    receiver.read(sentence, {});
  }
  ASSERT_EQ(log.routes.size(), 1U);
  ASSERT_EQ(log.routes[0].size(), 10U);
  EXPECT_NEAR(log.routes[0][9].latitude_deg, route[9].latitude_deg, 1e-7);
}

/// Keeps parts of messages, and reads them.
struct AisLog : AisSink {
  void on_part(const AisPart& part, SimTime stamp) override {
    parts.push_back(part);
    Refusal refusal;
    bool is_refused = false;
    const AisBits* bits = assembler.add(part, stamp.seconds(), &refusal, &is_refused);
    ASSERT_FALSE(is_refused) << to_text(refusal);
    if (bits == nullptr) return;
    const AisVessel* vessel = table.add(*bits, stamp.seconds(), &refusal, &is_refused);
    ASSERT_NE(vessel, nullptr) << to_text(refusal);
    newest = *vessel;
    types.push_back(vessel->message_type);
  }
  std::vector<AisPart> parts;
  std::vector<std::uint32_t> types;
  AisVessel newest;
  AisAssembler assembler;
  AisTargetTable table;
};

AisParams boat() {
  AisParams params;
  params.mmsi = 257'000'001;
  params.name = "Otter one";
  params.call_sign = "LAB1";
  params.to_bow_m = 1.2;
  return params;
}

AisState moving(double speed_knots) {
  AisState state;
  state.latitude_deg = 63.4389;
  state.longitude_deg = 10.399;
  state.speed_m_s = speed_knots * 1'852.0 / 3'600.0;
  state.course_rad = state.heading_rad = 1.0;
  return state;
}

std::size_t positions_in(double minutes, const AisParams& params, double speed_knots) {
  AisLog log;
  AisTransmitter transmitter(params, UtcClock(), log);
  for (int i = 0; i < 60 * minutes * 5; ++i) {
    transmitter.on_state(SimTime::from_seconds(0.2 * i), moving(speed_knots));
  }
  return static_cast<std::size_t>(
      std::count_if(log.types.begin(), log.types.end(), [](auto t) { return t == 1 || t == 18; }));
}

TEST(AisTransmitter, AVesselSendsItsNameThenItsPosition) {
  AisLog log;
  AisTransmitter transmitter(boat(), UtcClock(), log);
  transmitter.on_state(SimTime::from_seconds(42.0), moving(5.0));
  EXPECT_EQ(log.types, (std::vector<std::uint32_t>{5, 1}));
  EXPECT_EQ(log.parts.size(), 3U);
  EXPECT_EQ(log.newest.name, "OTTER ONE");
  EXPECT_NEAR(*log.newest.motion.latitude_deg, 63.4389, 1e-6);
  EXPECT_EQ(*log.newest.motion.speed_knots, 5.0);
  EXPECT_EQ(log.newest.motion.second, 42U);
  EXPECT_EQ(log.newest.extent.to_bow_m, 1U);
}

TEST(AisTransmitter, PositionsComeAsOftenAsTheSpeedAsksFor) {
  EXPECT_EQ(positions_in(2.0, boat(), 5.0), 12U);
  EXPECT_EQ(positions_in(2.0, boat(), 20.0), 20U);
  EXPECT_EQ(positions_in(2.0, boat(), 30.0), 60U);
  AisParams moored = boat();
  moored.nav_status = 5;
  EXPECT_EQ(positions_in(6.0, moored, 0.0), 2U);
  AisParams often = boat();
  often.position_period_s = 1.0;
  EXPECT_EQ(positions_in(1.0, often, 0.0), 60U);
}

TEST(AisTransmitter, ClassBSendsItsOwnMessages) {
  AisParams params = boat();
  params.vessel_class = AisClass::kB;
  AisLog log;
  AisTransmitter transmitter(params, UtcClock(), log);
  transmitter.on_state({0}, moving(5.0));
  EXPECT_EQ(log.types, (std::vector<std::uint32_t>{24, 24, 18}));
  EXPECT_EQ(log.newest.name, "OTTER ONE");
  EXPECT_EQ(log.newest.call_sign, "LAB1");
}

TEST(AisTransmitter, WithoutANumberNothingIsSent) {
  AisLog log;
  AisTransmitter transmitter(AisParams{}, UtcClock(), log);
  transmitter.on_state({0}, moving(5.0));
  EXPECT_TRUE(log.parts.empty());
}

}  // namespace
}  // namespace trident::bridges::nmea
