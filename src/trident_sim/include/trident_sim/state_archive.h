// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <cstddef>
#include <vector>

#include "trident_base/error.h"

namespace trident::sim {

/// Takes copies of what changes from step to step, or puts them back: one function of an object
/// serves both directions, so that they cannot differ.
///
///   void state(StateArchive& archive) override { archive(filtered_, reference_, count_); }
///
/// Any type that can be copied will do. Pointers are copied as such.
class StateArchive {
 public:
  using Store = std::vector<std::any>;  ///< copies of all fields, in the order of the calls

  /// An archive that appends copies to `to`, which must outlive it.
  static StateArchive saving(Store& to) { return {&to, nullptr}; }
  /// An archive that puts the copies back in their order. Throws Error where a field is of another
  /// type than the one that was saved in its place.
  static StateArchive restoring(const Store& from) { return {nullptr, &from}; }

  /// Saves or restores each field in order.
  template <class... Fields>
  void operator()(Fields&... fields) {
    (exchange(fields), ...);
  }

 private:
  StateArchive(Store* to, const Store* from) : to_(to), from_(from) {}

  template <class Field>
  void exchange(Field& field) {
    if (to_ != nullptr) {
      to_->emplace_back(field);
      return;
    }
    const Field* saved = next_ < from_->size() ? std::any_cast<Field>(&(*from_)[next_++]) : nullptr;
    if (saved == nullptr) throw Error("a state cannot be restored: it was saved by other code");
    field = *saved;
  }

  Store* to_;
  const Store* from_;
  std::size_t next_ = 0;
};

}  // namespace trident::sim
