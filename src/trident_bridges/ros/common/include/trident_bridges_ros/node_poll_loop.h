// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "trident_bridges/transport/epoll_loop.h"
#include "trident_ros/direct_inbox.h"

namespace trident::bridges {

/// ros::init() of a node whose thread is a NodePollLoop. With /use_sim_time, roscpp would subscribe
/// to /clock with a thread of its own; NodePollLoop::follow_clock() does so instead.
void init_node(int argc, char** argv, const std::string& name);

/// One thread that serves a node's topics and its endpoints: what comes from a socket is decoded
/// and published, and what comes on a topic is encoded and sent, without waking another thread.
///
/// - Frequent topics: subscribe(), and NodePublisher (trident_bridges_ros/node_publisher.h).
/// - Anything else of roscpp, services and timers included: a NodeHandle whose callback queue is
///   callback_queue() has its callbacks called here, too, one hand-over later.
/// - A service that must wait for an endpoint's answer cannot run here: it is served by a spinner
///   of its own and uses loop().post().
///
/// init_node() comes first. One of them in a process that is nothing else, not a nodelet manager.
class NodePollLoop {
 public:
  /// Throws Error when the system has no descriptor left.
  NodePollLoop();
  ~NodePollLoop();
  NodePollLoop(const NodePollLoop&) = delete;
  NodePollLoop& operator=(const NodePollLoop&) = delete;

  /// For endpoints and delays of wall time.
  PollLoop& loop() { return loop_; }
  /// For NodeHandle::setCallbackQueue(): its callbacks are called by this loop's thread.
  ros::CallbackQueueInterface* callback_queue() { return &queue_; }

  /// A handle of the same namespace whose callbacks are called by this loop's thread.
  ros::NodeHandle served(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

  /// Calls `handler` with each message until the result is destroyed. The object is the same for
  /// all messages, so that strings and arrays keep their memory; bytes that are no such message are
  /// logged and ignored. Within a handler nothing may be subscribed or unsubscribed. A topic can be
  /// subscribed to once in a process.
  template <class Message>
  std::unique_ptr<ros_utils::DirectSubscription> subscribe(
      ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size,
      std::function<void(const Message&)> handler) {
    auto message = std::make_shared<Message>();
    return inbox_.subscribe<Message>(
        node, topic, queue_size,
        [message, topic, handler = std::move(handler)](Span<const std::uint8_t> bytes) {
          try {
            // The stream takes a pointer to what it may change, and reads only.
            ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes.data()),
                                               static_cast<std::uint32_t>(bytes.size()));
            ros::serialization::deserialize(stream, *message);
          } catch (const std::exception&) {  // of a length, before its bytes are looked at
            warn_of_unreadable(topic, bytes.size());
            return;
          }
          handler(*message);
        });
  }
  /// The same with a message's bytes, of a type that is known only when the program runs.
  std::unique_ptr<ros_utils::DirectSubscription> subscribe_bytes(
      ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size,
      const ros_utils::MessageType& type, ros_utils::DirectInbox::Handler handler) {
    return inbox_.subscribe(node, topic, queue_size, type, std::move(handler));
  }

  /// With /use_sim_time: ros::Time::now() follows /clock from now on, and `handler` is called with
  /// each time. Otherwise nothing happens, and false is returned.
  bool follow_clock(ros::NodeHandle& node, std::function<void(const ros::Time&)> handler);

  /// Serves everything until ros::ok() is false or stop() is called.
  void run();
  /// Serves what is ready, after at most `timeout_s` [s] of waiting.
  void run_once(double timeout_s) { loop_.run_once(timeout_s); }
  /// Ends run(). Any thread may call it.
  void stop() { loop_.stop(); }

 private:
  /// A queue whose callbacks are called by the loop.
  class Queue : public ros::CallbackQueue {
   public:
    explicit Queue(EpollLoop& loop) : loop_(loop) {}
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

   private:
    EpollLoop& loop_;
  };

  static void warn_of_unreadable(const std::string& topic, std::size_t bytes);

  EpollLoop loop_;
  Queue queue_;
  ros_utils::DirectInbox inbox_;
  std::unique_ptr<ros_utils::DirectSubscription> clock_;
};

}  // namespace trident::bridges
