// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "trident_ros/raw_service.h"

namespace trident::sim {

/// Types of services, as their servers name them. The master has no news of services: it is asked
/// now and then, and the server itself, on threads of their own, since both may be slow.
class ServiceTypes {
 public:
  /// As it was last heard; "" as name: never. Asks again if that is so, or after ask_again().
  ros_utils::ServiceType look(const std::string& service);
  /// Its server may be another one by now.
  void ask_again(const std::string& service);

 private:
  struct Answer {
    ros_utils::ServiceType type;
    bool is_current = false;  ///< nothing has happened since
    double asked_at_s = -1e9;
    bool is_asked = false;  ///< an answer is awaited
  };
  struct Answers {
    std::mutex mutex;
    std::map<std::string, Answer> by_service;
  };
  static void ask(const std::shared_ptr<Answers>& answers, const std::string& service);

  /// Outlives a question that has no answer yet.
  std::shared_ptr<Answers> answers_ = std::make_shared<Answers>();
};

}  // namespace trident::sim
