// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Two ends of a protocol with a radio between them, in simulated time.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "trident_base/random_stream.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink::testing {

/// Loses messages by chance and delays the others; both directions have the same numbers.
class LossyLink {
 public:
  LossyLink(double loss, double delay_s, std::string_view name, double repeat = 0.0)
      : random_(1, name), loss_(loss), repeat_(repeat), delay_(SimTime::from_seconds(delay_s)) {}

  /// What an end sends: to be given to its machine.
  MessageSink from(int end) {
    return [this, end](const Message& message) {
      ++sent_;
      if (random_.uniform(sent_, 0) < loss_) return;
      flying_.push_back({now_ + delay_, 1 - end, message});
      if (random_.uniform(sent_, 1) < repeat_) {
        flying_.push_back({now_ + delay_ + delay_, 1 - end, message});
      }
    };
  }

  /// Time passes until `is_done`, or `limit_s` later; `receive` gets what arrives at an end,
  /// `update` is called each 10 ms. Returns how long it took [s].
  double run(double limit_s, const std::function<bool()>& is_done,
             const std::function<void(int, const Message&)>& receive,
             const std::function<void()>& update) {
    const SimTime begin = now_;
    while (!is_done() && (now_ - begin).seconds() < limit_s) {
      deliver(receive);
      update();
      now_ = now_ + SimTime{10'000'000};
    }
    return (now_ - begin).seconds();
  }

  SimTime now() const { return now_; }
  std::uint64_t sent() const { return sent_; }

 private:
  struct Flying {
    SimTime arrival;
    int to;
    Message message;
  };

  void deliver(const std::function<void(int, const Message&)>& receive) {
    std::vector<Flying> arrived;
    for (std::size_t i = 0; i < flying_.size();) {
      if (flying_[i].arrival > now_) {
        ++i;
        continue;
      }
      arrived.push_back(flying_[i]);
      flying_.erase(flying_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    for (const Flying& one : arrived) receive(one.to, one.message);
  }

  RandomStream random_;
  double loss_, repeat_;
  SimTime delay_, now_;
  std::uint64_t sent_ = 0;
  std::vector<Flying> flying_;
};

}  // namespace trident::bridges::mavlink::testing
