// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trident_base/se2.h"

namespace trident::estimation {

/// Weighted poses, one array per coordinate so that loops over them vectorise. Poses are in the
/// grid frame (see DistanceField); yaw in [-pi, pi]. Weights sum to one.
struct ParticleSet {
  std::vector<float> x, y;     ///< [m]
  std::vector<float> yaw;      ///< [rad]
  std::vector<double> weight;  ///< not normalized while it is worked on

  std::size_t size() const { return x.size(); }  ///< particles
  void clear();                                  ///< keeps the memory
  /// Makes room for so many particles, so that none is moved while they are added.
  void reserve(std::size_t count);
  /// Adds a pose without a weight: set_equal_weights() gives all of them one.
  void push_back(float px, float py, float heading) {
    x.push_back(px);
    y.push_back(py);
    yaw.push_back(heading);
  }
  /// All the same, for as many as there are poses.
  void set_equal_weights();
  /// Makes the sum one; where it is zero or not finite all become equal. Returns the sum before.
  double normalize();
  /// 1 / sum w^2: how many particles count.
  double effective_count() const;
  /// Of particle i, in the frame that the particles are in.
  SE2 pose(std::size_t i) const;
};

/// One group of particles that hang together.
struct PoseCluster {
  double weight = 0.0;                                   ///< sum over its particles
  SE2 T_grid_base;                                       ///< weighted mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x [m], y [m], yaw [rad])
  std::size_t count = 0;                                 ///< its particles
};

/// Counts the cells of pose space, 0.5 m x 0.5 m x 10 degrees, in which particles lie; for the
/// number of particles that KLD-sampling asks for, and for clusters. Reused from update to update
/// without allocation.
class PoseHistogram {
 public:
  /// Forgets all, and makes room.
  void reset(std::size_t most_particles);
  /// Returns the index of the particle's cell; those of new cells count up from zero.
  std::uint32_t insert(float x, float y, float yaw);
  std::size_t cell_count() const { return keys_.size(); }  ///< cells with a particle in them

  /// Groups of particles whose cells touch, those of the largest weight first. Fills the histogram
  /// with the particles.
  std::vector<PoseCluster> clusters(const ParticleSet& particles);

 private:
  struct Moments;
  std::uint32_t* slot_of(std::uint64_t key);
  std::vector<std::uint32_t> join_neighbors();

  std::vector<std::uint32_t> table_;  ///< cell index + 1, 0: empty; a power of two
  std::vector<std::uint64_t> keys_;   ///< of cells
};

/// How many particles keep the Kullback-Leibler distance below `kld_err` with the probability of
/// which `kld_z` is the quantile, when they lie in `cells` cells (Fox, "Adapting the sample size in
/// particle filters through KLD-sampling", IJRR 2003, equation 7).
std::size_t kld_sample_size(std::size_t cells, double kld_err, double kld_z);

}  // namespace trident::estimation
