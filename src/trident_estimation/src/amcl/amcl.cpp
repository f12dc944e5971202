// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/amcl.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "amcl/draws.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

constexpr double kLargestVariance = 1e8;  // [m^2], [rad^2]
constexpr double kFarthest = 1e8;         // of a pose and of odometry, from where they begin [m]

/// A matrix S with S S' = covariance, for covariances without full rank, too.
Eigen::Matrix3d square_root(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const bool is_legal =
      covariance.allFinite() && covariance.cwiseAbs().maxCoeff() <= kLargestVariance &&
      solver.info() == Eigen::Success && solver.eigenvalues().minCoeff() >= -1e-9 &&
      covariance.isApprox(covariance.transpose(), 1e-6);
  if (!is_legal) {
    throw Error("covariance of a pose: diagonal " + number_text(covariance(0, 0)) + ", " +
                number_text(covariance(1, 1)) + ", " + number_text(covariance(2, 2)) +
                ", legal: symmetric, without a negative eigenvalue, up to " +
                number_text(kLargestVariance));
  }
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

std::vector<std::uint32_t> free_cells_of(const OccupancyGrid& map) {
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] == OccupancyGrid::kFree) cells.push_back(static_cast<std::uint32_t>(i));
  }
  if (cells.empty()) throw Error("map: no free cell, legal: at least one");
  return cells;
}

bool is_finite(const SE2& T) {
  return std::abs(T.p.x()) <= kFarthest && std::abs(T.p.y()) <= kFarthest && std::isfinite(T.angle);
}

bool is_placed(const LaserScan& scan) {
  return std::isfinite(scan.angle_min) && std::isfinite(scan.angle_increment) &&
         is_finite(scan.T_base_laser);
}

/// What is wrong with a scan; empty if nothing.
std::string problem_of(const LaserScan& scan, const SE2& T_odom_base) {
  if (!is_finite(T_odom_base)) return "odometry is not finite; the scan is not used";
  if (!is_placed(scan)) {
    return "the scan's angles or its laser's place are not finite; it is not used";
  }
  if (!(scan.range_max > 0.0) || !std::isfinite(scan.range_max)) {
    return "the scan's range_max is " + number_text(scan.range_max) + " m, legal: > 0";
  }
  return scan.ranges.empty() ? "the scan has no beams" : "";
}

}  // namespace

void AmclParams::validate() const {
  if (min_particles <= max_particles) return;
  throw Error("min_particles: " + std::to_string(min_particles) +
              ", legal: at most max_particles (" + std::to_string(max_particles) + ")");
}

Amcl::Amcl(const AmclParams& params, const OccupancyGrid& map)
    : params_(params),
      free_space_{map.T_map_origin, free_cells_of(map), map.width, map.resolution},
      known_(map),
      laser_(map, params.laser),
      motion_(params.motion, params.seed),
      matcher_(params.recover_by_matching ? std::make_unique<maps::GridMatcher>(map) : nullptr),
      random_{RandomStream(params.seed, "amcl")},
      recovery_{params.recovery_patience} {
  params.validate();
  for (ParticleSet* set : {&particles_, &next_}) {
    set->reserve(static_cast<std::size_t>(params.max_particles));
  }
  set_pose(SE2(), Eigen::Vector3d(0.25, 0.25, std::pow(kPi / 12.0, 2)).asDiagonal());
}

Amcl::~Amcl() = default;

/// Gaussian about the pose, by a square root of the covariance, which may be singular: a heading
/// that is known exactly is legal.
void Amcl::set_pose(const SE2& T_map_base, const Eigen::Matrix3d& covariance) {
  if (!is_finite(T_map_base))
    throw Error("pose: (" + number_text(T_map_base.p.x()) + ", " + number_text(T_map_base.p.y()) +
                ") m, " + number_text(T_map_base.angle) + " rad, legal: finite, up to " +
                number_text(kFarthest) + " m");
  const Eigen::Matrix3d root = square_root(covariance);
  const SE2 T_origin_map = free_space_.T_map_origin.inverse();
  ++random_.count;
  particles_.clear();
  for (int i = 0; i < params_.max_particles; ++i) {
    const std::uint64_t number = (random_.count << 32) | static_cast<std::uint64_t>(i);
    const Eigen::Vector3d away = root * Eigen::Vector3d(random_.stream.normal(number, kScatterX),
                                                        random_.stream.normal(number, kScatterY),
                                                        random_.stream.normal(number, kScatterYaw));
    const SE2 T_grid_base =
        T_origin_map * SE2::from_xy_yaw(T_map_base.p.x() + away.x(), T_map_base.p.y() + away.y(),
                                        T_map_base.angle + away.z());
    particles_.push_back(static_cast<float>(T_grid_base.p.x()),
                         static_cast<float>(T_grid_base.p.y()),
                         static_cast<float>(T_grid_base.angle));
  }
  particles_.set_equal_weights();
  T_odom_.used.reset();
  recovery_.is_anywhere = false;
  recovery_.disagreement = 0.0;
  recovery_.patience = params_.recovery_patience;
  mean_weights_.slow = mean_weights_.fast = 0.0;
  update_estimate();
}

void Amcl::set_anywhere() {
  ++random_.count;
  particles_.clear();
  for (int i = 0; i < params_.max_particles; ++i) {
    push_random_pose(particles_, (random_.count << 32) | static_cast<std::uint64_t>(i));
  }
  particles_.set_equal_weights();
  T_odom_.used.reset();
  recovery_.is_anywhere = true;
  mean_weights_.slow = mean_weights_.fast = 0.0;
  update_estimate();
}

void Amcl::push_random_pose(ParticleSet& particles, std::uint64_t number) {
  const std::uint64_t bits = random_.stream.bits(number, kPlace);
  const std::uint32_t cell = free_space_.cells[static_cast<std::size_t>(
      to_unit(bits) * static_cast<double>(free_space_.cells.size()))];
  const auto width = static_cast<std::uint32_t>(free_space_.width);
  const std::uint32_t column = cell % width, row = cell / width;
  const double x = column + random_.stream.uniform(number, kScatterX);
  const double y = row + random_.stream.uniform(number, kScatterY);
  particles.push_back(
      static_cast<float>(x * free_space_.resolution),
      static_cast<float>(y * free_space_.resolution),
      static_cast<float>((2.0 * random_.stream.uniform(number, kHeading) - 1.0) * kPi));
}

bool Amcl::has_moved(const SE2& T_odom_base) const {
  if (!T_odom_.used) return true;
  const Eigen::Vector2d motion = T_odom_base.p - T_odom_.used->p;
  return std::abs(motion.x()) > params_.update_min_d ||
         std::abs(motion.y()) > params_.update_min_d ||
         std::abs(angle_difference(T_odom_base.angle, T_odom_.used->angle)) > params_.update_min_a;
}

/// Moves the odometry of the last update along, so that the jump is not taken for motion.
void Amcl::remove_jump(const SE2& T_odom_base, AmclStep& step) {
  if (T_odom_.seen && T_odom_.used) {
    const double jump = (T_odom_base.p - T_odom_.seen->p).norm();
    if (jump > params_.max_odom_jump) {
      step.problem = "odometry jumped by " + number_text(std::round(jump * 100.0) / 100.0) +
                     " m from one scan to the next (max_odom_jump " +
                     number_text(params_.max_odom_jump) + " m); taken for a reset";
      T_odom_.used = T_odom_base * (T_odom_.seen->inverse() * *T_odom_.used);
    }
  }
  T_odom_.seen = T_odom_base;
}

void Amcl::forget_odometry() {
  T_odom_.used.reset();
  T_odom_.seen.reset();
}

/// One step of Monte Carlo localization: move by odometry, weigh by the scan, estimate, search if
/// the scan disagrees, resample. The estimate is taken before resampling, whose draws only add
/// noise.
AmclStep Amcl::update(const LaserScan& scan, const SE2& T_odom_base, const SE2& T_start_end) {
  AmclStep step;
  step.problem = problem_of(scan, T_odom_base);
  if (!step.problem.empty()) return step;
  remove_jump(T_odom_base, step);
  if (!is_forced_ && !has_moved(T_odom_base)) return step;
  step.is_updated = true;
  is_forced_ = false;
  if (T_odom_.used)
    motion_.apply(T_odom_.used->inverse() * T_odom_base, ++random_.count, particles_);
  T_odom_.used = T_odom_base;

  const ScanBeams beams = select_beams(scan, params_.laser, T_start_end);
  if (beams.points.p_base.empty()) {
    step.problem = "the scan has no return within its limits; only odometry is used";
    update_estimate();
    return step;
  }
  note_mean_weight(laser_.weigh(beams, particles_));
  particles_.normalize();
  update_estimate();
  recover(beams, step);
  step.is_resampled = resample_when_due();
  return step;
}

/// Whether it was.
bool Amcl::resample_when_due() {
  if (++resampling_.updates_since < params_.resample_interval) return false;
  resample();
  resampling_.updates_since = 0;
  return true;
}

/// Augmented MCL ("Probabilistic Robotics", table 8.3).
void Amcl::note_mean_weight(double mean_weight) {
  mean_weights_.slow += mean_weights_.slow == 0.0
                            ? mean_weight
                            : params_.recovery_alpha_slow * (mean_weight - mean_weights_.slow);
  mean_weights_.fast += mean_weights_.fast == 0.0
                            ? mean_weight
                            : params_.recovery_alpha_fast * (mean_weight - mean_weights_.fast);
}

/// Random particles are drawn while recent scans fit worse than they do in the long run.
double Amcl::random_share() const {
  if (params_.recovery_alpha_slow == 0.0 || params_.recovery_alpha_fast == 0.0) return 0.0;
  return mean_weights_.slow > 0.0 ? std::max(0.0, 1.0 - mean_weights_.fast / mean_weights_.slow)
                                  : 0.0;
}

/// Indexed search (Chen and Asau, On generating random variates from an empirical distribution,
/// 1974): the guide says where the running sum of weights passes each slice of [0, 1), so that a
/// draw need not begin at the first particle.
void Amcl::make_guide() {
  const std::size_t count = particles_.size();
  resampling_.cumulative.resize(count);
  resampling_.guide.resize(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) resampling_.cumulative[i] = sum += particles_.weight[i];
  resampling_.cumulative.back() =
      2.0;  // above every uniform number, whatever rounding made of the sum
  std::uint32_t at = 0;
  for (std::size_t slice = 0; slice < count; ++slice) {
    const double begin = static_cast<double>(slice) / static_cast<double>(count);
    while (resampling_.cumulative[at] <= begin) ++at;
    resampling_.guide[slice] = at;
  }
}

/// The particle on which a uniform number falls, in constant time on average.
std::size_t Amcl::chosen(double u) const {
  std::size_t i =
      resampling_
          .guide[static_cast<std::size_t>(u * static_cast<double>(resampling_.guide.size()))];
  while (resampling_.cumulative[i] <= u) ++i;
  return i;
}

/// Adds one particle to the next set: a random pose, or one of those that there are, by weight.
void Amcl::draw(double share_of_random, std::uint64_t number) {
  if (share_of_random > 0.0 && random_.stream.uniform(number, kFresh) < share_of_random) {
    push_random_pose(next_, number);
    return;
  }
  const std::size_t parent = chosen(to_unit(random_.stream.bits(number, kChoice)));
  next_.push_back(particles_.x[parent], particles_.y[parent], particles_.yaw[parent]);
}

/// KLD-sampling: draws until the cells of pose space that are hit ask for no more.
void Amcl::resample() {
  if (params_.selective_resampling &&
      particles_.effective_count() > 0.5 * static_cast<double>(particles_.size())) {
    return;
  }
  const double share = random_share();
  const auto least = static_cast<std::size_t>(params_.min_particles);
  const auto most = static_cast<std::size_t>(params_.max_particles);
  ++random_.count;
  make_guide();
  histogram_.reset(most);
  next_.clear();
  std::size_t wanted = most, cells = 0;
  for (std::uint64_t i = 0; next_.size() < wanted; ++i) {
    draw(share, (random_.count << 32) | i);
    histogram_.insert(next_.x.back(), next_.y.back(), next_.yaw.back());
    if (histogram_.cell_count() == cells) continue;
    cells = histogram_.cell_count();
    wanted = std::clamp(kld_sample_size(cells, params_.kld_err, params_.kld_z), least, most);
  }
  std::swap(particles_, next_);
  particles_.set_equal_weights();
  // Random particles have had a chance; otherwise there would be ever more of them.
  if (share > 0.0) mean_weights_.slow = mean_weights_.fast = 0.0;
}

void Amcl::update_estimate() {
  const std::vector<PoseCluster> clusters = histogram_.clusters(particles_);
  const PoseCluster& best = clusters.front();
  estimate_.T_map_base = free_space_.T_map_origin * best.T_grid_base;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = free_space_.T_map_origin.rotation();
  estimate_.covariance = R * best.covariance * R.transpose();
  estimate_.cluster_weight = best.weight;
  estimate_.clusters = clusters.size();
  estimate_.particles = particles_.size();
}

}  // namespace trident::estimation
