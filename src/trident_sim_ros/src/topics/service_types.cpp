// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "service_types.h"

#include <chrono>
#include <thread>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr double kAskAgain_s = 0.25;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void ServiceTypes::ask(const std::shared_ptr<Answers>& answers, const std::string& service) {
  ros_utils::ServiceType type;
  try {
    type = ros_utils::RawServiceClient(service).probe();
  } catch (const Error&) {
    // Nobody serves it now: it is asked again.
  }
  const std::lock_guard<std::mutex> lock(answers->mutex);
  Answer& answer = answers->by_service[service];
  answer.is_asked = false;
  answer.asked_at_s = wall_s();
  if (type.name.empty()) return;
  answer.type = type;
  answer.is_current = true;
}

ros_utils::ServiceType ServiceTypes::look(const std::string& service) {
  const std::lock_guard<std::mutex> lock(answers_->mutex);
  Answer& answer = answers_->by_service[service];
  const bool is_due =
      !answer.is_current && !answer.is_asked && wall_s() - answer.asked_at_s > kAskAgain_s;
  if (is_due) {
    answer.is_asked = true;
    std::thread([answers = answers_, service] { ask(answers, service); }).detach();
  }
  return answer.type;
}

void ServiceTypes::ask_again(const std::string& service) {
  const std::lock_guard<std::mutex> lock(answers_->mutex);
  answers_->by_service[service].is_current = false;
}

}  // namespace trident::sim
