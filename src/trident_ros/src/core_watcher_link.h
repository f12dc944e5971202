// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include "thread_affinity.h"

namespace trident::ros_utils {

/// The program core_watcher, which gives processes back their cores when this process ends without
/// having done so: after SIGKILL nothing else can.
class CoreWatcherLink {
 public:
  CoreWatcherLink() = default;
  /// Lets the program end, and waits for that.
  ~CoreWatcherLink();
  CoreWatcherLink(const CoreWatcherLink&) = delete;
  CoreWatcherLink& operator=(const CoreWatcherLink&) = delete;

  /// Sends a process to the watching program; the first call starts it. Returns whether it watches.
  bool watch(const affinity::KeptProcess& kept);

 private:
  bool start();

  pid_t program_ = 0;
  int socket_ = -1;
};

}  // namespace trident::ros_utils
