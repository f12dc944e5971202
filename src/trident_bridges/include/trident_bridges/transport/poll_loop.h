// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace trident::bridges {

/// Watches file descriptors and timers for one thread: every callback of a process's endpoints runs
/// in it, so that what arrives is decoded and handed on without waking another thread.
class PollLoop {
 public:
  /// What a descriptor is ready for.
  enum Ready : std::uint32_t { kReadable = 1, kWritable = 2, kClosed = 4 };
  /// Called with a set of Ready.
  using Callback = std::function<void(std::uint32_t ready)>;

  virtual ~PollLoop() = default;
  /// Watches a descriptor, level-triggered; `callback` may call watch and forget.
  virtual void watch(int descriptor, std::uint32_t wanted, Callback callback) = 0;
  /// Changes what a watched descriptor is wanted for.
  virtual void change(int descriptor, std::uint32_t wanted) = 0;
  /// Ends the watch; the descriptor stays open. Nothing of it is called afterwards.
  virtual void forget(int descriptor) = 0;
  /// Calls `callback` after `delay_s` of wall time, once. Returns a number for cancel().
  virtual std::uint64_t call_after(double delay_s, std::function<void()> callback) = 0;
  /// Prevents a call that has not been made yet; otherwise it does nothing.
  virtual void cancel(std::uint64_t call) = 0;
  /// Wall time since an arbitrary instant, which never jumps [s].
  virtual double now_s() const = 0;
  /// Calls `callback` in the loop's thread soon, once. The one function that any thread may call.
  virtual void post(std::function<void()> callback) = 0;
};

}  // namespace trident::bridges
