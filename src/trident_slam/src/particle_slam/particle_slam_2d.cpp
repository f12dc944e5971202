// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/particle_slam_2d.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "grids/probability_grid.h"
#include "motion/motion_filter.h"
#include "proposal.h"
#include "trident_base/random_stream.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/point_scan.h"
#include "trident_slam/slam_2d_factory.h"
#include "trident_slam/sweep_motion.h"

namespace trident::slam {
namespace {

constexpr double kPassed = 0.4;            ///< probability of a cell that a beam passed
constexpr double kEnded = 0.8;             ///< and of one where a beam ended
constexpr double kBeamsThatCount = 100.0;  ///< independent ones in a scan, for the pose
constexpr double kWeightGain =
    0.1;  ///< and for the weight, divided by ogain: maps share errors, too

/// A hypothesis. Copying its map is cheap: tiles that did not change are shared.
struct Particle {
  explicit Particle(const ProbabilityGrid& map) : map(map) {}
  ProbabilityGrid map;
  SE2 T_map_base;
  double log_weight = 0.0;
  int keyframe = -1;  ///< place of its newest pose in the tree of paths
};

/// A pose of a path; paths of particles that were drawn from one share their beginnings.
struct Keyframe {
  SE2 T_map_base;
  int parent = -1;
  int level = 0;  ///< number of updates before
};

/// A scan relative to the update before it.
struct Between {
  std::int64_t stamp_ns = 0;
  int level = 0;  ///< of that update; -1 before the first
  SE2 T_update_base;
};

}  // namespace

class ParticleSlam2d::Impl {
 public:
  explicit Impl(const ParticleSlamParams& params)
      : params_(params),
        update_filter_({params.linearUpdate, params.angularUpdate, params.temporalUpdate}),
        stream_(params.seed, "particle_slam_2d"),
        particles_(static_cast<std::size_t>(params.particles),
                   Particle(ProbabilityGrid(params.delta, kPassed, kEnded))) {}

  // Between updates of the maps all particles move alike, by one tracker: only updates cost by
  // particle.
  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) {
    ScanPose2d result = tracker_.add_scan(scan, T_odom_base);
    const SE2 T_before_now = tracked_.inverse() * result.T_map_base;
    since_update_.add(T_before_now, result.is_used && result.problem != "");
    tracked_ = result.T_map_base;
    if (result.is_used) use(scan, T_before_now, result);
    last_stamp_ns_ = scan.stamp_ns;
    const SE2 T_update_base = since_update_.T_update_base;
    result.T_map_base = best().T_map_base * T_update_base;
    betweens_.push_back({scan.stamp_ns, updates_ - 1, T_update_base});
    return result;
  }

  // The path of the best particle is read backwards through the tree of keyframes.
  std::vector<StampedPose2d> trajectory() const {
    std::vector<StampedPose2d> poses;
    std::vector<SE2> path(static_cast<std::size_t>(updates_));
    if (!keyframes_.empty()) {
      for (int k = best().keyframe; k >= 0; k = keyframes_[static_cast<std::size_t>(k)].parent) {
        const Keyframe& keyframe = keyframes_[static_cast<std::size_t>(k)];
        path[static_cast<std::size_t>(keyframe.level)] = keyframe.T_map_base;
      }
    }
    for (const Between& scan : betweens_) {
      const SE2 T_map_update =
          scan.level < 0 ? SE2::identity() : path[static_cast<std::size_t>(scan.level)];
      poses.push_back({scan.stamp_ns, T_map_update * scan.T_update_base});
    }
    return poses;
  }

  void set_uses_odometry(bool uses_odometry) { tracker_.set_uses_odometry(uses_odometry); }
  OccupancyGrid map() const { return best().map.occupancy(); }

  // 0 when one particle has all weight, ln n when all weigh the same.
  double entropy() const {
    double sum = 0.0;
    for (const double w : weights()) sum -= w > 0.0 ? w * std::log(w) : 0.0;
    return sum;
  }

 private:
  /// The path length since the maps were updated, as tracked.
  struct SinceUpdate {
    SE2 T_update_base;
    double meters = 0.0;
    double radians = 0.0;
    bool is_lost = false;
    void add(const SE2& T_before_now, bool had_problem) {
      T_update_base = T_update_base * T_before_now;
      meters += T_before_now.p.norm();
      radians += std::abs(T_before_now.angle);
      is_lost = is_lost || had_problem;
    }
  };

  void use(const LaserScan& scan, const SE2& T_before_now, ScanPose2d& result) {
    if (updates_ > 0 && !is_update_due(scan.stamp_ns)) return;
    PointScanOptions options;
    options.max_range = params_.maxUrange;
    const double seconds = 1e-9 * static_cast<double>(scan.stamp_ns - last_stamp_ns_);
    const PointScan points =
        make_point_scan(scan, options, sweep_twist(scan, T_before_now, seconds));
    if (updates_ > 0) update(points);
    for (Particle& particle : particles_) insert(particle, points);
    result.covariance = spread();
    ++updates_;
    update_stamp_ns_ = scan.stamp_ns;
    since_update_ = {};
  }

  // A tracker that had a problem may have lost the pose, which the particles' spread must find
  // again.
  bool is_update_due(std::int64_t stamp_ns) const {
    const double seconds = 1e-9 * static_cast<double>(stamp_ns - update_stamp_ns_);
    return since_update_.is_lost ||
           update_filter_.is_due(since_update_.meters, since_update_.radians, seconds);
  }

  PointScan thinned(PointScan points) const {
    const auto step = static_cast<std::size_t>(params_.lskip) + 1;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.points.size(); i += step) {
      points.points[kept++] = points.points[i];
    }
    points.points.resize(kept);
    return points;
  }

  // Neighboring beams have errors in common, so that a scan counts as a limited number of
  // independent ones.
  void update(const PointScan& whole) {
    const PointScan points = thinned(whole);
    const auto beams = static_cast<double>(points.points.size());
    const double beam_weight = std::min(1.0, kBeamsThatCount / std::max<double>(1.0, beams));
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      Particle& particle = particles_[i];
      const PoseGaussian motion = moved(particle.T_map_base);
      const Proposal proposal = propose(particle.map, points, motion, beam_weight);
      const bool is_believed = proposal.score * beams >= params_.minimumScore;
      particle.T_map_base = draw(is_believed ? proposal.pose : motion, i);
      particle.log_weight += proposal.log_evidence * kWeightGain / params_.ogain;
    }
    resample_if_due();
  }

  PoseGaussian moved(const SE2& T_map_base) const {
    constexpr double kMinSigma = 1e-3;  // [m], [rad]: a standing robot's pose is not exact either
    const double meters = since_update_.meters;
    const double radians = since_update_.radians;
    const double linear = std::hypot(params_.srr * meters, params_.srt * radians) + kMinSigma;
    const double angular = std::hypot(params_.str * meters, params_.stt * radians) + kMinSigma;
    const double lost = since_update_.is_lost ? 1.0 : 0.0;
    PoseGaussian result;
    result.T_map_base = T_map_base * since_update_.T_update_base;
    result.covariance = Eigen::Vector3d(linear + lost, linear + lost, angular + 0.5 * lost)
                            .cwiseAbs2()
                            .asDiagonal();
    return result;
  }

  SE2 draw(const PoseGaussian& pose, std::size_t particle) const {
    const auto channel = static_cast<std::uint32_t>(4 * particle);
    const auto sample = static_cast<std::uint64_t>(updates_);
    const Eigen::Vector3d n(stream_.normal(sample, channel), stream_.normal(sample, channel + 1),
                            stream_.normal(sample, channel + 2));
    const Eigen::Vector3d e = pose.covariance.llt().matrixL() * n;
    return SE2::from_xy_yaw(pose.T_map_base.p.x() + e[0], pose.T_map_base.p.y() + e[1],
                            pose.T_map_base.angle + e[2]);
  }

  void insert(Particle& particle, const PointScan& points) {
    particle.map.insert(particle.T_map_base, points);
    keyframes_.push_back({particle.T_map_base, particle.keyframe, updates_});
    particle.keyframe = static_cast<int>(keyframes_.size()) - 1;
  }

  std::vector<double> weights() const {
    double largest = particles_.front().log_weight;
    for (const Particle& particle : particles_) largest = std::max(largest, particle.log_weight);
    std::vector<double> w;
    double sum = 0.0;
    for (const Particle& particle : particles_) {
      w.push_back(std::exp(particle.log_weight - largest));
      sum += w.back();
    }
    for (double& value : w) value /= sum;
    return w;
  }

  /// Systematic draws (Arulampalam et al. 2002), as many as there are particles.
  std::vector<Particle> drawn_by(const std::vector<double>& w) const {
    const auto count = static_cast<double>(w.size());
    constexpr std::uint32_t kChannel = 0xFFFFFFF0;
    const double offset = stream_.uniform(static_cast<std::uint64_t>(updates_), kChannel);
    std::vector<Particle> drawn;
    double cumulative = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      cumulative += w[i] * count;
      while (static_cast<double>(drawn.size()) + offset < cumulative && drawn.size() < w.size()) {
        drawn.push_back(particles_[i]);
      }
    }
    while (drawn.size() < w.size()) drawn.push_back(particles_.back());
    return drawn;
  }

  /// When the effective number of particles is low.
  void resample_if_due() {
    const std::vector<double> w = weights();
    double sum_of_squares = 0.0;
    for (const double value : w) sum_of_squares += value * value;
    const auto count = static_cast<double>(w.size());
    if (1.0 / sum_of_squares >= params_.resampleThreshold * count) return;
    particles_ = drawn_by(w);
    for (Particle& particle : particles_) particle.log_weight = 0.0;
  }

  const Particle& best() const {
    return *std::max_element(
        particles_.begin(), particles_.end(),
        [](const Particle& a, const Particle& b) { return a.log_weight < b.log_weight; });
  }

  Eigen::Matrix3d spread() const {
    const std::vector<double> w = weights();
    const SE2 middle = best().T_map_base;
    Eigen::Matrix3d covariance = 1e-6 * Eigen::Matrix3d::Identity();
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const SE2 apart = middle.inverse() * particles_[i].T_map_base;
      Eigen::Vector3d e;
      e << middle.rotation() * apart.p, apart.angle;
      covariance += w[i] * e * e.transpose();
    }
    return covariance;
  }

  ParticleSlamParams params_;
  MotionFilter update_filter_;
  RandomStream stream_;
  HectorSlam2d tracker_;  ///< the motion from scan to scan
  SE2 tracked_;           ///< the base in the tracker's map
  std::vector<Particle> particles_;
  std::vector<Keyframe> keyframes_;
  std::vector<Between> betweens_;
  int updates_ = 0;
  std::int64_t update_stamp_ns_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  SinceUpdate since_update_;
};

ParticleSlam2d::ParticleSlam2d(const ParticleSlamParams& params)
    : impl_(std::make_unique<Impl>(params)) {}

ParticleSlam2d::~ParticleSlam2d() = default;

ScanPose2d ParticleSlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  return impl_->add_scan(scan, T_odom_base);
}

void ParticleSlam2d::set_uses_odometry(bool uses_odometry) {
  impl_->set_uses_odometry(uses_odometry);
}

std::vector<StampedPose2d> ParticleSlam2d::trajectory() const { return impl_->trajectory(); }

OccupancyGrid ParticleSlam2d::map() const { return impl_->map(); }

double ParticleSlam2d::entropy() const { return impl_->entropy(); }

TRIDENT_SLAM_2D_METHOD(particle_slam_2d, "particle_slam_2d", ParticleSlam2d, ParticleSlamParams)

}  // namespace trident::slam
