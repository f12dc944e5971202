// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/filter/filter.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <utility>

#include "filter/covariance.h"
#include "filter/differences.h"
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

Outcome refused(const Measurement& measurement, const std::string& reason) {
  Outcome outcome;
  outcome.reason = measurement.source + ": " + reason;
  return outcome;
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

Outcome Filter::update(const Measurement& measurement) {
  const std::string problem = problem_of(measurement, stamp_);
  if (!problem.empty()) return refused(measurement, problem);
  const Belief before{state_, covariance_};
  const Expectation expected = kind_ == FilterKind::kEkf
                                   ? expect_extended(*model_, before, measurement)
                                   : expect_unscented(*model_, before, sigma_points_, measurement);
  const Eigen::LLT<Eigen::MatrixXd> S(expected.S);
  if (!expected.S.allFinite() || !expected.innovation.allFinite() || S.info() != Eigen::Success) {
    return refused(measurement, "what is expected here is not finite");
  }
  Outcome outcome;
  outcome.innovation = expected.innovation;
  outcome.S = expected.S;
  outcome.normalized_squared = expected.innovation.dot(S.solve(expected.innovation));
  if (measurement.gate && outcome.normalized_squared > *measurement.gate * *measurement.gate) {
    outcome.kind = Outcome::Kind::kGated;
    outcome.reason = measurement.source + ": Mahalanobis distance " +
                     number_text(std::sqrt(outcome.normalized_squared)) + ", the gate is " +
                     number_text(*measurement.gate);
    return outcome;
  }
  // Joseph's form: a sum of two positive terms, whatever K's rounding.
  const Eigen::MatrixXd K = S.solve(expected.H * covariance_).transpose();
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(K.rows(), K.rows()) - K * expected.H;
  const Eigen::MatrixXd covariance =
      rest * covariance_ * rest.transpose() + K * expected.unexplained * K.transpose();
  const Eigen::VectorXd state = model_->boxplus(state_, K * expected.innovation);
  if (!covariance.allFinite() || !state.allFinite()) {
    return refused(measurement, "it would lead to a state that is not finite");
  }
  outcome.kind = Outcome::Kind::kUsed;
  state_ = state;
  covariance_ = positive_definite(covariance);
  return outcome;
}

}  // namespace trident::estimation
