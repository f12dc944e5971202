// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/sentence_reader.h"

#include <ros/ros.h>

#include <utility>

#include "trident_ros/message_checks.h"

namespace trident::bridges {

SentenceReader::SentenceReader(std::string link, std::string peer, const NmeaReadParams& params,
                               const NmeaReadHooks& hooks)
    : link_(std::move(link)),
      peer_(std::move(peer)),
      hooks_(hooks),
      framer_(params.framer),
      receiver_(params.receiver, hooks.events == nullptr ? nobody_ : *hooks.events, *this) {}

void SentenceReader::read(Bytes bytes, bool is_whole) {
  receipt_ = hooks_.receipt();
  framer_.feed(bytes, *this);
  if (is_whole) framer_.finish(*this);
}

void SentenceReader::on_sentence(const nmea::Sentence& sentence) {
  if (hooks_.sentence) hooks_.sentence(sentence);
  receiver_.read(sentence, receipt_);
}

void SentenceReader::on_refusal(const nmea::Refusal& refusal, std::string_view text) {
  if (hooks_.refusals == nullptr) return;
  const std::string what = link_ + ", from " + peer_ + ": " + nmea::to_text(refusal) + ", in '" +
                           std::string(text) + "'";
  hooks_.refusals->note(link_ + ": " + nmea::name_of(refusal.kind), ros_utils::quoted(what));
}

void SentenceReader::on_problem(const nmea::Refusal& refusal, const nmea::Sentence& sentence) {
  on_refusal(refusal, sentence.text());
}

std::string text_of(const nmea::Sentence& sentence) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text(sentence.text());
  const unsigned sum = nmea::checksum_of(sentence.text().substr(1));
  text += {'*', kDigits[sum / 16], kDigits[sum % 16]};
  return text;
}

}  // namespace trident::bridges
