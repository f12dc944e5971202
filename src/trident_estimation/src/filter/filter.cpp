// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/filter.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "filter/covariance.h"
#include "filter/differences.h"
#include "filter/intersection.h"
#include "filter/moments.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

// Why a measurement cannot be used at a belief of that stamp; empty: it can.
std::string problem_of(const Measurement& measurement, SimTime stamp) {
  if (!measurement.h) return "it does not say how it follows from the state";
  if (measurement.z.size() == 0 || !measurement.z.allFinite()) {
    return "values are missing or not finite";
  }
  if (measurement.stamp != stamp) {
    return "stamp is " + number_text(measurement.stamp.seconds()) + " s, the belief's " +
           number_text(stamp.seconds()) + " s";
  }
  return covariance_problem(measurement.R, measurement.z.size());
}

constexpr double kUnknown = 2.0;  // bounds the covariance of a difference, whatever they share

// Everything that an update is made of.
struct Update {
  const Measurement& measurement;
  const Eigen::MatrixXd& P;
  Eigen::MatrixXd columns;  // of P, for the rows of H
  Expectation expected;
  Eigen::MatrixXd noise;  // of the measurement, and what no straight line explains
};

Outcome refused(const Measurement& measurement, const std::string& reason) {
  Outcome outcome;
  outcome.reason = measurement.source + ": " + reason;
  return outcome;
}

// `factor` times the variances of what a measurement depends on, with the same correlations.
Eigen::MatrixXd widened(const Eigen::MatrixXd& P, const Measurement& measurement, double factor) {
  if (factor == 1.0) return P;
  if (measurement.dofs.empty()) return factor * P;
  Eigen::MatrixXd result = P;
  for (const Eigen::Index dof : measurement.dofs) {
    result.row(dof) *= std::sqrt(factor);
    result.col(dof) *= std::sqrt(factor);
  }
  return result;
}

// Gates a measurement that is farther from what is expected than its gate.
void apply_gate(const Measurement& measurement, Outcome& outcome) {
  if (!measurement.gate) return;
  if (!(outcome.normalized_squared > *measurement.gate * *measurement.gate)) return;
  outcome.kind = Outcome::Kind::kGated;
  outcome.reason = measurement.source + ": Mahalanobis distance " +
                   number_text(std::sqrt(outcome.normalized_squared)) + ", the gate is " +
                   number_text(*measurement.gate);
}

// What is to become of it, if the correction is finite.
Outcome judged(const Update& update) {
  const Measurement& measurement = update.measurement;
  Outcome outcome;
  outcome.innovation = update.expected.innovation;
  outcome.S = update.expected.S - update.expected.unexplained + update.noise;
  if (measurement.is_shared) outcome.S *= kUnknown;
  const Eigen::LLT<Eigen::MatrixXd> S(outcome.S);
  if (!outcome.S.allFinite() || !outcome.innovation.allFinite() || S.info() != Eigen::Success) {
    return refused(measurement, "what is expected here is not finite");
  }
  outcome.normalized_squared = outcome.innovation.dot(S.solve(outcome.innovation));
  outcome.kind = Outcome::Kind::kUsed;
  apply_gate(measurement, outcome);
  return outcome;
}

// P' = (I - K H) P (I - K H)' + K noise K', Joseph's form: a sum of two positive terms, whatever
// K's rounding. Only the columns of P that H reads are multiplied by it.
Correction corrected(const Update& update, const Outcome& outcome) {
  const Eigen::MatrixXd& H = update.expected.H;
  const Eigen::MatrixXd PHt = update.columns * H.transpose();
  const Eigen::MatrixXd K = outcome.S.llt().solve(PHt.transpose()).transpose();
  Correction result{K * outcome.innovation, update.P};
  result.covariance.noalias() -= K * PHt.transpose();
  const Eigen::MatrixXd right =
      columns_of(result.covariance, update.measurement) * H.transpose() - K * update.noise;
  result.covariance.noalias() -= right * K.transpose();
  return result;
}

// By covariance intersection of what the measurement depends on; all else follows as it does
// whatever corrects these.
std::optional<Correction> intersected(const Update& update) {
  const Eigen::MatrixXd P = rows_of(update.columns, update.measurement);
  const auto part = intersect(P, update.expected.H, update.noise, update.expected.innovation);
  if (!part) return std::nullopt;
  const Eigen::MatrixXd gain = P.llt().solve(update.columns.transpose()).transpose();
  return Correction{gain * part->moved,
                    update.P + gain * (part->covariance - P) * gain.transpose()};
}

}  // namespace

Eigen::MatrixXd Model::jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                                double dt) const {
  const Eigen::VectorXd center = predict(x, u, dt);
  return central_differences(dim(), [&](const Eigen::VectorXd& d) {
    return boxminus(predict(boxplus(x, d), u, dt), center);
  });
}

Filter::Filter(FilterKind kind, std::shared_ptr<const Model> model, SimTime stamp,
               Eigen::VectorXd state, Eigen::MatrixXd covariance, const SigmaPoints& sigma_points)
    : kind_(kind),
      model_(std::move(model)),
      stamp_(stamp),
      state_(std::move(state)),
      covariance_(std::move(covariance)),
      sigma_points_(sigma_points) {
  const std::string problem = covariance_problem(covariance_, model_->dim());
  if (!problem.empty()) throw Error("filter: initial " + problem);
  if (!state_.allFinite()) throw Error("filter: the initial state is not finite");
  const SigmaPoints& points = sigma_points_;
  if (!(points.alpha > 0.0 && points.alpha <= 1.0)) {
    throw Error("filter: alpha is " + number_text(points.alpha) +
                ", legal is above 0 and at most 1");
  }
  if (!(points.kappa > -model_->dim())) {
    throw Error("filter: kappa is " + number_text(points.kappa) + ", legal is above " +
                number_text(-model_->dim()));
  }
}

bool Filter::predict_to(SimTime stamp, const Eigen::VectorXd& u) {
  if (stamp < stamp_) return false;
  if (stamp == stamp_) return true;
  const double dt = (stamp - stamp_).seconds();
  const Belief before{state_, covariance_};
  const Belief after = kind_ == FilterKind::kEkf
                           ? predict_extended(*model_, before, u, dt)
                           : predict_unscented(*model_, before, sigma_points_, u, dt);
  if (!after.state.allFinite() || !after.covariance.allFinite()) return false;
  stamp_ = stamp;
  state_ = after.state;
  covariance_ = positive_definite(after.covariance);
  return true;
}

// False, and nothing changes, where that is not finite.
bool Filter::move(const Eigen::VectorXd& d, const Eigen::MatrixXd& covariance) {
  if (!covariance.allFinite() || !d.allFinite()) return false;
  const Eigen::VectorXd state = model_->boxplus(state_, d);
  if (!state.allFinite()) return false;
  state_ = state;
  covariance_ = positive_definite(covariance);
  return true;
}

Outcome Filter::update(const Measurement& measurement, double inflation, double widening) {
  const std::string problem = problem_of(measurement, stamp_);
  if (!problem.empty()) return refused(measurement, problem);
  const Belief before{state_, widened(covariance_, measurement, widening)};
  Update update{measurement, before.covariance, columns_of(before.covariance, measurement), {}, {}};
  update.expected =
      kind_ == FilterKind::kEkf
          ? expect_extended(*model_, before, update.columns, measurement)
          : expect_unscented(*model_, before, update.columns, sigma_points_, measurement);
  update.noise = update.expected.unexplained + inflation * measurement.R;
  Outcome outcome = judged(update);
  if (outcome.kind != Outcome::Kind::kUsed) return outcome;
  const std::optional<Correction> correction =
      measurement.is_shared ? intersected(update) : corrected(update, outcome);
  if (!correction) return outcome;  // it brings nothing that is not in the belief
  if (move(correction->moved, correction->covariance)) return outcome;
  return refused(measurement, "it would lead to a state that is not finite");
}

}  // namespace trident::estimation
