// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "carriers.h"
#include "latency_record.h"
#include "parts.h"

namespace trident::bridges {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kFirstPeriod_ns = 50'000'000;
constexpr std::int64_t kShortWait_ns = 20'000;
constexpr std::int64_t kBeat_ns = 1'000'000;    // what is due within it is sent together
constexpr std::int64_t kLoss_ns = 200'000'000;  // nothing came for so long: the rest is lost

// A sleep until a time that is past still sets a timer, which takes tens of microseconds.
void sleep_until(std::int64_t time_ns) {
  if (monotonic_ns() >= time_ns) return;
  const timespec when{time_ns / kSecond_ns, time_ns % kSecond_ns};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr);
}

template <class Carrier>
class Source {
 public:
  explicit Source(const ProbeOptions& options)
      : options_(options),
        carrier_(make_carrier<Carrier>(options)),
        record_(options.record),
        count_(std::min(options.count, record_.capacity() - 1)),
        publisher_(node_.advertise<typename Carrier::Message>(options.topic, kProbeQueue)) {}

  int run() {
    if (!wait_for_the_path()) {
      std::fprintf(stderr, "latency_probe: nothing of %s arrived within %g s\n",
                   publisher_.getTopic().c_str(), options_.limit_s);
      return 1;
    }
    record_.set_state(LatencyRecord::kRunning);
    const std::int64_t begin_ns = monotonic_ns();
    for (std::uint64_t number = 1; number <= count_ && ros::ok(); ++number) {
      if (options_.rate > 0.0) {
        const auto due_ns = static_cast<std::int64_t>(1e9 * number / options_.rate);
        sleep_until(begin_ns + (due_ns + kBeat_ns - 1) / kBeat_ns * kBeat_ns);
      } else {
        wait_for_room(options_.window);
      }
      send(number);
    }
    wait_for_room(1);
    record_.set_state(LatencyRecord::kDone);
    return 0;
  }

 private:
  void send(std::uint64_t number) {
    carrier_.put(number, options_.size, message_);
    record_.note_sent(number, monotonic_ns());
    ++sent_;
    publisher_.publish(message_);
  }

  bool wait_for_the_path() {
    const std::int64_t limit_ns =
        monotonic_ns() + static_cast<std::int64_t>(1e9 * options_.limit_s);
    while (ros::ok() && monotonic_ns() < limit_ns) {
      if (publisher_.getNumSubscribers() > 0) {
        carrier_.put(0, options_.size, message_);
        publisher_.publish(message_);
      }
      sleep_until(monotonic_ns() + kFirstPeriod_ns);
      if (record_.has_received(0)) return true;
    }
    return false;
  }

  // Until fewer than `window` messages are on their path; those that nothing has been heard of for
  // long are given up.
  void wait_for_room(std::uint64_t window) {
    std::uint64_t arrived = record_.received() - 1;  // without number 0
    std::int64_t progress_ns = monotonic_ns();
    while (ros::ok() && sent_ >= arrived + lost_ + window) {
      sleep_until(monotonic_ns() + kShortWait_ns);
      const std::uint64_t now_arrived = record_.received() - 1;
      if (now_arrived != arrived) {
        arrived = now_arrived;
        progress_ns = monotonic_ns();
      } else if (monotonic_ns() - progress_ns > kLoss_ns) {
        lost_ = sent_ - arrived;
      }
    }
  }

  const ProbeOptions& options_;
  Carrier carrier_;
  LatencyRecord record_;
  std::uint64_t count_, sent_ = 0, lost_ = 0;
  typename Carrier::Message message_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
};

}  // namespace

int run_source(const ProbeOptions& options) {
  return with_carrier(options.message, [&](auto carrier) {
    return Source<typename decltype(carrier)::type>(options).run();
  });
}

}  // namespace trident::bridges
