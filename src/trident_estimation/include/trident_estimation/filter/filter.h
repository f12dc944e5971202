// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>

#include "trident_base/sim_time.h"
#include "trident_estimation/filter/measurement.h"
#include "trident_estimation/filter/model.h"

namespace trident::estimation {

/// How a covariance goes through what is not linear.
enum class FilterKind {
  kEkf,  ///< by Jacobians (extended Kalman filter)
  kUkf   ///< by sigma points (Julier and Uhlmann 1997; scaled: Wan and van der Merwe 2000)
};

/// Spread and weights of the sigma points of an unscented filter.
struct SigmaPoints {
  double alpha = 0.001;  ///< spread, above 0 and at most 1
  double beta = 2.0;     ///< 2: best for Gaussians
  double kappa = 0.0;    ///< above -dim()
};

/// Where something is believed to be: a Kalman filter over a model, for states on manifolds. After
/// every call the state is finite and the covariance symmetric and positive definite. No clock and
/// no random numbers: equal calls give equal bits. May be copied; the copies share the model.
class Filter {
 public:
  /// `covariance` is of the model's dim() degrees of freedom. Throws Error unless all is finite and
  /// the covariance symmetric and positive definite, or for sigma points out of their ranges.
  Filter(FilterKind kind, std::shared_ptr<const Model> model, SimTime stamp, Eigen::VectorXd state,
         Eigen::MatrixXd covariance, const SigmaPoints& sigma_points = {});

  /// The belief at `stamp`, with the model's input `u` until then. False, and nothing changes, for
  /// a stamp before the belief's, and when the model gives what is not finite.
  bool predict_to(SimTime stamp, const Eigen::VectorXd& u = {});

  /// Takes in what was measured at the belief's stamp (another stamp: predict_to() first), with
  /// `inflation` times its covariance, and `widening` times that of what it depends on.
  Outcome update(const Measurement& measurement, double inflation = 1.0, double widening = 1.0);

  SimTime stamp() const { return stamp_; }                           ///< of the belief
  const Eigen::VectorXd& state() const { return state_; }            ///< of the model
  const Eigen::MatrixXd& covariance() const { return covariance_; }  ///< dim() x dim()
  const Model& model() const { return *model_; }                     ///< that it was made with

 private:
  bool move(const Eigen::VectorXd& d, const Eigen::MatrixXd& covariance);

  FilterKind kind_;
  std::shared_ptr<const Model> model_;
  SimTime stamp_;
  Eigen::VectorXd state_;
  Eigen::MatrixXd covariance_;
  SigmaPoints sigma_points_;
};

}  // namespace trident::estimation
