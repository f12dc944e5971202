// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges {

/// A call of a loop after a delay, which is not made any more when this is destroyed.
class DelayedCall {
 public:
  /// `loop` must outlive it.
  explicit DelayedCall(PollLoop& loop) : loop_(loop) {}
  ~DelayedCall() { cancel(); }
  DelayedCall(const DelayedCall&) = delete;
  DelayedCall& operator=(const DelayedCall&) = delete;

  /// Calls `callback` after a delay [s], in place of a call that is still waiting.
  template <class Callback>
  void start(double delay_s, Callback callback) {
    cancel();
    number_ = loop_.call_after(delay_s, [this, callback] {
      number_ = 0;
      callback();
    });
  }
  /// Whether a call is waiting.
  bool is_waiting() const { return number_ != 0; }
  /// The call is not made.
  void cancel() {
    if (number_ != 0) loop_.cancel(number_);
    number_ = 0;
  }

 private:
  PollLoop& loop_;
  std::uint64_t number_ = 0;
};

/// What all endpoints have: their loop, their owner's functions, counts and warnings.
class EndpointBase : public Endpoint {
 public:
  EndpointCounts counts() const override { return counts_; }
  std::string name() const override { return name_; }

 protected:
  EndpointBase(const EndpointOptions& options, PollLoop& loop, EndpointEvents events)
      : options_(options), loop_(loop), events_(std::move(events)) {}

  void report_received(PeerId peer, Bytes block) {
    ++counts_.received;
    counts_.received_bytes += block.size();
    if (events_.received) events_.received(peer, block);
  }
  void report_joined(PeerId peer, const std::string& address) const {
    if (events_.joined) events_.joined(peer, address);
  }
  void report_left(PeerId peer, const std::string& reason) const {
    if (events_.left) events_.left(peer, reason);
  }
  void report_notice(const std::string& text) const {
    if (events_.notice) events_.notice(name_ + ": " + text);
  }
  /// Reports the first of its kind.
  void report_warning(const std::string& kind, const std::string& text) {
    if (warned_.insert(kind).second && events_.warning) events_.warning(name_ + ": " + text);
  }
  /// The next warning of this kind is reported again.
  void forget_warning(const std::string& kind) { warned_.erase(kind); }

  void count_sent(std::size_t bytes) {
    ++counts_.sent;
    counts_.sent_bytes += bytes;
  }

  EndpointOptions options_;
  PollLoop& loop_;
  EndpointEvents events_;
  EndpointCounts counts_;
  std::string name_;

 private:
  std::set<std::string> warned_;
};

}  // namespace trident::bridges
