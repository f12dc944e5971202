// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/sensor_telemetry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kGravity_m_s2 = 9.80665;
constexpr double kFloor_hz = 5.0;   // of AP_InertialSensor's vibration floor
constexpr double kSmooth_hz = 2.0;  // of its squares
/// HIGHRES_IMU.fields_updated: acceleration and rates of all axes.
constexpr std::uint16_t kAllOfInertia = 0x3F;

std::int16_t thousandths(double value) { return to_whole<std::int16_t>(1e3 * value); }

Message highres_imu(const TelemetrySource& source, const ImuReading& imu) {
  // Like an accelerometer's, whose downward axis reads -g at rest.
  const Eigen::Vector3f f = swap_body(imu.f_body_m_s2).cast<float>();
  const Eigen::Vector3f w = swap_body(imu.w_body_rad_s).cast<float>();
  mavlink_highres_imu_t payload{};
  payload.time_usec = static_cast<std::uint64_t>(imu.stamp.ns / 1000);
  payload.xacc = f.x();
  payload.yacc = f.y();
  payload.zacc = f.z();
  payload.xgyro = w.x();
  payload.ygyro = w.y();
  payload.zgyro = w.z();
  payload.fields_updated = kAllOfInertia;
  return pack(payload, source.self);
}

Message scaled_imu2(const TelemetrySource& source, const ImuReading& imu) {
  const Eigen::Vector3d f = swap_body(imu.f_body_m_s2) / kGravity_m_s2;
  const Eigen::Vector3d w = swap_body(imu.w_body_rad_s);
  mavlink_scaled_imu2_t payload{};
  payload.time_boot_ms = static_cast<std::uint32_t>(imu.stamp.ns / 1'000'000);
  payload.xacc = thousandths(f.x());
  payload.yacc = thousandths(f.y());
  payload.zacc = thousandths(f.z());
  payload.xgyro = thousandths(w.x());
  payload.ygyro = thousandths(w.y());
  payload.zgyro = thousandths(w.z());
  return pack(payload, source.self);
}

Message vibration(const TelemetrySource& source) {
  const Eigen::Vector3f level = source.readings.vibration_m_s2.cast<float>();
  mavlink_vibration_t payload{};
  payload.time_usec = source.boot_us();
  payload.vibration_x = level.x();
  payload.vibration_y = level.y();
  payload.vibration_z = level.z();
  return pack(payload, source.self);
}

Message wind_cov(const TelemetrySource& source, const Eigen::Vector3d& wind_world_m_s) {
  const Eigen::Vector3f wind = swap_world(wind_world_m_s).cast<float>();
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  mavlink_wind_cov_t payload{};
  payload.time_usec = source.boot_us();
  payload.wind_x = wind.x();
  payload.wind_y = wind.y();
  payload.wind_z = wind.z();
  payload.var_horiz = payload.var_vert = payload.horiz_accuracy = payload.vert_accuracy = unknown;
  payload.wind_alt = static_cast<float>(source.geo.to_geo(source.state.p_world_m).altitude_m);
  return pack(payload, source.self);
}

/// By how much of the difference to a new value a first-order filter moves in a step.
double filter_share(double cutoff_hz, double step_s) {
  return -std::expm1(-2.0 * kPi * cutoff_hz * step_s);
}

}  // namespace

void VibrationMeter::add(const ImuReading& reading) {
  if (!last_ || reading.stamp <= *last_) {
    floor_m_s2_ = reading.f_body_m_s2;
  } else {
    const double step_s = (reading.stamp - *last_).seconds();
    floor_m_s2_ += filter_share(kFloor_hz, step_s) * (reading.f_body_m_s2 - floor_m_s2_);
    const Eigen::Vector3d above = reading.f_body_m_s2 - floor_m_s2_;
    square_ += filter_share(kSmooth_hz, step_s) * (above.cwiseAbs2() - square_);
    level_m_s2_ = square_.cwiseSqrt();
  }
  last_ = reading.stamp;
}

std::optional<Message> sensor_message(std::uint32_t id, const TelemetrySource& source) {
  const auto& imu = source.readings.imu;
  const auto& wind = source.readings.wind_world_m_s;
  if (id == MAVLINK_MSG_ID_HIGHRES_IMU && imu) return highres_imu(source, *imu);
  if (id == MAVLINK_MSG_ID_SCALED_IMU2 && imu) return scaled_imu2(source, *imu);
  if (id == MAVLINK_MSG_ID_VIBRATION && imu) return vibration(source);
  if (id == MAVLINK_MSG_ID_WIND_COV && wind) return wind_cov(source, *wind);
  return std::nullopt;
}

}  // namespace trident::bridges::mavlink
