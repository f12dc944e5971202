// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <boost/signals2/connection.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "trident_base/span.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/subscriptions.h"

namespace trident {

class DirectInbox;

/// A subscription of a DirectInbox; ends when destroyed, and no handler runs afterwards.
class DirectSubscription {
 public:
  ~DirectSubscription();
  DirectSubscription(const DirectSubscription&) = delete;
  DirectSubscription& operator=(const DirectSubscription&) = delete;

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

 private:
  friend class DirectInbox;
  DirectSubscription(DirectInbox& inbox, std::uint64_t id) : inbox_(inbox), id_(id) {}
  DirectInbox& inbox_;
  std::uint64_t id_;
  ros::Subscriber subscriber_;
};

/// Messages of some topics, read from their sockets by the thread that waits for them. roscpp's way
/// costs three reads, a poll of all its sockets, a pass over all its publications and the waking
/// of a second thread per message; this one a poll and a read. roscpp makes the connections and
/// ends them. What comes before a connection is taken over, or on a transport other than TCP,
/// passes through here in order.
/// wait() and read() belong to one thread; the rest may be called from any.
class DirectInbox {
 public:
  using Handler = std::function<void(Span<const std::uint8_t>)>;  ///< bytes of one message

  /// Throws Error when the system has no descriptor left.
  DirectInbox();
  ~DirectInbox();
  DirectInbox(const DirectInbox&) = delete;
  DirectInbox& operator=(const DirectInbox&) = delete;

  /// Handlers run within read(), under the inbox's lock: they must not subscribe or unsubscribe.
  template <typename Message>
  std::unique_ptr<DirectSubscription> subscribe(ros::NodeHandle& node, const std::string& topic,
                                                std::uint32_t queue_size, Handler handler) {
    const std::uint64_t id = add(std::move(handler));
    auto options = raw_subscription<Message>(
        topic, queue_size, [this, id](Span<const std::uint8_t> bytes) { put(id, bytes); }, &queue_);
    std::unique_ptr<DirectSubscription> result(new DirectSubscription(*this, id));
    result->subscriber_ = node.subscribe(options);
    attach(id, result->subscriber_.getTopic());
    return result;
  }

  /// Waits until there is something to read, or wake() is called. False: the time is over.
  bool wait(std::chrono::milliseconds limit);
  /// Runs the handlers of what has come.
  void read();
  /// Ends a wait(), or the next one.
  void wake();
  /// Connections that are read here, not by roscpp.
  std::size_t link_count();

 private:
  friend class DirectSubscription;
  struct Topic;
  struct Link;

  std::uint64_t add(Handler handler);
  void attach(std::uint64_t id, const std::string& topic);
  void remove(std::uint64_t id);
  void put(std::uint64_t id, Span<const std::uint8_t> bytes);
  void take_over_links();
  void take_over(Topic& topic, std::uint64_t id);
  void read_put();
  void read_link(std::uint64_t key);
  void hand_out(Link& link, std::size_t size);
  void give_back(std::uint64_t key);

  InlineCallbackQueue queue_;
  std::mutex mutex_;
  int epoll_ = -1;
  int wake_ = -1;
  std::uint64_t next_key_ = 1;
  std::unordered_map<std::uint64_t, std::unique_ptr<Topic>> topics_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Link>> links_;
  std::atomic<bool> has_new_links_{false};
  std::atomic<bool> has_put_{false};
  std::vector<std::pair<std::uint64_t, std::vector<std::uint8_t>>> put_;  ///< through roscpp
  std::vector<std::uint8_t> buffer_;
  std::vector<std::uint64_t> ready_;  ///< found by wait()
  boost::signals2::connection listener_;
};

}  // namespace trident
