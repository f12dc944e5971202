// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/transport/epoll_loop.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>
#include <utility>

#include "trident_base/error.h"

namespace trident::bridges {
namespace {

// Serials of watches begin at 1, so that these keys are no watch's.
constexpr std::uint64_t kTimerKey = 0;
constexpr std::uint64_t kWakeKey = 1;
constexpr std::size_t kEvents = 64;
constexpr std::size_t kFirstCalls = 64;

std::uint64_t key_of(int descriptor, std::uint32_t serial) {
  return std::uint64_t{serial} << 32 | static_cast<std::uint32_t>(descriptor);
}

std::uint32_t epoll_events(std::uint32_t wanted) {
  return ((wanted & PollLoop::kReadable) != 0 ? EPOLLIN : 0U) |
         ((wanted & PollLoop::kWritable) != 0 ? EPOLLOUT : 0U);
}

std::uint32_t ready_of(std::uint32_t events) {
  return ((events & EPOLLIN) != 0 ? PollLoop::kReadable : 0U) |
         ((events & EPOLLOUT) != 0 ? PollLoop::kWritable : 0U) |
         ((events & (EPOLLHUP | EPOLLERR)) != 0 ? PollLoop::kClosed : 0U);
}

void drain(int descriptor) {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto size = ::read(descriptor, &count, sizeof(count));
}

}  // namespace

EpollLoop::EpollLoop()
    : epoll_(epoll_create1(EPOLL_CLOEXEC)),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (epoll_ < 0 || timer_ < 0 || wake_ < 0) {
    throw Error(std::string("poll loop: ") + std::strerror(errno));
  }
  calls_.reserve(kFirstCalls);
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kTimerKey;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, timer_, &event);
  event.data.u64 = kWakeKey;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event);
}

EpollLoop::~EpollLoop() {
  for (const int descriptor : {epoll_, timer_, wake_}) {
    if (descriptor >= 0) close(descriptor);
  }
}

void EpollLoop::control(int operation, int descriptor, std::uint32_t wanted, std::uint32_t serial) {
  epoll_event event{};
  event.events = epoll_events(wanted);
  event.data.u64 = key_of(descriptor, serial);
  if (epoll_ctl(epoll_, operation, descriptor, &event) != 0) {
    throw Error("poll loop: descriptor " + std::to_string(descriptor) + ": " +
                std::strerror(errno));
  }
}

void EpollLoop::watch(int descriptor, std::uint32_t wanted, Callback callback) {
  const std::uint32_t serial = next_serial_++;
  auto entry = std::make_shared<Watch>(Watch{descriptor, serial, std::move(callback)});
  control(EPOLL_CTL_ADD, descriptor, wanted, serial);
  watches_[descriptor] = std::move(entry);
}

void EpollLoop::change(int descriptor, std::uint32_t wanted) {
  control(EPOLL_CTL_MOD, descriptor, wanted, watches_.at(descriptor)->serial);
}

void EpollLoop::forget(int descriptor) {
  if (watches_.erase(descriptor) == 0) return;
  epoll_ctl(epoll_, EPOLL_CTL_DEL, descriptor, nullptr);
}

std::uint64_t EpollLoop::call_after(double delay_s, std::function<void()> callback) {
  const double due_s = now_s() + std::max(delay_s, 0.0);
  const auto later = [due_s](const WaitingCall& call) { return call.due_s > due_s; };
  const auto place = std::partition_point(calls_.begin(), calls_.end(), later);
  calls_.insert(place, {due_s, next_call_, std::move(callback)});
  arm_timer();
  return next_call_++;
}

void EpollLoop::cancel(std::uint64_t call) {
  const auto is_it = [call](const WaitingCall& other) { return other.number == call; };
  calls_.erase(std::remove_if(calls_.begin(), calls_.end(), is_it), calls_.end());
}

double EpollLoop::now_s() const {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void EpollLoop::post(std::function<void()> callback) {
  {
    const Lock lock(mutex_);
    posted_.push_back(std::move(callback));
  }
  wake();
}

// Before a call is made and after those that were due; a timer that rings too early does no harm.
void EpollLoop::arm_timer() {
  const double earliest_s = calls_.empty() ? 0.0 : calls_.back().due_s;
  if (earliest_s == armed_s_ || earliest_s == 0.0) return;
  armed_s_ = earliest_s;
  itimerspec when{};
  when.it_value.tv_sec = static_cast<time_t>(std::floor(earliest_s));
  when.it_value.tv_nsec = static_cast<long>(1e9 * (earliest_s - std::floor(earliest_s)));
  timerfd_settime(timer_, TFD_TIMER_ABSTIME, &when, nullptr);
}

void EpollLoop::make_due_calls() {
  drain(timer_);
  armed_s_ = 0.0;
  // Also when a callback throws.
  const std::unique_ptr<EpollLoop, void (*)(EpollLoop*)> at_end(
      this, [](EpollLoop* loop) { loop->arm_timer(); });
  // Calls that these make wait for the next turn, so that descriptors have theirs.
  const double now = now_s();
  const std::uint64_t first_new = next_call_;
  while (!calls_.empty() && calls_.back().due_s <= now && calls_.back().number < first_new) {
    const std::function<void()> callback = std::move(calls_.back().callback);
    calls_.pop_back();
    callback();
  }
}

void EpollLoop::make_posted_call() {
  drain(wake_);
  std::function<void()> callback;
  {
    const Lock lock(mutex_);
    if (posted_.empty()) return;
    callback = std::move(posted_.front());
    posted_.pop_front();
    if (!posted_.empty()) wake();
  }
  callback();
}

void EpollLoop::wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto size = ::write(wake_, &one, sizeof(one));
}

void EpollLoop::dispatch(std::uint64_t key, std::uint32_t events) {
  if (key == kTimerKey) return make_due_calls();
  if (key == kWakeKey) return make_posted_call();
  const auto entry = watches_.find(static_cast<int>(key & 0xFFFFFFFFU));
  if (entry == watches_.end() || entry->second->serial != key >> 32) return;
  // A copy of the pointer: the callback may forget its descriptor.
  const std::shared_ptr<Watch> watch = entry->second;
  watch->callback(ready_of(events));
}

bool EpollLoop::run_once(double timeout_s) {
  std::array<epoll_event, kEvents> events;
  const int timeout_ms =
      timeout_s < 0 ? -1 : static_cast<int>(std::min(std::ceil(1e3 * timeout_s), 1e9));
  const int count = is_stopped_ ? 0 : epoll_wait(epoll_, events.data(), kEvents, timeout_ms);
  for (int i = 0; i < count && !is_stopped_; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    dispatch(event.data.u64, event.events);
  }
  return !is_stopped_;
}

void EpollLoop::run() {
  while (run_once(-1.0)) {
  }
}

void EpollLoop::stop() {
  is_stopped_ = true;
  wake();
}

}  // namespace trident::bridges
