// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Texts and lists of limited size that allocate nothing: what the fields of a sentence are read
/// into.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <string_view>

namespace trident::bridges::nmea {

/// A text of up to `Capacity` characters.
template <std::size_t Capacity>
class FixedText {
 public:
  FixedText() = default;
  /// What does not fit is cut off.
  FixedText(std::string_view text) { assign(text); }
  FixedText(const char* text) { assign(text); }  ///< the same

  static constexpr std::size_t capacity() { return Capacity; }  ///< [characters]
  /// What does not fit is cut off.
  void assign(std::string_view text) {
    size_ = std::min(text.size(), Capacity);
    std::copy_n(text.begin(), size_, text_.begin());
  }
  std::string_view view() const { return {text_.data(), size_}; }  ///< while it does not change
  bool empty() const { return size_ == 0; }                        ///< an absent field, too

  friend bool operator==(const FixedText& a, const FixedText& b) { return a.view() == b.view(); }
  friend bool operator==(const FixedText& a, std::string_view b) { return a.view() == b; }
  friend bool operator==(const FixedText& a, const char* b) { return a.view() == b; }

 private:
  std::array<char, Capacity> text_{};
  std::size_t size_ = 0;
};

/// A list of up to `Capacity` items.
template <class T, std::size_t Capacity>
class FixedList {
 public:
  static constexpr std::size_t capacity() { return Capacity; }  ///< [items]
  std::size_t size() const { return size_; }                    ///< [items]
  bool empty() const { return size_ == 0; }                     ///< no items
  bool full() const { return size_ == Capacity; }               ///< push_back() is not allowed
  void clear() { size_ = 0; }                                   ///< forgets all items
  /// Requires that the list is not full.
  void push_back(const T& item) {
    assert(!full());
    items_[size_++] = item;
  }
  T& operator[](std::size_t index) {  ///< index < size()
    assert(index < size_);
    return items_[index];
  }
  const T& operator[](std::size_t index) const {  ///< index < size()
    assert(index < size_);
    return items_[index];
  }
  T* begin() { return items_.data(); }                    ///< for loops
  T* end() { return items_.data() + size_; }              ///< behind the last
  const T* begin() const { return items_.data(); }        ///< for loops
  const T* end() const { return items_.data() + size_; }  ///< behind the last

 private:
  std::array<T, Capacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace trident::bridges::nmea
