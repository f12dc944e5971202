// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue_interface.h>

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <thread>

namespace trident::ros_utils {

/// Runs each callback on a thread of its own, so that one that waits keeps nobody else waiting.
class ThreadedCallbackQueue : public ros::CallbackQueueInterface {
 public:
  ThreadedCallbackQueue() = default;
  /// Waits for the callbacks that run: who ends it has to end what they wait for first.
  ~ThreadedCallbackQueue() override {
    std::unique_lock<std::mutex> lock(running_->mutex);
    running_->ended.wait(lock, [this] { return running_->count == 0; });
  }
  ThreadedCallbackQueue(const ThreadedCallbackQueue&) = delete;
  ThreadedCallbackQueue& operator=(const ThreadedCallbackQueue&) = delete;

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
    {
      const std::lock_guard<std::mutex> lock(running_->mutex);
      ++running_->count;
    }
    std::thread([callback = ros::CallbackInterfacePtr(callback), running = running_]() mutable {
      callback->call();
      callback.reset();
      const std::lock_guard<std::mutex> lock(running->mutex);
      --running->count;
      running->ended.notify_all();
    }).detach();
  }
  /// Nothing ever waits here.
  void removeByID(std::uint64_t) override {}

 private:
  struct Running {
    std::mutex mutex;
    std::condition_variable ended;
    std::size_t count = 0;
  };
  std::shared_ptr<Running> running_ = std::make_shared<Running>();  ///< outlives the last thread
};

}  // namespace trident::ros_utils
