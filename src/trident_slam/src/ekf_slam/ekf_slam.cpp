// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/ekf_slam.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "chi_squared.h"
#include "joint_compatibility.h"
#include "landmark_models.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::slam {
namespace {

/// A scan with more observations than this is associated in the order given, so many at a time.
constexpr int kMaxJointPairs = 64;

void check_probability(const char* name, double value) {
  if (value > 0.0 && value < 1.0) return;
  throw Error(std::string(name) + " is " + std::to_string(value) + ", must be in (0, 1)");
}

}  // namespace

void EkfSlamParams::validate() const {
  check_probability("match_probability", match_probability);
  check_probability("new_probability", new_probability);
  if (new_probability < match_probability) {
    throw Error("new_probability " + std::to_string(new_probability) +
                " is below match_probability " + std::to_string(match_probability) +
                ": an observation could be both a known landmark and a new one");
  }
}

EkfSlam::EkfSlam(EkfSlamParams params)
    : params_(params),
      state_(Eigen::VectorXd::Zero(kRobotStates)),
      covariance_(Eigen::MatrixXd::Zero(kRobotStates, kRobotStates)) {
  params_.validate();
  covariance_(3, 3) = params_.yaw_scale_sigma * params_.yaw_scale_sigma;
  covariance_(4, 4) = params_.curvature_sigma * params_.curvature_sigma;
  joint_gates_.push_back(0.0);
  for (int pairs = 1; pairs <= kMaxJointPairs; ++pairs) {
    joint_gates_.push_back(chi_squared_quantile(params_.match_probability, 2 * pairs));
  }
  new_gate_ = chi_squared_quantile(params_.new_probability, 2);
}

SE2 EkfSlam::T_map_base() const { return SE2::from_xy_yaw(state_[0], state_[1], state_[2]); }

/// The filter's time update, x' = f(x, u), P' = F P F' + Q. F differs from the identity in the rows
/// of the robot only, so that rows and columns of P are multiplied in place: linear in the number
/// of landmarks instead of quadratic.
void EkfSlam::predict(const SE2& T_before_now, const Eigen::Matrix3d& covariance) {
  if (!T_before_now.p.allFinite() || !std::isfinite(T_before_now.angle) ||
      !covariance.allFinite()) {
    throw Error("a motion of the robot or its covariance is not finite");
  }
  const double distance = T_before_now.p.norm();
  const Motion motion = move(state_.head<kRobotStates>(), T_before_now);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = T_map_base().rotation();

  state_.head<kRobotStates>() = motion.after;
  covariance_.topRows<kRobotStates>() = (motion.F * covariance_.topRows<kRobotStates>()).eval();
  covariance_.leftCols<kRobotStates>() =
      (covariance_.leftCols<kRobotStates>() * motion.F.transpose()).eval();
  // The motion's covariance is given in the frame before it; P is in the map's.
  covariance_.topLeftCorner<3, 3>() += R * covariance * R.transpose();
  // Both systematic errors walk with the distance, not with time: a robot at rest learns nothing.
  covariance_(3, 3) += distance * params_.yaw_scale_walk * params_.yaw_scale_walk;
  covariance_(4, 4) += distance * params_.curvature_walk * params_.curvature_walk;
}

Eigen::Matrix2d EkfSlam::noise(const PointObservation& observation) const {
  if (params_.observation_sigma <= 0.0) return observation.covariance;
  return params_.observation_sigma * params_.observation_sigma * Eigen::Matrix2d::Identity();
}

/// A covariance that has no Cholesky factor is not one of a measurement.
bool EkfSlam::is_usable(const PointObservation& observation) const {
  return observation.p_base.allFinite() && noise(observation).allFinite() &&
         noise(observation).llt().info() == Eigen::Success;
}

/// Innovation and its squared Mahalanobis distance d2 = v' S^-1 v with S = H P H' + R (Neira and
/// Tardos 2001).
LandmarkPair EkfSlam::pair(const PointObservation& observation, std::size_t observed,
                           std::size_t landmark) const {
  const Sight sight = see(state_.head<3>(), state_.segment<2>(index(landmark)));
  LandmarkPair result;
  result.observed = observed;
  result.landmark = landmark;
  result.innovation = observation.p_base - sight.p_base;
  result.H = sight.H;
  const Eigen::Matrix2d S = cross_covariance(result, result) + noise(observation);
  result.distance2 = result.innovation.dot(S.llt().solve(result.innovation));
  return result;
}

/// Covariance of the innovations of two pairs, without noise: H_a P H_b'. Only the 5 x 5 part of P
/// that both Jacobians touch is read.
Eigen::Matrix2d EkfSlam::cross_covariance(const LandmarkPair& a, const LandmarkPair& b) const {
  Eigen::Matrix<double, 5, 5> P;
  const Eigen::Index i = index(a.landmark);
  const Eigen::Index j = index(b.landmark);
  P.topLeftCorner<3, 3>() = covariance_.topLeftCorner<3, 3>();
  P.topRightCorner<3, 2>() = covariance_.block<3, 2>(0, j);
  P.bottomLeftCorner<2, 3>() = covariance_.block<2, 3>(i, 0);
  P.bottomRightCorner<2, 2>() = covariance_.block<2, 2>(i, j);
  return a.H * P * b.H.transpose();
}

/// Individual compatibility: landmarks within the gate of the Mahalanobis distance, the nearest
/// first, so that the joint search finds a good hypothesis early. Equal distances go by the
/// landmark, the same on every machine.
std::vector<std::vector<LandmarkPair>> EkfSlam::compatible_pairs(
    const std::vector<PointObservation>& observations) const {
  std::vector<std::vector<LandmarkPair>> pairs(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!is_usable(observations[i])) continue;
    for (std::size_t landmark = 0; landmark < tracks_.size(); ++landmark) {
      const LandmarkPair candidate = pair(observations[i], i, landmark);
      if (candidate.distance2 <= joint_gates_[1]) pairs[i].push_back(candidate);
    }
    std::sort(pairs[i].begin(), pairs[i].end(), [](const auto& a, const auto& b) {
      return std::tie(a.distance2, a.landmark) < std::tie(b.distance2, b.landmark);
    });
  }
  return pairs;
}

bool EkfSlam::is_new(const PointObservation& observation) const {
  const Eigen::Vector2d p_map = place(state_.head<3>(), observation.p_base).landmark_map;
  for (std::size_t landmark = 0; landmark < tracks_.size(); ++landmark) {
    if ((state_.segment<2>(index(landmark)) - p_map).norm() < params_.new_distance) return false;
    if (pair(observation, 0, landmark).distance2 < new_gate_) return false;
  }
  return true;
}

void EkfSlam::add_new(const std::vector<PointObservation>& observations, std::vector<int>& ids) {
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (ids[i] != kAmbiguous || !is_usable(observations[i]) || !is_new(observations[i])) continue;
    ids[i] = next_id_++;
    add(observations[i], ids[i]);
  }
}

/// Associates first and corrects afterwards with all pairs at once: pairs are jointly compatible
/// only under one common linearization.
std::vector<int> EkfSlam::observe(const std::vector<PointObservation>& observations) {
  std::vector<int> ids(observations.size(), kAmbiguous);
  const std::vector<std::vector<LandmarkPair>> candidates = compatible_pairs(observations);
  const auto joint_covariance = [&](const LandmarkPair& a, const LandmarkPair& b) {
    Eigen::Matrix2d S = cross_covariance(a, b);
    if (a.observed == b.observed) S += noise(observations[a.observed]);
    return S;
  };
  const std::vector<LandmarkPair> pairs =
      largest_joint_set(candidates, joint_gates_, joint_covariance, params_.max_pairings);

  std::vector<bool> was_seen(tracks_.size(), false);
  for (const LandmarkPair& p : pairs) {
    ids[p.observed] = tracks_[p.landmark].id;
    was_seen[p.landmark] = true;
  }
  // New landmarks are placed from the corrected pose.
  correct(pairs, observations);
  add_new(observations, ids);
  count_misses(was_seen);
  return ids;
}

/// With associations from outside, as data sets give them. All landmarks that are known correct the
/// state before new ones are added: these begin with the corrected pose.
void EkfSlam::observe_known(const std::vector<PointObservation>& observations,
                            const std::vector<int>& ids) {
  if (observations.size() != ids.size()) throw Error("each observation needs one id");
  std::vector<LandmarkPair> pairs;
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!is_usable(observations[i])) continue;
    const auto track = std::find_if(tracks_.begin(), tracks_.end(),
                                    [&](const Track& known) { return known.id == ids[i]; });
    if (track == tracks_.end()) {
      fresh.push_back(i);
    } else {
      pairs.push_back(pair(observations[i], i, static_cast<std::size_t>(track - tracks_.begin())));
    }
  }
  correct(pairs, observations);
  for (const std::size_t i : fresh) {
    add(observations[i], ids[i]);
    next_id_ = std::max(next_id_, ids[i] + 1);
  }
}

/// Measurement update with all pairs as one stacked measurement. P H' is built from the columns
/// that each H touches, which keeps the cost at O(n m) besides the final O(n^2 m).
void EkfSlam::correct(const std::vector<LandmarkPair>& pairs,
                      const std::vector<PointObservation>& observations) {
  if (pairs.empty()) return;
  const auto rows = 2 * static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd PHt(state_.size(), rows);
  Eigen::VectorXd innovation(rows);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const LandmarkPair& p = pairs[k];
    const auto row = 2 * static_cast<Eigen::Index>(k);
    PHt.middleCols<2>(row) =
        covariance_.leftCols<3>() * p.H.leftCols<3>().transpose() +
        covariance_.middleCols<2>(index(p.landmark)) * p.H.rightCols<2>().transpose();
    innovation.segment<2>(row) = p.innovation;
    ++tracks_[p.landmark].sightings;
    tracks_[p.landmark].misses = 0;
  }
  Eigen::MatrixXd S(rows, rows);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const LandmarkPair& p = pairs[k];
    const auto row = 2 * static_cast<Eigen::Index>(k);
    S.middleRows<2>(row) = p.H.leftCols<3>() * PHt.topRows<3>() +
                           p.H.rightCols<2>() * PHt.middleRows<2>(index(p.landmark));
    S.block<2, 2>(row, row) += noise(observations[p.observed]);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  state_ += PHt * factor.solve(innovation);
  state_[2] = wrap_to_pi(state_[2]);
  const Eigen::MatrixXd W = factor.matrixL().solve(PHt.transpose());  // P -= W' W stays symmetric
  covariance_.noalias() -= W.transpose() * W;
}

/// Appends a landmark with the cross covariances of the pose that it was seen from (Smith, Self,
/// Cheeseman 1990): P_ln = G P_pose,n, P_ll = G P_pose G' + G_z R G_z'.
void EkfSlam::add(const PointObservation& observation, int id) {
  const Eigen::Index n = state_.size();
  const PlacedLandmark placed = place(state_.head<3>(), observation.p_base);
  state_.conservativeResize(n + 2);
  state_.tail<2>() = placed.landmark_map;
  covariance_.conservativeResize(n + 2, n + 2);
  covariance_.bottomLeftCorner(2, n) = placed.G_pose * covariance_.topLeftCorner(3, n);
  covariance_.topRightCorner(n, 2) = covariance_.bottomLeftCorner(2, n).transpose();
  covariance_.bottomRightCorner<2, 2>() =
      placed.G_pose * covariance_.topLeftCorner<3, 3>() * placed.G_pose.transpose() +
      placed.G_seen * noise(observation) * placed.G_seen.transpose();
  tracks_.push_back({id, 1, 0});
}

/// By the mean alone: near the edge of the view a miss counts as little as a sighting would.
bool EkfSlam::should_be_seen(std::size_t landmark) const {
  const Eigen::Vector2d p_base = see(state_.head<3>(), state_.segment<2>(index(landmark))).p_base;
  return p_base.norm() < params_.view_range &&
         std::abs(std::atan2(p_base.y(), p_base.x())) < params_.view_half_angle;
}

/// Backwards, since forget() moves the landmarks behind. Confirmed ones stay, however often they
/// are missed.
void EkfSlam::count_misses(const std::vector<bool>& was_seen) {
  for (std::size_t landmark = was_seen.size(); landmark-- > 0;) {
    Track& track = tracks_[landmark];
    if (was_seen[landmark] || track.sightings >= params_.confirm_sightings) continue;
    if (should_be_seen(landmark) && ++track.misses >= params_.forget_misses) forget(landmark);
  }
}

/// Marginalizes a landmark out of the filter: of mean and covariance its rows and columns are
/// dropped.
void EkfSlam::forget(std::size_t landmark) {
  const Eigen::Index at = index(landmark);
  const Eigen::Index behind = state_.size() - at - 2;
  state_.segment(at, behind) = state_.tail(behind).eval();
  state_.conservativeResize(at + behind);
  covariance_.middleRows(at, behind) = covariance_.bottomRows(behind).eval();
  covariance_.middleCols(at, behind) = covariance_.rightCols(behind).eval();
  covariance_.conservativeResize(at + behind, at + behind);
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(landmark));
}

std::vector<EkfSlam::Landmark> EkfSlam::landmarks() const {
  std::vector<Landmark> result;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    result.push_back({tracks_[i].id, state_.segment<2>(index(i)),
                      covariance_.block<2, 2>(index(i), index(i)), tracks_[i].sightings});
  }
  return result;
}

}  // namespace trident::slam
