// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/mutex.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace trident {
namespace {

TEST(Unlock, TakesTheMutexBackWhenAnExceptionEndsTheScope) {
  FairMutex mutex;
  std::thread other;
  {
    const Lock lock(mutex);
    EXPECT_THROW(
        {
          const Unlock unlocked(mutex);
          throw std::runtime_error("meanwhile");
        },
        std::runtime_error);
    other = std::thread([&] { const Lock theirs(mutex); });
    while (mutex.waiting() == 0) std::this_thread::yield();
  }
  other.join();
}

TEST(FairMutex, IsGivenToThoseWhoWaitInTheirOrder) {
  FairMutex mutex;
  std::vector<int> order;
  std::vector<std::thread> threads;
  {
    const Lock lock(mutex);
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&, i] {
        const Lock mine(mutex);
        order.push_back(i);
      });
      while (mutex.waiting() < static_cast<std::uint64_t>(i) + 1) std::this_thread::yield();
    }
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(FairMutex, WhoTakesItAgainAndAgainStarvesNobody) {
  FairMutex mutex;
  std::atomic<bool> is_over{false};
  std::atomic<bool> is_stepping{false};
  std::thread stepper([&] {
    while (!is_over) {
      const Lock lock(mutex);
      is_stepping = true;
    }
  });
  while (!is_stepping) std::this_thread::yield();
  for (int i = 0; i < 1000; ++i) const Lock service(mutex);
  is_over = true;
  stepper.join();
}

TEST(WaitUntil, HoldsTheMutexWhenItReturns) {
  FairMutex mutex;
  std::condition_variable_any changed;
  bool is_done = false;
  std::thread other([&] {
    const Lock lock(mutex);
    is_done = true;
    changed.notify_all();
  });
  {
    const Lock lock(mutex);
    wait_until(changed, mutex, [&] { return is_done; });
    EXPECT_TRUE(is_done);
  }
  other.join();
}

}  // namespace
}  // namespace trident
