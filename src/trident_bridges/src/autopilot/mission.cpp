// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/mission.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

namespace command = mission_command;

constexpr std::uint16_t kNavigation[] = {
    command::kWaypoint, command::kLoiterForever, command::kLoiterTurns, command::kLoiterTime,
    command::kReturn,   command::kLand,          command::kTakeOff,     command::kSplineWaypoint};
constexpr std::uint16_t kInPassing[] = {
    command::kDelay,    command::kConditionDelay,   command::kConditionYaw,
    command::kJump,     command::kChangeSpeed,      command::kSetHome,
    command::kSetServo, command::kRegionOfInterest, command::kEnableFence};

// MAV_CMD_DO_SET_RELAY to _DO_REPEAT_SERVO without kSetServo; _DO_CONTROL_VIDEO, _DO_DIGICAM_* to
// _DO_SET_CAM_TRIGG_DIST, _DO_SET_CAM_TRIGG_INTERVAL; _SET_CAMERA_*; _DO_GIMBAL_MANAGER_*;
// _IMAGE_*_CAPTURE, _VIDEO_*_CAPTURE.
constexpr std::uint16_t kForPayload[] = {181, 182, 184, 200,  202,  203,  204,  205,  206, 214,
                                         530, 531, 532, 1000, 1001, 2000, 2001, 2500, 2501};

template <std::size_t size>
bool has(const std::uint16_t (&list)[size], std::uint16_t command) {
  return std::find(std::begin(list), std::end(list), command) != std::end(list);
}

/// A field that is not legal: its name, the value and the range.
struct Problem {
  std::string field;
  double value;
  std::string legal;
};

std::optional<Problem> at_least(const char* field, double value, double least) {
  if (value >= least && std::isfinite(value)) return std::nullopt;
  return Problem{field, value, number_text(least) + " or more"};
}

std::optional<Problem> field_problem(const MissionItem& item, int count) {
  const auto& p = item.params;
  if (item.has_place && !item.p_world_m.allFinite()) {
    return Problem{"place", item.p_world_m.sum(), "finite numbers"};
  }
  switch (item.command) {
    case command::kJump:
      if (!(p[0] >= 0 && p[0] < count && p[0] == std::floor(p[0]))) {
        return Problem{"param1", p[0], "an index from 0 to " + std::to_string(count - 1)};
      }
      return at_least("param2", p[1], -1.0);
    case command::kChangeSpeed:
      if (p[1] == -1.0) return std::nullopt;  // as it is
      return at_least("param2", p[1], 0.01);
    case command::kLoiterTurns:
    case command::kLoiterTime:
    case command::kConditionDelay:
    case command::kDelay:
      return at_least("param1", p[0], 0.0);
    case command::kConditionYaw:
      return at_least("param1", p[0], -360.0);
    default:
      return std::nullopt;
  }
}

bool is_only_of_multirotors(std::uint16_t item) {
  return item == command::kLoiterTurns || item == command::kTakeOff || item == command::kLand;
}

double or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

}  // namespace

bool is_navigation(std::uint16_t item) { return has(kNavigation, item); }

bool is_for_payload(std::uint16_t item) { return has(kForPayload, item); }

Answer check_mission(const std::vector<MissionItem>& items, VehicleClass vehicle) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string where = "mission item " + std::to_string(i) + ": ";
    const std::uint16_t number = items[i].command;
    if (is_for_payload(number)) continue;
    if (!is_navigation(number) && !has(kInPassing, number)) {
      return {Result::kUnsupported, where + "command " + std::to_string(number) + " is not known"};
    }
    if (vehicle != VehicleClass::kMultirotor && is_only_of_multirotors(number)) {
      return {Result::kUnsupported,
              where + "command " + std::to_string(number) + " is only for vehicles that fly"};
    }
    if (const auto problem = field_problem(items[i], static_cast<int>(items.size()))) {
      return denied(where + problem->field + " " + number_text(problem->value) +
                    ", legal: " + problem->legal);
    }
  }
  return {};
}

void MissionExecutor::load(std::vector<MissionItem> items) {
  items_ = std::move(items);
  jumps_.assign(items_.size(), 0);
  current_ = 0;
  resume();
}

Answer MissionExecutor::set_current(int index) {
  if (index < 0 || index >= size()) {
    return denied("mission item " + std::to_string(index) + ", legal: 0 to " +
                  std::to_string(size() - 1));
  }
  current_ = index;
  std::fill(jumps_.begin(), jumps_.end(), 0);
  resume();
  return {};
}

void MissionExecutor::resume() {
  is_new_ = true;
  held_since_ = {-1};
}

MissionOrder MissionExecutor::step(SimTime now, bool has_arrived, MissionReport& report) {
  // Jumps that lead to one another end after each item was passed once.
  for (int passed = 0; current_ < size() && passed <= size(); ++passed) {
    const MissionItem& item = items_[static_cast<std::size_t>(current_)];
    if (is_navigation(item.command)) {
      const bool was_new = is_new_;
      if (was_new || is_held(item, now, has_arrived)) {
        MissionOrder order = order_of(item);
        order.is_new = was_new;
        is_new_ = false;
        return order;
      }
      report.reached = current_;
      go_to_next();
      continue;
    }
    if (pass(item, now, report) == Passing::kWaiting) {
      MissionOrder order;
      order.kind = MissionOrder::Kind::kStay;
      order.is_new = std::exchange(is_new_, false);
      return order;
    }
  }
  MissionOrder order;
  order.kind = current_ < size() ? MissionOrder::Kind::kStay : MissionOrder::Kind::kFinished;
  order.is_new = std::exchange(is_new_, false);
  return order;
}

MissionOrder MissionExecutor::order_of(const MissionItem& item) {
  MissionOrder order;
  order.p_m = item.p_world_m;
  using Kind = MissionOrder::Kind;
  order.kind = item.has_place ? Kind::kGoTo : Kind::kStay;
  switch (item.command) {
    case command::kTakeOff:
      order.kind = Kind::kTakeOff;
      break;
    case command::kLand:
      order.kind = Kind::kLand;
      if (!item.has_place) order.p_m.setConstant(std::nan(""));
      break;
    case command::kReturn:
      order.kind = Kind::kReturn;
      break;
    case command::kLoiterTurns:
      order.kind = Kind::kCircle;
      order.radius_m = or_zero(item.params[2]);
      order.turns = item.params[0];
      break;
    default:
      break;
  }
  return order;
}

/// Whether a navigation item still lasts.
bool MissionExecutor::is_held(const MissionItem& item, SimTime now, bool has_arrived) {
  if (!has_arrived) return true;
  if (held_since_.ns < 0) held_since_ = now;
  if (item.command == command::kLoiterForever) return true;
  const bool holds = item.command == command::kWaypoint || item.command == command::kLoiterTime ||
                     item.command == command::kSplineWaypoint;
  return holds && (now - held_since_).seconds() < or_zero(item.params[0]);
}

MissionExecutor::Passing MissionExecutor::pass(const MissionItem& item, SimTime now,
                                               MissionReport& report) {
  switch (item.command) {
    case command::kJump:
      jump(item);
      return Passing::kDone;
    case command::kDelay:
    case command::kConditionDelay:
      if (held_since_.ns < 0) held_since_ = now;
      if ((now - held_since_).seconds() < item.params[0]) return Passing::kWaiting;
      break;
    case command::kChangeSpeed:
      report.speed_m_s = item.params[1];
      break;
    case command::kConditionYaw:
      report.sets_yaw = true;
      report.is_yaw_relative = item.params[3] == 1.0;
      // Clockwise from north; a relative angle has its direction in param3.
      report.yaw = report.is_yaw_relative
                       ? -deg_to_rad(item.params[0]) * (item.params[2] < 0.0 ? -1.0 : 1.0)
                       : 0.5 * kPi - deg_to_rad(item.params[0]);
      break;
    case command::kRegionOfInterest:
      report.looks_at = item.has_place;
      report.look_at_m = item.p_world_m;
      break;
    case command::kSetHome:
      report.sets_home = true;
      break;
    case command::kEnableFence:
      report.fence = item.params[0] != 0.0 ? 1 : 0;
      break;
    default:
      break;
  }
  go_to_next();
  return Passing::kDone;
}

void MissionExecutor::jump(const MissionItem& item) {
  int& taken = jumps_[static_cast<std::size_t>(current_)];
  const double repetitions = item.params[1];
  if (repetitions >= 0.0 && taken >= repetitions) {
    taken = 0;  // an outer jump may come back to it
    go_to_next();
    return;
  }
  ++taken;
  current_ = static_cast<int>(item.params[0]);
  resume();
}

void MissionExecutor::go_to_next() {
  ++current_;
  resume();
}

}  // namespace trident::bridges
