// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/send/sentence_sender.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::nmea {
namespace {

template <class... Types>
std::vector<std::string> names_of(SentenceTypes<Types...> /*types*/) {
  return {Types::kType...};
}

}  // namespace

void TalkerIds::validate() const {
  for (const auto& [name, id] : {std::pair<const char*, const std::string&>{"gnss", gnss},
                                 {"heading", heading},
                                 {"water", water},
                                 {"depth", depth},
                                 {"wind", wind},
                                 {"transducers", transducers},
                                 {"engine", engine},
                                 {"guidance", guidance}}) {
    Refusal refusal;
    if (check_talker(id, &refusal)) continue;
    throw Error(std::string(name) + " is '" + id + "', legal: " + refusal.legal);
  }
}

void TalkerParams::validate() const {
  const std::vector<std::string> known = names_of(AllSentences{});
  for (const auto& [name, rate] : rates) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw Error("rates has the unknown sentence " + unknown_name_text(name, known));
  }
}

SentenceSender::SentenceSender(const TalkerParams& params, TalkerSink& sink)
    : params_(params), sink_(sink) {
  params.validate();
  params.talkers.validate();
  set_rates(AllSentences{});
}

template <class... Types>
void SentenceSender::set_rates(SentenceTypes<Types...> /*types*/) {
  const auto rate_of = [this](const char* type) {
    const auto rate = params_.rates.find(type);
    return Rate{rate == params_.rates.end() ? 0.0 : rate->second, -1};
  };
  rates_ = {rate_of(Types::kType)...};
}

bool SentenceSender::is_due(std::size_t index, SimTime stamp) {
  Rate& rate = rates_[index];
  if (rate.hz <= 0.0) return false;
  if (rate.hz >= TalkerParams::kUnlimitedHz) return true;
  // A stamp of 0.2 s belongs to slot 1 of 5 Hz, whatever 0.2 is as a double.
  constexpr double kSlack = 1e-6;
  const auto slot = static_cast<std::int64_t>(std::floor(stamp.seconds() * rate.hz + kSlack));
  if (slot == rate.slot) return false;
  rate.slot = slot;  // also of a time that went back
  return true;
}

}  // namespace trident::bridges::nmea
