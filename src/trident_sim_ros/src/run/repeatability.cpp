// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "repeatability.h"

#include <algorithm>

namespace trident::sim {

void Repeatability::spoil(const std::string& who, SimTime time, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = std::find_if(notes_.begin(), notes_.end(), [&](const Note& note) {
    return note.who == who && note.why == why;
  });
  if (known != notes_.end()) {
    ++known->count;
    return;
  }
  ++kinds_;
  if (notes_.size() < kMaxNotes) notes_.push_back({who, why, time});
}

bool Repeatability::take_unlogged(Note* note) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (logged_ >= notes_.size()) return false;
  *note = notes_[logged_++];
  return true;
}

std::vector<Repeatability::Note> Repeatability::notes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return notes_;
}

std::size_t Repeatability::kinds() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return kinds_;
}

void Repeatability::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  notes_.clear();
  kinds_ = logged_ = 0;
}

}  // namespace trident::sim
