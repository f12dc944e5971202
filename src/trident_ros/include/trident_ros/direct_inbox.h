// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sys/types.h>

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

namespace trident::ros_utils {

class DirectInbox;

/// A subscription of a DirectInbox; ends when destroyed, and no handler runs afterwards.
class DirectSubscription {
 public:
  ~DirectSubscription();
  DirectSubscription(const DirectSubscription&) = delete;
  DirectSubscription& operator=(const DirectSubscription&) = delete;

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }  ///< connected now
  /// Processes at the other ends of the connections that the inbox reads itself, as far as
  /// peer_process() finds them.
  std::vector<pid_t> processes() const;

 private:
  friend class DirectInbox;
  DirectSubscription(DirectInbox& inbox, std::uint64_t id) : inbox_(inbox), id_(id) {}
  DirectInbox& inbox_;
  std::uint64_t id_;
  ros::Subscriber subscriber_;
};

/// Messages of some topics, read from their sockets by the thread that waits for them. roscpp's own
/// path costs three reads, a poll of all its sockets, a pass over all its publications and the
/// waking of a second thread per message; this one a poll and a read. roscpp makes the connections
/// and ends them. What comes before a connection is taken over, or on a transport other than TCP,
/// passes through here in order; so do the objects that publishers in this process hand over.
/// wait() and read() belong to one thread; the rest may be called from any.
class DirectInbox {
 public:
  using Handler = std::function<void(Span<const std::uint8_t>)>;  ///< bytes of one message
  template <class Message>
  using ObjectHandler = std::function<void(const Message&)>;

  /// Who reads the sockets. In a process that others share, a nodelet manager, it must be roscpp:
  /// another subscriber of the same topic would hear nothing any more.
  enum class Sockets { kReadHere, kReadByRoscpp };

  /// Throws Error when the system has no descriptor left.
  explicit DirectInbox(Sockets sockets = Sockets::kReadHere);
  ~DirectInbox();
  DirectInbox(const DirectInbox&) = delete;
  DirectInbox& operator=(const DirectInbox&) = delete;

  /// Handlers run within read(), under the inbox's lock: they must not subscribe or unsubscribe.
  template <typename Message>
  std::unique_ptr<DirectSubscription> subscribe(ros::NodeHandle& node, const std::string& topic,
                                                std::uint32_t queue_size, Handler handler) {
    const std::uint64_t id = add({std::move(handler), {}, nullptr, false});
    return subscribed(node, id, raw_subscription<Message>(topic, queue_size, putter(id), &queue_));
  }
  /// The same for a type that is known only when the program runs.
  std::unique_ptr<DirectSubscription> subscribe(ros::NodeHandle& node, const std::string& topic,
                                                std::uint32_t queue_size, const MessageType& type,
                                                Handler handler) {
    const std::uint64_t id = add({std::move(handler), {}, nullptr, false});
    return subscribed(node, id, raw_subscription(topic, queue_size, type, putter(id), &queue_));
  }
  /// The same, and objects of publishers in this process come as they are.
  template <typename Message>
  std::unique_ptr<DirectSubscription> subscribe(ros::NodeHandle& node, const std::string& topic,
                                                std::uint32_t queue_size, Handler on_bytes,
                                                ObjectHandler<Message> on_object) {
    auto on_any = [on_object = std::move(on_object)](const void* message) {
      on_object(*static_cast<const Message*>(message));
    };
    const std::uint64_t id = add({std::move(on_bytes), std::move(on_any), nullptr, false});
    const auto put_object = [this, id](const boost::shared_ptr<Message const>& message) {
      put({id, {}, message});
    };
    return subscribed(
        node, id, object_subscription<Message>(topic, queue_size, putter(id), put_object, &queue_));
  }

  /// Readable when wait() would return true: the loop of a node that has other descriptors, too,
  /// can watch it, and then calls wait() without waiting, and read().
  int descriptor() const { return descriptors_.epoll; }
  /// Waits until there is something to read, or wake() is called. False: the time is over.
  bool wait(std::chrono::milliseconds limit);
  /// Runs the handlers of what has come.
  void read();
  /// Ends a wait(), or the next one.
  void wake();
  /// Connections that are read here, not by roscpp.
  std::size_t link_count();
  /// Changes whenever another connection is read here.
  std::uint64_t newest_link() const { return newest_link_; }

 private:
  friend class DirectSubscription;
  struct Topic {
    Handler on_bytes;
    std::function<void(const void*)> on_object;
    ros::SubscriptionPtr subscription;
    bool has_new_link;
  };
  struct Link;
  /// What came through roscpp: bytes or an object.
  struct Item {
    std::uint64_t topic;
    std::vector<std::uint8_t> bytes;
    boost::shared_ptr<void const> object;
  };

  struct Descriptors {
    int epoll = -1;
    int wake = -1;
  };
  /// What came through roscpp and waits for read().
  struct PutItems {
    std::atomic<bool> any{false};
    std::mutex mutex;  ///< taken after mutex_: a handler may publish to a topic of this inbox
    std::vector<Item> waiting, being_read;
  };

  std::uint64_t add(Topic topic);
  std::unique_ptr<DirectSubscription> subscribed(ros::NodeHandle& node, std::uint64_t id,
                                                 ros::SubscribeOptions options);
  void remove(std::uint64_t id);
  Handler putter(std::uint64_t id);
  void put(Item item);
  void take_over_links();
  void take_over(Topic& topic, std::uint64_t id);
  void read_put();
  void read_link(std::uint64_t key);
  void hand_out(Link& link, std::size_t size);
  void return_to_roscpp(std::uint64_t key);

  Sockets sockets_;
  InlineCallbackQueue queue_;
  std::mutex mutex_;
  Descriptors descriptors_;
  std::uint64_t next_key_ = 1;
  std::atomic<std::uint64_t> newest_link_{0};
  std::unordered_map<std::uint64_t, Topic> topics_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Link>> links_;
  std::atomic<bool> has_new_links_{false};
  PutItems put_;
  std::vector<std::uint8_t> buffer_;
  std::vector<std::uint64_t> ready_;  ///< found by wait()
  boost::signals2::connection listener_;
};

}  // namespace trident::ros_utils
