// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/all_sentences.h"

#include <algorithm>

namespace trident::bridges::nmea {

void EncodedSentence::close(std::size_t size) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  const std::uint8_t sum = checksum_of({text_.data() + 1, size - 1});
  CharWriter tail(text_.data() + size, kTailLength);
  tail.put('*');
  tail.put(kDigits[sum / 16]);
  tail.put(kDigits[sum % 16]);
  tail.put("\r\n");
  size_ = size + kTailLength;
}

bool check_talker(std::string_view talker, Refusal* refusal) {
  const bool is_maker = !talker.empty() && talker[0] == 'P';
  if (talker.size() == 2 && !is_maker &&
      std::all_of(talker.begin(), talker.end(), is_capital_or_digit)) {
    return true;
  }
  *refusal = {RefusalKind::kBadAddress, "talker", talker,
              "two capital letters or digits, the first not P"};
  return false;
}

bool refuse_length(Refusal* refusal) {
  *refusal = {RefusalKind::kTooLong, "length", kMaxSentenceLength + 1.0, 0.0, kMaxSentenceLength};
  return false;
}

}  // namespace trident::bridges::nmea
