// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/crash_rescue.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <exception>
#include <utility>

namespace trident::slam {
namespace {

constexpr std::array<int, 5> kFaults = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr unsigned kSecondsToSave = 60;
constexpr unsigned kSecondsToFork = 90;  // a fault within malloc may leave fork() waiting for ever

std::function<void()>& saver() {
  static std::function<void()> save;
  return save;
}
std::atomic<bool> is_armed{false};

void disarm() {
  for (const int fault : kFaults) std::signal(fault, SIG_DFL);
}

void save_in_a_copy() {
  alarm(kSecondsToFork);
  const pid_t copy = fork();
  if (copy == 0) {
    alarm(kSecondsToSave);
    try {
      saver()();
    } catch (const std::exception&) {
      _exit(1);
    }
    _exit(0);
  }
  if (copy < 0) return;
  while (waitpid(copy, nullptr, 0) < 0 && errno == EINTR) continue;
}

void on_fault(int fault) {
  disarm();
  if (is_armed.exchange(false)) save_in_a_copy();
  std::raise(fault);
}

}  // namespace

CrashRescue::CrashRescue(std::function<void()> save) {
  saver() = std::move(save);
  is_armed = true;
  struct sigaction action = {};
  action.sa_handler = on_fault;
  action.sa_flags = SA_NODEFER;
  for (const int fault : kFaults) sigaction(fault, &action, nullptr);
}

CrashRescue::~CrashRescue() {
  is_armed = false;
  disarm();
}

}  // namespace trident::slam
