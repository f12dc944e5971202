// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <sensor_msgs/BatteryState.h>

#include <limits>

#include "conversions/conversions.h"
#include "trident_sim/samples/battery_sample.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {

/// The message has a current that is negative while the battery gives it (REP of BatteryState).
void convert(const BatterySample& sample, sensor_msgs::BatteryState& message) {
  using sensor_msgs::BatteryState;
  message.header.stamp = to_ros(sample.stamp);
  message.voltage = static_cast<float>(sample.voltage_v);
  message.current = static_cast<float>(-sample.current_a);
  message.charge = static_cast<float>(sample.charge_ah);
  message.capacity = message.design_capacity = static_cast<float>(sample.capacity_ah);
  message.percentage = static_cast<float>(sample.charge_share);
  message.power_supply_status = BatteryState::POWER_SUPPLY_STATUS_DISCHARGING;
  message.power_supply_health = sample.charge_share > 0.0 ? BatteryState::POWER_SUPPLY_HEALTH_GOOD
                                                          : BatteryState::POWER_SUPPLY_HEALTH_DEAD;
  message.power_supply_technology = BatteryState::POWER_SUPPLY_TECHNOLOGY_LIPO;
  message.present = 1;
  message.cell_voltage = sample.cell_voltages;
}

namespace {

const OutputTopicRegistrar<BatterySample, sensor_msgs::BatteryState> kBatteryTopic;

}  // namespace
}  // namespace trident::sim
