// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/peer_process.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace trident::ros_utils {
namespace {

namespace fs = std::filesystem;

/// Address and port as /proc/net/tcp and tcp6 write them: words as they lie in memory.
std::string in_proc_form(const sockaddr_storage& address) {
  std::uint32_t words[4] = {};
  std::size_t count = 0;
  std::uint16_t port = 0;
  if (address.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
    words[0] = v4.sin_addr.s_addr;
    port = v4.sin_port;
    count = 1;
  } else if (address.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
    std::memcpy(words, &v6.sin6_addr, sizeof(words));
    port = v6.sin6_port;
    count = 4;
  }
  std::string text;
  char part[16];
  for (std::size_t i = 0; i < count; ++i) {
    std::snprintf(part, sizeof(part), "%08X", words[i]);
    text += part;
  }
  std::snprintf(part, sizeof(part), ":%04X", ntohs(port));
  return text + part;
}

/// Inode of the socket between `local` and `remote`; "" if this machine does not have it.
std::string find_inode(const char* table, const std::string& local, const std::string& remote) {
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string slot, here, there, state, queues, timer, retransmits, user, timeout, inode;
    words >> slot >> here >> there >> state >> queues >> timer >> retransmits >> user >> timeout >>
        inode;
    if (here == local && there == remote) return inode;
  }
  return {};
}

bool holds(const fs::path& process, const std::string& link) {
  std::error_code error;  // a process may end, and others' descriptors are not for us
  for (fs::directory_iterator it(process / "fd", error), end; !error && it != end;
       it.increment(error)) {
    std::error_code unreadable;
    if (fs::read_symlink(it->path(), unreadable).string() == link) return true;
  }
  return false;
}

/// The process that holds the file behind `link` open; 0: none that can be looked into.
pid_t find_holder(const std::string& link) {
  std::error_code error;
  for (fs::directory_iterator it("/proc", error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    const bool is_process =
        std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_process && holds(it->path(), link)) return std::atoi(name.c_str());
  }
  return 0;
}

}  // namespace

pid_t peer_process(int descriptor) {
  sockaddr_storage here{}, there{};
  socklen_t size = sizeof(here);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &size) != 0) return 0;
  size = sizeof(there);
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&there), &size) != 0) return 0;
  const char* table = here.ss_family == AF_INET6 ? "/proc/net/tcp6" : "/proc/net/tcp";
  const std::string inode = find_inode(table, in_proc_form(there), in_proc_form(here));
  if (inode.empty() || inode == "0") return 0;
  return find_holder("socket:[" + inode + "]");
}

}  // namespace trident::ros_utils
