// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

#include "trident_bridges/nmea/ais/target_table.h"
#include "trident_bridges/nmea/all_sentences.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/receive/instrument_reader.h"
#include "trident_bridges/nmea/receive/navsat_reader.h"
#include "trident_bridges/nmea/receive/steering_reader.h"

namespace trident::bridges::nmea {

/// What a Receiver needs to know.
struct ReceiverParams {
  NavsatParams navsat;
  SteeringParams steering;
  std::optional<double> magnetic_variation_deg;  ///< until a sentence says it; east is positive
};

/// How many sentences came.
struct ReceiverCounts {
  std::uint64_t read = 0;         ///< understood
  std::uint64_t unknown = 0;      ///< of a type that is not understood
  std::uint64_t proprietary = 0;  ///< of a manufacturer
  RefusalCounts refused;          ///< by kind
};

/// Reads the sentences of one peer.
class Receiver {
 public:
  /// `sink` and `problems` outlive the receiver.
  Receiver(const ReceiverParams& params, ReceiverSink& sink, ProblemSink& problems);
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  /// Hands what the sentence says to the sink.
  void read(const Sentence& sentence, const Receipt& receipt);
  /// Since the beginning.
  const ReceiverCounts& counts() const { return counts_; }

 private:
  struct Visitor;
  void read_ais(const AisPart& part, bool is_own, const Sentence& sentence, const Receipt& receipt);

  ReceiverSink& sink_;
  ProblemSink& problems_;
  Magnetic magnetic_;
  NavsatReader navsat_;
  InstrumentReader instruments_;
  SteeringReader steering_;
  RouteReader routes_;
  AisAssembler assembler_;
  AisTargetTable targets_;
  ReceiverCounts counts_;
};

}  // namespace trident::bridges::nmea
