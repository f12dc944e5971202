// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

#include "nmea/random_fields.h"
#include "nmea/sentence_log.h"
#include "trident_bridges/nmea/all_sentences.h"

namespace trident::bridges::nmea {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Reads a sentence without checksum as a T; the refusal's text otherwise.
template <class T>
std::optional<T> read(const std::string& text, std::string* problem = nullptr) {
  Sentence sentence;
  Refusal refusal;
  std::optional<T> result;
  if (!sentence.assign(text, &refusal)) {
    ADD_FAILURE() << to_text(refusal);
    return result;
  }
  const auto keep = [&](const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, T>) result = value;
  };
  if (decode(sentence, keep, &refusal) == Decoded::kRefused && problem != nullptr) {
    *problem = std::string(name_of(refusal.kind)) + ": " + to_text(refusal);
  }
  return result;
}

template <class T>
std::string problem_of(const std::string& text) {
  std::string problem = "no problem";
  read<T>(text, &problem);
  return problem;
}

/// As it is sent; a refusal's text otherwise.
template <class T>
std::string sent(const T& value, const std::string& talker = "GP") {
  EncodedSentence out;
  Refusal refusal;
  if (!encode(talker, value, &out, &refusal)) return to_text(refusal);
  return std::string(out.view());
}

Gga rtk_fix() {
  Gga gga;
  gga.time = TimeOfDay{12, 35, 19.25};
  gga.latitude_deg = 63.4389;
  gga.longitude_deg = 10.399;
  gga.quality = Gga::kRtkFixed;
  gga.satellites = 9;
  gga.hdop = 0.8;
  gga.altitude_m = 1.234;
  gga.geoid_separation_m = 39.87;
  return gga;
}

TEST(Sentences, AFixIsWrittenWithFiveDecimalsOfAMinute) {
  EXPECT_EQ(
      sent(rtk_fix()),
      with_checksum("$GPGGA,123519.25,6326.33400,N,01023.94000,E,4,09,0.8,1.234,M,39.87,M,,"));
}

TEST(Sentences, AFixIsRead) {
  const auto gga =
      read<Gga>("$GNGGA,071502.50,3305.12345,S,07140.54321,W,1,11,0.91,12.5,M,-20.75,M,2.5,0007");
  ASSERT_TRUE(gga);
  EXPECT_EQ(*gga->time, (TimeOfDay{7, 15, 2.5}));
  EXPECT_EQ(*gga->latitude_deg, -(33 + 5.12345 / 60.0));
  EXPECT_EQ(*gga->longitude_deg, -(71 + 40.54321 / 60.0));
  EXPECT_EQ(*gga->quality, 1);
  EXPECT_EQ(*gga->satellites, 11);
  EXPECT_EQ(*gga->hdop, 0.91);
  EXPECT_EQ(*gga->altitude_m, 12.5);
  EXPECT_EQ(*gga->geoid_separation_m, -20.75);
  EXPECT_EQ(*gga->correction_age_s, 2.5);
  EXPECT_EQ(gga->station, "0007");
}

TEST(Sentences, SixtyMinutesAreTheNextDegree) {
  Gga gga = rtk_fix();
  gga.latitude_deg = 59.0 + 59.999999 / 60.0;
  gga.longitude_deg = -179.99999999;
  EXPECT_NE(sent(gga).find(",6000.00000,N,18000.00000,W,"), std::string::npos) << sent(gga);
}

TEST(Sentences, RoundingAPositionCostsLessThanACentimeter) {
  for (int i = 0; i < 1'000; ++i) {
    Gga gga = rtk_fix();
    gga.latitude_deg = -89.9 + 0.17981 * i;
    gga.longitude_deg = -179.9 + 0.35971 * i;
    const std::string text = sent(gga);
    const auto back = read<Gga>(text.substr(0, text.find('*')));
    ASSERT_TRUE(back);
    EXPECT_NEAR(*back->latitude_deg, *gga.latitude_deg, 0.5e-5 / 60.0 + 1e-12);
    EXPECT_NEAR(*back->longitude_deg, *gga.longitude_deg, 0.5e-5 / 60.0 + 1e-12);
  }
}

TEST(Sentences, EightyTwoCharactersAreNeverExceeded) {
  Gga gga = rtk_fix();
  gga.altitude_m = -98'765.4321;
  gga.geoid_separation_m = -123.456;
  gga.hdop = 12.3;
  EXPECT_NE(sent(gga).find(",-98765.43,M,-123.5,M,"), std::string::npos) << sent(gga);
  EXPECT_EQ(sent(gga).size(), 81U);
  gga.correction_age_s = 123.4;
  EXPECT_EQ(sent(gga), "length is 83, legal: [0, 82]");
}

TEST(Sentences, NumbersAreNotSentWhenTheyAreNotLegal) {
  Gga gga = rtk_fix();
  gga.latitude_deg = 91.0;
  EXPECT_EQ(sent(gga), "latitude is 91, legal: [-90, 90]");
  gga.latitude_deg = kNan;
  EXPECT_EQ(sent(gga), "latitude is nan, legal: [-90, 90]");
  Hdt hdt;
  hdt.heading_deg = kNan;
  EXPECT_EQ(sent(hdt), "heading is nan, legal: [0, 360]");
  hdt.heading_deg = 1.0;
  EXPECT_EQ(sent(hdt, "G"), "talker is 'G', legal: two capital letters or digits, the first not P");
}

TEST(Sentences, AnyTwoLettersAreATalker) {
  Hdt hdt;
  hdt.heading_deg = 12.345;
  EXPECT_EQ(sent(hdt, "HE"), with_checksum("$HEHDT,12.35,T"));
  EXPECT_TRUE(read<Hdt>("$ZZHDT,12.35,T"));
}

TEST(Sentences, ARecommendedMinimumHasADate) {
  const auto rmc =
      read<Rmc>("$GPRMC,071502.500,A,3305.1234,S,07140.5432,W,1.25,271.5,280226,3.5,W,A,S");
  ASSERT_TRUE(rmc);
  EXPECT_EQ(*rmc->date, (CivilDate{2026, 2, 28}));
  EXPECT_EQ(*rmc->variation_deg, -3.5);
  EXPECT_EQ(rmc->mode, 'A');
  EXPECT_EQ(rmc->navigation, 'S');
  EXPECT_EQ(problem_of<Rmc>("$GPRMC,071502.500,A,3305.1234,S,07140.5432,W,1.25,271.5,,,,A"),
            "missing field: date is '', legal: ddmmyy, where there is a fix");
  EXPECT_EQ(problem_of<Rmc>("$GPRMC,071502.500,A,3305.1234,S,07140.5432,W,1.25,271.5,310226,,,A"),
            "out of range: date is '310226', legal: ddmmyy, a day of the calendar");
  EXPECT_EQ(problem_of<Rmc>("$GPRMC,,V,,,,,,,,,,N"), "no problem");
}

TEST(Sentences, OlderRevisionsEndEarlier) {
  EXPECT_TRUE(read<Rmc>("$GPRMC,071502,A,3305.12,S,07140.54,W,001.2,271.5,280226,003.5,E"));
  EXPECT_TRUE(read<Gll>("$GPGLL,3305.12,S,07140.54,W,071502,A"));
  EXPECT_TRUE(read<Dpt>("$SDDPT,2.5,0.3"));
  EXPECT_TRUE(read<Vlw>("$VWVLW,12.4,N,1.5,N"));
}

TEST(Sentences, AFixWithoutTimeOrPlaceIsRefused) {
  EXPECT_EQ(problem_of<Gga>("$GPGGA,,3305.12345,S,07140.54321,W,1,11,0.91,12.5,M,-20.75,M,,"),
            "missing field: UTC is '', legal: hhmmss.ss, where there is a fix");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50,3305.12345,S,,,1,11,0.91,12.5,M,-20.75,M,,"),
            "missing field: longitude is '', legal: a position, where there is a fix");
  EXPECT_EQ(problem_of<Gll>("$GPGLL,3305.12,S,07140.54,W,,A,A"),
            "missing field: UTC is '', legal: hhmmss.ss, where there is a fix");
  EXPECT_TRUE(read<Gga>("$GPGGA,,,,,,0,00,99.99,,,,,,"));
}

TEST(Sentences, IllegalFieldsAreNamedWithTheirRange) {
  const std::string end = ",1,11,0.91,12.5,M,-20.75,M,,";
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50,9100.00000,N,07140.54321,W" + end),
            "out of range: latitude is '9100.00000', legal: [-90, 90]");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50,3360.00000,N,07140.54321,W" + end),
            "out of range: latitude is '3360.00000', legal: [-90, 90]");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50,3305.12345,Q,07140.54321,W" + end),
            "out of range: latitude is 'Q', legal: N or S");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50,nan,N,07140.54321,W" + end),
            "not a number: latitude is 'nan', legal: ddmm.mmmm");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,246000.00,3305.12345,N,07140.54321,W" + end),
            "out of range: UTC is '246000.00', legal: hhmmss or hhmmss.ss, up to 235960");
  EXPECT_EQ(problem_of<Gga>("$GPGGA,0715-2.50,3305.12345,N,07140.54321,W" + end),
            "not a number: UTC is '0715-2.50', legal: hhmmss or hhmmss.ss, up to 235960");
  EXPECT_EQ(problem_of<Hdt>("$HEHDT,nan,T"),
            "not a number: heading is 'nan', legal: a number such as -12.5");
  EXPECT_EQ(problem_of<Hdt>("$HEHDT,1e2,T"),
            "not a number: heading is '1e2', legal: a number such as -12.5");
  EXPECT_EQ(problem_of<Hdt>("$HEHDT,360.1,T"), "out of range: heading is '360.1', legal: [0, 360]");
  EXPECT_EQ(problem_of<Hdt>("$HEHDT,12,M"),
            "out of range: reference of heading is 'M', legal: another letter, or empty");
  EXPECT_EQ(problem_of<Mwv>("$WIMWV,12,R,3,X,A"), "out of range: unit is 'X', legal: KMNS");
}

TEST(Sentences, AWrongNumberOfFieldsIsNamed) {
  EXPECT_EQ(problem_of<Gga>("$GPGGA,071502.50"),
            "wrong number of fields: number of fields is 1, legal: [14, 14]");
  EXPECT_EQ(problem_of<Rmc>("$GPRMC,071502.5,V,,,,,,,,"),
            "wrong number of fields: number of fields is 10, legal: [11, 13]");
  EXPECT_EQ(problem_of<Hdt>("$HEHDT,12,T,1"),
            "wrong number of fields: number of fields is 3, legal: [2, 2]");
  EXPECT_EQ(problem_of<Gsv>("$GPGSV,1,1,02,01,45,120,30,02,10"),
            "wrong number of fields: satellites is 6, legal: fields in whole groups");
}

TEST(Sentences, SatellitesInViewHaveZeroToFourGroups) {
  const auto old = read<Gsv>("$GPGSV,1,1,02,01,45,120,30,02,10,350,");
  ASSERT_TRUE(old);
  ASSERT_EQ(old->satellites.size(), 2U);
  EXPECT_EQ(*old->satellites[0].azimuth_deg, 120);
  EXPECT_FALSE(old->satellites[1].snr_db);
  EXPECT_EQ(old->signal, '\0');
  const auto newer = read<Gsv>("$GLGSV,1,1,01,65,45,120,30,1");
  ASSERT_TRUE(newer);
  EXPECT_EQ(newer->satellites.size(), 1U);
  EXPECT_EQ(newer->signal, '1');
  EXPECT_TRUE(read<Gsv>("$GPGSV,1,1,00"));
  EXPECT_TRUE(read<Gsv>("$GPGSV,1,1,00,1"));
}

TEST(Sentences, SidesAreSigns) {
  const auto xte = read<Xte>("$GPXTE,A,A,0.67,L,N");
  ASSERT_TRUE(xte);
  EXPECT_EQ(*xte->cross_track.distance_nm, 0.67);  // it has to steer left: right of the track
  EXPECT_EQ(*read<Xte>("$GPXTE,A,A,0.67,R,N")->cross_track.distance_nm, -0.67);
  EXPECT_EQ(*read<Vwr>("$WIVWR,45,L,3,N,,M,,K")->angle_deg, -45.0);
}

TEST(Sentences, ARouteIsReadAndWritten) {
  const auto rte = read<Rte>("$GPRTE,2,1,c,0,PIER,BUOY1,BUOY2,HOME");
  ASSERT_TRUE(rte);
  EXPECT_EQ(rte->waypoints.size(), 4U);
  EXPECT_EQ(rte->waypoints[3].name, "HOME");
  EXPECT_EQ(sent(*rte), with_checksum("$GPRTE,2,1,c,0,PIER,BUOY1,BUOY2,HOME"));
  EXPECT_EQ(problem_of<Rte>("$GPRTE,2,3,c,0"), "out of range: sentence is 3, legal: [1, 2]");
}

TEST(Sentences, TextsAreSentWithoutReservedCharacters) {
  Wpl wpl;
  wpl.latitude_deg = 1.0;
  wpl.longitude_deg = 2.0;
  wpl.name = "A,B*C$";
  EXPECT_EQ(sent(wpl), with_checksum("$GPWPL,0100.00000,N,00200.00000,E,ABC"));
}

TEST(Sentences, ATypeThatIsNotKnownIsNoError) {
  Sentence sentence;
  Refusal refusal;
  ASSERT_TRUE(sentence.assign("$GPTXT,01,01,02,x", &refusal));
  EXPECT_EQ(decode(
                sentence, [](const auto&) {}, &refusal),
            Decoded::kUnknown);
  ASSERT_TRUE(sentence.assign("$PGGA,1", &refusal));
  EXPECT_EQ(decode(
                sentence, [](const auto&) {}, &refusal),
            Decoded::kUnknown);
}

template <class T>
class EverySentence : public testing::Test {};

template <class List>
struct TestTypes;
template <class... T>
struct TestTypes<SentenceTypes<T...>> {
  using Type = testing::Types<T...>;
};
TYPED_TEST_SUITE(EverySentence, TestTypes<AllSentences>::Type);

/// Reads an encoded sentence and writes it again. False: it was refused.
bool rewrite(const EncodedSentence& in, EncodedSentence* out) {
  const SentenceLog log = framed(in.view());
  Sentence sentence;
  Refusal refusal;
  if (log.sentences.size() != 1 || !sentence.assign(log.sentences[0], &refusal)) return false;
  const auto write = [&](const auto& value) { encode("GP", value, out, &refusal); };
  return decode(sentence, write, &refusal) == Decoded::kRead;
}

/// Whether rules across fields allow the value.
template <class T>
bool is_consistent(const T& value) {
  Refusal refusal;
  if constexpr (sentence_detail::has_check_v<T>) return value.check(&refusal);
  return true;
}

/// What is written, read, and written again is the same text.
TYPED_TEST(EverySentence, IsReadAsItWasWritten) {
  RandomFields fields(1);
  int written = 0;
  for (int i = 0; i < 2'000; ++i) {
    TypeParam value;
    value.visit(fields);
    EncodedSentence first, second, third;
    Refusal refusal;
    if (!is_consistent(value) || !encode("GP", value, &first, &refusal)) continue;
    ASSERT_LE(first.view().size(), kMaxSentenceLength);
    ASSERT_TRUE(rewrite(first, &second)) << first.view();
    ASSERT_TRUE(rewrite(second, &third)) << second.view();
    ASSERT_EQ(second.view(), third.view());
    // A short one has lost no decimals.
    constexpr std::size_t kShort = 40;
    if (first.view().size() < kShort) ASSERT_EQ(first.view(), second.view());
    ++written;
  }
  EXPECT_GT(written, 20);
}

/// Every text shorter than the whole and every one with a character changed is read or refused.
TYPED_TEST(EverySentence, SurvivesMutation) {
  RandomFields fields(2);
  const RandomStream random(3, "mutation");
  for (std::uint64_t i = 0; i < 300; ++i) {
    TypeParam value;
    value.visit(fields);
    EncodedSentence out;
    Refusal refusal;
    if (!encode("GP", value, &out, &refusal)) continue;
    std::string text(out.view().substr(0, out.view().size() - 5));
    for (std::uint64_t k = 0; k < 4; ++k) {
      const std::uint64_t bits = random.bits(i, static_cast<std::uint32_t>(k));
      const std::size_t at = 7 + bits % text.size();
      if (at < text.size()) text[at] = static_cast<char>(' ' + (bits >> 32U) % 95);
    }
    Sentence sentence;
    if (!sentence.assign(text.substr(0, 7 + random.bits(i, 9) % text.size()), &refusal)) continue;
    if (decode(
            sentence, [](const auto&) {}, &refusal) == Decoded::kRefused) {
      EXPECT_FALSE(to_text(refusal).empty());
    }
  }
}

}  // namespace
}  // namespace trident::bridges::nmea
