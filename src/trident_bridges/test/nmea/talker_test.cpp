// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "nmea/sentence_log.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_bridges/nmea/send/gnss_talker.h"
#include "trident_bridges/nmea/send/instrument_talker.h"

namespace trident::bridges::nmea {
namespace {

using Texts = std::vector<std::string>;

/// Keeps what is sent.
struct SentLog : TalkerSink {
  void on_sentence(std::string_view sentence, SimTime) override { sent.emplace_back(sentence); }
  void on_problem(std::string_view type, const Refusal& refusal) override {
    problems.push_back(std::string(type) + ": " + to_text(refusal));
  }
  Texts sent, problems;
};

TalkerParams with_rates(const std::map<std::string, double>& rates) {
  TalkerParams params;
  params.rates = rates;
  return params;
}

GnssEpoch fixed_epoch(double at_s) {
  GnssEpoch epoch;
  epoch.stamp = SimTime::from_seconds(at_s);
  epoch.fix = GnssEpoch::Fix::kFixed;
  epoch.latitude_deg = 63.4389;
  epoch.longitude_deg = 10.399;
  epoch.altitude_m = 41.25;
  epoch.horizontal_stddev_m = 0.01;
  epoch.vertical_stddev_m = 0.02;
  epoch.satellites = 6;
  epoch.geoid_separation_m = 40.0;
  return epoch;
}

/// What is sent of one epoch with these sentences on.
Texts sent_of(const GnssEpoch& epoch, const std::map<std::string, double>& rates,
              const std::optional<GroundVelocity>& velocity = std::nullopt) {
  SentLog log;
  SentenceSender sender(with_rates(rates), log);
  GnssTalker talker(sender, UtcClock());
  if (velocity) talker.set_velocity(*velocity);
  talker.on_epoch(epoch);
  return log.sent;
}

TEST(GnssTalker, AnRtkFixedPositionIsSent) {
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"GGA", 5.0}}),
            Texts{with_checksum(
                "$GPGGA,000001.50,6326.33400,N,01023.94000,E,4,06,1.0,1.250,M,40.00,M,,")});
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"GLL", 5.0}}),
            Texts{with_checksum("$GPGLL,6326.33400,N,01023.94000,E,000001.50,A,R")});
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"ZDA", 5.0}}),
            Texts{with_checksum("$GPZDA,000001.50,01,01,2026,00,00")});
}

TEST(GnssTalker, WithoutAGeoidTheAltitudeIsAboveTheEllipsoid) {
  GnssEpoch epoch = fixed_epoch(0.0);
  epoch.geoid_separation_m.reset();
  EXPECT_NE(sent_of(epoch, {{"GGA", 1.0}})[0].find(",41.250,M,,M,,"), std::string::npos);
}

TEST(GnssTalker, SpeedAndCourseAreThoseOfTheVelocity) {
  const GroundVelocity west{-1'852.0 / 3'600.0, 0.0};
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"RMC", 1.0}}, west),
            Texts{with_checksum(
                "$GPRMC,000001.50,A,6326.33400,N,01023.94000,E,1.000,270.00,010126,,,R,S")});
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"VTG", 1.0}}, west),
            Texts{with_checksum("$GPVTG,270.00,T,,M,1.000,N,1.852,K,R")});
  EXPECT_EQ(sent_of(fixed_epoch(1.5), {{"VTG", 1.0}}, GroundVelocity{0.01, 0.0}),
            Texts{with_checksum("$GPVTG,,T,,M,0.019,N,0.036,K,R")});
}

TEST(GnssTalker, WithoutAFixNoPlaceIsSent) {
  GnssEpoch epoch = fixed_epoch(2.0);
  epoch.fix = GnssEpoch::Fix::kNone;
  epoch.satellites = 3;
  EXPECT_EQ(sent_of(epoch, {{"GGA", 1.0}, {"RMC", 1.0}, {"GST", 1.0}, {"GSA", 1.0}}),
            (Texts{with_checksum("$GPGGA,000002.00,,,,,0,03,,,M,,M,,"),
                   with_checksum("$GPRMC,000002.00,V,,,,,,,010126,,,N,V"),
                   with_checksum("$GPGSA,A,1,,,,,,,,,,,,,,,,1")}));
}

TEST(GnssTalker, SatellitesAreSentFourAtATime) {
  EXPECT_EQ(sent_of(fixed_epoch(0.0), {{"GSV", 1.0}}),
            (Texts{with_checksum("$GPGSV,2,1,06,01,,,,02,,,,03,,,,04,,,,1"),
                   with_checksum("$GPGSV,2,2,06,05,,,,06,,,,1")}));
  EXPECT_EQ(sent_of(fixed_epoch(0.0), {{"GSA", 1.0}}),
            Texts{with_checksum("$GPGSA,A,3,01,02,03,04,05,06,,,,,,,1.7,1.0,1.4,1")});
}

TEST(GnssTalker, ErrorsAreThoseOfTheStatus) {
  EXPECT_EQ(sent_of(fixed_epoch(0.0), {{"GST", 1.0}}),
            Texts{with_checksum("$GPGST,000000.00,0.010,0.010,0.010,0.0,0.010,0.010,0.020")});
}

TEST(GnssTalker, ANumberThatIsNotFiniteIsNotSent) {
  SentLog log;
  SentenceSender sender(with_rates({{"GGA", 1.0}}), log);
  GnssTalker talker(sender, UtcClock());
  GnssEpoch epoch = fixed_epoch(0.0);
  epoch.latitude_deg = std::numeric_limits<double>::quiet_NaN();
  talker.on_epoch(epoch);
  EXPECT_TRUE(log.sent.empty());
  EXPECT_EQ(log.problems, Texts{"GGA: latitude is nan, legal: [-90, 90]"});
}

TEST(SentenceSender, RatesAreKeptOnAGridOfSimulatedTime) {
  SentLog log;
  SentenceSender sender(with_rates({{"GGA", 5.0}, {"ZDA", 1.0}}), log);
  GnssTalker talker(sender, UtcClock());
  for (int i = 0; i < 150; ++i) talker.on_epoch(fixed_epoch(i / 15.0));  // 15 Hz for 10 s
  const auto count = [&](const std::string& type) {
    return std::count_if(log.sent.begin(), log.sent.end(), [&](const std::string& sentence) {
      return sentence.substr(3, 3) == type;
    });
  };
  EXPECT_EQ(count("GGA"), 50);
  EXPECT_EQ(count("ZDA"), 10);
}

TEST(SentenceSender, AnUnlimitedRateSendsAllThatComes) {
  SentLog log;
  SentenceSender sender(with_rates({{"ZDA", TalkerParams::kUnlimitedHz}}), log);
  GnssTalker talker(sender, UtcClock());
  for (int i = 0; i < 20; ++i) talker.on_epoch(fixed_epoch(1.0));
  EXPECT_EQ(log.sent.size(), 20U);
}

TEST(SentenceSender, ATimeThatGoesBackIsSentAtOnce) {
  SentLog log;
  SentenceSender sender(with_rates({{"ZDA", 1.0}}), log);
  GnssTalker talker(sender, UtcClock());
  for (const double at_s : {5.0, 5.1, 0.0, 0.1}) talker.on_epoch(fixed_epoch(at_s));
  EXPECT_EQ(log.sent.size(), 2U);
}

TEST(SentenceSender, UnknownSentencesAndTalkersAreRefused) {
  SentLog log;
  const auto error_of = [&](const TalkerParams& params) -> std::string {
    try {
      SentenceSender sender(params, log);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of(with_rates({{"GGS", 1.0}})).substr(0, 63),
            "rates has the unknown sentence 'GGS'; did you mean 'GGA'? Known");
  TalkerParams params;
  params.talkers.gnss = "gp";
  EXPECT_EQ(error_of(params),
            "gnss is 'gp', legal: two capital letters or digits, the first not P");
}

GnssJoin::Status status_at(double at_s, GnssEpoch::Fix fix = GnssEpoch::Fix::kFloat) {
  GnssJoin::Status status;
  status.stamp = SimTime::from_seconds(at_s);
  status.fix = fix;
  status.satellites = 9;
  return status;
}

TEST(GnssJoin, AFixAndItsStatusAreOneEpochInEitherOrder) {
  GnssJoin join;
  EXPECT_FALSE(join.add_fix(fixed_epoch(1.0), true));
  const auto first = join.add_status(status_at(1.0));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->fix, GnssEpoch::Fix::kFloat);
  EXPECT_EQ(first->satellites, 9);
  EXPECT_FALSE(join.add_status(status_at(2.0)));
  EXPECT_TRUE(join.add_fix(fixed_epoch(2.0), true));
}

TEST(GnssJoin, AFixThatWaitsInVainIsNotLost) {
  GnssJoin join;
  join.add_fix(fixed_epoch(1.0), true);
  const auto late = join.add_fix(fixed_epoch(2.0), true);
  ASSERT_TRUE(late);
  EXPECT_EQ(late->stamp.seconds(), 1.0);
  EXPECT_TRUE(GnssJoin().add_fix(fixed_epoch(1.0), false)) << "nobody sends status messages";
}

TEST(GnssJoin, AStatusWithoutAFixIsAnEpoch) {
  GnssJoin join;
  const auto epoch = join.add_status(status_at(3.0, GnssEpoch::Fix::kNone));
  ASSERT_TRUE(epoch);
  EXPECT_EQ(epoch->fix, GnssEpoch::Fix::kNone);
}

/// An instrument talker with these sentences on.
struct Instruments {
  explicit Instruments(const TalkerParams& params) : sender(params, log), talker(sender) {}
  explicit Instruments(const std::map<std::string, double>& rates)
      : Instruments(with_rates(rates)) {}
  SentLog log;
  SentenceSender sender;
  InstrumentTalker talker;
};

Attitude heading_of(double heading_deg) {
  Attitude attitude;
  attitude.heading_rad = deg_to_rad(heading_deg);
  attitude.roll_rad = deg_to_rad(3.0);
  attitude.pitch_rad = deg_to_rad(-2.0);
  attitude.turn_rad_s = deg_to_rad(-1.0);
  return attitude;
}

TEST(InstrumentTalker, HeadingTurnAndTiltAreSent) {
  TalkerParams params =
      with_rates({{"HDT", 1.0}, {"HDG", 1.0}, {"ROT", 1.0}, {"XDR", 1.0}, {"THS", 1.0}});
  params.magnetic_variation_deg = 5.0;
  Instruments instruments(params);
  instruments.talker.on_attitude({0}, heading_of(2.0));
  EXPECT_EQ(instruments.log.sent,
            (Texts{with_checksum("$HEHDT,2.00,T"), with_checksum("$HETHS,2.00,A"),
                   with_checksum("$HEHDG,357.00,,,5.0,E"), with_checksum("$HEROT,60.00,A"),
                   with_checksum("$YXXDR,A,3.000,D,ROLL,A,2.000,D,PTCH")}));
}

TEST(InstrumentTalker, SpeedsThroughTheWaterAndOverGroundAreSent) {
  Instruments instruments({{"VHW", 1.0}, {"VBW", 1.0}, {"VLW", 1.0}});
  instruments.talker.on_attitude({0}, heading_of(90.0));
  instruments.talker.set_ground_velocity({1'852.0 / 3'600.0, 0.0});
  instruments.talker.on_water_velocity({0}, {2.0 * 1'852.0 / 3'600.0, 0.0});
  EXPECT_EQ(instruments.log.sent, (Texts{with_checksum("$VWVHW,90.00,T,,M,2.000,N,3.704,K"),
                                         with_checksum("$VWVBW,2.000,0.000,A,1.000,0.000,A,,V,,V"),
                                         with_checksum("$VWVLW,0.000,N,0.000,N,,N,,N")}));
  instruments.talker.on_water_velocity(SimTime::from_seconds(3.6), {1'852.0 / 3.6, 0.0});
  EXPECT_EQ(instruments.log.sent.back(), with_checksum("$VWVLW,1.000,N,1.000,N,,N,,N"));
}

TEST(InstrumentTalker, DepthsAreSent) {
  Instruments instruments({{"DBT", 1.0}, {"DPT", 1.0}});
  instruments.talker.on_depth({0}, {3.048, -0.5, 100.0});
  EXPECT_EQ(instruments.log.sent, (Texts{with_checksum("$SDDBT,10.00,f,3.05,M,1.67,F"),
                                         with_checksum("$SDDPT,3.05,-0.50,100.0")}));
}

TEST(InstrumentTalker, TheTrueWindFollowsFromTheApparentOne) {
  Instruments instruments({{"MWV", 1.0}, {"MWD", 1.0}, {"VWR", 1.0}});
  instruments.talker.on_wind({0}, {false, 10.0, 0.0});
  EXPECT_EQ(instruments.log.sent.size(), 2U) << "heading and velocity are not known yet";
  instruments.log.sent.clear();
  instruments.talker.on_attitude({0}, heading_of(90.0));
  instruments.talker.set_ground_velocity({4.0, 0.0});
  instruments.talker.on_wind(SimTime::from_seconds(1.0), {false, 10.0, 0.0});
  EXPECT_EQ(instruments.log.sent, (Texts{with_checksum("$WIMWV,0.00,R,10.00,M,A"),
                                         with_checksum("$WIVWR,0.00,R,19.44,N,10.00,M,36.00,K"),
                                         with_checksum("$WIMWV,0.00,T,6.00,M,A"),
                                         with_checksum("$WIMWD,90.00,T,90.00,M,11.66,N,6.00,M")}));
}

TEST(InstrumentTalker, MachineryIsSent) {
  Instruments instruments({{"RPM", 1.0}, {"RSA", 1.0}, {"MTW", 1.0}});
  const std::vector<double> shafts{-1'200.0, 900.0};
  instruments.talker.on_shafts({0}, shafts);
  instruments.talker.on_rudder({0}, deg_to_rad(-12.0));
  instruments.talker.on_water_temperature({0}, 8.25);
  EXPECT_EQ(instruments.log.sent,
            (Texts{with_checksum("$ERRPM,S,1,-1200.0,,A"), with_checksum("$ERRPM,S,2,900.0,,A"),
                   with_checksum("$ERRSA,-12.00,A,,V"), with_checksum("$YXMTW,8.25,C")}));
}

}  // namespace
}  // namespace trident::bridges::nmea
