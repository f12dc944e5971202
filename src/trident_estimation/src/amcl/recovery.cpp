// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0

// The part of Amcl that finds a robot which is lost.

#include <algorithm>

#include "amcl/draws.h"
#include "amcl/fast_math.h"
#include "trident_estimation/amcl.h"

namespace trident::estimation {
namespace {

constexpr std::size_t kMatchedPoints = 90;  // of a scan, that is looked for in the whole map
constexpr double kClearlyBetter = 0.1;      // share of beams by which a hypothesis must be better
constexpr double kInjectedSigma = 0.08;     // [m]
constexpr double kInjectedSigmaYaw = 0.03;  // [rad]
constexpr std::size_t kParticlesPerHypothesis = 100;
constexpr int kMaxPatience = 32;  // times recovery_patience

/// Few enough for the search, evenly from the scan.
maps::ScanPoints thinned(const maps::ScanPoints& points) {
  maps::ScanPoints result;
  result.p_base_laser = points.p_base_laser;
  const std::size_t step = points.p_base.size() / kMatchedPoints + 1;
  for (std::size_t i = 0; i < points.p_base.size(); i += step) {
    result.p_base.push_back(points.p_base[i]);
  }
  return result;
}

}  // namespace

/// Sums up by how much the estimate explains too little of the scans, over updates in a row (a
/// cumulative sum: Page, "Continuous inspection schemes", 1954): a scan that nearly fits says less
/// than one that does not fit at all, which counts as one.
bool Amcl::is_search_due() {
  const bool is_explained = estimate_.agreement >= params_.recovery_agreement;
  if (is_explained) {
    recovery_.disagreement = 0.0;
    recovery_.patience = params_.recovery_patience;
  } else {
    const double lacking = 1.0 - estimate_.agreement / params_.recovery_agreement;
    recovery_.disagreement += std::min(2.0 * lacking, 1.0);
  }
  return recovery_.is_anywhere || recovery_.disagreement >= recovery_.patience;
}

/// Looks for the scan in the whole map where the estimate does not explain it; less and less often
/// where no place explains it better, as among crowds or on an old map.
void Amcl::recover(const ScanBeams& beams, AmclStep& step) {
  estimate_.agreement = agreement(beams);
  if (!matcher_ || !is_search_due()) return;
  step.is_searched = true;
  std::vector<maps::PoseHypothesis> hypotheses = matcher_->match(thinned(beams.points));
  const double least = recovery_.is_anywhere ? 0.0 : estimate_.agreement + kClearlyBetter;
  hypotheses.erase(std::remove_if(hypotheses.begin(), hypotheses.end(),
                                  [least](const auto& h) { return h.agreement < least; }),
                   hypotheses.end());
  recovery_.is_anywhere = false;
  recovery_.disagreement = 0.0;
  step.hypotheses = hypotheses.size();
  if (hypotheses.empty()) {
    recovery_.patience = std::min(2 * recovery_.patience, kMaxPatience * params_.recovery_patience);
  } else {
    inject(hypotheses, beams);
  }
}

/// Half of the particles stay as they were, the others go to the hypotheses; all are weighed again.
void Amcl::inject(const std::vector<maps::PoseHypothesis>& hypotheses, const ScanBeams& beams) {
  const auto most = static_cast<std::size_t>(params_.max_particles);
  const std::size_t each =
      std::max<std::size_t>(1, std::min(kParticlesPerHypothesis, most / (2 * hypotheses.size())));
  const std::size_t fresh = each * hypotheses.size();
  const std::size_t kept =
      std::min(particles_.size(), std::min(fresh, most - std::min(fresh, most)));
  ++random_.count;
  make_guide();
  next_.clear();
  for (std::uint64_t i = 0; i < kept; ++i) {
    const std::size_t parent =
        chosen(to_unit(random_.stream.bits((random_.count << 32) | i, kChoice)));
    next_.push_back(particles_.x[parent], particles_.y[parent], particles_.yaw[parent]);
  }
  for (const maps::PoseHypothesis& hypothesis : hypotheses) {
    const SE2 T_grid_base = free_space_.T_map_origin.inverse() * hypothesis.T_map_base;
    for (std::size_t i = 0; i < each; ++i) {
      const auto away = random_.stream.normals4((random_.count << 32) | next_.size(), kScatterX);
      const auto sigma = static_cast<float>(kInjectedSigma);
      next_.push_back(static_cast<float>(T_grid_base.p.x()) + sigma * away[0],
                      static_cast<float>(T_grid_base.p.y()) + sigma * away[1],
                      fast::wrapped(static_cast<float>(T_grid_base.angle) +
                                    static_cast<float>(kInjectedSigmaYaw) * away[2]));
    }
  }
  std::swap(particles_, next_);
  particles_.set_equal_weights();
  mean_weights_.slow = mean_weights_.fast = laser_.weigh(beams, particles_);
  particles_.normalize();
  update_estimate();
  estimate_.agreement = agreement(beams);
}

/// Unknown space is where maps end and behind furniture: a robot that is driven there is not lost.
double Amcl::agreement(const ScanBeams& beams) const {
  const SE2 T_grid_base = free_space_.T_map_origin.inverse() * estimate_.T_map_base;
  return maps::scan_agreement(laser_.field(), known_, beams.points, T_grid_base);
}

}  // namespace trident::estimation
