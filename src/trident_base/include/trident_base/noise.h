// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident {

// Every sample is addressed by (index, channel) of the sensor's RandomStream. A vector sample uses
// the channels [channel, channel + 3); give each quantity of a sensor its own channels.

/// Discrete Gaussian noise, in the unit of the measurement (SDF's <noise type="gaussian">).
struct GaussianNoise {
  double mean = 0.0;    ///< a constant bias
  double stddev = 0.0;  ///< >= 0; 0: no noise, the mean alone

  /// mean + stddev n, with n the stream's standard normal at (index, channel).
  double sample(const RandomStream& stream, std::uint64_t index, std::uint32_t channel) const;
};

/// Standard normals of one sample whose channels 0, 1, 2, ... are asked for about in order, as
/// those of the beams of a scan are. A number is a function of sample and channel alone.
class NormalRow {
 public:
  /// Keeps a copy of `stream`; `index` is that of the sample, of the scan for one.
  NormalRow(const RandomStream& stream, std::uint64_t index) : stream_(stream), index_(index) {}

  /// The standard normal of a channel. Four successive channels cost one evaluation.
  float at(std::uint32_t channel) {
    if (channel / 4 != block_) {
      block_ = channel / 4;
      values_ = stream_.normals4(index_, block_);
    }
    return values_[channel % 4];
  }

 private:
  const RandomStream& stream_;
  std::uint64_t index_;
  std::uint32_t block_ = std::numeric_limits<std::uint32_t>::max();
  std::array<float, 4> values_{};
};

/// Continuous white noise: `density` [unit/sqrt(Hz)], sampled with period dt [s] it has the
/// standard deviation density / sqrt(dt).
struct WhiteNoise {
  double density = 0.0;  ///< >= 0

  /// density / sqrt(dt) times a standard normal; `dt` > 0 [s] is not checked.
  double sample(const RandomStream& stream, std::uint64_t index, std::uint32_t channel,
                double dt) const;
};

/// Uniform noise in [lower, upper), in the unit of the measurement.
struct UniformNoise {
  double lower = 0.0;  ///< included
  double upper = 0.0;  ///< excluded; equal to `lower`: a constant

  /// The stream's uniform number at (index, channel), scaled.
  double sample(const RandomStream& stream, std::uint64_t index, std::uint32_t channel) const;
};

/// `GaussianNoise` per axis.
struct GaussianNoise3 {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();    ///< per axis
  Eigen::Vector3d stddev = Eigen::Vector3d::Zero();  ///< per axis, >= 0

  /// Independent axes, of the channels `channel` to `channel` + 2.
  Eigen::Vector3d sample(const RandomStream& stream, std::uint64_t index,
                         std::uint32_t channel) const;
};

/// `UniformNoise` per axis.
struct UniformNoise3 {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  ///< per axis, included
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();  ///< per axis, excluded

  /// Independent axes, of the channels `channel` to `channel` + 2.
  Eigen::Vector3d sample(const RandomStream& stream, std::uint64_t index,
                         std::uint32_t channel) const;
};

/// A slowly varying bias: db/dt = -b / tau + random_walk * n(t), plus a constant turn-on bias.
struct GaussMarkovParams {
  double random_walk = 0.0;  ///< Driving noise density [unit*sqrt(Hz)], >= 0.
  double correlation_time =
      std::numeric_limits<double>::infinity();  ///< tau [s], > 0; infinite: a pure random walk.
  double turn_on_stddev = 0.0;  ///< Spread of the bias that is drawn once per run [unit], >= 0.
};

/// First-order Gauss-Markov bias, discretised exactly for sample period dt:
///   b[k] = exp(-dt/tau) b[k-1] + sqrt(-random_walk^2 * tau/2 * (exp(-2 dt/tau) - 1)) n[k],
///   b[-1] = 0. The stationary variance is random_walk^2 * tau / 2.
/// (Maybeck, Stochastic Models, Estimation, and Control, vol. 1, sec. 4.11; RotorS' IMU uses the
/// same.) Uses two channels: `channel` for the driving noise, `channel + kTurnOnChannelOffset` for
/// turn-on.
class GaussMarkov {
 public:
  /// Above any channel that a sensor numbers itself.
  static constexpr std::uint32_t kTurnOnChannelOffset = 0x10000;

  /// Throws Error when a parameter or dt [s] is outside its legal range.
  GaussMarkov(const GaussMarkovParams& params, double dt, std::uint32_t channel);

  /// The bias of sample `index` [unit]. Samples that were skipped (nobody listened) are caught up
  /// with, so the value depends on the index alone; an index before the last one replays from the
  /// start. Pass the same stream each time.
  double sample(const RandomStream& stream, std::uint64_t index);

  /// Forgets the state: the next sample starts again from b[-1] = 0 (reset_simulation).
  void reset();

 private:
  double decay_;
  double step_stddev_;
  double turn_on_stddev_;
  std::uint32_t channel_;
  std::uint64_t next_index_ = 0;
  double bias_ = 0.0;
  double turn_on_ = 0.0;
};

/// Noise of one three-axis inertial sensor.
struct InertialNoiseParams {
  double noise_density = 0.0;  ///< White noise [unit/sqrt(Hz)].
  GaussMarkovParams bias;      ///< In the same unit.
};

/// Defaults: an ADIS16448 with doubled data-sheet densities, as RotorS ships it.
struct ImuNoiseParams {
  /// [rad/s/sqrt(Hz)], {[rad/s^2/sqrt(Hz)], [s], [rad/s]}
  InertialNoiseParams gyroscope{deg_to_rad(2.0 * 35.0 / 3600.0),
                                {deg_to_rad(2.0 * 4.0 / 3600.0), 1000.0, deg_to_rad(0.5)}};
  /// [m/s^2/sqrt(Hz)], {[m/s^3/sqrt(Hz)], [s], [m/s^2]}
  InertialNoiseParams accelerometer{2.0 * 2.0e-3, {2.0 * 3.0e-3, 300.0, 20.0e-3 * 9.8}};
};

/// Adds RotorS' IMU noise (gazebo_imu_plugin): measured = true + bias + turn-on bias + white noise,
/// with independent axes.
class ImuNoise {
 public:
  /// `dt` is the sample period [s]. Throws Error when a parameter is outside its legal range.
  ImuNoise(const ImuNoiseParams& params, double dt, const RandomStream& stream);

  /// Adds the noise of sample `index` to the angular velocity [rad/s] and the specific force
  /// [m/s^2], both in the sensor's frame.
  void add(std::uint64_t index, Eigen::Vector3d* w_sensor, Eigen::Vector3d* f_sensor);

  /// All biases start again; the next index is to be 0, else they are replayed up to it.
  void reset();

 private:
  struct Triad {
    WhiteNoise white;
    GaussMarkov bias[3];
    std::uint32_t channel;
  };
  static Triad make_triad(const InertialNoiseParams& params, double dt, std::uint32_t channel);
  void add(Triad* triad, std::uint64_t index, Eigen::Vector3d* value) const;

  RandomStream stream_;
  double dt_;
  Triad gyroscope_;
  Triad accelerometer_;
};

}  // namespace trident
