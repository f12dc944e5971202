// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Mutexes whose use clang's thread-safety analysis checks (`./trident lint thread-safety`): what
/// TRIDENT_GUARDED_BY names a mutex for may be touched with it held only, and who calls a function
/// marked TRIDENT_REQUIRES must hold it. For gcc the marks mean nothing.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#if defined(__clang__)
#define TRIDENT_THREAD_MARK(mark) __attribute__((mark))
#else
#define TRIDENT_THREAD_MARK(mark)
#endif
#define TRIDENT_CAPABILITY TRIDENT_THREAD_MARK(capability("mutex"))
#define TRIDENT_SCOPED_CAPABILITY TRIDENT_THREAD_MARK(scoped_lockable)
/// Behind a data member: it is read and written with this mutex held.
#define TRIDENT_GUARDED_BY(mutex) TRIDENT_THREAD_MARK(guarded_by(mutex))
/// Behind a pointer: what it points to is read and written with this mutex held.
#define TRIDENT_PT_GUARDED_BY(mutex) TRIDENT_THREAD_MARK(pt_guarded_by(mutex))
/// Behind a function: its caller holds these mutexes, before and after the call.
#define TRIDENT_REQUIRES(...) TRIDENT_THREAD_MARK(requires_capability(__VA_ARGS__))
/// Behind a function: its caller must not hold these mutexes.
#define TRIDENT_EXCLUDES(...) TRIDENT_THREAD_MARK(locks_excluded(__VA_ARGS__))
#define TRIDENT_ACQUIRE(...) TRIDENT_THREAD_MARK(acquire_capability(__VA_ARGS__))
#define TRIDENT_RELEASE(...) TRIDENT_THREAD_MARK(release_capability(__VA_ARGS__))
/// Behind a function that is called where these mutexes are held by other names.
#define TRIDENT_ASSERT_HELD(...) TRIDENT_THREAD_MARK(assert_capability(__VA_ARGS__))
/// Behind a function whose locking the analysis cannot follow.
#define TRIDENT_NO_THREAD_SAFETY_ANALYSIS TRIDENT_THREAD_MARK(no_thread_safety_analysis)

namespace trident {

/// std::mutex with marks.
class TRIDENT_CAPABILITY Mutex {
 public:
  /// Blocks; not to be locked again by its holder.
  void lock() TRIDENT_ACQUIRE() { mutex_.lock(); }
  void unlock() TRIDENT_RELEASE() { mutex_.unlock(); }  ///< by the thread that locked it

 private:
  std::mutex mutex_;
};

/// A mutex that is given to those who wait for it in the order in which they came. A thread that
/// releases it and takes it again at once, such as one that steps a world, starves nobody.
class TRIDENT_CAPABILITY FairMutex {
 public:
  /// Blocks until all who came before have had it.
  void lock() TRIDENT_ACQUIRE() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t ticket = next_ticket_++;
    turn_.wait(lock, [&] { return ticket == now_serving_; });
  }
  /// Hands it to the one who has waited longest.
  void unlock() TRIDENT_RELEASE() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++now_serving_;
    }
    turn_.notify_all();
  }
  /// How many threads wait for it, for tests.
  std::uint64_t waiting() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return next_ticket_ - now_serving_ - (next_ticket_ > now_serving_ ? 1 : 0);
  }

 private:
  std::mutex mutex_;
  std::condition_variable turn_;
  std::uint64_t next_ticket_ = 0;
  std::uint64_t now_serving_ = 0;
};

/// Holds a Mutex or a FairMutex for as long as it lives.
template <class AnyMutex>
class TRIDENT_SCOPED_CAPABILITY Lock {
 public:
  /// Blocks until the mutex is held.
  explicit Lock(AnyMutex& mutex) TRIDENT_ACQUIRE(mutex) : mutex_(mutex) { mutex_.lock(); }
  ~Lock() TRIDENT_RELEASE() { mutex_.unlock(); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  AnyMutex& mutex_;
};

/// Releases a mutex that is held, for as long as it lives. It is held again afterwards, also when
/// an exception ends the scope.
template <class AnyMutex>
class TRIDENT_SCOPED_CAPABILITY Unlock {
 public:
  /// The calling thread holds the mutex.
  explicit Unlock(AnyMutex& mutex) TRIDENT_RELEASE(mutex) : mutex_(mutex) { mutex_.unlock(); }
  ~Unlock() TRIDENT_RELEASE() { mutex_.lock(); }
  Unlock(const Unlock&) = delete;
  Unlock& operator=(const Unlock&) = delete;

 private:
  AnyMutex& mutex_;
};

/// Waits, with the mutex held, until a condition holds; it is released meanwhile.
template <class AnyMutex, class Condition>
void wait_until(std::condition_variable_any& changed, AnyMutex& mutex, Condition condition)
    TRIDENT_REQUIRES(mutex) TRIDENT_NO_THREAD_SAFETY_ANALYSIS {
  while (!condition()) changed.wait(mutex);
}

}  // namespace trident
