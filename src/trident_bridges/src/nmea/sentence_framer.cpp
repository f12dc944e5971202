// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/sentence_framer.h"

#include <algorithm>
#include <string>

#include "trident_base/error.h"
#include "trident_base/hex_digit.h"
#include "trident_bridges/nmea/field_values.h"

namespace trident::bridges::nmea {
namespace {

constexpr std::size_t kLineEnd = 2;  ///< CR and LF, which a sentence's length counts
constexpr std::size_t kChecksumDigits = 2;
constexpr std::size_t kAddressLength = 5;       ///< of "GPGGA"
constexpr std::size_t kMakerAddressLength = 4;  ///< of "PUBX", at the least
constexpr const char* kHexDigits = "0123456789ABCDEF";

bool is_printable(char c) { return c >= ' ' && c <= '~'; }
bool is_start(char c) { return c == '$' || c == '!'; }
bool is_line_end(char c) { return c == '\r' || c == '\n'; }

/// The value of two hexadecimal digits, -1 when they are something else.
int checksum_value(std::string_view digits) {
  if (digits.size() != kChecksumDigits) return -1;
  const int high = hex_digit(digits[0]), low = hex_digit(digits[1]);
  return high < 0 || low < 0 ? -1 : 16 * high + low;
}

bool is_right(std::string_view text, std::string_view digits) {
  return checksum_value(digits) == checksum_of(text.substr(1));
}

/// "\s:station,c:1609459200*hh\" without the backslashes: right, or without a checksum.
bool is_tag_block(std::string_view block) {
  const std::size_t star = block.find('*');
  if (star == std::string_view::npos) return true;
  return checksum_value(block.substr(star + 1)) == checksum_of(block.substr(0, star));
}

}  // namespace

SentenceFramer::SentenceFramer(const FramerParams& params) : params_(params) {
  if (params.max_length < kMaxSentenceLength || params.max_length > kMaxLength) {
    throw Error("max_length is " + std::to_string(params.max_length) + ", legal: [82, 1024]");
  }
}

void SentenceFramer::feed(Span<const std::uint8_t> bytes, SentenceSink& sink) {
  counts_.bytes += bytes.size();
  for (const std::uint8_t byte : bytes) take(static_cast<char>(byte), sink);
}

void SentenceFramer::finish(SentenceSink& sink) {
  take('\n', sink);
  reset();
}

void SentenceFramer::reset() {
  if (state_ == State::kSentence) counts_.skipped += length_;
  state_ = State::kIdle;
  length_ = tag_length_ = 0;
}

void SentenceFramer::begin(char start) {
  state_ = State::kSentence;
  line_[0] = start;
  length_ = 1;
  star_ = bang_ = 0;
}

void SentenceFramer::take(char c, SentenceSink& sink) {
  switch (state_) {
    case State::kSentence:
      take_in_sentence(c, sink);
      break;
    case State::kIdle:
      take_idle(c);
      break;
    case State::kTagBlock:
      take_in_tag_block(c);
      break;
    case State::kOverlong:
      take_overlong(c);
      break;
  }
}

void SentenceFramer::take_overlong(char c) {
  if (is_start(c)) {
    begin(c);
  } else if (!is_printable(c)) {
    state_ = State::kIdle;
  } else {
    ++counts_.skipped;
  }
}

void SentenceFramer::take_idle(char c) {
  if (is_start(c)) {
    begin(c);
    return;
  }
  tag_length_ = 0;  // it belongs to what stands directly behind it
  if (c == '\\') {
    state_ = State::kTagBlock;
  } else if (!is_line_end(c)) {
    ++counts_.skipped;
  }
}

void SentenceFramer::take_in_tag_block(char c) {
  if (is_start(c)) {
    counts_.skipped += 1 + tag_length_;
    tag_length_ = 0;
    begin(c);
  } else if (c == '\\') {
    state_ = State::kIdle;
    if (!is_tag_block({tag_block_.data(), tag_length_})) tag_length_ = 0;
  } else if (!is_printable(c) || tag_length_ + kLineEnd >= kMaxTagBlockLength) {
    state_ = State::kIdle;
    counts_.skipped += 2 + tag_length_;
    tag_length_ = 0;
  } else {
    tag_block_[tag_length_++] = c;
  }
}

void SentenceFramer::take_in_sentence(char c, SentenceSink& sink) {
  if (is_line_end(c)) {
    end_without_checksum(sink);
  } else if (c == '$') {
    // What stood before was cut off: "$" is reserved for beginnings.
    counts_.skipped += length_;
    tag_length_ = 0;
    begin(c);
  } else if (!is_printable(c)) {
    const auto byte = static_cast<std::uint8_t>(c);
    refuse({RefusalKind::kNotText, "character", static_cast<double>(byte), ' ', '~'}, sink);
  } else if (length_ + kLineEnd == params_.max_length) {
    const auto most = static_cast<double>(params_.max_length);
    const bool is_over = bang_ == 0;
    refuse({RefusalKind::kTooLong, "length", most + 1.0, 0.0, most}, sink);
    if (is_over) state_ = State::kOverlong;
    take(c, sink);
  } else {
    append(c, sink);
  }
}

void SentenceFramer::append(char c, SentenceSink& sink) {
  line_[length_] = c;
  if (c == '*' && star_ == 0) star_ = length_;
  if (c == '!') bang_ = length_;
  ++length_;
  if (star_ != 0 && length_ == star_ + 1 + kChecksumDigits) end_with_checksum(sink);
}

void SentenceFramer::end_with_checksum(SentenceSink& sink) {
  const std::string_view text(line_.data(), star_);
  const std::string_view digits(line_.data() + star_ + 1, length_ - star_ - 1);
  if (is_right(text, digits)) {
    hand_out(text, sink);
    return;
  }
  const std::uint8_t right = checksum_of(text.substr(1));
  const std::array<char, 3> legal{kHexDigits[right / 16], kHexDigits[right % 16], '\0'};
  refuse({RefusalKind::kWrongChecksum, "checksum", digits, legal.data()}, sink);
}

void SentenceFramer::end_without_checksum(SentenceSink& sink) {
  if (star_ != 0) {
    end_with_checksum(sink);
  } else if (params_.require_checksum) {
    refuse({RefusalKind::kNoChecksum, "checksum", "", "* and two hexadecimal digits"}, sink);
  } else {
    hand_out({line_.data(), length_}, sink);
  }
}

void SentenceFramer::hand_out(std::string_view text, SentenceSink& sink) {
  Refusal refusal;
  if (!sentence_.assign(text, &refusal)) {
    refuse(refusal, sink);
    return;
  }
  sentence_.set_tag_block({tag_block_.data(), tag_length_});
  ++counts_.sentences;
  sink.on_sentence(sentence_);
  state_ = State::kIdle;
  tag_length_ = 0;
}

void SentenceFramer::refuse(const Refusal& refusal, SentenceSink& sink) {
  if (bang_ != 0 && refusal.kind != RefusalKind::kNotText) {
    take_again_from_bang(sink);
    return;
  }
  if (has_address()) {
    counts_.refused.count(refusal.kind);
    sink.on_refusal(refusal, {line_.data(), length_});
  } else {
    counts_.skipped += length_;
  }
  state_ = State::kIdle;
  tag_length_ = 0;
}

/// Whether what was read began as a sentence does; otherwise it was noise.
bool SentenceFramer::has_address() const {
  const std::string_view text(line_.data(), length_);
  const std::size_t end = std::min(text.find_first_of(",*"), text.size());
  const std::string_view address = text.substr(1, end - 1);
  const bool is_maker = !address.empty() && address[0] == 'P';
  return address.size() >= (is_maker ? kMakerAddressLength : kAddressLength) &&
         std::all_of(address.begin(), address.end(), is_capital_or_digit);
}

void SentenceFramer::take_again_from_bang(SentenceSink& sink) {
  std::array<char, kMaxLength> rest{};
  const std::size_t rest_length = length_ - bang_;
  std::copy_n(line_.begin() + static_cast<std::ptrdiff_t>(bang_), rest_length, rest.begin());
  counts_.skipped += bang_;
  state_ = State::kIdle;
  tag_length_ = 0;
  for (std::size_t i = 0; i < rest_length; ++i) take(rest[i], sink);
}

}  // namespace trident::bridges::nmea
