// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_estimation/filter/filter.h"
#include "trident_estimation/filter/history.h"

namespace trident::estimation {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Position [m] and velocity [m/s] on a line, with white noise of acceleration.
class OnALine : public Model {
 public:
  int dim() const override { return 2; }
  VectorXd predict(const VectorXd& x, const VectorXd& u, double dt) const override {
    const double acceleration = u.size() == 1 ? u(0) : 0.0;
    return Vector2d(x(0) + dt * x(1) + 0.5 * dt * dt * acceleration, x(1) + dt * acceleration);
  }
  MatrixXd jacobian(const VectorXd& /*x*/, const VectorXd& /*u*/, double dt) const override {
    return (MatrixXd(2, 2) << 1.0, dt, 0.0, 1.0).finished();
  }
  MatrixXd noise(const VectorXd& /*x*/, double dt) const override {
    const double cube = dt * dt * dt / 3.0, square = dt * dt / 2.0;
    return kNoise * (MatrixXd(2, 2) << cube, square, square, dt).finished();
  }
  static constexpr double kNoise = 0.04;  // [m^2/s^3]
};

/// A unicycle with a constant speed: x, y [m], yaw [rad], speed [m/s].
class Unicycle : public Model {
 public:
  int dim() const override { return 4; }
  VectorXd predict(const VectorXd& x, const VectorXd& u, double dt) const override {
    const double turn = u.size() == 1 ? u(0) : 0.0;
    VectorXd next = x;
    next(0) += dt * x(3) * std::cos(x(2) + 0.5 * dt * turn);
    next(1) += dt * x(3) * std::sin(x(2) + 0.5 * dt * turn);
    next(2) = wrap_to_pi(x(2) + dt * turn);
    return next;
  }
  MatrixXd noise(const VectorXd& /*x*/, double dt) const override {
    return dt * Eigen::Vector4d(1e-4, 1e-4, 4e-4, 1e-2).asDiagonal().toDenseMatrix();
  }
  VectorXd boxplus(const VectorXd& x, const VectorXd& d) const override {
    VectorXd moved = x + d;
    moved(2) = wrap_to_pi(moved(2));
    return moved;
  }
  VectorXd boxminus(const VectorXd& a, const VectorXd& b) const override {
    VectorXd difference = a - b;
    difference(2) = wrap_to_pi(difference(2));
    return difference;
  }
};

Measurement position(double seconds, double z, double variance) {
  Measurement measurement;
  measurement.stamp = SimTime::from_seconds(seconds);
  measurement.source = "gnss";
  measurement.z = VectorXd::Constant(1, z);
  measurement.R = MatrixXd::Constant(1, 1, variance);
  measurement.h = [](const VectorXd& x) { return VectorXd(x.head(1)); };
  return measurement;
}

/// Range [m] and bearing [rad] of a mark on the ground.
Measurement mark(double seconds, const Vector2d& place, const Vector2d& z) {
  Measurement measurement;
  measurement.stamp = SimTime::from_seconds(seconds);
  measurement.source = "mark";
  measurement.z = z;
  measurement.R = Vector2d(0.04, 4e-4).asDiagonal().toDenseMatrix();
  measurement.h = [place](const VectorXd& x) {
    const Vector2d away = place - x.head<2>();
    return VectorXd(Vector2d(away.norm(), wrap_to_pi(std::atan2(away.y(), away.x()) - x(2))));
  };
  measurement.residual = [](const VectorXd& z, const VectorXd& z_hat) {
    return VectorXd(Vector2d(z(0) - z_hat(0), wrap_to_pi(z(1) - z_hat(1))));
  };
  return measurement;
}

Filter on_a_line(FilterKind kind, double variance = 4.0) {
  return {kind, std::make_shared<OnALine>(), SimTime{}, Vector2d(0.5, -0.2),
          variance * MatrixXd::Identity(2, 2)};
}

class BothKinds : public testing::TestWithParam<FilterKind> {};
INSTANTIATE_TEST_SUITE_P(Filters, BothKinds, testing::Values(FilterKind::kEkf, FilterKind::kUkf));

// What is linear has one solution (Kalman 1960), here over all measurements at once: least squares
// over the initial state and the noise of each step.
TEST_P(BothKinds, ALinearProblemIsSolvedExactly) {
  Filter filter = on_a_line(GetParam());
  const OnALine model;
  constexpr int kSteps = 12;
  const double dt = 0.25;
  const MatrixXd F = model.jacobian({}, {}, dt), Q = model.noise({}, dt);
  // Rows: prior, then per step the motion and the position; unknowns: all states.
  const int unknowns = 2 * (kSteps + 1);
  MatrixXd information = MatrixXd::Zero(unknowns, unknowns);
  VectorXd vector = VectorXd::Zero(unknowns);
  information.topLeftCorner(2, 2) = MatrixXd::Identity(2, 2) / 4.0;
  vector.head(2) = Vector2d(0.5, -0.2) / 4.0;
  const MatrixXd W = Q.inverse();
  RandomStream stream(3, "filter_test");
  for (int k = 1; k <= kSteps; ++k) {
    MatrixXd motion = MatrixXd::Zero(2, unknowns);
    motion.block(0, 2 * k - 2, 2, 2) = -F;
    motion.block(0, 2 * k, 2, 2) = MatrixXd::Identity(2, 2);
    information += motion.transpose() * W * motion;
    const double z = 0.1 * k + stream.normal(static_cast<std::uint64_t>(k), 0);
    information(2 * k, 2 * k) += 1.0 / 0.09;
    vector(2 * k) += z / 0.09;
    ASSERT_TRUE(filter.predict_to(SimTime::from_seconds(dt * k)));
    ASSERT_EQ(filter.update(position(dt * k, z, 0.09)).kind, Outcome::Kind::kUsed);
  }
  const MatrixXd covariance = information.inverse();
  const VectorXd states = covariance * vector;
  const double tolerance = GetParam() == FilterKind::kEkf ? 1e-11 : 1e-8;
  EXPECT_TRUE(filter.state().isApprox(states.tail(2), tolerance))
      << filter.state() - states.tail(2);
  EXPECT_TRUE(filter.covariance().isApprox(covariance.bottomRightCorner(2, 2), tolerance));
}

TEST_P(BothKinds, AnInputMovesTheState) {
  Filter filter = on_a_line(GetParam());
  ASSERT_TRUE(filter.predict_to(SimTime::from_seconds(2.0), VectorXd::Constant(1, 3.0)));
  EXPECT_NEAR(filter.state()(0), 0.5 - 0.4 + 6.0, 1e-6);
  EXPECT_NEAR(filter.state()(1), -0.2 + 6.0, 1e-6);
}

// A drive among marks, over the seam of the yaw at +-180 degrees.
std::vector<Measurement> drive(std::uint64_t seed, VectorXd* end, const VectorXd& start) {
  const Unicycle model;
  RandomStream stream(seed, "filter_test");
  std::uint64_t draw = 0;
  const auto noise = [&](double sigma) { return sigma * stream.normal(draw++, 0); };
  const Vector2d places[] = {{8.0, 0.0}, {-6.0, 5.0}, {0.0, -9.0}};
  const double dt = 0.1;
  VectorXd x = start;
  std::vector<Measurement> measurements;
  for (int k = 1; k <= 200; ++k) {
    x = model.predict(x, {}, dt);
    const MatrixXd root = model.noise(x, dt).llt().matrixL();
    const VectorXd disturbance =
        (VectorXd(4) << noise(1.0), noise(1.0), noise(1.0), noise(1.0)).finished();
    x = model.boxplus(x, root * disturbance);
    const Vector2d& place = places[k % 3];
    const VectorXd exact = mark(dt * k, place, Vector2d::Zero()).h(x);
    measurements.push_back(
        mark(dt * k, place, {exact(0) + noise(0.2), wrap_to_pi(exact(1) + noise(0.02))}));
  }
  *end = x;
  return measurements;
}

// NEES of a consistent filter: its mean over N runs is chi-squared of 4 N, over N (Bar-Shalom,
// "Estimation with Applications to Tracking and Navigation", section 5.4). Normal approximation.
TEST_P(BothKinds, TheCovarianceIsThatOfTheErrors) {
  const auto model = std::make_shared<Unicycle>();
  const VectorXd start = (VectorXd(4) << 0.0, 0.0, 3.0, 0.4).finished();
  const MatrixXd covariance = Eigen::Vector4d(0.25, 0.25, 0.04, 0.04).asDiagonal();
  constexpr int kRuns = 50;
  double nees = 0.0, nis = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream stream(1000 + static_cast<std::uint64_t>(run), "filter_test");
    const VectorXd error = Eigen::Vector4d(0.5 * stream.normal(0, 0), 0.5 * stream.normal(1, 0),
                                           0.2 * stream.normal(2, 0), 0.2 * stream.normal(3, 0));
    Filter filter(GetParam(), model, SimTime{}, start, covariance);
    VectorXd truth;
    for (const Measurement& one :
         drive(static_cast<std::uint64_t>(run), &truth, model->boxplus(start, error))) {
      ASSERT_TRUE(filter.predict_to(one.stamp));
      const Outcome outcome = filter.update(one);
      ASSERT_EQ(outcome.kind, Outcome::Kind::kUsed) << outcome.reason;
      nis += outcome.normalized_squared / (200.0 * kRuns);
    }
    const VectorXd off = model->boxminus(truth, filter.state());
    nees += off.dot(filter.covariance().llt().solve(off)) / kRuns;
  }
  EXPECT_NEAR(nees, 4.0, 1.96 * std::sqrt(2.0 * 4.0 / kRuns));
  EXPECT_NEAR(nis, 2.0, 1.96 * std::sqrt(2.0 * 2.0 / (200.0 * kRuns)));
}

TEST_P(BothKinds, TheOrderOfArrivalDoesNotMatter) {
  const auto model = std::make_shared<Unicycle>();
  const VectorXd start = (VectorXd(4) << 0.0, 0.0, 3.0, 0.4).finished();
  const Filter first(GetParam(), model, SimTime{}, start, 0.1 * MatrixXd::Identity(4, 4));
  VectorXd truth;
  const std::vector<Measurement> sorted = drive(7, &truth, start);
  // Each is up to a second late.
  std::vector<std::pair<double, std::size_t>> arrivals;
  RandomStream stream(11, "filter_test");
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    arrivals.emplace_back(sorted[i].stamp.seconds() + stream.uniform(i, 0), i);
  }
  std::sort(arrivals.begin(), arrivals.end());
  History in_order(first, SimTime::from_seconds(1.0)), shuffled(first, SimTime::from_seconds(1.0));
  for (const Measurement& one : sorted) in_order.add(one);
  for (const auto& [arrival, i] : arrivals) {
    ASSERT_NE(shuffled.add(sorted[i]).kind, Outcome::Kind::kRefused) << arrival;
  }
  EXPECT_EQ(shuffled.newest().state(), in_order.newest().state());
  EXPECT_EQ(shuffled.newest().covariance(), in_order.newest().covariance());
  EXPECT_LE(shuffled.size(), 12U);
  const auto before = shuffled.at(SimTime::from_seconds(19.55));
  ASSERT_TRUE(before.has_value());
  EXPECT_NEAR(model->boxminus(before->state(), truth).head(2).norm(), 0.0, 0.5);
  EXPECT_FALSE(shuffled.at(SimTime::from_seconds(10.0)).has_value());
}

TEST_P(BothKinds, WhatIsNoCovarianceIsRefusedAndChangesNothing) {
  Filter filter = on_a_line(GetParam());
  const VectorXd state = filter.state();
  Measurement measurement = position(0.0, 1.0, 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double variance : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    measurement.R(0, 0) = variance;
    const Outcome outcome = filter.update(measurement);
    EXPECT_EQ(outcome.kind, Outcome::Kind::kRefused);
    EXPECT_NE(outcome.reason.find("gnss: covariance is not"), std::string::npos) << outcome.reason;
  }
  measurement = position(0.0, nan, 1.0);
  EXPECT_EQ(filter.update(measurement).kind, Outcome::Kind::kRefused);
  measurement = position(0.0, 1.0, 1.0);
  measurement.z = Vector2d(1.0, 1.0);
  measurement.R = (MatrixXd(2, 2) << 1.0, 0.5, 0.1, 1.0).finished();
  EXPECT_NE(filter.update(measurement).reason.find("not symmetric"), std::string::npos);
  EXPECT_FALSE(filter.predict_to(SimTime::from_seconds(-1.0)));
  EXPECT_EQ(filter.state(), state);
}

TEST_P(BothKinds, AbsurdCovariancesLeaveAFiniteBelief) {
  Filter filter = on_a_line(GetParam());
  RandomStream stream(5, "filter_test");
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double seconds = 1e-3 * static_cast<double>(i);
    ASSERT_TRUE(filter.predict_to(SimTime::from_seconds(seconds)));
    const double variance = std::pow(10.0, -300.0 + 600.0 * stream.uniform(2 * i, 0));
    filter.update(position(seconds, 10.0 * stream.normal(2 * i + 1, 0), variance));
    ASSERT_TRUE(filter.state().allFinite()) << i;
    ASSERT_EQ(filter.covariance().llt().info(), Eigen::Success) << i << "\n" << filter.covariance();
  }
}

TEST_P(BothKinds, WhatIsFarFromTheExpectationIsGated) {
  Filter filter = on_a_line(GetParam(), 1.0);
  Measurement measurement = position(0.0, 0.5 + 6.0, 3.0);  // three of two meters
  measurement.gate = 2.9;
  const Outcome outcome = filter.update(measurement);
  EXPECT_EQ(outcome.kind, Outcome::Kind::kGated);
  EXPECT_NEAR(outcome.normalized_squared, 9.0, 1e-6);
  EXPECT_EQ(filter.state(), VectorXd(Vector2d(0.5, -0.2)));
  measurement.gate = 3.1;
  EXPECT_EQ(filter.update(measurement).kind, Outcome::Kind::kUsed);
}

TEST(FilterModel, TheDefaultJacobianIsThatOfThePrediction) {
  const Unicycle model;
  const VectorXd x = (VectorXd(4) << 1.0, -2.0, 3.1, 0.7).finished();
  const MatrixXd F = model.jacobian(x, VectorXd::Constant(1, 0.4), 0.5);
  const double yaw = 3.1 + 0.1;
  EXPECT_NEAR(F(0, 2), -0.5 * 0.7 * std::sin(yaw), 1e-9);
  EXPECT_NEAR(F(1, 3), 0.5 * std::sin(yaw), 1e-9);
  EXPECT_NEAR(F(2, 2), 1.0, 1e-9);
}

TEST(FilterStart, IsRefusedWithTheReason) {
  const auto model = std::make_shared<OnALine>();
  const auto start = [&](const VectorXd& x, const MatrixXd& P, SigmaPoints points = {}) {
    return Filter(FilterKind::kUkf, model, SimTime{}, x, P, points);
  };
  const MatrixXd unit = MatrixXd::Identity(2, 2);
  EXPECT_THROW(start(Vector2d(0.0, NAN), unit), Error);
  EXPECT_THROW(start(Vector2d::Zero(), MatrixXd::Zero(2, 2)), Error);
  EXPECT_THROW(start(Vector2d::Zero(), MatrixXd::Identity(3, 3)), Error);
  EXPECT_THROW(start(Vector2d::Zero(), unit, {0.0, 2.0, 0.0}), Error);
  EXPECT_THROW(start(Vector2d::Zero(), unit, {0.1, 2.0, -2.0}), Error);
  EXPECT_THROW(History(start(Vector2d::Zero(), unit), SimTime{-1}), Error);
}

TEST(FilterHistory, WhatComesTooLateIsRefused) {
  History history(on_a_line(FilterKind::kEkf), SimTime::from_seconds(0.5));
  EXPECT_EQ(history.add(position(2.0, 0.0, 1.0)).kind, Outcome::Kind::kUsed);
  EXPECT_EQ(history.add(position(1.5, 0.0, 1.0)).kind, Outcome::Kind::kUsed);
  const Outcome late = history.add(position(1.4, 0.0, 1.0));
  EXPECT_EQ(late.kind, Outcome::Kind::kRefused);
  EXPECT_EQ(late.reason, "gnss: stamp is 1.4 s, legal is at least 1.5 s");
  EXPECT_EQ(history.add(position(1.6, 0.0, 0.0)).kind, Outcome::Kind::kRefused);
  EXPECT_EQ(history.size(), 2U);
}

}  // namespace
}  // namespace trident::estimation
