// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trident_base/config_types.h"
#include "trident_base/span.h"
#include "trident_bridges/nmea/refusal.h"
#include "trident_bridges/nmea/sentence.h"

namespace trident::bridges::nmea {

/// What a SentenceFramer accepts.
struct FramerParams {
  bool require_checksum = true;                 ///< refuses sentences without "*hh"
  std::size_t max_length = kMaxSentenceLength;  ///< with CR and LF, [82, 1024]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("require_checksum", require_checksum, "refuses sentences without a checksum");
    ar.field("max_length", max_length, Range{kMaxSentenceLength, 1024},
             "longest sentence that is read, with CR and LF [characters]");
  }
};

/// What a SentenceFramer finds. What it hands out lives during the call.
class SentenceSink {
 public:
  virtual ~SentenceSink() = default;
  /// A sentence whose checksum is right, or which has none and needs none.
  virtual void on_sentence(const Sentence& sentence) = 0;
  /// Something that began as a sentence and did not become one. `text`: as much of it as was read.
  virtual void on_refusal(const Refusal& refusal, std::string_view text) = 0;
};

/// What a SentenceFramer has read.
struct FramerCounts {
  std::uint64_t bytes = 0;      ///< all
  std::uint64_t skipped = 0;    ///< bytes of no sentence: binary protocols, noise
  std::uint64_t sentences = 0;  ///< handed out
  RefusalCounts refused;        ///< by kind
};

/// Finds sentences in a stream of bytes, however it is cut into blocks, also between the messages
/// of binary protocols (UBX, SiRF). A sentence ends with its checksum, or without one with CR or
/// LF. "$" begins one wherever it stands; after a failure the search goes back to the last "!" in
/// it. Allocates nothing.
class SentenceFramer {
 public:
  /// Throws Error naming max_length and its legal range.
  explicit SentenceFramer(const FramerParams& params = {});

  /// Reads a block and hands what it ends to `sink`.
  void feed(Span<const std::uint8_t> bytes, SentenceSink& sink);
  /// The block was a datagram, which ends as a line does.
  void finish(SentenceSink& sink);
  /// Forgets a sentence that has begun: the stream was interrupted.
  void reset();
  /// Since the beginning.
  const FramerCounts& counts() const { return counts_; }

  static constexpr std::size_t kMaxLength = 1024;        ///< of FramerParams::max_length
  static constexpr std::size_t kMaxTagBlockLength = 80;  ///< with its backslashes (NMEA 4.10, 7)

 private:
  enum class State { kIdle, kTagBlock, kSentence, kOverlong };

  void begin(char start);
  void take(char c, SentenceSink& sink);
  void take_overlong(char c);
  void take_idle(char c);
  void take_in_tag_block(char c);
  void take_in_sentence(char c, SentenceSink& sink);
  void append(char c, SentenceSink& sink);
  void end_with_checksum(SentenceSink& sink);
  void end_without_checksum(SentenceSink& sink);
  void hand_out(std::string_view text, SentenceSink& sink);
  void refuse(const Refusal& refusal, SentenceSink& sink);
  bool has_address() const;
  void take_again_from_bang(SentenceSink& sink);

  FramerParams params_;
  FramerCounts counts_;
  State state_ = State::kIdle;
  std::array<char, kMaxLength> line_{};
  std::size_t length_ = 0;  ///< of line_
  std::size_t star_ = 0;    ///< where "*" is in line_; 0: nowhere yet
  std::size_t bang_ = 0;    ///< where the last "!" behind the first character is; 0: nowhere
  std::array<char, kMaxTagBlockLength> tag_block_{};
  std::size_t tag_length_ = 0;
  Sentence sentence_;
};

}  // namespace trident::bridges::nmea
