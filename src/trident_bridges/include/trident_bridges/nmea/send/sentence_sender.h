// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>

#include "trident_base/config_types.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/nmea/all_sentences.h"
#include "trident_bridges/nmea/refusal.h"

namespace trident::bridges::nmea {

namespace sentence_detail {

template <class... Types>
constexpr std::size_t count_of(SentenceTypes<Types...> /*types*/) {
  return sizeof...(Types);
}

/// The place of T among the types.
template <class T, class... Types>
constexpr std::size_t index_of(SentenceTypes<Types...> /*types*/) {
  std::size_t index = 0;
  (void)((std::is_same_v<T, Types> || (++index, false)) || ...);
  return index;
}

}  // namespace sentence_detail

/// Two letters that say which device sends.
struct TalkerIds {
  std::string gnss = "GP";         ///< of positions; GN where several systems are used
  std::string heading = "HE";      ///< of headings, a gyro compass
  std::string water = "VW";        ///< of speeds through the water
  std::string depth = "SD";        ///< of depths
  std::string wind = "WI";         ///< of wind
  std::string transducers = "YX";  ///< of tilt and temperatures
  std::string engine = "ER";       ///< of shafts and rudders
  std::string guidance = "GP";     ///< of steering and routes

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("gnss", gnss, "of positions; GN where several systems are used");
    ar.field("heading", heading, "of headings");
    ar.field("water", water, "of speeds through the water");
    ar.field("depth", depth, "of depths");
    ar.field("wind", wind, "of wind");
    ar.field("transducers", transducers, "of tilt and temperatures");
    ar.field("engine", engine, "of shafts and rudders");
    ar.field("guidance", guidance, "of steering and routes");
  }
  /// Throws Error naming one that has not two capital letters or digits.
  void validate() const;
};

/// What is sent, how often and by whom.
struct TalkerParams {
  /// A rate of sentences that are sent whenever what they are made of comes.
  static constexpr double kUnlimitedHz = 1e6;

  /// Of each sentence that is sent [1/s of simulated time]; never more often than what it is made
  /// of comes.
  std::map<std::string, double> rates = {{"GGA", 5.0}, {"RMC", 1.0}, {"VTG", 1.0}, {"GLL", 1.0},
                                         {"ZDA", 1.0}, {"GSA", 1.0}, {"GSV", 1.0}, {"GST", 1.0},
                                         {"HDT", 5.0}, {"XDR", 1.0}, {"VHW", 1.0}, {"DPT", 1.0},
                                         {"MWV", 1.0}};
  TalkerIds talkers;
  double magnetic_variation_deg = 0.0;  ///< of the place; east is positive

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("rates", rates, Range{0.0, kUnlimitedHz},
             "sentences that are sent, with rates in simulated time; 1000000: as they come [Hz]");
    ar.field("talkers", talkers, "two letters that say which device sends");
    ar.field("magnetic_variation", magnetic_variation_deg, Range{-180.0, 180.0},
             "of the place, east is positive [deg]");
  }
  /// Throws Error naming a sentence that is not known, with the nearest one that is.
  void validate() const;
};

/// Takes what a talker sends.
class TalkerSink {
 public:
  virtual ~TalkerSink() = default;
  /// A whole sentence with CR and LF, valid during the call. `stamp`: of what it was made of.
  virtual void on_sentence(std::string_view sentence, SimTime stamp) = 0;
  /// A sentence of this type was not sent.
  virtual void on_problem(std::string_view type, const Refusal& refusal) = 0;
};

/// Sends sentences at their rates, on a grid of simulated time from its beginning on.
class SentenceSender {
 public:
  /// `sink` outlives the sender. Throws Error as TalkerParams::validate() does.
  SentenceSender(const TalkerParams& params, TalkerSink& sink);

  const TalkerParams& params() const { return params_; }  ///< as given

  /// Sends a sentence if it is due at `stamp`, made by `make` then only.
  template <class T, class Make>
  void send_if_due(std::string_view talker, SimTime stamp, const Make& make) {
    if (is_due(sentence_detail::index_of<T>(AllSentences{}), stamp)) send(talker, stamp, make());
  }
  /// Whether it is due at `stamp`, for several sentences of a type at once: then use send().
  template <class T>
  bool is_due(SimTime stamp) {
    return is_due(sentence_detail::index_of<T>(AllSentences{}), stamp);
  }
  /// Sends it.
  template <class T>
  void send(std::string_view talker, SimTime stamp, const T& value) {
    Refusal refusal;
    if (encode(talker, value, &out_, &refusal)) {
      sink_.on_sentence(out_.view(), stamp);
    } else {
      sink_.on_problem(T::kType, refusal);
    }
  }

 private:
  template <class... Types>
  void set_rates(SentenceTypes<Types...> /*types*/);
  bool is_due(std::size_t index, SimTime stamp);

  struct Rate {
    double hz = 0.0;
    std::int64_t slot = -1;  ///< of the grid, in which the last one was sent
  };
  TalkerParams params_;
  TalkerSink& sink_;
  std::array<Rate, sentence_detail::count_of(AllSentences{})> rates_{};
  EncodedSentence out_;
};

}  // namespace trident::bridges::nmea
