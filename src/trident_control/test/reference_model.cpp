// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "reference_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trident::control::test {
namespace {

using Vec = std::array<double, 3>;
using Mat = std::array<Vec, 3>;
using Rows = std::vector<std::vector<double>>;

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec scaled(const Vec& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vec from(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Mat transposed_times(const Mat& a, const Mat& b) {
  Mat c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[k][i] * b[k][j];
    }
  }
  return c;
}

Mat product(const Mat& a, const Mat& b) {
  Mat c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Mat rotation_of(const Eigen::Quaterniond& q) {
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Vec column(const Mat& m, int j) { return {m[0][j], m[1][j], m[2][j]}; }

// Solves a x = b (square) by Gauss-Jordan with row pivoting.
std::vector<double> solve(Rows a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i; r < n; ++r) {
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    }
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == i) continue;
      const double factor = a[r][i] / a[i][i];
      for (std::size_t c = 0; c < n; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) b[i] /= a[i][i];
  return b;
}

Rows allocation_rows(const VehicleParams& vehicle) {
  Rows rows(4, std::vector<double>(vehicle.rotors.size()));
  for (std::size_t i = 0; i < vehicle.rotors.size(); ++i) {
    const RotorConfig& rotor = vehicle.rotors[i];
    const Vec arm = {rotor.arm_length * std::cos(rotor.angle),
                     rotor.arm_length * std::sin(rotor.angle), 0};
    const Vec force = scaled(from(rotor.thrust_axis_body), rotor.force_constant);
    const Vec lever = cross(arm, force);
    for (int k = 0; k < 3; ++k) {
      rows[k][i] = lever[k] - rotor.direction * rotor.moment_constant * force[k];
    }
    rows[3][i] = force[2];
  }
  return rows;
}

Vec inertia_times(const VehicleParams& vehicle, const Vec& v) {
  Vec out{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[i] += vehicle.inertia(i, j) * v[j];
  }
  return out;
}

Vec inertia_solve(const VehicleParams& vehicle, const Vec& v, bool transposed) {
  Rows a(3, std::vector<double>(3));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      a[i][j] = transposed ? vehicle.inertia(j, i) : vehicle.inertia(i, j);
  }
  const std::vector<double> x = solve(a, {v[0], v[1], v[2]});
  return {x[0], x[1], x[2]};
}

std::vector<double> speeds_for(const VehicleParams& vehicle, const AttitudeGains& gains,
                               const AttitudeQuirks& quirks, const Mat& R, const Mat& Rd,
                               const Vec& w, double yaw_rate, double thrust) {
  const Mat RdtR = transposed_times(Rd, R);
  const Mat RtRd = transposed_times(R, Rd);
  Mat skew{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) skew[i][j] = 0.5 * (RdtR[i][j] - RtRd[i][j]);
  }
  const Vec e_R = {skew[2][1], skew[0][2], skew[1][0]};
  const Mat& rate_rotation = quirks.rotate_yaw_rate_with_RdT_R ? RdtR : RtRd;
  const Vec k_R = inertia_solve(vehicle, from(gains.attitude), true);
  const Vec k_w = inertia_solve(vehicle, from(gains.angular_rate), true);
  Vec alpha{};
  for (int i = 0; i < 3; ++i) {
    alpha[i] = -k_R[i] * e_R[i] - k_w[i] * (w[i] - rate_rotation[i][2] * yaw_rate);
  }
  if (!quirks.omit_gyroscopic_term) {
    const Vec gyro = inertia_solve(vehicle, cross(w, inertia_times(vehicle, w)), false);
    for (int i = 0; i < 3; ++i) alpha[i] += gyro[i];
  }
  const Vec torque = inertia_times(vehicle, alpha);
  const Rows A = allocation_rows(vehicle);
  Rows gram(4, std::vector<double>(4, 0.0));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < A[i].size(); ++k) gram[i][j] += A[i][k] * A[j][k];
    }
  }
  const std::vector<double> y = solve(gram, {torque[0], torque[1], torque[2], thrust});
  std::vector<double> speeds(vehicle.rotors.size());
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    double squared = 0.0;
    for (int i = 0; i < 4; ++i) squared += A[i][k] * y[i];
    speeds[k] = squared > 0.0 ? std::sqrt(squared) : 0.0;
    if (!quirks.unlimited_rotor_speed) speeds[k] = std::min(speeds[k], quirks.max_rotor_speed);
  }
  return speeds;
}

double uniform(std::mt19937_64& random, double bound) {
  return std::uniform_real_distribution<double>(-bound, bound)(random);
}

Eigen::Vector3d uniform_vector(std::mt19937_64& random, double bound) {
  const double x = uniform(random, bound), y = uniform(random, bound);
  return {x, y, uniform(random, bound)};
}

}  // namespace

std::vector<double> reference_lee_speeds(const LeeParams& params, const OdometryState& state,
                                         const TrajectoryPoint& reference) {
  const Mat R = rotation_of(state.R_world_body);
  const double m = params.vehicle.mass;
  Vec a{};
  for (int i = 0; i < 3; ++i) {
    double v_world = 0.0;
    for (int j = 0; j < 3; ++j) v_world += R[i][j] * state.v_body[j];
    a[i] = (params.gains.position[i] * (state.p_world_body[i] - reference.p_world[i]) +
            params.gains.velocity[i] * (v_world - reference.v_world[i])) /
               m -
           (i == 2 ? params.vehicle.gravity : 0.0) - reference.a_world[i];
  }
  const Vec b3 = scaled(a, -1.0 / std::sqrt(dot(a, a)));
  const Vec b2_raw = cross(b3, {std::cos(reference.yaw), std::sin(reference.yaw), 0.0});
  const Vec b2 = scaled(b2_raw, 1.0 / std::sqrt(dot(b2_raw, b2_raw)));
  const Vec b1 = cross(b2, b3);
  Mat Rd{};
  for (int i = 0; i < 3; ++i) Rd[i] = {b1[i], b2[i], b3[i]};
  return speeds_for(params.vehicle, params.gains, params.quirks, R, Rd, from(state.w_body),
                    reference.yaw_rate, -m * dot(a, column(R, 2)));
}

std::vector<double> reference_attitude_speeds(const VehicleParams& vehicle,
                                              const AttitudeGains& gains,
                                              const AttitudeQuirks& quirks,
                                              const OdometryState& state,
                                              const AttitudeCommand& command) {
  const Mat R = rotation_of(state.R_world_body);
  const double yaw = std::atan2(R[1][0], R[0][0]);
  const double cy = std::cos(yaw), sy = std::sin(yaw);
  const double cr = std::cos(command.roll), sr = std::sin(command.roll);
  const double cp = std::cos(command.pitch), sp = std::sin(command.pitch);
  const Mat Rz = {{{cy, -sy, 0}, {sy, cy, 0}, {0, 0, 1}}};
  const Mat Rx = {{{1, 0, 0}, {0, cr, -sr}, {0, sr, cr}}};
  const Mat Ry = {{{cp, 0, sp}, {0, 1, 0}, {-sp, 0, cp}}};
  return speeds_for(vehicle, gains, quirks, R, product(product(Rz, Rx), Ry), from(state.w_body),
                    command.yaw_rate, command.thrust);
}

VehicleParams regular_multirotor(int rotor_count, double arm_length, double first_angle) {
  VehicleParams vehicle;
  const RotorConfig like = vehicle.rotors.front();
  vehicle.rotors.clear();
  for (int i = 0; i < rotor_count; ++i) {
    RotorConfig rotor = like;
    rotor.angle = first_angle + 2.0 * M_PI * i / rotor_count;
    rotor.arm_length = arm_length;
    rotor.direction = i % 2 == 0 ? 1 : -1;
    vehicle.rotors.push_back(rotor);
  }
  return vehicle;
}

OdometryState random_state(std::mt19937_64& random) {
  OdometryState state;
  state.p_world_body = uniform_vector(random, 5.0);
  state.v_body = uniform_vector(random, 5.0);
  state.w_body = uniform_vector(random, 5.0);
  Eigen::Quaterniond q;
  do {
    q.coeffs() << uniform_vector(random, 1.0), uniform(random, 1.0);
  } while (q.norm() < 0.1);
  state.R_world_body = q.normalized();
  return state;
}

TrajectoryPoint random_point(std::mt19937_64& random) {
  TrajectoryPoint point;
  point.p_world = uniform_vector(random, 5.0);
  point.v_world = uniform_vector(random, 5.0);
  point.a_world = uniform_vector(random, 3.0);
  point.yaw = uniform(random, M_PI);
  point.yaw_rate = uniform(random, 2.0);
  return point;
}

std::array<double, 4> wrench_of(const VehicleParams& vehicle, const std::vector<double>& speeds) {
  const Rows A = allocation_rows(vehicle);
  std::array<double, 4> wrench{};
  for (int i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < speeds.size(); ++k) wrench[i] += A[i][k] * speeds[k] * speeds[k];
  }
  return wrench;
}

}  // namespace trident::control::test
