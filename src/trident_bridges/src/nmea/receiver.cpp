// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/receiver.h"

#include <type_traits>
#include <utility>

namespace trident::bridges::nmea {
namespace {

/// Whether Reader has a read() for sentences of type T.
template <class Reader, class T, class = void>
inline constexpr bool reads_v = false;
template <class Reader, class T>
inline constexpr bool reads_v<Reader, T,
                              std::void_t<decltype(std::declval<Reader&>().read(
                                  std::declval<const T&>(), std::declval<const Receipt&>()))>> =
    true;

}  // namespace

/// Hands each sentence to the readers that know its type.
struct Receiver::Visitor {
  Receiver& receiver;
  const Sentence& sentence;
  const Receipt& receipt;

  template <class T>
  void operator()(const T& value) {
    if constexpr (std::is_base_of_v<AisPart, T>) {
      receiver.read_ais(value, std::is_same_v<T, Vdo>, sentence, receipt);
    } else if constexpr (std::is_same_v<T, Rmc>) {
      if (value.variation_deg) receiver.magnetic_.variation_deg = value.variation_deg;
      receiver.navsat_.read(value, receipt);
    } else if constexpr (reads_v<NavsatReader, T>) {
      receiver.navsat_.read(value, receipt);
    } else if constexpr (reads_v<InstrumentReader, T>) {
      receiver.instruments_.read(value, receipt);
    } else if constexpr (reads_v<SteeringReader, T>) {
      receiver.steering_.read(value, receipt);
    } else if constexpr (reads_v<RouteReader, T>) {
      receiver.routes_.read(value, receipt);
    }
  }
};

Receiver::Receiver(const ReceiverParams& params, ReceiverSink& sink, ProblemSink& problems)
    : sink_(sink),
      problems_(problems),
      magnetic_{params.magnetic_variation_deg},
      navsat_(params.navsat, sink),
      instruments_(magnetic_, sink),
      steering_(params.steering, magnetic_, sink),
      routes_(sink) {}

void Receiver::read(const Sentence& sentence, const Receipt& receipt) {
  if (sentence.is_proprietary()) {
    ++counts_.proprietary;
    return;
  }
  Refusal refusal;
  switch (decode(sentence, Visitor{*this, sentence, receipt}, &refusal)) {
    case Decoded::kRead:
      ++counts_.read;
      break;
    case Decoded::kUnknown:
      ++counts_.unknown;
      break;
    case Decoded::kRefused:
      counts_.refused.count(refusal.kind);
      problems_.on_problem(refusal, sentence);
      break;
  }
}

void Receiver::read_ais(const AisPart& part, bool is_own, const Sentence& sentence,
                        const Receipt& receipt) {
  Refusal refusal;
  bool is_refused = false;
  const AisVessel* vessel = nullptr;
  const AisBits* const bits = assembler_.add(part, receipt.now_s, &refusal, &is_refused);
  if (bits != nullptr) vessel = targets_.add(*bits, receipt.now_s, &refusal, &is_refused);
  if (is_refused) {
    counts_.refused.count(refusal.kind);
    problems_.on_problem(refusal, sentence);
  }
  if (vessel != nullptr) sink_.on_ais(*vessel, is_own);
}

}  // namespace trident::bridges::nmea
