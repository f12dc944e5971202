// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "trident_base/mutex.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges {

/// A poll loop on epoll and timerfd, for the one thread that runs it. Once everything is watched,
/// neither events nor calls after a delay take memory.
class EpollLoop : public PollLoop {
 public:
  /// Throws Error when the system has no descriptor left.
  EpollLoop();
  /// Descriptors that are still watched stay open.
  ~EpollLoop() override;
  EpollLoop(const EpollLoop&) = delete;
  EpollLoop& operator=(const EpollLoop&) = delete;

  void watch(int descriptor, std::uint32_t wanted, Callback callback) override;
  void change(int descriptor, std::uint32_t wanted) override;
  void forget(int descriptor) override;
  std::uint64_t call_after(double delay_s, std::function<void()> callback) override;
  void cancel(std::uint64_t call) override;
  double now_s() const override;
  void post(std::function<void()> callback) override;

  /// Waits for at most `timeout_s` [s], negative: without limit, and makes the calls that are due.
  /// Returns false once stop() was called. What a callback throws comes out of here, and the loop
  /// can be run again.
  bool run_once(double timeout_s);
  /// run_once() until stop().
  void run();
  /// Ends run(), also one that begins later. Any thread or signal handler may call it.
  void stop();
  /// Readable when run_once(0) would make a call: an outer loop can watch it.
  int descriptor() const { return epoll_; }

 private:
  struct Watch {
    int descriptor;
    std::uint32_t
        serial;  ///< keeps events of a descriptor that was forgotten apart from later ones
    Callback callback;
  };
  struct WaitingCall {
    double due_s;
    std::uint64_t number;
    std::function<void()> callback;
  };

  void control(int operation, int descriptor, std::uint32_t wanted, std::uint32_t serial);
  void dispatch(std::uint64_t key, std::uint32_t events);
  void make_posted_call();
  void wake();
  void make_due_calls();
  void arm_timer();

  int epoll_ = -1, timer_ = -1, wake_ = -1;
  std::atomic<bool> is_stopped_{false};
  std::uint32_t next_serial_ = 1;
  std::unordered_map<int, std::shared_ptr<Watch>> watches_;
  std::uint64_t next_call_ = 1;
  std::vector<WaitingCall> calls_;  ///< the earliest is the last
  double armed_s_ = 0.0;            ///< 0: the timer is not armed
  Mutex mutex_;
  std::deque<std::function<void()>> posted_ TRIDENT_GUARDED_BY(mutex_);
};

}  // namespace trident::bridges
