// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_sensor.h"

#include "sdf_params.h"
#include "sdf_values.h"
#include "trident_base/error.h"

namespace trident::sim {

SensorSpec convert_sensor(const sdf::Sensor& from, const std::string& link, const std::string& what,
                          const ConvertContext& context) {
  const sdf::ElementPtr element = from.Element();
  const std::string sensor_name = what + " sensor '" + from.Name() + "'";
  SensorSpec sensor;
  sensor.name = from.Name();
  // As in the file: libsdformat reads "ray" and "lidar" as one type.
  sensor.type = element->Get<std::string>("type");
  sensor.T_link_sensor = resolve(from.SemanticPose(), link, sensor_name);
  sensor.update_rate_hz = value_or(element, {"update_rate"}, 0.0);
  if (!(sensor.update_rate_hz >= 0.0) || !std::isfinite(sensor.update_rate_hz)) {
    throw Error(context.label + ": " + sensor_name + ": <update_rate> is " +
                std::to_string(sensor.update_rate_hz) + " Hz, must be >= 0 and finite");
  }
  sensor.always_on = value_or(element, {"always_on"}, false);
  sensor.visualize = value_or(element, {"visualize"}, false);
  sensor.params = to_param_node(element, "plugin");
  sensor.plugins = convert_plugins(element);
  return sensor;
}

}  // namespace trident::sim
