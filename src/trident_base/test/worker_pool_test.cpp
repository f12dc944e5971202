// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "trident_base/error.h"

namespace trident {
namespace {

TEST(WorkerPool, DoesEveryPartOnce) {
  for (const std::size_t threads : {1U, 2U, 5U}) {
    WorkerPool pool(threads);
    for (std::size_t parts = 0; parts < 40; ++parts) {
      std::vector<std::atomic<int>> times(parts);
      pool.share(parts, [&](std::size_t part, std::size_t worker) {
        ++times[part];
        EXPECT_LT(worker, threads);
      });
      for (std::size_t part = 0; part < parts; ++part) EXPECT_EQ(times[part], 1) << part;
    }
  }
}

TEST(WorkerPool, WorkersAreThreadsOfTheirOwn) {
  constexpr std::size_t kThreads = 3;
  WorkerPool pool(kThreads);
  std::mutex mutex;
  std::condition_variable all_there;
  std::set<std::thread::id> threads;
  std::set<std::size_t> workers;
  // Each part waits for the others: only three threads at once can end it.
  pool.share(kThreads, [&](std::size_t, std::size_t worker) {
    std::unique_lock<std::mutex> lock(mutex);
    threads.insert(std::this_thread::get_id());
    workers.insert(worker);
    all_there.notify_all();
    all_there.wait(lock, [&] { return threads.size() == kThreads; });
  });
  EXPECT_EQ(workers, (std::set<std::size_t>{0, 1, 2}));
}

TEST(WorkerPool, ResultsDoNotDependOnTheNumberOfThreads) {
  const auto computed = [](std::size_t threads) {
    WorkerPool pool(threads);
    std::vector<std::uint64_t> values(1000);
    for (int round = 0; round < 20; ++round) {
      pool.share(values.size(), [&](std::size_t part, std::size_t) {
        values[part] = values[part] * 6364136223846793005ULL + part;
      });
    }
    return values;
  };
  EXPECT_EQ(computed(1), computed(4));
}

TEST(WorkerPool, TheFirstErrorOfAPartIsRethrownAndTheOthersAreDone) {
  for (const std::size_t threads : {1U, 4U}) {
    WorkerPool pool(threads);
    std::atomic<int> done{0};
    const auto work = [&](std::size_t part, std::size_t) {
      ++done;
      if (part % 10 == 3) throw std::runtime_error(std::to_string(part));
    };
    try {
      pool.share(50, work);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(done, 50);
    pool.share(2, [&](std::size_t, std::size_t) { ++done; });
    EXPECT_EQ(done, 52);
  }
}

TEST(WorkerPool, RefusesNoThreads) {
  EXPECT_THROW(WorkerPool(0), Error);
  EXPECT_THROW(WorkerPool(257), Error);
}

}  // namespace
}  // namespace trident
