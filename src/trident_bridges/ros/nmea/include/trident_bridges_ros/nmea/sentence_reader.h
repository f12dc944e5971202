// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/receive/receiver.h"
#include "trident_bridges/nmea/sentence_framer.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// How sentences are read.
struct NmeaReadParams {
  nmea::FramerParams framer;
  nmea::ReceiverParams receiver;
};

/// What a reader hands on, and where it takes the time from.
struct NmeaReadHooks {
  std::function<nmea::Receipt()> receipt;               ///< of bytes that come now
  std::function<void(const nmea::Sentence&)> sentence;  ///< each that was found; may be empty
  nmea::ReceiverSink* events = nullptr;                 ///< what they say; nullptr: nobody asks
  ros_utils::Refusals* refusals = nullptr;              ///< logs and counts what is wrong
};

/// Reads the sentences of one source: a peer of a link, or a topic.
class SentenceReader : nmea::SentenceSink, nmea::ProblemSink {
 public:
  /// `link` and `peer` name the source in messages; `hooks` outlive the reader.
  SentenceReader(std::string link, std::string peer, const NmeaReadParams& params,
                 const NmeaReadHooks& hooks);

  /// Reads what came. `is_whole`: no sentence continues in the next block, as of a datagram.
  void read(Bytes bytes, bool is_whole);
  const std::string& peer() const { return peer_; }  ///< as given
  /// Since the beginning.
  const nmea::FramerCounts& counts() const { return framer_.counts(); }

 private:
  void on_sentence(const nmea::Sentence& sentence) override;
  void on_refusal(const nmea::Refusal& refusal, std::string_view text) override;
  void on_problem(const nmea::Refusal& refusal, const nmea::Sentence& sentence) override;

  std::string link_, peer_;
  const NmeaReadHooks& hooks_;
  nmea::Receipt receipt_;  ///< of the bytes that are read now
  nmea::ReceiverSink nobody_;
  nmea::SentenceFramer framer_;
  nmea::Receiver receiver_;
};

/// A sentence with its checksum, without a line end.
std::string text_of(const nmea::Sentence& sentence);

}  // namespace trident::bridges
