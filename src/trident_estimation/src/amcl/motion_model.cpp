// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/motion_model.h"

#include <algorithm>
#include <cmath>

#include "amcl/fast_math.h"
#include "trident_base/angle.h"

namespace trident::estimation {
namespace {

constexpr std::uint32_t kSteps = 1U << 11;  // of the table of quantiles
constexpr double kTail = 4.0;               // what the table ends at [standard deviations]
constexpr double kStill = 0.01;             // below it, the motion has no direction [m]

/// The x at which the standard normal's distribution reaches p, by bisection.
double normal_quantile(double p) {
  double low = -kTail, high = kTail;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// How far a turn is from straight ahead or straight back: reversing is no turn by 180 degrees.
double turn_for_noise(double turn) {
  return std::min(std::abs(wrap_to_pi(turn)), std::abs(wrap_to_pi(turn - kPi)));
}

}  // namespace

MotionModel::MotionModel(const MotionModelParams& params, std::uint64_t seed)
    : params_(params), random_(seed, "amcl/motion") {
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    quantiles_.push_back(static_cast<float>(normal_quantile(static_cast<double>(i) / kSteps)));
  }
}

/// Three normals from one block of random bits: 11 bits choose an interval between quantiles, 10
/// the place in it.
void MotionModel::draw(std::uint64_t step, std::size_t count) {
  for (auto* values : {&first_, &second_, &third_, &heading_, &sine_, &cosine_}) {
    values->resize(count);
  }
  const auto normal = [this](std::uint64_t bits) {
    const auto i = static_cast<std::size_t>((bits >> 10) & (kSteps - 1));
    const float part = (static_cast<float>(bits & 1023U) + 0.5F) * (1.0F / 1024.0F);
    return quantiles_[i] + part * (quantiles_[i + 1] - quantiles_[i]);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = random_.bits((step << 32) | i, 0);
    first_[i] = normal(bits);
    second_[i] = normal(bits >> 21);
    third_[i] = normal(bits >> 42);
  }
}

float MotionModel::deviation(double variance) const {
  const bool is_corrected = params_.odom_model_type == OdomModel::kDiffCorrected ||
                            params_.odom_model_type == OdomModel::kOmniCorrected;
  return static_cast<float>(is_corrected ? std::sqrt(variance) : variance);
}

void MotionModel::apply(const SE2& T_old_new, std::uint64_t step, ParticleSet& particles) {
  draw(step, particles.size());
  const bool is_diff = params_.odom_model_type == OdomModel::kDiff ||
                       params_.odom_model_type == OdomModel::kDiffCorrected;
  if (is_diff) {
    apply_diff(T_old_new, particles);
  } else {
    apply_omni(T_old_new, particles);
  }
}

/// "Probabilistic Robotics", table 5.6: turn, go, turn.
void MotionModel::apply_diff(const SE2& T_old_new, ParticleSet& particles) {
  const double distance = T_old_new.p.norm();
  const double turn1 = distance < kStill ? 0.0 : std::atan2(T_old_new.p.y(), T_old_new.p.x());
  const double turn2 = wrap_to_pi(T_old_new.angle - turn1);
  const double noise1 = std::pow(turn_for_noise(turn1), 2);
  const double noise2 = std::pow(turn_for_noise(turn2), 2);
  const double square = distance * distance;
  const float s1 = deviation(params_.odom_alpha1 * noise1 + params_.odom_alpha2 * square);
  const float s2 = deviation(params_.odom_alpha3 * square + params_.odom_alpha4 * noise1 +
                             params_.odom_alpha4 * noise2);
  const float s3 = deviation(params_.odom_alpha1 * noise2 + params_.odom_alpha2 * square);
  const auto mean1 = static_cast<float>(turn1), mean2 = static_cast<float>(distance),
             mean3 = static_cast<float>(turn2);
  const std::size_t count = particles.size();
  float *x = particles.x.data(), *y = particles.y.data(), *yaw = particles.yaw.data();
  for (std::size_t i = 0; i < count; ++i) heading_[i] = yaw[i] + (mean1 - s1 * first_[i]);
  fast::sines_cosines(heading_.data(), count, sine_.data(), cosine_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const float gone = mean2 - s2 * second_[i];
    x[i] += gone * cosine_[i];
    y[i] += gone * sine_[i];
    yaw[i] = fast::wrapped(heading_[i] + (mean3 - s3 * third_[i]));
  }
}

void MotionModel::apply_omni(const SE2& T_old_new, ParticleSet& particles) {
  const double distance = T_old_new.p.norm(), square = distance * distance;
  const double turn_square = T_old_new.angle * T_old_new.angle;
  const auto bearing = static_cast<float>(std::atan2(T_old_new.p.y(), T_old_new.p.x()));
  const auto mean_distance = static_cast<float>(distance),
             mean_turn = static_cast<float>(T_old_new.angle);
  const float s_distance =
      deviation(params_.odom_alpha3 * square + params_.odom_alpha1 * turn_square);
  const float s_turn = deviation(params_.odom_alpha4 * turn_square + params_.odom_alpha2 * square);
  const float s_strafe =
      deviation(params_.odom_alpha1 * turn_square + params_.odom_alpha5 * square);
  const std::size_t count = particles.size();
  float *x = particles.x.data(), *y = particles.y.data(), *yaw = particles.yaw.data();
  for (std::size_t i = 0; i < count; ++i) heading_[i] = yaw[i] + bearing;
  fast::sines_cosines(heading_.data(), count, sine_.data(), cosine_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const float gone = mean_distance + s_distance * first_[i], strafed = s_strafe * second_[i];
    x[i] += gone * cosine_[i] + strafed * sine_[i];
    y[i] += gone * sine_[i] - strafed * cosine_[i];
    yaw[i] = fast::wrapped(yaw[i] + mean_turn + s_turn * third_[i]);
  }
}

}  // namespace trident::estimation
