// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace trident::bridges {

/// When each message was sent and received, in a file that several processes have mapped. Who makes
/// the file fixes its size: eight 64-bit fields (kMagic, capacity, state, counts), then `capacity`
/// times of sending and as many of receiving [ns], 0: not yet.
class LatencyRecord {
 public:
  static constexpr std::uint64_t kMagic = 0x3159434E54414C54;  ///< "TLATNCY1", little-endian
  /// How far the measurement has got.
  enum State : std::uint64_t { kStarting = 0, kRunning = 1, kDone = 2 };

  /// Maps a file. Throws Error when it is not a record.
  explicit LatencyRecord(const std::string& file);
  ~LatencyRecord();
  LatencyRecord(const LatencyRecord&) = delete;
  LatencyRecord& operator=(const LatencyRecord&) = delete;

  std::uint64_t capacity() const { return size_; }  ///< message numbers are below it
  State state() const { return static_cast<State>(header().state.load()); }  ///< set by the source
  void set_state(State state) { header().state = state; }                    ///< by the source
  std::uint64_t received() const { return header().received; }               ///< different messages

  /// number < capacity().
  void note_sent(std::uint64_t number, std::int64_t time_ns);
  /// A number that was received before, or that is too large, is counted only.
  void note_received(std::uint64_t number, std::int64_t time_ns);
  /// Whether it was received; number < capacity().
  bool has_received(std::uint64_t number) const { return received_ns(number) != 0; }

 private:
  struct Header {
    std::uint64_t magic, capacity;
    std::atomic<std::uint64_t> state, sent, received, doubles, unknown, unused;
  };
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  static_assert(sizeof(Header) == 8 * sizeof(std::uint64_t));

  Header& header() const { return *static_cast<Header*>(memory_); }
  std::atomic<std::int64_t>& sent_ns(std::uint64_t number) const;
  std::atomic<std::int64_t>& received_ns(std::uint64_t number) const;

  void* memory_ = nullptr;
  std::uint64_t bytes_ = 0, size_ = 0;
};

/// CLOCK_MONOTONIC, which all processes of a machine share [ns].
std::int64_t monotonic_ns();

}  // namespace trident::bridges
