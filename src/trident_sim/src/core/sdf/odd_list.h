// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

/// The odd elements of a load, and what is done with them.
struct OddList {
  OddElements policy = OddElements::kRefuse;
  std::vector<std::string> texts{};
  /// Further elements that lack what one of `texts` names.
  std::vector<std::string> repeats{};
  /// What libsdformat says of a repaired document: many sentences for one element, without a place.
  std::vector<std::string> vague{};

  /// Notes it, or throws it as an Error.
  void add(const std::string& text) {
    if (policy == OddElements::kRefuse) throw Error(text);
    texts.push_back(text + "; left out");
  }
  /// Notes the first of the vague ones, if the conversion has noted nothing better since `before`.
  void close(std::size_t before) {
    if (texts.size() == before && !vague.empty()) texts.push_back(vague.front());
  }
  /// Runs `load` and notes its Error, if odd elements are left out; `text_of` makes the text.
  template <class Load, class TextOf>
  void guard(const Load& load, const TextOf& text_of) {
    try {
      load();
    } catch (const Error& error) {
      if (policy == OddElements::kRefuse) throw;
      add(text_of(error.what()));
    }
  }
};

}  // namespace trident::sim
