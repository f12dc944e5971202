// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/links/radio_links.h"

#include <algorithm>
#include <string>

namespace trident::sim {
namespace {

constexpr double kStale_m = 0.1;

bool has_moved(const Eigen::Vector3d& now, const Eigen::Vector3d& before) {
  return (now - before).squaredNorm() >= kStale_m * kStale_m;
}

}  // namespace

RadioLinks::RadioLinks(World& world, const PathLossParams& params)
    : world_(world), params_(params), path_loss_(world, params) {}

void RadioLinks::set_end(int station, std::shared_ptr<const RadioEnd> end) {
  const auto place = static_cast<std::size_t>(station);
  if (ends_.size() <= place) {
    ends_.resize(place + 1);
    poses_.resize(place + 1);
  }
  ends_[place] = std::move(end);
}

void RadioLinks::follow() {
  around_.look(world_);
  is_fresh_ = false;
  for (auto& pose : poses_) pose.reset();
}

const SE3& RadioLinks::pose(int station) {
  auto& known = poses_[static_cast<std::size_t>(station)];
  if (!known) known = end(station).T_world_antenna();
  return *known;
}

double RadioLinks::distance_m(int a, int b) { return (pose(a).p - pose(b).p).norm(); }

double RadioLinks::loss_db(int a, int b) {
  // Paths are reciprocal, so that a pair is worked out once.
  const Key key{std::min(a, b), std::max(a, b)};
  const Eigen::Vector3d& p_first = pose(key.first).p;
  const Eigen::Vector3d& p_second = pose(key.second).p;
  const std::size_t models = world_.models().size();
  const auto known = pairs_.find(key);
  if (known != pairs_.end() && known->second.models == models &&
      !has_moved(p_first, known->second.p_first) && !has_moved(p_second, known->second.p_second)) {
    return known->second.loss_db;
  }
  const double loss_db = work_out(key.first, key.second).whole_db;
  pairs_[key] = {p_first, p_second, models, loss_db};
  return loss_db;
}

LinkLoss RadioLinks::present_loss(int a, int b) { return work_out(std::min(a, b), std::max(a, b)); }

LinkLoss RadioLinks::work_out(int first, int second) {
  // Once in a step, and only if a loss is asked for.
  if (!is_fresh_) rays(world_, RayGeometry::kCollision).refresh();
  is_fresh_ = true;
  const RadioEnd &a = end(first), &b = end(second);
  const SE3 &T_a = pose(first), &T_b = pose(second);
  const Eigen::Vector3d path = T_b.p - T_a.p;
  const double distance = path.norm();
  const Eigen::Vector3d along =
      distance > 1e-9 ? Eigen::Vector3d(path / distance) : Eigen::Vector3d::UnitX();
  const double wavelength = wavelength_m(channel_frequency_hz(a.params.channel));
  LinkLoss loss;
  loss.obstacles_db =
      path_loss_.obstacles().loss_db({T_a.p, a.model}, {T_b.p, b.model}, wavelength);
  loss.whole_db = path_loss_.over_distance_db(T_a.p, T_b.p, wavelength, around_.sea(),
                                              world_.time().seconds()) +
                  loss.obstacles_db + shadow_db({first, second}) - a.gain_towards_dbi(T_a, along) -
                  b.gain_towards_dbi(T_b, -along);
  return loss;
}

// In the order of the names: numbers depend on who came first.
double RadioLinks::shadow_db(Key key) {
  if (end(key.second).name < end(key.first).name) std::swap(key.first, key.second);
  auto known = shadows_.find(key);
  if (known == shadows_.end()) {
    const std::string pair = end(key.first).name + "/" + end(key.second).name;
    const ShadowField field(params_.shadowing, world_.seed(), pair);
    known = shadows_.emplace(key, field).first;
  }
  return known->second.at(pose(key.first).p, pose(key.second).p);
}

}  // namespace trident::sim
