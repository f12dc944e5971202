// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace trident::slam {

/// While it lives, `save` runs before the process ends by a fault: SIGSEGV, SIGBUS, SIGFPE, SIGILL,
/// or SIGABRT, which an exception that nobody catches ends in. It runs in a copy of the process
/// that has no other threads, so that locks may be held for ever and what it needs may be broken:
/// it must not wait for a lock, and gets a minute. The process then ends by the signal as it would
/// have. One at a time.
class CrashRescue {
 public:
  /// Installs the handlers of these signals.
  explicit CrashRescue(std::function<void()> save);
  ~CrashRescue();
  CrashRescue(const CrashRescue&) = delete;
  CrashRescue& operator=(const CrashRescue&) = delete;
};

}  // namespace trident::slam
