// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/surfel_map.h"

#include <cmath>
#include <limits>

namespace trident {
namespace {

/// Cosine of the angle between normals up to which points belong to one face (60 degrees).
constexpr float kSameFace = 0.5F;

bool is_same_face(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  if (a.isZero(0.0F) || b.isZero(0.0F)) return a.isZero(0.0F) == b.isZero(0.0F);
  return a.dot(b) > kSameFace;
}

/// Offsets of ring r, the cells at Chebyshev distance r, for r = 0 .. kMaxRings.
constexpr int kMaxRings = 4;

struct Rings {
  std::vector<Eigen::Vector2i> offsets[kMaxRings + 1];
  Rings() {
    for (int y = -kMaxRings; y <= kMaxRings; ++y) {
      for (int x = -kMaxRings; x <= kMaxRings; ++x) {
        offsets[std::max(std::abs(x), std::abs(y))].emplace_back(x, y);
      }
    }
  }
};

const Rings& rings_of_offsets() {
  static const Rings rings;
  return rings;
}

}  // namespace

int SurfelMap::cell_of(float value) const {
  return static_cast<int>(std::floor(value * per_metre_));
}

void SurfelMap::insert_point(const SurfacePoint& point, int owner) {
  const int x = cell_of(point.p.x());
  const int y = cell_of(point.p.y());
  std::int32_t& first = first_.at(x, y);
  if (first == 0) touched_.emplace_back(x, y);
  for (std::int32_t i = first; i != 0; i = surfels_[i - 1].next) {
    Surfel& surfel = surfels_[i - 1];
    if (is_hidden(surfel.owner) || !is_same_face(surfel.normal, point.normal)) continue;
    surfel.count += 1.0F;
    surfel.mean += (point.p - surfel.mean) / surfel.count;
    surfel.normal_sum += point.normal;
    if (point.has_normal()) surfel.normal = surfel.normal_sum.normalized();
    return;
  }
  Surfel surfel;
  surfel.mean = point.p;
  surfel.normal = surfel.normal_sum = point.normal;
  surfel.count = 1.0F;
  surfel.next = first;
  surfel.owner = owner;
  surfels_.push_back(surfel);
  first = static_cast<std::int32_t>(surfels_.size());
}

void SurfelMap::insert(const SE2& T_map_base, const PointScan& scan, int owner) {
  const Eigen::Matrix2f R = T_map_base.rotation().cast<float>();
  const Eigen::Vector2f t = T_map_base.p.cast<float>();
  for (const SurfacePoint& point : scan.points) {
    insert_point({R * point.p + t, R * point.normal}, owner);
  }
}

void SurfelMap::clear() {
  for (const Eigen::Vector2i& cell : touched_) first_.at(cell.x(), cell.y()) = 0;
  touched_.clear();
  surfels_.clear();
}

const Surfel* SurfelMap::nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal,
                                 int rings) const {
  const int x = cell_of(p.x());
  const int y = cell_of(p.y());
  const Surfel* best = nullptr;
  float best_distance = std::numeric_limits<float>::max();
  for (int ring = 0; ring <= std::min(rings, kMaxRings); ++ring) {
    for (const Eigen::Vector2i& offset : rings_of_offsets().offsets[ring]) {
      for (std::int32_t i = first_.get(x + offset.x(), y + offset.y()); i != 0;
           i = surfels_[i - 1].next) {
        const Surfel& surfel = surfels_[i - 1];
        const float distance = (surfel.mean - p).squaredNorm();
        if (distance < best_distance && is_same_face(surfel.normal, normal) &&
            !is_hidden(surfel.owner)) {
          best = &surfel;
          best_distance = distance;
        }
      }
    }
    if (best != nullptr && ring > 0) break;  // what lies a ring farther out can hardly be nearer
  }
  return best;
}

}  // namespace trident
