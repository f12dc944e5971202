// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Numbers and names as bytes, each number with its lowest byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trident::sim::wire {

template <class Number>
void put(Number value, std::string* to) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    to->push_back(static_cast<char>(static_cast<std::uint8_t>(bits >> (8 * i))));
  }
}

/// Reads fields one after the other; after one that is missing nothing is read any more.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  Number get() {
    if (rest_.size() < sizeof(Number)) {
      fail();
      return {};
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bits |= std::uint64_t{static_cast<std::uint8_t>(rest_[i])} << (8 * i);
    }
    rest_.remove_prefix(sizeof(Number));
    return static_cast<Number>(bits);
  }
  /// So many bytes.
  std::string_view text(std::size_t size) {
    if (rest_.size() < size) {
      fail();
      return {};
    }
    const std::string_view result = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return result;
  }
  /// Nothing is read any more: the bytes are something else.
  void fail() {
    is_whole_ = false;
    rest_ = {};
  }
  bool is_whole() const { return is_whole_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool is_whole_ = true;
};

}  // namespace trident::sim::wire
