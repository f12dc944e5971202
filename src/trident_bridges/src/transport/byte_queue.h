// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>

#include "trident_bridges/transport/endpoint.h"

namespace trident::bridges {

/// Bytes that wait for a slow peer, in a ring of fixed size. Its memory is taken by the first
/// push().
class ByteQueue {
 public:
  /// Holds up to `capacity` bytes.
  explicit ByteQueue(std::size_t capacity) : capacity_(capacity) {}

  std::size_t size() const { return size_; }                    ///< bytes that wait
  bool empty() const { return size_ == 0; }                     ///< nothing waits
  std::size_t free_bytes() const { return capacity_ - size_; }  ///< what push() takes

  /// Appends all bytes of a block; false, and nothing is appended, when they do not fit.
  bool push(Bytes block) {
    if (block.size() > free_bytes()) return false;
    if (!ring_) ring_.reset(new std::uint8_t[capacity_]);
    const std::size_t end = (begin_ + size_) % capacity_;
    const std::size_t first = std::min(block.size(), capacity_ - end);
    if (first > 0) std::memcpy(ring_.get() + end, block.data(), first);
    if (first < block.size()) std::memcpy(ring_.get(), block.data() + first, block.size() - first);
    size_ += block.size();
    return true;
  }

  /// The first `count` bytes, count <= size(), in one or two parts; the second may be empty. They
  /// stay where they are until pop(), push() or clear().
  std::array<Bytes, 2> front(std::size_t count) const {
    const std::size_t first = std::min(count, capacity_ - begin_);
    return {Bytes(ring_.get() + begin_, first), Bytes(ring_.get(), count - first)};
  }

  /// Removes the first `count` bytes; count <= size().
  void pop(std::size_t count) {
    begin_ = (begin_ + count) % capacity_;
    size_ -= count;
  }

  /// Removes all bytes.
  void clear() { begin_ = size_ = 0; }

 private:
  std::size_t capacity_;
  std::unique_ptr<std::uint8_t[]> ring_;  // not a vector: its memory is not touched before use
  std::size_t begin_ = 0, size_ = 0;
};

}  // namespace trident::bridges
