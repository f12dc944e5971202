// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/trust.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>

#include "filter/intersection.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_estimation/filter/history.h"

namespace trident::estimation {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Two positions that wander apart from one another [m].
class Wandering : public Model {
 public:
  explicit Wandering(bool is_in_groups = true) : is_in_groups_(is_in_groups) {}
  int dim() const override { return 2; }
  VectorXd predict(const VectorXd& x, const VectorXd& /*u*/, double /*dt*/) const override {
    return x;
  }
  MatrixXd noise(const VectorXd& /*x*/, double dt) const override {
    return 0.01 * dt * MatrixXd::Identity(2, 2);
  }
  std::vector<DofRange> groups() const override {
    return is_in_groups_ ? std::vector<DofRange>{{0, 1}, {1, 1}} : Model::groups();
  }

 private:
  bool is_in_groups_;
};

Filter wandering(FilterKind kind = FilterKind::kEkf, bool is_in_groups = true) {
  const MatrixXd P = (MatrixXd(2, 2) << 4.0, 1.0, 1.0, 2.0).finished();
  return {kind, std::make_shared<Wandering>(is_in_groups), SimTime{}, Vector2d(1.0, 2.0), P};
}

/// The second position, or a bend of it.
Measurement second(double seconds, const std::string& source, double z, double variance) {
  Measurement measurement;
  measurement.stamp = SimTime::from_seconds(seconds);
  measurement.source = source;
  measurement.z = VectorXd::Constant(1, z);
  measurement.R = MatrixXd::Constant(1, 1, variance);
  measurement.h = [](const VectorXd& x) { return VectorXd(x.tail(1)); };
  measurement.dofs = {1};
  return measurement;
}

TEST(Gate, IsTheQuantileOfChiSquared) {
  EXPECT_NEAR(gate_of(0.99, 1), std::sqrt(6.635), 0.03);
  EXPECT_NEAR(gate_of(0.99, 3), std::sqrt(11.345), 0.03);
  EXPECT_NEAR(gate_of(0.95, 6), std::sqrt(12.592), 0.03);
}

// What a measurement depends on, and what moves apart, only saves time.
TEST(FilterParts, GiveWhatTheWholeGives) {
  for (const FilterKind kind : {FilterKind::kEkf, FilterKind::kUkf}) {
    Filter parts = wandering(kind), whole = wandering(kind, false);
    Measurement bent = second(0.5, "bent", 3.0, 0.2);
    bent.h = [](const VectorXd& x) { return VectorXd(x.tail(1).array().square() / 4.0); };
    ASSERT_TRUE(parts.predict_to(bent.stamp));
    ASSERT_TRUE(whole.predict_to(bent.stamp));
    parts.update(bent);
    bent.dofs.clear();
    whole.update(bent);
    EXPECT_TRUE(parts.state().isApprox(whole.state(), 1e-6)) << parts.state() - whole.state();
    EXPECT_TRUE(parts.covariance().isApprox(whole.covariance(), 1e-6));
  }
}

TEST(Intersection, HasTheLeastDeterminantOfAllWeights) {
  const MatrixXd P = (MatrixXd(2, 2) << 4.0, 0.5, 0.5, 1.0).finished();
  const MatrixXd R = (MatrixXd(2, 2) << 1.0, -0.2, -0.2, 3.0).finished();
  const MatrixXd H = MatrixXd::Identity(2, 2);
  const auto best = intersect(P, H, R, Vector2d(1.0, -1.0));
  ASSERT_TRUE(best.has_value());
  double least = 1e9;
  for (double w = 0.001; w < 1.0; w += 0.001) {
    least = std::min(least, (w * P.inverse() + (1.0 - w) * R.inverse()).inverse().determinant());
  }
  EXPECT_NEAR(best->covariance.determinant(), least, 1e-5);
}

TEST(Intersection, DoesNothingWithWhatIsNotBetterThanTheBelief) {
  const MatrixXd P = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(intersect(P, P, 1.5 * P, Vector2d(1.0, 1.0)).has_value());
  EXPECT_FALSE(intersect(P, P, P, Vector2d(1.0, 1.0)).has_value());
}

// The belief itself, returned to it again and again.
TEST(Intersection, KnowsNothingMoreFromAnEcho) {
  Filter shared = wandering(), naive = wandering();
  for (int i = 0; i < 10; ++i) {
    Measurement echo = second(0.0, "echo", shared.state()(1), shared.covariance()(1, 1));
    naive.update(second(0.0, "echo", naive.state()(1), naive.covariance()(1, 1)));
    echo.is_shared = true;
    EXPECT_EQ(shared.update(echo).kind, Outcome::Kind::kUsed);
  }
  EXPECT_EQ(shared.covariance(), wandering().covariance());
  EXPECT_LT(naive.covariance()(1, 1), 0.01);
}

TEST(Intersection, WhatIsBetterCorrectsAllThatFollows) {
  Filter filter = wandering();
  Measurement better = second(0.0, "mate", 3.0, 0.1);
  better.is_shared = true;
  EXPECT_EQ(filter.update(better).kind, Outcome::Kind::kUsed);
  // Of one number the intersection is the better one; the other follows by 1 / 2.
  EXPECT_NEAR(filter.state()(1), 3.0, 1e-3);
  EXPECT_NEAR(filter.state()(0), 1.5, 1e-3);
  EXPECT_NEAR(filter.covariance()(1, 1), 0.1, 1e-3);
  EXPECT_NEAR(filter.covariance()(0, 0), 4.0 - 0.5 + 0.25 * 0.1, 1e-3);
}

/// Three sources of one position, of which one says that it is `factor` times as good as it is.
History heard(double factor, std::optional<TrustParams> trust, double outliers = 0.0) {
  History history(wandering(), SimTime::from_seconds(0.5), trust);
  RandomStream stream(5, "trust_test");
  for (std::uint64_t i = 1; i <= 1500; ++i) {
    const double seconds = 0.1 * static_cast<double>(i / 3);
    const char* names[] = {"a", "b", "c"};
    const double noise = stream.normal(i, 0);
    const double variance = i % 3 == 0 ? 1.0 / (factor * factor) : 1.0;
    const double off = stream.uniform(i, 1) < outliers ? 20.0 : 0.0;
    Measurement one = second(seconds, names[i % 3], 2.0 + noise + off, variance);
    one.gate = gate_of(0.99, 1);
    history.add(std::move(one));
  }
  return history;
}

TEST(Trust, NamesTheSourceThatLiesAndKeepsItFromHarm) {
  const auto reports = heard(5.0, TrustParams{}).reports();
  EXPECT_NEAR(reports.at("a").trust.inflation, 25.0, 12.0);
  EXPECT_EQ(reports.at("b").trust.inflation, 1.0);
  EXPECT_EQ(reports.at("c").trust.inflation, 1.0);
  EXPECT_EQ(heard(5.0, {}).reports().at("a").trust.inflation, 1.0);
}

TEST(Trust, BelievesHonestSourcesWithOutliers) {
  for (const double outliers : {0.0, 0.2}) {
    for (const auto& [source, report] : heard(1.0, TrustParams{}, outliers).reports()) {
      EXPECT_EQ(report.trust.inflation, 1.0) << source;
      EXPECT_EQ(report.used + report.gated, 500U) << source;
      EXPECT_NEAR(static_cast<double>(report.gated), 500.0 * outliers, 25.0) << source;
    }
  }
}

// A belief that is sure and wrong.
TEST(Trust, LetsASourceInAgainThatIsGatedForLong) {
  History history(wandering(), SimTime{}, TrustParams{});
  history.add(second(0.0, "a", 500.0, 1e-6));
  for (int i = 1; i <= 60; ++i) {
    Measurement one = second(0.01 * i, "a", 2.0, 0.01);
    one.gate = gate_of(0.99, 1);
    history.add(std::move(one));
  }
  EXPECT_NEAR(history.newest().state()(1), 2.0, 1.0);
}

TEST(Trust, ParametersOutOfRangeAreNamed) {
  EXPECT_THROW((TrustParams{0.5, 100.0, 8}.validate()), Error);
  EXPECT_THROW((TrustParams{0.7, 0.0, 8}.validate()), Error);
  EXPECT_THROW((TrustParams{0.7, 10.0, 0}.validate()), Error);
}

TEST(FilterHistory, ABatchIsAsOneByOne) {
  History one(wandering(), SimTime::from_seconds(1.0)), batch = one;
  std::vector<Measurement> all;
  for (int i = 9; i >= 1; --i) all.push_back(second(0.1 * i, "a", 0.1 * i, i == 4 ? -1.0 : 1.0));
  const std::vector<Outcome> outcomes = batch.add_all(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(one.add(all[i]).kind, outcomes[i].kind) << i;
  }
  EXPECT_EQ(outcomes[5].kind, Outcome::Kind::kRefused);
  EXPECT_EQ(one.newest().state(), batch.newest().state());
  EXPECT_EQ(one.newest().covariance(), batch.newest().covariance());
  EXPECT_EQ(batch.reports().at("a").refused, 1U);
  EXPECT_EQ(batch.reports().at("a").used, 8U);
}

}  // namespace
}  // namespace trident::estimation
