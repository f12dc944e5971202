// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trident_base/span.h"
#include "trident_bridges/nmea/sentence_framer.h"

namespace trident::bridges::nmea {

/// Keeps what a framer has handed out.
class SentenceLog : public SentenceSink {
 public:
  void on_sentence(const Sentence& sentence) override {
    sentences.emplace_back(sentence.text());
    tag_blocks.emplace_back(sentence.tag_block());
  }
  void on_refusal(const Refusal& refusal, std::string_view text) override {
    refusals.push_back(std::string(name_of(refusal.kind)) + ": " + to_text(refusal));
    refused_texts.emplace_back(text);
  }

  std::vector<std::string> sentences, tag_blocks, refusals, refused_texts;
};

/// The bytes of a text.
inline Span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// "$" or "!" and the rest, with the checksum, CR and LF behind it.
inline std::string with_checksum(const std::string& text) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  const std::uint8_t sum = checksum_of(std::string_view(text).substr(1));
  return text + '*' + kDigits[sum / 16] + kDigits[sum % 16] + "\r\n";
}

/// What a framer finds in a text.
inline SentenceLog framed(std::string_view text, const FramerParams& params = {}) {
  SentenceLog log;
  SentenceFramer framer(params);
  framer.feed(bytes_of(text), log);
  return log;
}

}  // namespace trident::bridges::nmea
