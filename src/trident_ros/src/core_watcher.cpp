// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Gives processes back their cores when the process that has restricted them ends, however it ends.
//
// ProcessCores starts this program with one end of a socket as its standard input, and sends it
// each process. The socket closes with the process that holds its other end, also by SIGKILL.
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

#include "thread_affinity.h"

int main() {
  std::vector<trident::ros_utils::affinity::KeptProcess> kept;
  while (true) {
    trident::ros_utils::affinity::KeptProcess next;
    const ssize_t size = recv(STDIN_FILENO, &next, sizeof(next), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size != sizeof(next)) break;
    kept.push_back(next);
  }
  for (const trident::ros_utils::affinity::KeptProcess& process : kept)
    trident::ros_utils::affinity::release(process);
  return 0;
}
