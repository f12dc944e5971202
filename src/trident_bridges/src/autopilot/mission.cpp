// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/mission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/is_one_of.h"
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
constexpr std::uint16_t kInFlight[] = {command::kLoiterTurns, command::kTakeOff, command::kLand};
constexpr std::uint16_t kHolding[] = {command::kWaypoint, command::kLoiterTime,
                                      command::kSplineWaypoint};

// MAV_CMD_DO_SET_RELAY to _DO_REPEAT_SERVO without kSetServo; _DO_CONTROL_VIDEO, _DO_DIGICAM_* to
// _DO_SET_CAM_TRIGG_DIST, _DO_SET_CAM_TRIGG_INTERVAL; _SET_CAMERA_*; _DO_GIMBAL_MANAGER_*;
// _IMAGE_*_CAPTURE, _VIDEO_*_CAPTURE.
constexpr std::uint16_t kForPayload[] = {181, 182, 184, 200,  202,  203,  204,  205,  206, 214,
                                         530, 531, 532, 1000, 1001, 2000, 2001, 2500, 2501};

/// A field that is not legal: its name, the value and the range.
struct Problem {
  std::string field;
  double value;
  std::string legal;
};

std::optional<Problem> at_least(const std::string& field, double value, double least) {
  if (value >= least && std::isfinite(value)) return std::nullopt;
  return Problem{field, value, number_text(least) + " or more"};
}

/// The least value that a parameter of a command may have.
struct ParamMinimum {
  std::uint16_t command;
  std::size_t index;
  double min;
};

constexpr ParamMinimum kParamMinima[] = {
    {command::kJump, 1, -1.0},          {command::kChangeSpeed, 1, 0.01},
    {command::kLoiterTurns, 0, 0.0},    {command::kLoiterTime, 0, 0.0},
    {command::kDelay, 0, 0.0},          {command::kConditionDelay, 0, 0.0},
    {command::kConditionYaw, 0, -360.0}};

std::optional<Problem> minimum_problem(const MissionItem& item) {
  const bool keeps_speed = item.command == command::kChangeSpeed && item.params[1] == -1.0;
  if (keeps_speed) return std::nullopt;
  const auto* const found =
      std::find_if(std::begin(kParamMinima), std::end(kParamMinima),
                   [&](const ParamMinimum& row) { return row.command == item.command; });
  if (found == std::end(kParamMinima)) return std::nullopt;
  const std::string field = "param" + std::to_string(found->index + 1);
  return at_least(field, item.params[found->index], found->min);
}

bool is_index(double value, int count) {
  return value >= 0 && value < count && value == std::floor(value);
}

std::optional<Problem> field_problem(const MissionItem& item, int count) {
  const auto& p = item.params;
  if (item.has_place && !item.p_world_m.allFinite()) {
    return Problem{"place", item.p_world_m.sum(), "finite numbers"};
  }
  if (item.command == command::kJump && !is_index(p[0], count)) {
    return Problem{"param1", p[0], "an index from 0 to " + std::to_string(count - 1)};
  }
  return minimum_problem(item);
}

bool is_known(std::uint16_t item) { return is_navigation(item) || is_one_of(item, kInPassing); }

/// Whether vehicles of that class carry the command out; some are for those that fly.
bool suits(VehicleClass vehicle, std::uint16_t item) {
  return vehicle == VehicleClass::kMultirotor || !is_one_of(item, kInFlight);
}

/// Clockwise from north; a relative angle has its direction in param3.
double yaw_of(const MissionItem& item) {
  const auto& p = item.params;
  const bool is_relative = p[3] == 1.0;
  return is_relative ? -deg_to_rad(p[0]) * (p[2] < 0.0 ? -1.0 : 1.0) : 0.5 * kPi - deg_to_rad(p[0]);
}

/// What a command that is done in passing reports.
void note_in_passing(const MissionItem& item, MissionReport& report) {
  const auto& p = item.params;
  switch (item.command) {
    case command::kChangeSpeed:
      report.speed_m_s = p[1];
      break;
    case command::kConditionYaw:
      report.sets_yaw = true;
      report.is_yaw_relative = p[3] == 1.0;
      report.yaw = yaw_of(item);
      break;
    case command::kRegionOfInterest:
      report.looks_at = item.has_place;
      report.look_at_m = item.p_world_m;
      break;
    case command::kSetHome:
      report.sets_home = true;
      break;
    case command::kEnableFence:
      report.fence = static_cast<int>(p[0] != 0.0);
      break;
    default:
      break;
  }
}

MissionOrder order_to(MissionOrder::Kind kind) {
  MissionOrder order;
  order.kind = kind;
  return order;
}

double or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

}  // namespace

bool is_navigation(std::uint16_t item) { return is_one_of(item, kNavigation); }

bool is_for_payload(std::uint16_t item) { return is_one_of(item, kForPayload); }

Answer check_mission(const std::vector<MissionItem>& items, VehicleClass vehicle) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string where = "mission item " + std::to_string(i) + ": ";
    const std::uint16_t number = items[i].command;
    if (is_for_payload(number)) continue;
    if (!is_known(number)) {
      return {Result::kUnsupported, where + "command " + std::to_string(number) + " is not known"};
    }
    if (!suits(vehicle, number)) {
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

/// The order as it is given, new if it is given for the first time.
MissionOrder MissionExecutor::give(MissionOrder order) {
  order.is_new = std::exchange(is_new_, false);
  return order;
}

/// What the current item still asks for; nothing: it was left for the next.
std::optional<MissionOrder> MissionExecutor::order_of_current(SimTime now, bool has_arrived,
                                                              MissionReport& report) {
  const MissionItem& item = items_[static_cast<std::size_t>(current_)];
  if (!is_navigation(item.command)) {
    if (pass(item, now, report) == Passing::kDone) return std::nullopt;
    return order_to(MissionOrder::Kind::kStay);
  }
  if (is_new_ || is_held(item, now, has_arrived)) return order_of(item);
  report.reached = current_;
  go_to_next();
  return std::nullopt;
}

MissionOrder MissionExecutor::step(SimTime now, bool has_arrived, MissionReport& report) {
  // Jumps that lead to one another end after each item was passed once.
  for (int passed = 0; current_ < size() && passed <= size(); ++passed) {
    if (auto order = order_of_current(now, has_arrived, report)) return give(*std::move(order));
  }
  using Kind = MissionOrder::Kind;
  return give(order_to(current_ < size() ? Kind::kStay : Kind::kFinished));
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

/// Whether the current item, held from the first such question on, is to be held on.
bool MissionExecutor::has_to_wait(double duration_s, SimTime now) {
  if (held_since_.ns < 0) held_since_ = now;
  return (now - held_since_).seconds() < duration_s;
}

/// Whether a navigation item still lasts.
bool MissionExecutor::is_held(const MissionItem& item, SimTime now, bool has_arrived) {
  if (!has_arrived || item.command == command::kLoiterForever) return true;
  return is_one_of(item.command, kHolding) && has_to_wait(or_zero(item.params[0]), now);
}

MissionExecutor::Passing MissionExecutor::pass(const MissionItem& item, SimTime now,
                                               MissionReport& report) {
  if (item.command == command::kJump) {
    jump(item);
    return Passing::kDone;
  }
  const bool is_delay = item.command == command::kDelay || item.command == command::kConditionDelay;
  if (is_delay && has_to_wait(item.params[0], now)) return Passing::kWaiting;
  note_in_passing(item, report);
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
