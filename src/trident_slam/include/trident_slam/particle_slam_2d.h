// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// Names and meanings are those of slam_gmapping.
struct ParticleSlamParams {
  int particles = 30;              ///< hypotheses of path and map
  double delta = 0.05;             ///< resolution of the maps [m]
  double maxUrange = 30.0;         ///< returns beyond it are not used [m]
  double linearUpdate = 0.5;       ///< travelled between two scans that update the maps [m]
  double angularUpdate = 0.5;      ///< turned between [rad]
  double temporalUpdate = -1.0;    ///< or that long after the last [s]; negative: never
  double resampleThreshold = 0.5;  ///< effective share of the particles below which they are drawn
  double srr = 0.1;                ///< odometry: error of translation by translation [m/m]
  double srt = 0.2;                ///< of translation by rotation [m/rad]
  double str = 0.1;                ///< of rotation by translation [rad/m]
  double stt = 0.2;                ///< of rotation by rotation [rad/rad]
  double ogain = 3.0;              ///< evens out the weights: beams are not independent
  double minimumScore = 0.0;       ///< beams that must fit to believe a match
  int lskip = 0;                   ///< beams left out between two that are matched
  std::uint64_t seed = 1;          ///< of the particles' draws

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& archive) {
    archive.field("particles", particles, Range{1, 10000}, "hypotheses of path and map");
    archive.field("delta", delta, Range{0.005, 1.0}, "resolution of the maps [m]");
    archive.field("maxUrange", maxUrange, Range::positive(), "returns beyond it are not used [m]");
    archive.field("linearUpdate", linearUpdate, Range::non_negative(),
                  "travelled between two scans that update the maps [m]");
    archive.field("angularUpdate", angularUpdate, Range::non_negative(), "turned between [rad]");
    archive.field("temporalUpdate", temporalUpdate, "or that long after; negative: never [s]");
    archive.field("resampleThreshold", resampleThreshold, Range{0.0, 1.0},
                  "effective share of the particles below which they are resampled");
    archive.field("srr", srr, Range::non_negative(), "translation's error by translation [m/m]");
    archive.field("srt", srt, Range::non_negative(), "translation's error by rotation [m/rad]");
    archive.field("str", str, Range::non_negative(), "rotation's error by translation [rad/m]");
    archive.field("stt", stt, Range::non_negative(), "rotation's error by rotation [rad/rad]");
    archive.field("ogain", ogain, Range::positive(), "evens out the weights");
    archive.field("minimumScore", minimumScore, Range::non_negative(),
                  "beams that must fit to believe a match: probabilities under them, summed");
    archive.field("lskip", lskip, Range{0, 1000}, "beams left out between two that are matched");
    archive.field("seed", seed, "of the particles' draws");
  }
};

/// Rao-Blackwellised particle filter: each particle is a path with the map that follows from it.
/// Poses are drawn from the improved proposal, the odometry's and the scan's likelihood together,
/// here by its Laplace approximation about the scan match; particles are resampled only when their
/// effective number falls (Grisetti, Stachniss, Burgard: Improved techniques for grid mapping with
/// Rao-Blackwellized particle filters, T-RO 2007). Maps of particles share what they have in
/// common.
class ParticleSlam2d : public Slam2d, public Slam2dOdometryUse {
 public:
  /// Throws Error for parameters out of range.
  explicit ParticleSlam2d(const ParticleSlamParams& params = {});
  ~ParticleSlam2d() override;

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  void set_uses_odometry(bool uses_odometry) override;
  /// Of the particle of largest weight.
  std::vector<StampedPose2d> trajectory() const override;
  OccupancyGrid map() const override;

  /// Of the distribution of the particles' poses, as slam_gmapping publishes it: -sum w ln w.
  double entropy() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident::slam
