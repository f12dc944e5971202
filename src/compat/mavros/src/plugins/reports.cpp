// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/ESCInfo.h>
#include <mavros_msgs/ESCStatus.h>
#include <mavros_msgs/LogData.h>
#include <mavros_msgs/LogEntry.h>
#include <mavros_msgs/LogRequestData.h>
#include <mavros_msgs/LogRequestEnd.h>
#include <mavros_msgs/LogRequestList.h>
#include <mavros_msgs/OpticalFlowRad.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/Temperature.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <limits>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/optical_flow.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using mavros_msgs::OpticalFlowRad;

/// ESC_INFO and ESC_STATUS come for four motors at a time; topics have all of them.
class EscStatus : public Plugin {
 public:
  explicit EscStatus(Hub& hub) : vehicle_(hub.vehicle) {
    info_topic_ = hub.ros.advertise<mavros_msgs::ESCInfo>("esc_info");
    status_topic_ = hub.ros.advertise<mavros_msgs::ESCStatus>("esc_status");
    on<mavlink_esc_info_t>(vehicle_, [this](const auto& p) { on_info(p); });
    on<mavlink_esc_status_t>(vehicle_, [this](const auto& p) { on_status(p); });
  }

 private:
  static constexpr std::size_t kAtOnce = 4;

  void on_info(const mavlink_esc_info_t& p) {
    constexpr int kCentiDegrees = 100;
    info_.header.stamp = vehicle_.stamp_us(p.time_usec);
    info_.counter = p.counter;
    info_.count = p.count;
    info_.connection_type = p.connection_type;
    info_.info = p.info;
    info_.esc_info.resize(p.count);
    for (std::size_t i = 0; i < kAtOnce && p.index + i < p.count; ++i) {
      auto& one = info_.esc_info[p.index + i];
      one.header = info_.header;
      one.failure_flags = p.failure_flags[i];
      one.error_count = p.error_count[i];
      one.temperature = p.temperature[i] == INT16_MAX ? 0 : p.temperature[i] / kCentiDegrees;
    }
    if (p.index + kAtOnce >= p.count) info_topic_->publish(info_);
  }
  void on_status(const mavlink_esc_status_t& p) {
    // ESC_INFO says how many there are; until it has come all four of each message count.
    const std::size_t count = info_.count > 0 ? info_.count : p.index + kAtOnce;
    status_.header.stamp = vehicle_.stamp_us(p.time_usec);
    status_.esc_status.resize(std::max(count, status_.esc_status.size()));
    if (info_.count > 0) status_.esc_status.resize(count);
    for (std::size_t i = 0; i < kAtOnce && p.index + i < count; ++i) {
      auto& one = status_.esc_status[p.index + i];
      one.header = status_.header;
      one.rpm = p.rpm[i];
      one.voltage = p.voltage[i];
      one.current = p.current[i];
    }
    if (p.index + kAtOnce >= count) status_topic_->publish(status_);
  }

  VehicleSide& vehicle_;
  mavros_msgs::ESCInfo info_;
  mavros_msgs::ESCStatus status_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::ESCInfo>> info_topic_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::ESCStatus>> status_topic_;
};

/// Logs of the vehicle, as it sends them: log_transfer/raw/...
class LogTransfer : public Plugin {
 public:
  explicit LogTransfer(Hub& hub) : vehicle_(hub.vehicle) {
    entries_ = hub.ros.advertise<mavros_msgs::LogEntry>("log_transfer/raw/log_entry");
    data_ = hub.ros.advertise<mavros_msgs::LogData>("log_transfer/raw/log_data");
    on<mavlink_log_entry_t>(vehicle_, [this](const auto& p) {
      mavros_msgs::LogEntry message;
      message.header.stamp = ros::Time::now();
      message.id = p.id;
      message.num_logs = p.num_logs;
      message.last_log_num = p.last_log_num;
      message.time_utc = ros::Time(p.time_utc, 0);
      message.size = p.size;
      entries_->publish(message);
    });
    on<mavlink_log_data_t>(vehicle_, [this](const auto& p) {
      mavros_msgs::LogData message;
      message.header.stamp = ros::Time::now();
      message.id = p.id;
      message.offset = p.ofs;
      const std::size_t count = std::min<std::size_t>(p.count, std::size(p.data));
      message.data.assign(std::begin(p.data), std::begin(p.data) + count);
      data_->publish(message);
    });
    serve(hub.ros);
  }

 private:
  void serve(RosSide& ros) {
    ros.serve<mavros_msgs::LogRequestList>("log_transfer/raw/log_request_list",
                                           [this](const auto& q) {
                                             mavlink_log_request_list_t payload{};
                                             payload.start = q.start;
                                             payload.end = q.end;
                                             return sent<mavros_msgs::LogRequestList>(payload);
                                           });
    ros.serve<mavros_msgs::LogRequestData>("log_transfer/raw/log_request_data",
                                           [this](const auto& q) {
                                             mavlink_log_request_data_t payload{};
                                             payload.id = q.id;
                                             payload.ofs = q.offset;
                                             payload.count = q.count;
                                             return sent<mavros_msgs::LogRequestData>(payload);
                                           });
    ros.serve<mavros_msgs::LogRequestEnd>("log_transfer/raw/log_request_end", [this](const auto&) {
      return sent<mavros_msgs::LogRequestEnd>(mavlink_log_request_end_t{});
    });
    ros.serve<std_srvs::Trigger>("log_transfer/raw/log_request_erase", [this](const auto&) {
      return sent<std_srvs::Trigger>(mavlink_log_erase_t{});
    });
  }
  /// Sends a request; without a vehicle it fails.
  template <class Service, class Payload>
  typename Service::Response sent(const Payload& payload) {
    typename Service::Response response;
    response.success = static_cast<std::uint8_t>(vehicle_.is_connected());
    if (vehicle_.is_connected()) send_to_target(vehicle_, payload);
    return response;
  }

  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::LogEntry>> entries_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::LogData>> data_;
};

/// OPTICAL_FLOW_RAD from the vehicle, and px4flow/raw/send to it. Axes are those of the body.
class Px4Flow : public Plugin {
 public:
  explicit Px4Flow(Hub& hub) : hub_(hub), frame_id_(hub.params.frame_prefix + "px4flow") {
    const auto& node = hub.ros.node();
    node.param("px4flow/frame_id", frame_id_, frame_id_);
    node.param("px4flow/ranger_fov", field_of_view_rad_, field_of_view_rad_);
    node.param("px4flow/ranger_min_range", least_m_, least_m_);
    node.param("px4flow/ranger_max_range", most_m_, most_m_);
    flow_ = hub.ros.advertise<OpticalFlowRad>("px4flow/raw/optical_flow_rad");
    distance_ = hub.ros.advertise<sensor_msgs::Range>("px4flow/ground_distance");
    temperature_ = hub.ros.advertise<sensor_msgs::Temperature>("px4flow/temperature");
    on<mavlink_optical_flow_rad_t>(hub.vehicle, [this](const auto& p) { publish(p); });
    hub.ros.subscribe<OpticalFlowRad>("px4flow/raw/send", [this](const auto& m) { send_flow(m); });
  }

 private:
  static constexpr double kCentiDegrees = 0.01;

  void publish(const mavlink_optical_flow_rad_t& p) {
    OpticalFlowRad m;
    m.header.stamp = hub_.vehicle.stamp_us(p.time_usec);
    m.header.frame_id = frame_id_;
    copy_flow(p, m);
    flow_->publish(m);
    sensor_msgs::Temperature temperature;
    temperature.header = m.header;
    temperature.temperature = kCentiDegrees * p.temperature;
    temperature_->publish(temperature);
    sensor_msgs::Range range;
    range.header = m.header;
    range.radiation_type = sensor_msgs::Range::ULTRASOUND;
    range.field_of_view = static_cast<float>(field_of_view_rad_);
    range.min_range = static_cast<float>(least_m_);
    range.max_range = static_cast<float>(most_m_);
    range.range = p.distance;
    distance_->publish(range);
  }

  void send_flow(const OpticalFlowRad& m) {
    mavlink_optical_flow_rad_t payload{};
    payload.time_usec = m.header.stamp.toNSec() / 1000;
    copy_flow(m, payload);
    send(hub_.vehicle, payload);
  }

  Hub& hub_;
  std::string frame_id_;
  double field_of_view_rad_ = 0.118682, least_m_ = 0.3, most_m_ = 5.0;
  std::unique_ptr<bridges::NodePublisher<OpticalFlowRad>> flow_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::Range>> distance_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::Temperature>> temperature_;
};

/// RANGEFINDER of ArduPilot, which says neither its limits nor its cone.
class Rangefinder : public Plugin {
 public:
  explicit Rangefinder(Hub& hub) {
    range_ = hub.ros.advertise<sensor_msgs::Range>("rangefinder/rangefinder");
    const std::string frame_id = hub.params.frame_prefix + "rangefinder";
    on<mavlink_rangefinder_t>(hub.vehicle, [this, frame_id](const auto& p) {
      sensor_msgs::Range range;
      range.header.stamp = ros::Time::now();
      range.header.frame_id = frame_id;
      range.radiation_type = sensor_msgs::Range::INFRARED;
      range.max_range = std::numeric_limits<float>::max();
      range.range = p.distance;
      range_->publish(range);
    });
  }

 private:
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::Range>> range_;
};

}  // namespace

std::unique_ptr<Plugin> make_esc_status(Hub& hub) { return std::make_unique<EscStatus>(hub); }
std::unique_ptr<Plugin> make_log_transfer(Hub& hub) { return std::make_unique<LogTransfer>(hub); }
std::unique_ptr<Plugin> make_px4flow(Hub& hub) { return std::make_unique<Px4Flow>(hub); }
std::unique_ptr<Plugin> make_rangefinder(Hub& hub) { return std::make_unique<Rangefinder>(hub); }

}  // namespace trident::mavros
