// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "trident_ros/peer_process.h"
#include "trident_ros/process_cores.h"

namespace trident::ros_utils {
namespace {

/// A Python program in a process of its own, which ends with this object.
class Child {
 public:
  explicit Child(const std::string& program) : id_(fork()) {
    if (id_ != 0) return;
    execl("/usr/bin/python3", "python3", "-c", program.c_str(), nullptr);
    _exit(1);
  }
  ~Child() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  pid_t id() const { return id_; }

  bool wait_for_threads(std::ptrdiff_t count) const {
    namespace fs = std::filesystem;
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    const fs::path tasks = "/proc/" + std::to_string(id_) + "/task";
    while (std::chrono::steady_clock::now() < limit) {
      if (std::distance(fs::directory_iterator(tasks), fs::directory_iterator()) == count) {
        return true;
      }
      std::this_thread::yield();
    }
    return false;
  }

 private:
  pid_t id_;
};

std::string threads(std::size_t count) {
  return "import threading, time\n"
         "for _ in range(" +
         std::to_string(count - 1) +
         "): threading.Thread(target=time.sleep, args=(60,)).start()\n" + "time.sleep(60)";
}

std::vector<int> cores_of(pid_t process) {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(process, sizeof(set), &set);
  std::vector<int> result;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &set)) result.push_back(core);
  }
  return result;
}

TEST(ProcessCores, KeepsAProcessOnOneCoreAndGivesItBack) {
  const std::vector<int> all = cores_of(0);
  if (all.size() < 2) GTEST_SKIP() << "one core";
  const Child child(threads(3));
  ASSERT_TRUE(child.wait_for_threads(3));
  {
    ProcessCores cores;
    EXPECT_EQ(cores.count(), all.size());
    EXPECT_EQ(cores.keep(child.id(), all.size() + 1), all[1]);
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(child.id()) + "/task")) {
      EXPECT_EQ(cores_of(std::stoi(thread.path().filename())), std::vector<int>{all[1]});
    }
    EXPECT_EQ(cores.keep(child.id(), 0), -1) << "it is kept already";
  }
  EXPECT_EQ(cores_of(child.id()), all);
}

TEST(ProcessCores, LeavesAloneWhatIsNotARoscppNode) {
  const std::vector<int> all = cores_of(0);
  const Child child(threads(ProcessCores::kMaxThreads + 1));
  ASSERT_TRUE(child.wait_for_threads(ProcessCores::kMaxThreads + 1));
  ProcessCores cores;
  EXPECT_EQ(cores.keep(child.id(), 0), -1);
  EXPECT_EQ(cores_of(child.id()), all);
  EXPECT_EQ(cores.keep(getpid(), 0), -1);
  EXPECT_EQ(cores.keep(0, 0), -1);
  EXPECT_EQ(cores_of(0), all);
}

/// Both ends of a TCP connection of this process.
struct Pair {
  int client = socket(AF_INET, SOCK_STREAM, 0);
  int server = -1;
  Pair() {
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    socklen_t size = sizeof(address);
    bind(listener, any, size);
    listen(listener, 1);
    getsockname(listener, any, &size);
    connect(client, any, size);
    server = accept(listener, nullptr, nullptr);
    close(listener);
  }
  ~Pair() {
    close(client);
    close(server);
  }
};

TEST(PeerProcess, IsFoundOnThisMachine) {
  const Pair pair;
  EXPECT_EQ(peer_process(pair.client), getpid());
  EXPECT_EQ(peer_process(pair.server), getpid());
}

TEST(PeerProcess, IsNoneWithoutAPeer) {
  Pair pair;
  close(pair.server);
  pair.server = -1;
  EXPECT_EQ(peer_process(pair.client), 0);
  const int lonely = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(peer_process(lonely), 0);
  close(lonely);
  EXPECT_EQ(peer_process(-1), 0);
}

}  // namespace
}  // namespace trident::ros_utils
