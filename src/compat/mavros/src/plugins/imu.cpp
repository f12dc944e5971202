// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/Temperature.h>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::swap_attitude;
using bridges::mavlink::swap_body;

constexpr double kStandardGravity_m_s2 = 9.80665;
constexpr double kMilliGauss_T = 1e-7, kGauss_T = 1e-4;
constexpr double kMilliG = 1e-3 * kStandardGravity_m_s2, kMilliRad = 1e-3;
constexpr double kHectopascal = 100.0, kCentiDegree = 0.01;
constexpr unsigned kHasAcceleration = 7, kHasGyro = 7U << 3, kHasMagnet = 7U << 6;
constexpr unsigned kHasPressure = 1U << 9, kHasDifference = 1U << 10, kHasTemperature = 1U << 12;

/// What inertial sensors, compass and barometer measure.
class ImuPlugin : public Plugin {
 public:
  explicit ImuPlugin(Hub& hub) : hub_(hub), vehicle_(hub.vehicle), params_(hub.params.imu) {
    RosSide& ros = hub.ros;
    data_ = ros.advertise<sensor_msgs::Imu>("imu/data");
    raw_ = ros.advertise<sensor_msgs::Imu>("imu/data_raw");
    magnet_ = ros.advertise<sensor_msgs::MagneticField>("imu/mag");
    temperature_ = ros.advertise<sensor_msgs::Temperature>("imu/temperature_imu");
    air_temperature_ = ros.advertise<sensor_msgs::Temperature>("imu/temperature_baro");
    pressure_ = ros.advertise<sensor_msgs::FluidPressure>("imu/static_pressure");
    difference_ = ros.advertise<sensor_msgs::FluidPressure>("imu/diff_pressure");
    on<mavlink_attitude_t>(vehicle_, [this](const auto& p) {
      if (!hub_.known.has_quaternion) publish_data(vehicle_.stamp_ms(p.time_boot_ms));
    });
    on<mavlink_attitude_quaternion_t>(
        vehicle_, [this](const auto& p) { publish_data(vehicle_.stamp_ms(p.time_boot_ms)); });
    on<mavlink_highres_imu_t>(vehicle_, [this](const auto& p) { on_highres(p); });
    on<mavlink_raw_imu_t>(vehicle_, [this](const auto& p) { on_raw(p); });
    on<mavlink_scaled_imu_t>(vehicle_, [this](const auto& p) {
      if (has_highres_) return;
      has_scaled_ = true;
      publish_scaled(vehicle_.stamp_ms(p.time_boot_ms), p, kMilliG);
    });
    on<mavlink_scaled_pressure_t>(vehicle_, [this](const auto& p) { on_pressure(p); });
  }

 private:
  std_msgs::Header header(const ros::Time& stamp) const {
    std_msgs::Header result;
    result.stamp = stamp;
    result.frame_id = params_.frame_id;
    return result;
  }

  void publish_data(const ros::Time& stamp) {
    if (data_->subscribers() == 0) return;
    sensor_msgs::Imu imu;
    imu.header = header(stamp);
    assign_rotation(imu.orientation, hub_.known.R_world_body);
    assign(imu.angular_velocity, hub_.known.w_body_rad_s);
    assign(imu.linear_acceleration, a_body_m_s2_);
    fill_variances(imu);
    assign_diagonal(imu.orientation_covariance,
                    params_.orientation_stdev * params_.orientation_stdev);
    data_->publish(imu);
  }
  void fill_variances(sensor_msgs::Imu& imu) const {
    assign_diagonal(imu.angular_velocity_covariance,
                    params_.angular_velocity_stdev * params_.angular_velocity_stdev);
    assign_diagonal(imu.linear_acceleration_covariance,
                    params_.linear_acceleration_stdev * params_.linear_acceleration_stdev);
  }
  void publish_raw(const ros::Time& stamp, const Eigen::Vector3d& w, const Eigen::Vector3d& a) {
    a_body_m_s2_ = a;
    sensor_msgs::Imu imu;
    imu.header = header(stamp);
    imu.orientation_covariance[0] = -1.0;  // sensor_msgs/Imu: no orientation
    assign(imu.angular_velocity, w);
    assign(imu.linear_acceleration, a);
    fill_variances(imu);
    raw_->publish(imu);
  }
  void publish_magnet(const ros::Time& stamp, const Eigen::Vector3d& field_T) {
    sensor_msgs::MagneticField message;
    message.header = header(stamp);
    assign(message.magnetic_field, field_T);
    assign_diagonal(message.magnetic_field_covariance,
                    params_.magnetic_stdev * params_.magnetic_stdev);
    magnet_->publish(message);
  }
  void publish_pressure(bridges::NodePublisher<sensor_msgs::FluidPressure>& to,
                        const ros::Time& stamp, double pressure_Pa) const {
    sensor_msgs::FluidPressure message;
    message.header = header(stamp);
    message.fluid_pressure = pressure_Pa;
    to.publish(message);
  }
  void publish_temperature(bridges::NodePublisher<sensor_msgs::Temperature>& to,
                           const ros::Time& stamp, double degrees_C) const {
    sensor_msgs::Temperature message;
    message.header = header(stamp);
    message.temperature = degrees_C;
    to.publish(message);
  }

  void on_highres(const mavlink_highres_imu_t& p) {
    has_highres_ = true;
    const ros::Time stamp = vehicle_.stamp_us(p.time_usec);
    if ((p.fields_updated & (kHasAcceleration | kHasGyro)) != 0) {
      publish_raw(stamp, swap_body({p.xgyro, p.ygyro, p.zgyro}),
                  swap_body({p.xacc, p.yacc, p.zacc}));
    }
    if ((p.fields_updated & kHasMagnet) != 0) {
      publish_magnet(stamp, swap_body({p.xmag, p.ymag, p.zmag}) * kGauss_T);
    }
    if ((p.fields_updated & kHasPressure) != 0) {
      publish_pressure(*pressure_, stamp, p.abs_pressure * kHectopascal);
    }
    if ((p.fields_updated & kHasDifference) != 0) {
      publish_pressure(*difference_, stamp, p.diff_pressure * kHectopascal);
    }
    if ((p.fields_updated & kHasTemperature) != 0) {
      publish_temperature(*temperature_, stamp, p.temperature);
    }
  }
  /// RAW_IMU has units of the sensors; ArduPilot's are those of SCALED_IMU.
  void on_raw(const mavlink_raw_imu_t& p) {
    if (has_highres_ || has_scaled_) return;
    publish_scaled(vehicle_.stamp_us(p.time_usec), p, vehicle_.is_px4() ? 0.0 : kMilliG);
  }
  template <class Payload>
  void publish_scaled(const ros::Time& stamp, const Payload& p, double unit) {
    const Eigen::Vector3d w(p.xgyro, p.ygyro, p.zgyro), a(p.xacc, p.yacc, p.zacc);
    publish_raw(stamp, swap_body(w * kMilliRad), swap_body(a * unit));
    publish_magnet(stamp, swap_body(Eigen::Vector3d(p.xmag, p.ymag, p.zmag) * kMilliGauss_T));
  }
  void on_pressure(const mavlink_scaled_pressure_t& p) {
    const ros::Time stamp = vehicle_.stamp_ms(p.time_boot_ms);
    publish_temperature(*air_temperature_, stamp, p.temperature * kCentiDegree);
    publish_pressure(*pressure_, stamp, p.press_abs * kHectopascal);
    publish_pressure(*difference_, stamp, p.press_diff * kHectopascal);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  const ImuParams& params_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::Imu>> data_, raw_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::MagneticField>> magnet_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::Temperature>> temperature_, air_temperature_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::FluidPressure>> pressure_, difference_;
  Eigen::Vector3d a_body_m_s2_ = Eigen::Vector3d::Zero();
  bool has_highres_ = false, has_scaled_ = false;
};

}  // namespace

void follow_attitude(Hub& hub) {
  on<mavlink_attitude_t>(hub.vehicle, [&hub](const mavlink_attitude_t& p) {
    hub.known.has_attitude = true;
    if (hub.known.has_quaternion) return;
    hub.known.R_world_body = swap_attitude(from_euler(p.roll, p.pitch, p.yaw));
    hub.known.w_body_rad_s = swap_body({p.rollspeed, p.pitchspeed, p.yawspeed});
  });
  on<mavlink_attitude_quaternion_t>(hub.vehicle, [&hub](const mavlink_attitude_quaternion_t& p) {
    hub.known.has_attitude = hub.known.has_quaternion = true;
    hub.known.R_world_body = swap_attitude(Eigen::Quaterniond(p.q1, p.q2, p.q3, p.q4).normalized());
    hub.known.w_body_rad_s = swap_body({p.rollspeed, p.pitchspeed, p.yawspeed});
  });
}

std::unique_ptr<Plugin> make_imu(Hub& hub) { return std::make_unique<ImuPlugin>(hub); }

}  // namespace trident::mavros
