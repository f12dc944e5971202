// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "trident_base/random_stream.h"
#include "trident_bridges/nmea/ais/messages.h"
#include "trident_bridges/nmea/ais/target_table.h"

namespace trident::bridges::nmea {
namespace {

AisPosition sample_position() {
  AisPosition position;
  position.header.mmsi = 257'000'001;
  position.status = 0;
  position.turn_rate_deg_min = -20.0;
  position.motion.speed_knots = 5.3;
  position.motion.longitude_deg = 10.399;
  position.motion.latitude_deg = -63.4389;
  position.motion.course_deg = 271.4;
  position.motion.heading_deg = 270.0;
  position.motion.second = 42;
  return position;
}

AisVoyage sample_voyage() {
  AisVoyage voyage;
  voyage.header.mmsi = 257'000'001;
  voyage.imo = 9'074'729;
  voyage.call_sign = "LATR1";
  voyage.name = "TRIDENT ONE";
  voyage.ship_type = 99;
  voyage.extent = {3, 2, 1, 1};
  voyage.draft_m = 0.4;
  voyage.destination = "TRONDHEIM";
  return voyage;
}

/// The sentences that carry a message.
std::vector<AisPart> parts_of(const AisBits& bits, std::size_t characters = 60) {
  std::vector<AisPart> parts;
  for (std::size_t at = 0; at < bits.size(); at += 6 * characters) {
    AisPart part;
    part.number = static_cast<int>(parts.size()) + 1;
    part.channel = 'A';
    part.payload = payload_of(bits, at, characters);
    part.fill_bits = fill_bits_of(bits, at, characters);
    parts.push_back(part);
  }
  for (AisPart& part : parts) {
    part.total = static_cast<int>(parts.size());
    if (parts.size() > 1) part.sequence = 3;
  }
  return parts;
}

/// A table that has got messages whole.
struct Received {
  AisAssembler assembler;
  AisTargetTable table;
  Refusal refusal;
  bool is_refused = false;

  const AisVessel* add(const AisBits& bits, double now_s = 0.0) {
    const AisVessel* vessel = nullptr;
    for (const AisPart& part : parts_of(bits)) {
      const AisBits* whole = assembler.add(part, now_s, &refusal, &is_refused);
      if (whole != nullptr) vessel = table.add(*whole, now_s, &refusal, &is_refused);
    }
    return vessel;
  }
};

TEST(Ais, MessagesHaveTheLengthsOfTheStandard) {
  EXPECT_EQ(to_bits(AisPosition{}).size(), 168U);
  EXPECT_EQ(to_bits(AisVoyage{}).size(), 424U);
  EXPECT_EQ(to_bits(AisClassBPosition{}).size(), 168U);
  AisDescription description;
  EXPECT_EQ(to_bits(description).size(), 168U);
  description.part = 1;
  EXPECT_EQ(to_bits(description).size(), 168U);
}

TEST(Ais, APositionIsReadAsItWasWritten) {
  Received received;
  const AisVessel* const vessel = received.add(to_bits(sample_position()));
  ASSERT_NE(vessel, nullptr);
  EXPECT_EQ(vessel->mmsi, 257'000'001U);
  EXPECT_EQ(vessel->message_type, 1U);
  EXPECT_EQ(vessel->status, 0U);
  EXPECT_NEAR(*vessel->turn_rate_deg_min, -20.0, 1.0);
  EXPECT_EQ(*vessel->motion.speed_knots, 5.3);
  EXPECT_NEAR(*vessel->motion.longitude_deg, 10.399, 1e-6);
  EXPECT_NEAR(*vessel->motion.latitude_deg, -63.4389, 1e-6);
  EXPECT_EQ(*vessel->motion.course_deg, 271.4);
  EXPECT_EQ(*vessel->motion.heading_deg, 270.0);
  EXPECT_EQ(vessel->motion.second, 42U);
}

TEST(Ais, WhatIsNotAvailableStaysAbsent) {
  AisPosition position;
  position.header.mmsi = 1;
  Received received;
  const AisVessel* const vessel = received.add(to_bits(position));
  ASSERT_NE(vessel, nullptr);
  EXPECT_FALSE(vessel->turn_rate_deg_min);
  EXPECT_FALSE(vessel->motion.speed_knots);
  EXPECT_FALSE(vessel->motion.longitude_deg);
  EXPECT_FALSE(vessel->motion.latitude_deg);
  EXPECT_FALSE(vessel->motion.course_deg);
  EXPECT_FALSE(vessel->motion.heading_deg);
}

TEST(Ais, ADescriptionInTwoSentencesIsMergedWithPositions) {
  Received received;
  EXPECT_EQ(parts_of(to_bits(sample_voyage())).size(), 2U);
  ASSERT_NE(received.add(to_bits(sample_voyage())), nullptr);
  const AisVessel* const vessel = received.add(to_bits(sample_position()), 60.0);
  ASSERT_NE(vessel, nullptr);
  EXPECT_EQ(vessel->name, "TRIDENT ONE");
  EXPECT_EQ(vessel->call_sign, "LATR1");
  EXPECT_EQ(vessel->ship_type, 99U);
  EXPECT_EQ(vessel->extent.to_bow_m, 3U);
  EXPECT_EQ(received.table.size(), 1U);
}

TEST(Ais, ClassBIsReadFromThreeMessages) {
  AisClassBPosition position;
  position.header.mmsi = 7;
  position.motion = sample_position().motion;
  AisDescription name, rest;
  name.header.mmsi = rest.header.mmsi = 7;
  name.name = "SMALL BOAT";
  rest.part = 1;
  rest.ship_type = 37;
  rest.call_sign = "XY1";
  rest.extent = {4, 1, 2, 2};
  Received received;
  received.add(to_bits(name));
  received.add(to_bits(rest));
  const AisVessel* const vessel = received.add(to_bits(position));
  ASSERT_NE(vessel, nullptr);
  EXPECT_EQ(vessel->message_type, 18U);
  EXPECT_EQ(vessel->name, "SMALL BOAT");
  EXPECT_EQ(vessel->call_sign, "XY1");
  EXPECT_EQ(vessel->ship_type, 37U);
  EXPECT_EQ(vessel->extent.to_starboard_m, 2U);
  EXPECT_NEAR(*vessel->motion.latitude_deg, -63.4389, 1e-6);
}

TEST(Ais, ATextKeepsCapitalsDigitsAndBlanksWithin) {
  AisVoyage voyage = sample_voyage();
  voyage.name = "a b? 1\x7f";
  const auto back = from_bits<AisVoyage>(to_bits(voyage));
  EXPECT_EQ(back.name, "A B? 1");
}

TEST(Ais, APartWithoutTheOneBeforeIsRefused) {
  const std::vector<AisPart> parts = parts_of(to_bits(sample_voyage()));
  AisAssembler assembler;
  Refusal refusal;
  bool is_refused = false;
  EXPECT_EQ(assembler.add(parts[1], 0.0, &refusal, &is_refused), nullptr);
  EXPECT_TRUE(is_refused);
  EXPECT_EQ(to_text(refusal), "sentence is 2, legal: [1, 1]");
  EXPECT_EQ(assembler.add(parts[0], 0.0, &refusal, &is_refused), nullptr);
  EXPECT_FALSE(is_refused);
  EXPECT_EQ(assembler.add(parts[1], 60.0, &refusal, &is_refused), nullptr) << "too late";
  EXPECT_TRUE(is_refused);
}

TEST(Ais, WrongPayloadsAreNamed) {
  AisPart part = parts_of(to_bits(sample_position()))[0];
  part.payload = "1P00~";
  AisAssembler assembler;
  Refusal refusal;
  bool is_refused = false;
  EXPECT_EQ(assembler.add(part, 0.0, &refusal, &is_refused), nullptr);
  EXPECT_EQ(to_text(refusal),
            "payload is '1P00~', legal: characters 0 to W and ` to w, 1014 bits in all");
  Received received;
  AisPosition nobody = sample_position();
  nobody.header.mmsi = 0;
  EXPECT_EQ(received.add(to_bits(nobody)), nullptr);
  EXPECT_EQ(to_text(received.refusal), "MMSI is 0, legal: [1, 999999999]");
  AisBits cut = to_bits(sample_position());
  cut.drop(60);
  EXPECT_EQ(received.add(cut), nullptr);
  EXPECT_EQ(to_text(received.refusal), "bits is 108, legal: [137, 1014]");
}

TEST(Ais, AMessageThatIsNotUnderstoodIsNoError) {
  AisPosition other = sample_position();
  other.header.type = 9;
  Received received;
  EXPECT_EQ(received.add(to_bits(other)), nullptr);
  EXPECT_FALSE(received.is_refused);
}

TEST(Ais, TheStationNotHeardLongestIsForgotten) {
  Received received;
  AisPosition position = sample_position();
  for (std::uint32_t i = 1; i <= AisTargetTable::kMaxVessels + 5; ++i) {
    position.header.mmsi = 1'000'000 - i;
    ASSERT_NE(received.add(to_bits(position), i), nullptr);
  }
  EXPECT_EQ(received.table.size(), AisTargetTable::kMaxVessels);
}

TEST(Ais, RandomBitsAreReadOrRefused) {
  const RandomStream random(11, "ais");
  Received received;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    AisBits bits;
    const std::uint64_t words = random.bits(i, 0) % 20;
    for (std::uint32_t word = 0; word < words; ++word) {
      bits.append(static_cast<std::uint32_t>(random.bits(i, 1 + word)), 6 + word % 20);
    }
    if (bits.size() > 0) received.add(bits, static_cast<double>(i));
  }
  EXPECT_LE(received.table.size(), AisTargetTable::kMaxVessels);
}

}  // namespace
}  // namespace trident::bridges::nmea
