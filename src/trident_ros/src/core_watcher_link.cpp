// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core_watcher_link.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string>

namespace trident::ros_utils {
namespace {

/// lib/trident_ros/core_watcher next to this library, lib/libtrident_ros.so, in the devel space as
/// in the install space.
std::string path_of_program() {
  static const char marker = 0;
  Dl_info info{};
  if (dladdr(&marker, &info) == 0 || info.dli_fname == nullptr) return {};
  return std::filesystem::path(info.dli_fname).parent_path() / "trident_ros" / "core_watcher";
}

/// Starts the program with `input` as its standard input, without this process' other files, output
/// and session: a socket or a pipe that it held would seem to be this process still. 0: it failed.
pid_t spawn(const std::string& program, int input) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  // It ends by itself: what ends this process is not to end it before its work is done. Blocked
  // from the first instruction on, which a handler would not be.
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) sigaddset(&blocked, number);
  posix_spawnattr_setsigmask(&attributes, &blocked);
  std::string name = "core_watcher";
  char* const words[] = {name.data(), nullptr};
  char* const environment[] = {nullptr};
  pid_t child = 0;
  const int code = posix_spawn(&child, program.c_str(), &files, &attributes, words, environment);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return code == 0 ? child : 0;
}

}  // namespace

CoreWatcherLink::~CoreWatcherLink() {
  if (socket_ < 0) return;
  close(socket_);
  while (waitpid(program_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool CoreWatcherLink::watch(const affinity::KeptProcess& kept) {
  if (socket_ < 0 && !start()) return false;
  return send(socket_, &kept, sizeof(kept), MSG_NOSIGNAL) == sizeof(kept);
}

bool CoreWatcherLink::start() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return false;
  program_ = spawn(path_of_program(), ends[1]);
  close(ends[1]);
  if (program_ != 0) {
    socket_ = ends[0];
    return true;
  }
  close(ends[0]);
  return false;
}

}  // namespace trident::ros_utils
