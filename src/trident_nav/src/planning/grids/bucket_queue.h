// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trident::nav {

/// A priority queue of items with whole-number keys, sorted by key / 2^shift only: within a bucket
/// the newest comes first, which lets a search dive along ties (Dial, "Algorithm 360", 1969).
/// Constant time per operation. Keys never lie below the base.
template <class Item>
class BucketQueue {
 public:
  /// Empties the queue; keys will be at least `base`.
  void reset(std::uint64_t base, unsigned shift) {
    for (std::size_t b = 0; b < used_; ++b) buckets_[b].clear();
    far_.clear();
    used_ = cursor_ = 0;
    base_ = base;
    shift_ = shift;
  }

  void push(std::uint64_t key, Item item) {
    const std::uint64_t bucket = (key - base_) >> shift_;
    if (bucket >= kMaxBuckets) {
      far_.push_back({key, item});
      return;
    }
    if (bucket >= used_) use(static_cast<std::size_t>(bucket) + 1);
    cursor_ = std::min(cursor_, static_cast<std::size_t>(bucket));
    buckets_[bucket].push_back(item);
  }

  /// Moves to the lowest bucket that holds something; false when the queue is empty.
  bool advance() {
    while (cursor_ < used_ && buckets_[cursor_].empty()) ++cursor_;
    if (cursor_ < used_) return true;
    return !far_.empty() && rebase();
  }

  /// No key in the queue is lower. After `advance`.
  std::uint64_t lower_bound() const {
    return base_ + (static_cast<std::uint64_t>(cursor_) << shift_);
  }

  /// Whether a key belongs behind the lowest bucket. After `advance`.
  bool is_later(std::uint64_t key) const {
    return key > base_ && (key - base_) >> shift_ > static_cast<std::uint64_t>(cursor_);
  }

  /// The newest of the lowest bucket. After `advance`.
  Item pop() {
    const Item item = buckets_[cursor_].back();
    buckets_[cursor_].pop_back();
    return item;
  }

  /// The item that comes so many pops later if nothing is pushed; the last of the bucket when there
  /// are fewer. After `advance`.
  const Item& ahead(std::size_t pops) const {
    const std::vector<Item>& bucket = buckets_[cursor_];
    return bucket[bucket.size() - 1 - std::min(pops, bucket.size() - 1)];
  }

  /// All items, in no order that matters; the queue is empty afterwards.
  std::vector<Item> take_all() {
    std::vector<Item> items;
    for (std::size_t b = cursor_; b < used_; ++b) {
      items.insert(items.end(), buckets_[b].begin(), buckets_[b].end());
    }
    for (const auto& [key, item] : far_) items.push_back(item);
    reset(base_, shift_);
    return items;
  }

 private:
  static constexpr std::size_t kMaxBuckets = std::size_t{1} << 16U;

  void use(std::size_t count) {
    if (count > buckets_.size()) buckets_.resize(std::max(count, 2 * buckets_.size()));
    used_ = count;
  }

  /// All buckets are empty: those keys that lay too far come into them.
  bool rebase() {
    std::vector<std::pair<std::uint64_t, Item>> items;
    items.swap(far_);
    std::uint64_t least = items.front().first;
    for (const auto& entry : items) least = std::min(least, entry.first);
    used_ = cursor_ = 0;
    base_ = least;
    for (const auto& [key, item] : items) push(key, item);
    return true;
  }

  std::vector<std::vector<Item>> buckets_;
  std::vector<std::pair<std::uint64_t, Item>> far_;
  std::size_t used_ = 0;    ///< Buckets from here on are empty.
  std::size_t cursor_ = 0;  ///< Buckets before this one are empty.
  std::uint64_t base_ = 0;
  unsigned shift_ = 0;
};

}  // namespace trident::nav
