// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "input_binder.h"

#include "conversions.h"

namespace trident {

void InputBinder::Mailbox::put(const geometry_msgs::Twist& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = from_twist(message);
}

std::optional<TwistCommand> InputBinder::Mailbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::optional<TwistCommand> taken;
  taken.swap(newest_);
  return taken;
}

void InputBinder::sync() {
  if (board_.version() == version_) return;
  version_ = board_.version();
  for (auto it = entries_.begin(); it != entries_.end();) {
    const bool is_there = board_.find_in<TwistCommand>(it->first) == it->second.port;
    it = is_there ? std::next(it) : entries_.erase(it);
  }
  board_.for_each([this](PortBase& port) {
    auto* input = dynamic_cast<InPort<TwistCommand>*>(&port);
    if (input == nullptr || entries_.count(port.name()) > 0) return;
    auto mailbox = std::make_shared<Mailbox>();
    ros::SubscribeOptions options;
    options.init<geometry_msgs::Twist>(
        "/" + port.name(), 1,
        [mailbox](const geometry_msgs::Twist::ConstPtr& message) { mailbox->put(*message); });
    options.callback_queue = &queue_;
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    entries_.emplace(port.name(), Entry{input, mailbox, node_.subscribe(options)});
  });
}

void InputBinder::deliver() {
  for (auto& [name, entry] : entries_) {
    if (const auto command = entry.mailbox->take()) entry.port->write(*command);
  }
}

void InputBinder::clear() {
  for (auto& [name, entry] : entries_) entry.mailbox->take();
}

}  // namespace trident
