// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/sdf/odd_list.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// The files of shapes that are not found: each is reported once, with its first place and the
/// number of places. A collision without its file is an odd element; a visual alone is only
/// reported.
class MissingFiles {
 public:
  MissingFiles(OddList& odd, const WarningSink& warn) : odd_(odd), warn_(warn) {}

  /// `file`: kind and URI; `text`: place and what is missing there, for its first use.
  void add_collision(const std::string& file, const std::string& text, const std::string& searched);
  void add_visual(const std::string& file, const std::string& text);
  /// Reports all, after the last.
  void close();

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Entry {
    std::string file, text;
    std::size_t uses = 0;
    std::size_t odd_text = kNone;  ///< index into the texts of odd_
  };
  Entry& use(const std::string& file, const std::string& text);

  OddList& odd_;
  const WarningSink& warn_;
  std::vector<Entry> entries_;  ///< in the order of their first uses
};

}  // namespace trident::sim
