// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/receiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/angle.h"

namespace trident::bridges::nmea {
namespace {

constexpr double kKnot = 1'852.0 / 3'600.0;

/// Keeps what a receiver hands on.
struct EventLog : ReceiverSink, ProblemSink {
  void on_fix(const NavsatFix& fix) override { fixes.push_back(fix); }
  void on_velocity(const GroundVelocity& velocity) override { velocities.push_back(velocity); }
  void on_time(std::int64_t unix_ns) override { times.push_back(unix_ns); }
  void on_heading(double heading_rad) override { headings_deg.push_back(rad_to_deg(heading_rad)); }
  void on_turn_rate(double rad_s) override { turn_rates.push_back(rad_s); }
  void on_tilt(const Tilt& tilt) override { tilts.push_back(tilt); }
  void on_water_velocity(const WaterVelocity& velocity) override { waters.push_back(velocity); }
  void on_depth(const DepthReading& depth) override { depths.push_back(depth); }
  void on_wind(const WindEvent& wind) override { winds.push_back(wind); }
  void on_number(const NamedNumber& number) override {
    numbers.emplace_back(number.name, number.value);
  }
  void on_steering(const SteeringEvent& steering) override { steerings.push_back(steering); }
  void on_route(const std::vector<RoutePlace>& places) override { routes.push_back(places); }
  void on_ais(const AisVessel& vessel, bool is_own) override {
    vessels.emplace_back(vessel.mmsi, is_own);
  }
  void on_problem(const Refusal& refusal, const Sentence&) override {
    problems.push_back(to_text(refusal));
  }

  std::vector<NavsatFix> fixes;
  std::vector<GroundVelocity> velocities;
  std::vector<std::int64_t> times;
  std::vector<double> headings_deg, turn_rates;
  std::vector<Tilt> tilts;
  std::vector<WaterVelocity> waters;
  std::vector<DepthReading> depths;
  std::vector<WindEvent> winds;
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<SteeringEvent> steerings;
  std::vector<std::vector<RoutePlace>> routes;
  std::vector<std::pair<std::uint32_t, bool>> vessels;
  std::vector<std::string> problems;
};

/// A receiver and what it has handed on.
struct Reading {
  explicit Reading(const ReceiverParams& params = {}) : receiver(params, log, log) {}
  EventLog& operator()(const std::string& text, const Receipt& receipt = {}) {
    Sentence sentence;
    Refusal refusal;
    EXPECT_TRUE(sentence.assign(text, &refusal)) << to_text(refusal);
    receiver.read(sentence, receipt);
    return log;
  }
  EventLog log;
  Receiver receiver;
};

const std::string kFix = "$GPGGA,071502.50,3305.12345,S,07140.54321,W,4,11,2.0,12.5,M,-20.75,M,,";

constexpr std::int64_t kDayNs = 86'400LL * 1'000'000'000;

std::int64_t day_ns(int year, int month, int day) {
  return days_from_civil({year, month, day}) * kDayNs;
}

TEST(Receiver, AFixLiesAboveTheEllipsoidWithUpstreamsErrors) {
  Reading reading;
  const EventLog& log = reading(kFix);
  ASSERT_EQ(log.fixes.size(), 1U);
  EXPECT_EQ(log.fixes[0].quality, 4);
  EXPECT_DOUBLE_EQ(log.fixes[0].altitude_m, 12.5 - 20.75);
  EXPECT_DOUBLE_EQ(log.fixes[0].latitude_deg, -(33.0 + 5.12345 / 60.0));
  EXPECT_EQ(log.fixes[0].errors, ErrorsKnown::kApproximately);
  EXPECT_DOUBLE_EQ(log.fixes[0].variance_m2[0], 0.04 * 0.04);
  EXPECT_DOUBLE_EQ(log.fixes[0].variance_m2[2], 0.16 * 0.16);
  EXPECT_FALSE(log.fixes[0].unix_ns) << "no date is known";
}

TEST(Receiver, ErrorsOfTheReceiverTakeTheirPlace) {
  Reading upstream;
  upstream("$GPGST,071502.50,,,,,0.010,0.020,0.030");
  EXPECT_DOUBLE_EQ(upstream(kFix).fixes[0].variance_m2[0], 0.04 * 0.04);
  EXPECT_DOUBLE_EQ(upstream.log.fixes[0].variance_m2[1], 0.02 * 0.02);
  ReceiverParams params;
  params.navsat.dop_scales_gst = false;
  Reading exact(params);
  exact("$GPGST,071502.50,,,,,0.010,0.020,0.030");
  EXPECT_DOUBLE_EQ(exact(kFix).fixes[0].variance_m2[0], 0.02 * 0.02);
  EXPECT_DOUBLE_EQ(exact.log.fixes[0].variance_m2[2], 0.03 * 0.03);
  EXPECT_EQ(exact.log.fixes[0].errors, ErrorsKnown::kYes);
}

TEST(Receiver, AReceiverWithoutAFixHasNoPlace) {
  Reading reading;
  const EventLog& log = reading("$GPGGA,071502.50,,,,,0,03,,,M,,M,,");
  ASSERT_EQ(log.fixes.size(), 1U);
  EXPECT_TRUE(std::isnan(log.fixes[0].latitude_deg));
  EXPECT_EQ(log.fixes[0].errors, ErrorsKnown::kNo);
}

TEST(Receiver, TheDateComesFromSentencesOrFromTheClock) {
  Reading reading;
  const Receipt at_noon{0.0, day_ns(2026, 3, 1) + kDayNs / 2};
  const std::int64_t of_day_ns = (7 * 3'600 + 15 * 60 + 2) * 1'000'000'000LL + 500'000'000;
  EXPECT_EQ(reading(kFix, at_noon).times.back(), day_ns(2026, 3, 1) + of_day_ns);
  reading("$GPZDA,071501.00,15,08,2027,00,00", at_noon);
  EXPECT_EQ(reading(kFix, at_noon).times.back(), day_ns(2027, 8, 15) + of_day_ns);
}

TEST(Receiver, MidnightIsCrossed) {
  Reading reading;
  reading("$GPRMC,235959.50,A,3305.1,S,07140.5,W,1.0,90.0,311226,,,A");
  const auto& log = reading("$GPGGA,000000.50,3305.1,S,07140.5,W,4,11,2.0,12.5,M,-20.75,M,,");
  EXPECT_EQ(log.times.back(), day_ns(2027, 1, 1) + 500'000'000);
}

TEST(Receiver, ATimeIsHandedOnOnce) {
  Reading reading;
  reading("$GPZDA,071502.50,15,08,2027,00,00");
  EXPECT_EQ(reading(kFix).times.size(), 1U);
}

TEST(Receiver, VelocityIsEastAndNorth) {
  Reading reading;
  reading("$GPRMC,071502.50,A,3305.1,S,07140.5,W,10.0,90.0,280226,,,A");
  ASSERT_EQ(reading.log.velocities.size(), 1U);
  EXPECT_NEAR(reading.log.velocities[0].east_m_s, 10.0 * kKnot, 1e-12);
  EXPECT_NEAR(reading.log.velocities[0].north_m_s, 0.0, 1e-12);
  EXPECT_TRUE(reading.log.fixes.empty());
  reading("$GPVTG,180.0,T,,M,10.0,N,18.52,K,A");
  EXPECT_EQ(reading.log.velocities.size(), 1U) << "VTG counts behind a fix of GGA";
  reading(kFix);
  reading("$GPVTG,180.0,T,,M,10.0,N,18.52,K,A");
  EXPECT_NEAR(reading.log.velocities.back().north_m_s, -10.0 * kKnot, 1e-12);
}

TEST(Receiver, AnEmptyCourseIsStandstillOrNothing) {
  Reading reading;
  reading("$GPRMC,071502.50,A,3305.1,S,07140.5,W,0.01,,280226,,,A");
  reading("$GPRMC,071503.50,A,3305.1,S,07140.5,W,3.0,,280226,,,A");
  EXPECT_EQ(reading.log.velocities.size(), 1U);
}

TEST(Receiver, UseRmcTakesFixesFromIt) {
  ReceiverParams params;
  params.navsat.use_rmc = true;
  Reading reading(params);
  EXPECT_TRUE(reading(kFix).fixes.empty());
  reading("$GPRMC,071502.50,A,3305.1,S,07140.5,W,10.0,90.0,280226,,,A");
  ASSERT_EQ(reading.log.fixes.size(), 1U);
  EXPECT_TRUE(std::isnan(reading.log.fixes[0].altitude_m));
  EXPECT_EQ(reading.log.times.size(), 1U);
}

TEST(Receiver, ALocalDatumIsTakenBackToWgs84) {
  Reading reading;
  reading("$GPDTM,999,,0.6000,N,1.2000,W,0.0,W84");
  const EventLog& log = reading(kFix);
  EXPECT_NEAR(log.fixes[0].latitude_deg, -(33.0 + 5.12345 / 60.0) - 0.01, 1e-12);
  EXPECT_NEAR(log.fixes[0].longitude_deg, -(71.0 + 40.54321 / 60.0) + 0.02, 1e-12);
}

TEST(Receiver, HeadingsAreFromTrueNorth) {
  Reading reading;
  reading("$HEHDT,350.0,T");
  reading("$HETHS,10.0,A");
  reading("$HETHS,20.0,V");
  reading("$HCHDM,30.0,M");
  EXPECT_EQ(reading.log.headings_deg.size(), 2U) << "the variation is not known yet";
  reading("$HCHDG,355.0,2.0,W,10.0,E");
  reading("$HCHDM,30.0,M");
  ASSERT_EQ(reading.log.headings_deg.size(), 4U);
  EXPECT_NEAR(reading.log.headings_deg[2], 3.0, 1e-9);
  EXPECT_NEAR(reading.log.headings_deg[3], 40.0, 1e-9);
}

TEST(Receiver, ATurnToStarboardIsClockwise) {
  Reading reading;
  reading("$TIROT,60.0,A");
  reading("$TIROT,60.0,V");
  ASSERT_EQ(reading.log.turn_rates.size(), 1U);
  EXPECT_NEAR(reading.log.turn_rates[0], -deg_to_rad(1.0), 1e-12);
}

TEST(Receiver, TransducersAreTiltAndNumbers) {
  Reading reading;
  reading("$YXXDR,A,5.0,D,ROLL,A,-2.0,D,PTCH,P,1.01325,B,Baro-1,C,12.5,C,AIR");
  ASSERT_EQ(reading.log.tilts.size(), 1U);
  EXPECT_NEAR(*reading.log.tilts[0].roll_rad, deg_to_rad(5.0), 1e-12);
  EXPECT_NEAR(*reading.log.tilts[0].pitch_rad, deg_to_rad(2.0), 1e-12);
  ASSERT_EQ(reading.log.numbers.size(), 2U);
  EXPECT_EQ(reading.log.numbers[0].first, "xdr/baro_1");
  EXPECT_NEAR(reading.log.numbers[0].second, 101'325.0, 1e-9);
  EXPECT_EQ(reading.log.numbers[1].second, 12.5);
}

TEST(Receiver, WaterAndDepthAreInSi) {
  Reading reading;
  reading("$VWVHW,,T,,M,2.0,N,,K");
  reading("$VDVBW,2.0,0.5,A,,,V,,V,,V");
  EXPECT_NEAR(reading.log.waters[0].ahead_m_s, 2.0 * kKnot, 1e-12);
  EXPECT_NEAR(reading.log.waters[1].port_m_s, -0.5 * kKnot, 1e-12);
  reading("$SDDPT,4.5,-0.5,100.0");
  reading("$SDDBT,,f,,M,1.0,F");
  EXPECT_EQ(reading.log.depths[0].depth_m, 4.5);
  EXPECT_EQ(*reading.log.depths[0].max_range_m, 100.0);
  EXPECT_NEAR(reading.log.depths[1].depth_m, 1.8288, 1e-12);
}

TEST(Receiver, WindIsClockwiseFromTheBow) {
  Reading reading;
  reading("$WIMWV,270.0,R,36.0,K,A");
  reading("$WIVWT,90.0,L,,N,5.0,M,,K");
  reading("$WIMWD,10.0,T,,M,,N,5.0,M");
  EXPECT_EQ(reading.log.winds.size(), 2U) << "the heading is not known yet";
  reading("$HEHDT,100.0,T");
  reading("$WIMWD,10.0,T,,M,,N,5.0,M");
  EXPECT_FALSE(reading.log.winds[0].is_true);
  EXPECT_NEAR(reading.log.winds[0].speed_m_s, 10.0, 1e-12);
  EXPECT_NEAR(reading.log.winds[1].angle_rad, deg_to_rad(270.0), 1e-12);
  EXPECT_NEAR(reading.log.winds[2].angle_rad, deg_to_rad(270.0), 1e-12);
  EXPECT_TRUE(reading.log.winds[2].is_true);
}

TEST(Receiver, MachineryHasNames) {
  Reading reading;
  reading("$ERRPM,S,2,-1200.0,,A");
  reading("$ERRSA,10.0,A,,V");
  reading("$ERRSA,10.0,V,,V");
  ASSERT_EQ(reading.log.numbers.size(), 2U);
  EXPECT_EQ(reading.log.numbers[0], (std::pair<std::string, double>("rpm/shaft_2", -1'200.0)));
  EXPECT_EQ(reading.log.numbers[1].first, "rudder_angle");
  EXPECT_NEAR(reading.log.numbers[1].second, deg_to_rad(10.0), 1e-12);
}

TEST(Receiver, AnAutopilotSteersWhatApbSays) {
  Reading reading;
  reading("$GPAPB,A,A,0.0100,R,N,V,V,11.0,T,HOME,11.0,T,15.5,T");
  ASSERT_EQ(reading.log.steerings.size(), 1U);
  EXPECT_NEAR(*reading.log.steerings[0].heading_rad, deg_to_rad(15.5), 1e-12);
  EXPECT_NEAR(*reading.log.steerings[0].cross_track_m, -18.52, 1e-9);
  reading("$GPRMB,A,0.0100,R,A,HOME,3305.1,S,07140.5,W,1.0,20.0,3.0,V", {1.0, {}});
  EXPECT_EQ(reading.log.steerings.size(), 1U) << "APB takes precedence";
  reading("$GPRMB,A,0.0100,R,A,HOME,3305.1,S,07140.5,W,1.0,20.0,3.0,V", {10.0, {}});
  EXPECT_NEAR(*reading.log.steerings.back().heading_rad, deg_to_rad(20.0), 1e-12);
}

TEST(Receiver, ApaIsSteeredBackToTheTrack) {
  Reading reading;
  // 20 m right of a track to the north: 45 degrees to the left.
  reading("$GPAPA,A,A,0.01079914,L,N,V,V,0.0,T,HOME");
  ASSERT_EQ(reading.log.steerings.size(), 1U);
  EXPECT_NEAR(*reading.log.steerings[0].heading_rad, deg_to_rad(315.0), 1e-6);
}

TEST(Receiver, WhatAPlannerMarksAsNotUsableIsNotSteered) {
  Reading reading;
  reading("$GPAPB,V,A,0.01,R,N,V,V,11.0,T,HOME,11.0,T,15.5,T");
  reading("$GPAPB,A,V,0.01,R,N,V,V,11.0,T,HOME,11.0,T,15.5,T");
  reading("$GPRMB,V,0.01,R,A,HOME,3305.1,S,07140.5,W,1.0,20.0,3.0,V");
  EXPECT_TRUE(reading.log.steerings.empty());
}

TEST(Receiver, ARouteIsHandedOnWholeInWhicheverOrderItsPartsCome) {
  Reading reading;
  reading("$GPRTE,2,1,c,R1,A,B");
  reading("$GPRTE,2,2,c,R1,C");
  reading("$GPWPL,0100.0,N,00200.0,E,A");
  reading("$GPWPL,0101.0,N,00200.0,E,B");
  EXPECT_TRUE(reading.log.routes.empty());
  reading("$GPWPL,0102.0,N,00200.0,E,C");
  ASSERT_EQ(reading.log.routes.size(), 1U);
  EXPECT_EQ(reading.log.routes[0].size(), 3U);
  EXPECT_NEAR(reading.log.routes[0][2].latitude_deg, 1.0 + 2.0 / 60.0, 1e-12);
  reading("$GPWPL,0102.0,N,00200.0,E,C");
  EXPECT_EQ(reading.log.routes.size(), 1U) << "nothing has changed";
  reading("$GPWPL,0103.0,N,00200.0,E,C");
  EXPECT_EQ(reading.log.routes.size(), 2U);
}

TEST(Receiver, ARouteWithALostPartIsNotHandedOn) {
  Reading reading;
  for (const char* name : {"A", "B", "C"})
    reading("$GPWPL,0100.0,N,00200.0,E," + std::string(name));
  reading("$GPRTE,3,1,c,R1,A");
  reading("$GPRTE,3,3,c,R1,C");
  EXPECT_TRUE(reading.log.routes.empty());
  reading("$GPRTE,1,1,c,R1,A,C");
  EXPECT_EQ(reading.log.routes.size(), 1U);
}

TEST(Receiver, ProblemsAreCountedAndHandedOn) {
  Reading reading;
  reading("$GPGGA,071502.50,9100.0,S,07140.54321,W,4,11,2.0,12.5,M,-20.75,M,,");
  reading("$GPTXT,01,01,02,x");
  reading("$PSRF103,0");
  reading("!AIVDM,2,2,1,A,0000,0");
  EXPECT_EQ(reading.log.problems,
            (std::vector<std::string>{"latitude is '9100.0', legal: [-90, 90]",
                                      "sentence is 2, legal: [1, 1]"}));
  EXPECT_EQ(reading.receiver.counts().refused.of(RefusalKind::kOutOfRange), 1U);
  EXPECT_EQ(reading.receiver.counts().refused.total(), 2U);
  EXPECT_EQ(reading.receiver.counts().unknown, 1U);
  EXPECT_EQ(reading.receiver.counts().proprietary, 1U);
}

}  // namespace
}  // namespace trident::bridges::nmea
