// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/transport/epoll_loop.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <thread>

#include "running_loop.h"
#include "transport/descriptor.h"

namespace trident::bridges {
namespace {

struct SocketPair {
  SocketPair() {
    std::array<int, 2> ends{};
    socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data());
    near = Descriptor(ends[0]);
    far = Descriptor(ends[1]);
  }
  void write_byte() { EXPECT_EQ(write(far.get(), "x", 1), 1); }
  Descriptor near, far;
};

TEST(EpollLoop, ADescriptorIsReportedReadableWritableAndClosed) {
  EpollLoop loop;
  SocketPair pair;
  std::uint32_t seen = 0;
  loop.watch(pair.near.get(), PollLoop::kReadable, [&](std::uint32_t ready) { seen = ready; });
  loop.run_once(0.0);
  EXPECT_EQ(seen, 0U);
  pair.write_byte();
  loop.run_once(0.0);
  EXPECT_EQ(seen, PollLoop::kReadable);
  loop.change(pair.near.get(), PollLoop::kWritable);
  loop.run_once(0.0);
  EXPECT_EQ(seen, PollLoop::kWritable);
  pair.far.reset();
  loop.run_once(0.0);
  EXPECT_NE(seen & PollLoop::kClosed, 0U);
}

TEST(EpollLoop, ADescriptorThatAnotherCallbackForgetsIsNotCalled) {
  EpollLoop loop;
  SocketPair first, second;
  int calls = 0;
  const auto forget_both = [&](std::uint32_t) {
    ++calls;
    loop.forget(first.near.get());
    loop.forget(second.near.get());
  };
  loop.watch(first.near.get(), PollLoop::kReadable, forget_both);
  loop.watch(second.near.get(), PollLoop::kReadable, forget_both);
  first.write_byte();
  second.write_byte();
  loop.run_once(0.0);
  loop.run_once(0.0);
  EXPECT_EQ(calls, 1);
}

TEST(EpollLoop, DelayedCallsComeInTheOrderOfTheirTimes) {
  EpollLoop loop;
  std::string order;
  loop.call_after(0.02, [&] { order += 'c'; });
  loop.call_after(0.0, [&] { order += 'a'; });
  loop.call_after(0.01, [&] { order += 'b'; });
  EXPECT_TRUE(run_until(loop, [&] { return order.size() == 3; }));
  EXPECT_EQ(order, "abc");
}

TEST(EpollLoop, ACancelledCallIsNotMade) {
  EpollLoop loop;
  bool is_made = false, is_last_made = false;
  const std::uint64_t call = loop.call_after(0.0, [&] { is_made = true; });
  loop.call_after(0.005, [&] { is_last_made = true; });
  loop.cancel(call);
  loop.cancel(call + 1000);
  EXPECT_TRUE(run_until(loop, [&] { return is_last_made; }));
  EXPECT_FALSE(is_made);
}

TEST(EpollLoop, CallsThatStartOthersDoNotStarveDescriptors) {
  EpollLoop loop;
  SocketPair pair;
  bool is_read = false;
  int calls = 0;
  std::function<void()> again = [&] {
    ++calls;
    loop.call_after(0.0, again);
  };
  again();
  loop.watch(pair.near.get(), PollLoop::kReadable, [&](std::uint32_t) { is_read = true; });
  pair.write_byte();
  EXPECT_TRUE(run_until(loop, [&] { return is_read && calls > 10; }));
}

TEST(EpollLoop, AnotherThreadPostsCallsAndStops) {
  EpollLoop loop;
  std::vector<int> made;
  std::thread thread([&] {
    for (int i = 0; i < 100; ++i) loop.post([&made, i] { made.push_back(i); });
    loop.post([&loop] { loop.stop(); });
  });
  loop.run();
  thread.join();
  ASSERT_EQ(made.size(), 100U);
  EXPECT_EQ(made.back(), 99);
  EXPECT_FALSE(loop.run_once(0.0));
}

TEST(EpollLoop, ItRunsOnAfterACallbackThrew) {
  EpollLoop loop;
  bool is_made = false;
  loop.call_after(0.0, [] { throw std::runtime_error("x"); });
  loop.call_after(0.0, [&] { is_made = true; });
  bool has_thrown = false;
  EXPECT_TRUE(run_until(loop, [&] {
    try {
      loop.run_once(0.01);
    } catch (const std::runtime_error&) {
      has_thrown = true;
    }
    return has_thrown;
  }));
  EXPECT_TRUE(run_until(loop, [&] { return is_made; }));
}

TEST(EpollLoop, ItsOwnDescriptorIsReadableWhenACallIsDue) {
  EpollLoop loop;
  pollfd state{loop.descriptor(), POLLIN, 0};
  EXPECT_EQ(poll(&state, 1, 0), 0);
  loop.call_after(0.001, [] {});
  EXPECT_EQ(poll(&state, 1, 60'000), 1);
}

TEST(EpollLoop, AClosedDescriptorCannotBeWatched) {
  EpollLoop loop;
  EXPECT_THROW(loop.watch(-1, PollLoop::kReadable, [](std::uint32_t) {}), Error);
}

}  // namespace
}  // namespace trident::bridges
