// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "missing_files.h"

#include <algorithm>

namespace trident::sim {

MissingFiles::Entry& MissingFiles::use(const std::string& file, const std::string& text) {
  auto entry = std::find_if(entries_.begin(), entries_.end(),
                            [&file](const Entry& known) { return known.file == file; });
  if (entry == entries_.end()) entry = entries_.insert(entry, {file, text});
  ++entry->uses;
  return *entry;
}

void MissingFiles::add_collision(const std::string& file, const std::string& text,
                                 const std::string& searched) {
  Entry& entry = use(file, text);
  if (entry.odd_text != kNone) {
    odd_.repeats.push_back(text + "; left out");
    return;
  }
  entry.odd_text = odd_.texts.size();
  odd_.add(entry.text + "; searched: " + searched);
}

void MissingFiles::add_visual(const std::string& file, const std::string& text) { use(file, text); }

void MissingFiles::close() {
  for (const Entry& entry : entries_) {
    const std::string uses =
        entry.uses > 1 ? "; used in " + std::to_string(entry.uses) + " places" : "";
    if (entry.odd_text != kNone) {
      odd_.texts[entry.odd_text] += uses;
    } else {
      warn_(entry.text + "; shown without it" + uses);
    }
  }
  entries_.clear();
}

}  // namespace trident::sim
