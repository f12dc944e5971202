// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/node_ticker.h"

#include <algorithm>
#include <utility>

namespace trident::bridges::modbus {

NodeTicker::NodeTicker(ros::NodeHandle& node, NodePollLoop& loop, double period_s,
                       std::function<void()> tick)
    : loop_(loop), period_s_(period_s), tick_(std::move(tick)) {
  if (loop_.follow_clock(node, [this](const ros::Time& now) { on_time(now.toSec()); })) return;
  next_s_ = loop_.loop().now_s();
  schedule();
}

NodeTicker::~NodeTicker() { loop_.loop().cancel(call_); }

/// A clock that jumps back, as after a reset, begins a new period.
void NodeTicker::on_time(double now_s) {
  if (next_s_ > now_s + period_s_) next_s_ = now_s;
  if (now_s < next_s_) return;
  next_s_ = std::max(next_s_ + period_s_, now_s);
  tick_();
}

/// From instant to instant, so that the time that a tick takes does not add up.
void NodeTicker::schedule() {
  const double now_s = loop_.loop().now_s();
  next_s_ = std::max(next_s_ + period_s_, now_s);
  call_ = loop_.loop().call_after(next_s_ - now_s, [this] {
    schedule();
    tick_();
  });
}

}  // namespace trident::bridges::modbus
