// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/waiting_services.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"
#include "trident_ros/refusals.h"

namespace trident::mavros {

/// Topics and services below the node's private namespace. All handlers are called by the loop's
/// thread.
class RosSide {
 public:
  /// `loop` must outlive it.
  RosSide(const ros::NodeHandle& node, bridges::NodePollLoop& loop)
      : node_(node), rare_(node), loop_(loop), waiting_(node, loop), refusals_(rare_) {
    rare_.setCallbackQueue(loop.callback_queue());
  }
  RosSide(const RosSide&) = delete;
  RosSide& operator=(const RosSide&) = delete;
  ~RosSide() {
    for (const auto& ticker : tickers_) loop_.loop().cancel(ticker->next);
  }

  /// A topic that is published often.
  template <class Message>
  std::unique_ptr<bridges::NodePublisher<Message>> advertise(const std::string& topic) {
    return std::make_unique<bridges::NodePublisher<Message>>(node_, topic, kQueue);
  }
  /// A topic whose last message late subscribers get, too.
  template <class Message>
  ros::Publisher advertise_latched(const std::string& topic) {
    return node_.advertise<Message>(topic, kQueue, true);
  }
  /// Calls `handler` with each message of a topic, as long as this lives.
  template <class Message>
  void subscribe(const std::string& topic, std::function<void(const Message&)> handler) {
    subscriptions_.push_back(loop_.subscribe<Message>(node_, topic, kQueue, std::move(handler)));
  }
  /// A service that is answered at once.
  template <class Service, class Handler>
  void serve(const std::string& name, Handler handler) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    servers_.push_back(rare_.advertiseService<Request, Response>(
        name, [handler](Request& request, Response& response) {
          response = handler(request);
          return true;
        }));
  }
  /// A service whose answer comes from the vehicle.
  template <class Service>
  void serve_waiting(const std::string& name, WaitingServices::Handler<Service> handler) {
    waiting_.serve<Service>(name, std::move(handler));
  }
  /// Calls `handler` each `period_s` [s] of wall time; never where that is not positive.
  void every(double period_s, std::function<void()> handler) {
    if (!(period_s > 0.0)) return;
    tickers_.push_back(std::make_shared<Ticker>(Ticker{period_s, std::move(handler), 0}));
    arm(tickers_.back());
  }

  /// Logs and counts a refusal of something that was asked for once.
  void refuse(const std::string& kind, const std::string& text) {
    ROS_ERROR("%s", text.c_str());
    refusals_.count(kind, text);
  }

  const ros::NodeHandle& node() const { return node_; }  ///< private namespace
  bridges::PollLoop& loop() { return loop_.loop(); }     ///< that calls all handlers
  ros_utils::Refusals& refusals() { return refusals_; }  ///< of what comes often

 private:
  static constexpr std::uint32_t kQueue = 10;
  struct Ticker {
    double period_s;
    std::function<void()> handler;
    std::uint64_t next;
  };
  void arm(const std::shared_ptr<Ticker>& ticker) {
    ticker->next = loop_.loop().call_after(ticker->period_s, [this, ticker] {
      arm(ticker);
      ticker->handler();
    });
  }

  ros::NodeHandle node_, rare_;
  bridges::NodePollLoop& loop_;
  WaitingServices waiting_;
  ros_utils::Refusals refusals_;
  std::vector<ros::ServiceServer> servers_;
  std::vector<std::shared_ptr<Ticker>> tickers_;
  std::vector<std::unique_ptr<ros_utils::DirectSubscription>> subscriptions_;
};

}  // namespace trident::mavros
