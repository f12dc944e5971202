// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "radio_calls.h"

#include <utility>

namespace trident::sim {
namespace {

// A rule whose service nobody serves by then, in simulated and in wall time, is a mistake.
constexpr SimTime kUnserved{5'000'000'000};
constexpr WallTime kUnservedWall = 5'000'000'000;

}  // namespace

RadioCalls::RadioCalls(ros::NodeHandle& node, const World& world, LossWatch& losses,
                       ReportSink report)
    : world_(world),
      report_(std::move(report)),
      repeatability_(losses.repeatability()),
      called_(node, types_, repeatability_, bell_),
      served_(types_, bell_, losses) {}

void RadioCalls::sync() {
  if (world_.ports().version() == version_) return;
  version_ = world_.ports().version();
  relay_ = find_relay_services(world_);
  if (relay_ == nullptr) return;
  const std::vector<RelayService> services = relay_->services();
  if (known_since_ == 0 && !services.empty()) known_since_ = wall_now();
  called_.sync(services);
  called_.look_for_types();
}

void RadioCalls::look_for_types() {
  if (relay_ == nullptr || called_.empty() || !looks_.is_due(world_.time())) return;
  called_.look_for_types();
  const bool is_late = known_since_ != 0 && wall_now() - known_since_ > kUnservedWall;
  if (is_late && world_.time() >= kUnserved && !std::exchange(has_reported_unserved_, true)) {
    report_unserved();
  }
}

void RadioCalls::report_unserved() {
  for (const auto& [rule, servers] : called_.unserved()) {
    report_(Severity::kWarning, rule + ": no node serves " + join(servers) + " after " +
                                    seconds_text(kUnserved.seconds()));
  }
}

bool RadioCalls::allows_step(SimTime begin) { return served_.allows_step(begin, is_calling()); }

void RadioCalls::deliver(SimTime begin) {
  if (relay_ == nullptr) return;
  served_.deliver(begin, *relay_, is_calling());
  called_.deliver(begin, *relay_, [this](const std::string& node) { return waits_for(node); });
}

void RadioCalls::take() {
  if (relay_ == nullptr) return;
  for (const ServedCall& call : relay_->take_served()) {
    served_.begin(call, called_.received());
  }
  for (const CallResult& result : relay_->take_results()) {
    served_.forget(result.number);
    called_.finish(result);
  }
}

void RadioCalls::abort_calls_of(const std::vector<std::string>& nodes, const std::string& why) {
  if (relay_ == nullptr) return;
  for (const std::string& node : nodes) {
    if (!called_.is_calling(node)) continue;
    // Calls that have come count as begun, so that they can be aborted.
    deliver(world_.time());
    called_.abort(node,
                  why + ", and " + node + " for this call, legal: calls from a thread of their own",
                  *relay_);
  }
  take();
}

std::string RadioCalls::describe() const {
  if (relay_ == nullptr || called_.empty()) return {};
  return std::to_string(called_.waiting()) + " wait for the next step, " +
         std::to_string(called_.in_progress()) + " are in progress, " +
         std::to_string(served_.size()) + " of these at their servers";
}

void RadioCalls::clear() {
  if (relay_ == nullptr) return;
  served_.clear();
  take();
  called_.clear();
}

void RadioCalls::end(const std::string& why) {
  served_.clear();
  called_.end(why);
}

}  // namespace trident::sim
