// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugins/vehicle_health.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <limits>

#include "core/typed_messages.h"
#include "trident_base/string_util.h"

namespace trident::mavros {
namespace {

constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();
constexpr double kPercent = 0.01, kMilli = 1e-3, kCenti = 1e-2;

}  // namespace

VehicleHealth::VehicleHealth(Hub& hub) : hub_(hub) {
  battery_ = hub.ros.advertise<sensor_msgs::BatteryState>("battery");
  status_ = hub.ros.advertise<mavros_msgs::SysStatus>("sys_status");
  diagnostics_ = ros::NodeHandle().advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 2);
  hub.vehicle.on(MAVLINK_MSG_ID_SYS_STATUS, [this](const Message& raw) { on_status(raw); });
  hub.vehicle.on(MAVLINK_MSG_ID_BATTERY_STATUS, [this](const Message& raw) { on_battery(raw); });
  hub.ros.every(1.0, [this] { publish_diagnostics(); });
}

void VehicleHealth::on_status(const Message& raw) {
  const auto status = bridges::mavlink::unpack<mavlink_sys_status_t>(raw);
  sensors_.are_known = true;
  sensors_.bad = status.onboard_control_sensors_enabled & ~status.onboard_control_sensors_health;
  mavros_msgs::SysStatus message;
  message.header.stamp = ros::Time::now();
  message.sensors_present = status.onboard_control_sensors_present;
  message.sensors_enabled = status.onboard_control_sensors_enabled;
  message.sensors_health = status.onboard_control_sensors_health;
  message.load = status.load;
  message.voltage_battery = status.voltage_battery;
  message.current_battery = status.current_battery;
  message.battery_remaining = status.battery_remaining;
  message.drop_rate_comm = status.drop_rate_comm;
  message.errors_comm = status.errors_comm;
  message.errors_count1 = status.errors_count1;
  message.errors_count2 = status.errors_count2;
  message.errors_count3 = status.errors_count3;
  message.errors_count4 = status.errors_count4;
  status_->publish(message);
  if (has_battery_status_) return;
  const double voltage_mV =
      status.voltage_battery == UINT16_MAX ? kNotKnown : status.voltage_battery;
  publish_battery(voltage_mV, status.current_battery, status.battery_remaining, {}, "id0");
}

void VehicleHealth::on_battery(const Message& raw) {
  const auto status = bridges::mavlink::unpack<mavlink_battery_status_t>(raw);
  has_battery_status_ = true;
  std::vector<float> cells;
  double voltage_mV = 0.0;
  constexpr std::uint16_t kNoCell = UINT16_MAX;
  for (const std::uint16_t cell : status.voltages) {
    if (cell == kNoCell) break;
    cells.push_back(static_cast<float>(cell * kMilli));
    voltage_mV += cell;
  }
  if (cells.empty()) voltage_mV = kNotKnown;
  publish_battery(voltage_mV, status.current_battery, status.battery_remaining, cells,
                  "id" + std::to_string(status.id));
}

void VehicleHealth::publish_battery(double voltage_mV, int current_cA, int percent,
                                    const std::vector<float>& cells, const std::string& location) {
  sensor_msgs::BatteryState battery;
  battery.header.stamp = ros::Time::now();
  battery.voltage = static_cast<float>(voltage_mV * kMilli);
  battery.current = current_cA < 0 ? kNotKnown : static_cast<float>(-current_cA * kCenti);
  battery.charge = battery.capacity = battery.design_capacity = kNotKnown;
  battery.percentage = percent < 0 ? kNotKnown : static_cast<float>(percent * kPercent);
  battery.power_supply_status = sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_DISCHARGING;
  battery.present = 1U;
  battery.cell_voltage = cells;
  battery.location = location;
  voltage_V_ = battery.voltage;
  battery_->publish(battery);
}

void VehicleHealth::publish_diagnostics() {
  using diagnostic_msgs::DiagnosticStatus;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  const auto add = [&](const std::string& name, bool is_good, const std::string& text) {
    DiagnosticStatus status;
    status.name = hub_.ros.node().getNamespace().substr(1) + ": " + name;
    status.level = is_good ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
    status.message = text;
    array.status.push_back(status);
  };
  add("Heartbeat", hub_.vehicle.is_connected(),
      hub_.vehicle.is_connected() ? "HEARTBEATs come" : "no HEARTBEAT comes");
  if (!hub_.params.sys.disable_diag && sensors_.are_known) {
    add("System", sensors_.bad == 0,
        sensors_.bad == 0 ? "all sensors are healthy"
                          : "sensors that are not healthy: " + std::to_string(sensors_.bad));
    const auto& limits = hub_.params.sys.min_voltage;
    const double limit_V = limits.empty() ? 0.0 : limits.front();
    add("Battery", !(voltage_V_ < limit_V),  // an unknown one is no reason to warn

        number_text(voltage_V_) + " V, limit " + number_text(limit_V) + " V");
  }
  diagnostics_.publish(array);
}

}  // namespace trident::mavros
