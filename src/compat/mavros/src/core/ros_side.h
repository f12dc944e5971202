// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/transform_follower.h"
#include "core/waiting_services.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"
#include "trident_ros/refusals.h"

namespace trident::mavros {

/// Topics and services below the node's private namespace. All handlers are called by the loop's
/// thread.
class RosSide {
 public:
  /// `transforms`: of the process. Both must outlive it.
  RosSide(const ros::NodeHandle& node, bridges::NodePollLoop& loop, Transforms& transforms)
      : node_(node),
        rare_(loop.served(node)),
        loop_(loop),
        transforms_(transforms),
        waiting_(node, loop),
        refusals_(rare_, node.getNamespace()) {}
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

  /// Calls `handler` with each new pose of a transform, at most at its rate.
  void follow(const TfParams& params, std::function<void(const FollowedPose&)> handler) {
    ROS_INFO("%s: follows the transform %s -> %s", node_.getNamespace().c_str(),
             params.frame_id.c_str(), params.child_frame_id.c_str());
    auto rate = std::make_shared<FollowedRate>(params.rate_limit);
    transforms_.on_change(refusals_, [this, params, rate, handler = std::move(handler)] {
      const auto pose = transforms_.find(params);
      if (pose && rate->is_due(pose->stamp)) handler(*pose);
    });
  }

  /// Calls `handler` with the newest pose of a transform at its rate of wall time, the same one
  /// again and again, until it is older than a second; a static one never is.
  void repeat(const TfParams& params, std::function<void(const FollowedPose&)> handler) {
    transforms_.on_change(refusals_, [] {});
    every(1.0 / params.rate_limit, [this, params, handler = std::move(handler)] {
      const auto pose = transforms_.find(params);
      if (!pose) return;
      const double age_s =
          pose->stamp.isZero() ? 0.0 : ros::Time::now().toSec() - pose->stamp.toSec();
      if (age_s <= kMaxAge_s) return handler(*pose);
      refusals_.note("set-points refused", "transform to " + params.child_frame_id + ": it is " +
                                               std::to_string(age_s) + " s old, legal: up to 1");
    });
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
  static constexpr double kMaxAge_s = 1.0;
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
  Transforms& transforms_;
  WaitingServices waiting_;
  ros_utils::Refusals refusals_;
  std::vector<ros::ServiceServer> servers_;
  std::vector<std::shared_ptr<Ticker>> tickers_;
  std::vector<std::unique_ptr<ros_utils::DirectSubscription>> subscriptions_;
};

}  // namespace trident::mavros
