// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/DebugValue.h>
#include <mavros_msgs/GPSRAW.h>

#include <map>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "plugins/rtk_baseline.h"

namespace trident::mavros {
namespace {

using mavros_msgs::DebugValue;

/// GPS_RAW_INT, GPS2_RAW, GPS_RTK and GPS2_RTK as they come.
class GpsStatus : public Plugin {
 public:
  explicit GpsStatus(Hub& hub) : vehicle_(hub.vehicle) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string prefix = "gpsstatus/gps" + std::to_string(i + 1);
      raw_[i] = hub.ros.advertise<mavros_msgs::GPSRAW>(prefix + "/raw");
      rtk_[i] = hub.ros.advertise<mavros_msgs::RTKBaseline>(prefix + "/rtk");
    }
    on<mavlink_gps_raw_int_t>(vehicle_, [this](const auto& p) {
      auto message = to_raw(p);
      message.alt_ellipsoid = p.alt_ellipsoid;
      message.h_acc = p.h_acc;
      message.v_acc = p.v_acc;
      message.vel_acc = p.vel_acc;
      message.hdg_acc = static_cast<std::int32_t>(p.hdg_acc);
      message.dgps_numch = UINT8_MAX;  // GPS_RAW_INT does not have it
      message.dgps_age = UINT32_MAX;
      raw_[0]->publish(message);
    });
    on<mavlink_gps2_raw_t>(vehicle_, [this](const auto& p) {
      auto message = to_raw(p);
      message.dgps_numch = p.dgps_numch;
      message.dgps_age = p.dgps_age;
      raw_[1]->publish(message);
    });
    on<mavlink_gps_rtk_t>(vehicle_, [this](const auto& p) { rtk_[0]->publish(to_rtk(p)); });
    on<mavlink_gps2_rtk_t>(vehicle_, [this](const auto& p) { rtk_[1]->publish(to_rtk(p)); });
  }

 private:
  template <class Payload>
  mavros_msgs::GPSRAW to_raw(const Payload& p) const {
    mavros_msgs::GPSRAW message;
    message.header.stamp = vehicle_.stamp_us(p.time_usec);
    message.fix_type = p.fix_type;
    message.lat = p.lat;
    message.lon = p.lon;
    message.alt = p.alt;
    message.eph = p.eph;
    message.epv = p.epv;
    message.vel = p.vel;
    message.cog = p.cog;
    message.satellites_visible = p.satellites_visible;
    message.yaw = p.yaw;
    return message;
  }
  VehicleSide& vehicle_;
  std::array<std::unique_ptr<bridges::NodePublisher<mavros_msgs::GPSRAW>>, 2> raw_;
  std::array<std::unique_ptr<bridges::NodePublisher<mavros_msgs::RTKBaseline>>, 2> rtk_;
};

/// Values for debugging, from and to the vehicle.
class DebugValues : public Plugin {
 public:
  explicit DebugValues(Hub& hub) : vehicle_(hub.vehicle) {
    for (const char* name :
         {"debug", "debug_vector", "debug_float_array", "named_value_float", "named_value_int"}) {
      topics_[name] = hub.ros.advertise<DebugValue>(std::string("debug_value/") + name);
    }
    listen();
    hub.ros.subscribe<DebugValue>("debug_value/send", [this](const auto& m) { send_value(m); });
  }

 private:
  DebugValue value(std::uint8_t type, const ros::Time& stamp, const std::string& name) const {
    DebugValue result;
    result.header.stamp = stamp;
    result.index = result.array_id = -1;
    result.type = type;
    result.name = name;
    return result;
  }
  void listen() {
    on<mavlink_debug_t>(vehicle_, [this](const auto& p) {
      auto m = value(DebugValue::TYPE_DEBUG, vehicle_.stamp_ms(p.time_boot_ms), "");
      m.index = p.ind;
      m.value_float = p.value;
      topics_["debug"]->publish(m);
    });
    on<mavlink_debug_vect_t>(vehicle_, [this](const auto& p) {
      auto m = value(DebugValue::TYPE_DEBUG_VECT, vehicle_.stamp_us(p.time_usec), text_of(p.name));
      m.data = {p.x, p.y, p.z};
      topics_["debug_vector"]->publish(m);
    });
    on<mavlink_debug_float_array_t>(vehicle_, [this](const auto& p) {
      auto m = value(DebugValue::TYPE_DEBUG_FLOAT_ARRAY, vehicle_.stamp_us(p.time_usec),
                     text_of(p.name));
      m.array_id = p.array_id;
      m.data.assign(std::begin(p.data), std::end(p.data));
      topics_["debug_float_array"]->publish(m);
    });
    on<mavlink_named_value_float_t>(vehicle_, [this](const auto& p) {
      auto m = value(DebugValue::TYPE_NAMED_VALUE_FLOAT, vehicle_.stamp_ms(p.time_boot_ms),
                     text_of(p.name));
      m.value_float = p.value;
      topics_["named_value_float"]->publish(m);
    });
    on<mavlink_named_value_int_t>(vehicle_, [this](const auto& p) {
      auto m = value(DebugValue::TYPE_NAMED_VALUE_INT, vehicle_.stamp_ms(p.time_boot_ms),
                     text_of(p.name));
      m.value_int = p.value;
      topics_["named_value_int"]->publish(m);
    });
  }

  void send_value(const DebugValue& m) {
    const std::uint32_t boot_ms = vehicle_.boot_ms(m.header.stamp);
    if (m.type == DebugValue::TYPE_DEBUG) {
      mavlink_debug_t payload{};
      payload.time_boot_ms = boot_ms;
      payload.ind = static_cast<std::uint8_t>(m.index);
      payload.value = m.value_float;
      send(vehicle_, payload);
    } else if (m.type == DebugValue::TYPE_NAMED_VALUE_FLOAT) {
      mavlink_named_value_float_t payload{};
      payload.time_boot_ms = boot_ms;
      m.name.copy(payload.name, sizeof(payload.name));
      payload.value = m.value_float;
      send(vehicle_, payload);
    } else if (m.type == DebugValue::TYPE_NAMED_VALUE_INT) {
      mavlink_named_value_int_t payload{};
      payload.time_boot_ms = boot_ms;
      m.name.copy(payload.name, sizeof(payload.name));
      payload.value = m.value_int;
      send(vehicle_, payload);
    } else {
      send_array(m);
    }
  }
  void send_array(const DebugValue& m) {
    constexpr std::size_t kVector = 3;
    if (m.type == DebugValue::TYPE_DEBUG_VECT && m.data.size() == kVector) {
      mavlink_debug_vect_t payload{};
      m.name.copy(payload.name, sizeof(payload.name));
      payload.x = m.data[0];
      payload.y = m.data[1];
      payload.z = m.data[2];
      send(vehicle_, payload);
    } else if (m.type == DebugValue::TYPE_DEBUG_FLOAT_ARRAY) {
      mavlink_debug_float_array_t payload{};
      m.name.copy(payload.name, sizeof(payload.name));
      payload.array_id = static_cast<std::uint16_t>(m.array_id);
      const std::size_t count = std::min(m.data.size(), std::size(payload.data));
      std::copy_n(m.data.begin(), count, std::begin(payload.data));
      send(vehicle_, payload);
    }
  }

  VehicleSide& vehicle_;
  std::map<std::string, std::unique_ptr<bridges::NodePublisher<DebugValue>>> topics_;
};

}  // namespace

std::unique_ptr<Plugin> make_gps_status(Hub& hub) { return std::make_unique<GpsStatus>(hub); }
std::unique_ptr<Plugin> make_debug_value(Hub& hub) { return std::make_unique<DebugValues>(hub); }

}  // namespace trident::mavros
