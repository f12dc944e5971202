// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// All sentences that are understood, and how they are read and written.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trident_bridges/nmea/field_reader.h"
#include "trident_bridges/nmea/field_writer.h"
#include "trident_bridges/nmea/sentence.h"
#include "trident_bridges/nmea/sentences/ais_part.h"
#include "trident_bridges/nmea/sentences/heading.h"
#include "trident_bridges/nmea/sentences/machinery.h"
#include "trident_bridges/nmea/sentences/position.h"
#include "trident_bridges/nmea/sentences/route.h"
#include "trident_bridges/nmea/sentences/satellites.h"
#include "trident_bridges/nmea/sentences/steering.h"
#include "trident_bridges/nmea/sentences/water.h"
#include "trident_bridges/nmea/sentences/wind.h"

namespace trident::bridges::nmea {

/// Types of sentences.
template <class... Types>
struct SentenceTypes {};

/// Those that are understood; the frequent ones first.
using AllSentences = SentenceTypes<Gga, Rmc, Vtg, Gsv, Gsa, Gll, Gst, Zda, Gbs, Dtm, Vdm, Vdo, Hdt,
                                   Ths, Hdg, Hdm, Rot, Mwv, Mwd, Vwr, Vwt, Vhw, Vbw, Vlw, Dpt, Dbt,
                                   Mtw, Xdr, Rpm, Rsa, Apb, Apa, Rmb, Xte, Bod, Bwc, Wpl, Rte>;

namespace sentence_detail {

/// Stands for a type in a call.
template <class T>
struct Tag {
  using Type = T;  ///< what it stands for
};

/// Whether T has rules across its fields.
template <class T, class = void>
inline constexpr bool has_check_v = false;
template <class T>
inline constexpr bool
    has_check_v<T, std::void_t<decltype(std::declval<const T&>().check(nullptr))>> = true;

template <class T, class Visitor>
bool read_as(const Sentence& sentence, Visitor& visitor, Refusal* refusal) {
  T value;
  FieldReader reader(sentence);
  value.visit(reader);
  if (!reader.finish(refusal)) return false;
  if constexpr (has_check_v<T>) {
    if (!value.check(refusal)) return false;
  }
  visitor(static_cast<const T&>(value));
  return true;
}

}  // namespace sentence_detail

/// What became of a sentence.
enum class Decoded {
  kRead,     ///< the visitor was called
  kUnknown,  ///< its type is not understood
  kRefused,  ///< a field is not legal
};

namespace sentence_detail {

template <class Visitor, class... Types>
Decoded decode_as(const Sentence& sentence, Visitor& visitor, Refusal* refusal,
                  SentenceTypes<Types...> /*types*/) {
  const std::uint32_t code = sentence.is_proprietary() ? 0 : type_code(sentence.type());
  Decoded result = Decoded::kUnknown;
  const auto try_type = [&](auto tag) {
    using Type = typename decltype(tag)::Type;
    if (code != type_code(Type::kType)) return false;
    result = read_as<Type>(sentence, visitor, refusal) ? Decoded::kRead : Decoded::kRefused;
    return true;
  };
  (void)(try_type(Tag<Types>{}) || ...);
  return result;
}

}  // namespace sentence_detail

/// Reads a sentence into the struct of its type and calls `visitor` with it. A refusal refers to
/// the sentence's characters.
template <class Visitor>
Decoded decode(const Sentence& sentence, Visitor&& visitor, Refusal* refusal) {
  return sentence_detail::decode_as(sentence, visitor, refusal, AllSentences{});
}

/// A sentence as it is sent, with checksum, CR and LF.
class EncodedSentence {
 public:
  std::string_view view() const { return {text_.data(), size_}; }  ///< all of it

  /// Where an encoder writes all but checksum, CR and LF.
  CharWriter body() { return {text_.data(), kMaxSentenceLength - kTailLength}; }
  /// Adds checksum, CR and LF behind the `size` characters that were written to body().
  void close(std::size_t size);

 private:
  static constexpr std::size_t kTailLength = 5;  ///< of "*hh", CR and LF
  std::array<char, kMaxSentenceLength> text_{};
  std::size_t size_ = 0;
};

/// Fills `refusal` with a talker that has not two capital letters or digits, and returns false.
bool check_talker(std::string_view talker, Refusal* refusal);
/// Fills `refusal` with a sentence that does not fit, and returns false.
bool refuse_length(Refusal* refusal);

/// Writes a sentence, never longer than kMaxSentenceLength: if need be, numbers lose decimals, down
/// to one. False, with `refusal` filled, when a value is not legal or it does not fit.
template <class T>
bool encode(std::string_view talker, T value, EncodedSentence* out, Refusal* refusal) {
  constexpr int kMaxOmittedDecimals = 3;
  if (!check_talker(talker, refusal)) return false;
  for (int omitted = 0; omitted <= kMaxOmittedDecimals; ++omitted) {
    CharWriter body = out->body();
    body.put(std::is_base_of_v<AisPart, T> ? '!' : '$');
    body.put(talker);
    body.put(T::kType);
    FieldWriter writer(body, omitted);
    value.visit(writer);
    if (!writer.finish(refusal)) return false;
    if (body.has_overflowed()) continue;
    out->close(body.size());
    return true;
  }
  return refuse_length(refusal);
}

}  // namespace trident::bridges::nmea
