// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "edge_model.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/so3.h"

namespace trident::slam {
namespace {

// Below this angle [rad] series with their last term are exact to double precision.
constexpr double kSeriesAngle = 0.3;

// h = angle/2 cot(angle/2) and its derivative.
struct HalfCotangent {
  double value, slope;
};
HalfCotangent half_cotangent(double angle) {
  if (std::abs(angle) > kSeriesAngle) {
    const double cotangent = 1.0 / std::tan(0.5 * angle);
    return {0.5 * angle * cotangent,
            0.5 * cotangent - 0.25 * angle * (1.0 + cotangent * cotangent)};
  }
  const double a2 = angle * angle;
  const double series =
      1.0 / 12 + a2 * (1.0 / 720 + a2 * (1.0 / 30240 + a2 * (1.0 / 1209600 + a2 / 47900160)));
  const double slope =
      1.0 / 6 + a2 * (1.0 / 180 + a2 * (1.0 / 5040 + a2 * (1.0 / 151200 + a2 / 4790016)));
  return {1.0 - a2 * series, -angle * slope};
}

// c = (1 - angle/2 cot(angle/2)) / angle^2 and c' / angle.
struct CotangentRemainder {
  double value, slope;
};
CotangentRemainder cotangent_remainder(double angle) {
  const double a2 = angle * angle;
  if (angle > kSeriesAngle) {
    const double cotangent = 1.0 / std::tan(0.5 * angle);
    const double h = 0.5 * angle * cotangent;
    const double value = (1.0 - h) / a2;
    const double h_slope = 0.5 * cotangent - 0.25 * angle * (1.0 + cotangent * cotangent);
    return {value, (-h_slope / angle - 2.0 * value) / a2};
  }
  return {1.0 / 12 + a2 * (1.0 / 720 + a2 * (1.0 / 30240 + a2 * (1.0 / 1209600 + a2 / 47900160))),
          1.0 / 360 + a2 * (1.0 / 7560 + a2 * (1.0 / 201600 + a2 * (1.0 / 5987520)))};
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& R) { return so3_log(Eigen::Quaterniond(R)); }

}  // namespace

SE2 EdgeModel<SE2>::to_group(const Pose& T) { return {std::atan2(T.R(1, 0), T.R(0, 0)), T.p}; }

SE2::Tangent EdgeModel<SE2>::log(const Pose& T) {
  const double angle = std::atan2(T.R(1, 0), T.R(0, 0));
  const double h = half_cotangent(angle).value;
  const double half = 0.5 * angle;
  return {h * T.p.x() + half * T.p.y(), h * T.p.y() - half * T.p.x(), angle};
}

SE2::Tangent EdgeModel<SE2>::log(const Pose& T, Matrix& J) {
  const double angle = std::atan2(T.R(1, 0), T.R(0, 0));
  const auto [h, slope] = half_cotangent(angle);
  Eigen::Matrix2d V_inverse;
  V_inverse << h, 0.5 * angle, -0.5 * angle, h;
  J.topLeftCorner<2, 2>() = V_inverse * T.R;
  J(0, 2) = slope * T.p.x() + 0.5 * T.p.y();
  J(1, 2) = slope * T.p.y() - 0.5 * T.p.x();
  J.row(2) << 0.0, 0.0, 1.0;
  Tangent error;
  error << V_inverse * T.p, angle;
  return error;
}

Eigen::Matrix3d EdgeModel<SE2>::inverse_adjoint(const Pose& T) {
  const Pose inverse = T.inverse();
  Matrix result = Matrix::Identity();
  result.topLeftCorner<2, 2>() = inverse.R;
  result(0, 2) = inverse.p.y();
  result(1, 2) = -inverse.p.x();
  return result;
}

EdgeModel<SE2>::Pose EdgeModel<SE2>::moved(const Pose& T, const Tangent& step) {
  const double c = std::cos(step[2]);
  const double s = std::sin(step[2]);
  // The first column turned, and normalised so that roundings do not gather.
  Eigen::Vector2d x = T.R * Eigen::Vector2d(c, s);
  x /= x.norm();
  Pose result;
  result.R << x.x(), -x.y(), x.y(), x.x();
  result.p = T.p + T.R * step.head<2>();
  return result;
}

SE3 EdgeModel<SE3>::to_group(const Pose& T) { return {Eigen::Quaterniond(T.R).normalized(), T.p}; }

SE3::Tangent EdgeModel<SE3>::log(const Pose& T) {
  const Eigen::Vector3d w = rotation_log(T.R);
  const Eigen::Vector3d w_p = w.cross(T.p);
  Tangent error;
  error << T.p - 0.5 * w_p + cotangent_remainder(w.norm()).value * w.cross(w_p), w;
  return error;
}

SE3::Tangent EdgeModel<SE3>::log(const Pose& T, Matrix& J) {
  const Eigen::Vector3d w = rotation_log(T.R);
  const auto [c, slope] = cotangent_remainder(w.norm());
  const Eigen::Matrix3d W = skew(w);
  const Eigen::Matrix3d WW = W * W;
  const Eigen::Vector3d w_w_p = WW * T.p;
  // The inverse right Jacobian of the rotation, and d(J_left(w)^-1 p) / dw.
  const Eigen::Matrix3d J_right = Eigen::Matrix3d::Identity() + 0.5 * W + c * WW;
  const Eigen::Matrix3d G = 0.5 * skew(T.p) +
                            c * (w.dot(T.p) * Eigen::Matrix3d::Identity() + w * T.p.transpose() -
                                 2.0 * T.p * w.transpose()) +
                            slope * w_w_p * w.transpose();
  J << J_right, G * J_right, Eigen::Matrix3d::Zero(), J_right;
  Tangent error;
  error << T.p - 0.5 * w.cross(T.p) + c * w_w_p, w;
  return error;
}

Matrix6d EdgeModel<SE3>::inverse_adjoint(const Pose& T) {
  const Eigen::Matrix3d R_transposed = T.R.transpose();
  Matrix result;
  result << R_transposed, -R_transposed * skew(T.p), Eigen::Matrix3d::Zero(), R_transposed;
  return result;
}

EdgeModel<SE3>::Pose EdgeModel<SE3>::moved(const Pose& T, const Tangent& step) {
  // Through a quaternion, normalised so that roundings do not gather.
  const Eigen::Quaterniond R = Eigen::Quaterniond(T.R) * so3_exp(step.tail<3>());
  return {R.normalized().toRotationMatrix(), T.p + T.R * step.head<3>()};
}

}  // namespace trident::slam
