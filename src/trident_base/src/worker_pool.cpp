// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "trident_base/error.h"

namespace trident {
namespace {

/// For about as long as it takes to wake a thread, so that work that follows on work needs no
/// waking and a thread that has none soon sleeps.
template <class Condition>
void spin_until(const Condition& condition) {
  constexpr int kRounds = 600;
  for (int i = 0; i < kRounds && !condition(); ++i) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
  }
}

}  // namespace

class WorkerPool::Crew {
 public:
  /// One piece of work, from which threads take part after part.
  struct Job {
    const std::function<void(std::size_t, std::size_t)>& work;
    std::size_t parts;
    std::atomic<std::size_t> next{0};
    std::mutex failure_mutex{};
    std::size_t failed_part = std::numeric_limits<std::size_t>::max();
    std::exception_ptr failure{};

    void help(std::size_t worker) {
      // The next free part is taken, not a share fixed ahead: parts differ in their work.
      for (std::size_t part = next++; part < parts; part = next++) {
        try {
          work(part, worker);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(failure_mutex);
          // The exception of the lowest part is rethrown,
          // whichever thread was first: errors repeat.
          if (part >= failed_part) continue;
          failed_part = part;
          failure = std::current_exception();
        }
      }
    }
  };

  explicit Crew(std::size_t helpers) {
    for (std::size_t i = 0; i < helpers; ++i) threads_.emplace_back([this, i] { live(i + 1); });
  }
  ~Crew() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void run(Job& job) {
    // The calling thread works, too, as worker 0.
    const std::size_t helpers = std::min(threads_.size(), job.parts - 1);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      job_ = &job;
      wanted_ = helpers;
    }
    for (std::size_t i = 0; i < helpers; ++i) wake_.notify_one();
    job.help(0);
    std::unique_lock<std::mutex> lock(mutex_);
    wanted_ = 0;  // who has not woken by now need not
    job_ = nullptr;
    lock.unlock();
    // The job is on the caller's stack: nobody may touch it after this returns.
    spin_until([this] { return busy_ == 0; });
    lock.lock();
    done_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void live(std::size_t worker) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      lock.unlock();
      spin_until([this] { return is_over_ || wanted_ > 0; });
      lock.lock();
      wake_.wait(lock, [this] { return is_over_ || wanted_ > 0; });
      if (is_over_) return;
      --wanted_;
      ++busy_;
      Job& job = *job_;
      lock.unlock();
      job.help(worker);
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  Job* job_ = nullptr;
  // Changed under the mutex, but looked at without it, too.
  std::atomic<std::size_t> wanted_{0};  ///< helpers that have yet to take up the job
  std::atomic<std::size_t> busy_{0};
  std::atomic<bool> is_over_{false};
  std::vector<std::thread> threads_;  ///< last: they use the rest
};

WorkerPool::WorkerPool(std::size_t threads) : threads_(threads) {
  constexpr std::size_t kMaxThreads = 256;
  if (threads < 1 || threads > kMaxThreads) {
    throw Error("worker threads: " + std::to_string(threads) + " is out of range [1, 256]");
  }
}

WorkerPool::~WorkerPool() = default;

void WorkerPool::share(std::size_t parts,
                       const std::function<void(std::size_t, std::size_t)>& work) {
  if (parts == 0) return;
  Crew::Job job{work, parts};
  if (threads_ == 1 || parts == 1) {
    job.help(0);
  } else {
    if (crew_ == nullptr) crew_ = std::make_unique<Crew>(threads_ - 1);
    crew_->run(job);
  }
  if (job.failure) std::rethrow_exception(job.failure);
}

}  // namespace trident
