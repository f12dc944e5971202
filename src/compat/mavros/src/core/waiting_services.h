// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::mavros {

/// Services of a node whose answer comes from the vehicle. A request is handed to the loop's
/// thread, and a thread of a spinner waits for the answer.
class WaitingServices {
 public:
  /// `node`: whose names are used. `loop` must outlive it.
  WaitingServices(const ros::NodeHandle& node, bridges::NodePollLoop& loop)
      : node_(node), loop_(loop), spinner_(kThreads, &queue_) {
    node_.setCallbackQueue(&queue_);
    spinner_.start();
  }
  /// Requests that wait are answered with false.
  ~WaitingServices() {
    is_closing_ = true;
    spinner_.stop();
  }
  WaitingServices(const WaitingServices&) = delete;
  WaitingServices& operator=(const WaitingServices&) = delete;

  /// Gives the answer, from the loop's thread; further calls do nothing.
  template <class Service>
  using Reply = std::function<void(const typename Service::Response&)>;
  /// Begins what was asked for, in the loop's thread.
  template <class Service>
  using Handler = std::function<void(const typename Service::Request&, Reply<Service>)>;

  /// Advertises a service.
  template <class Service>
  void serve(const std::string& name, Handler<Service> handler) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    auto shared = std::make_shared<Handler<Service>>(std::move(handler));
    servers_.push_back(node_.advertiseService<Request, Response>(
        name, [this, shared](Request& request, Response& response) {
          return wait_for<Service>(shared, request, response);
        }));
  }

 private:
  static constexpr std::uint32_t kThreads = 4;
  static constexpr std::chrono::milliseconds kLook{100};

  template <class Service>
  bool wait_for(const std::shared_ptr<Handler<Service>>& handler,
                const typename Service::Request& request, typename Service::Response& response) {
    using Response = typename Service::Response;
    auto answer = std::make_shared<std::promise<Response>>();
    std::future<Response> future = answer->get_future();
    loop_.loop().post([handler, request, answer] {
      auto is_given = std::make_shared<bool>(false);
      (*handler)(request, [answer, is_given](const Response& given) {
        if (!std::exchange(*is_given, true)) answer->set_value(given);
      });
    });
    while (future.wait_for(kLook) != std::future_status::ready) {
      if (is_closing_ || !ros::ok()) return false;
    }
    response = future.get();
    return true;
  }

  ros::NodeHandle node_;
  bridges::NodePollLoop& loop_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  std::vector<ros::ServiceServer> servers_;
  std::atomic<bool> is_closing_{false};
};

}  // namespace trident::mavros
