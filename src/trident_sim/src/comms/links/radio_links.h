// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "comms/links/path_loss.h"
#include "comms/links/radio_end.h"
#include "comms/mac/radio_params.h"
#include "trident_sim/sea.h"
#include "trident_sim/state_archive.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Of a pair of radios.
struct LinkLoss {
  double whole_db = 0.0;      ///< antennas included
  double obstacles_db = 0.0;  ///< of it by what is in the path
};

/// The losses between the radios of a world. That of a pair is worked out when it is asked for, and
/// again once an end has moved by 0.1 m, or things have come to the world or gone.
class RadioLinks : public LinkLosses {
 public:
  /// `world` must outlive it.
  RadioLinks(World& world, const PathLossParams& params);

  /// The radio of a station; nullptr: it is gone.
  void set_end(int station, std::shared_ptr<const RadioEnd> end);
  /// Everything stands where it does now until this is called again.
  void follow();

  double loss_db(int a, int b) override;
  /// The same as it is now, without an influence on what loss_db() returns afterwards.
  LinkLoss present_loss(int a, int b);
  /// Of the station's antenna, now, world frame [m].
  const Eigen::Vector3d& position(int station) { return pose(station).p; }
  /// From antenna to antenna, now [m].
  double distance_m(int a, int b);
  /// The station's radio; never that of one that is gone.
  const RadioEnd& end(int station) const { return *ends_[static_cast<std::size_t>(station)]; }

  /// Forgets what was worked out.
  void clear() { pairs_.clear(); }
  void state(StateArchive& archive) { archive(pairs_); }

 private:
  struct Pair {
    Eigen::Vector3d p_first, p_second;
    std::size_t models = 0;  ///< in the world
    double loss_db = 0.0;
  };
  using Key = std::pair<int, int>;  ///< the smaller number first

  const SE3& pose(int station);
  LinkLoss work_out(int first, int second);
  double shadow_db(Key key);

  World& world_;
  PathLossParams params_;
  PathLoss path_loss_;
  Surroundings around_;
  bool is_fresh_ = false;  ///< the ray scene is
  std::vector<std::shared_ptr<const RadioEnd>> ends_;
  std::vector<std::optional<SE3>> poses_;
  std::map<Key, Pair> pairs_;
  std::map<Key, ShadowField> shadows_;
};

}  // namespace trident::sim
