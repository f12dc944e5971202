// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ode_context.h"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace trident::sim {
namespace {

struct Messages {
  std::uint64_t count = 0;
  std::string last;
};

Messages& messages() {
  thread_local Messages of_this_thread;
  return of_this_thread;
}

void keep_message(int /*number*/, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof(text), format, arguments);
  ++messages().count;
  messages().last = text;
}

}  // namespace

void init_ode() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(keep_message);
  });
  thread_local const bool is_ready = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(is_ready);
}

std::uint64_t ode_message_count() { return messages().count; }
const std::string& last_ode_message() { return messages().last; }

}  // namespace trident::sim
