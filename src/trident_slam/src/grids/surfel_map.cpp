// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "surfel_map.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace trident::slam {
namespace {

constexpr int kMaxRings = SurfelMap::kMaxRings;

/// Cosine of the angle between normals up to which points belong to one face (60 degrees).
constexpr float kSameFace = 0.5F;

bool is_zero(const Eigen::Vector2f& v) { return v.x() == 0.0F && v.y() == 0.0F; }

bool is_same_face(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  const float cosine = a.x() * b.x() + a.y() * b.y();
  return cosine > kSameFace || (cosine == 0.0F && is_zero(a) && is_zero(b));
}

/// Offsets of ring r, the cells at Chebyshev distance r, for r = 0 .. kMaxRings.
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

const Rings kRings;

/// Squared distances from a point to the cells that are -kMaxRings .. kMaxRings away.
class Gaps {
 public:
  /// The point is this far above the lower edge of its cell.
  Gaps(float below, float cell) {
    for (int k = 1; k <= kMaxRings; ++k) {
      const float lower = below + static_cast<float>(k - 1) * cell;
      const float upper = static_cast<float>(k) * cell - below;
      squared_[kMaxRings - k] = lower * lower;
      squared_[kMaxRings + k] = upper * upper;
    }
  }
  float to(int offset) const { return squared_[kMaxRings + offset]; }

 private:
  std::array<float, 2 * kMaxRings + 1> squared_ = {};
};

}  // namespace

inline SurfelMap::Place SurfelMap::place_of(const Eigen::Vector2f& p) const {
  Place place;
  for (const int axis : {0, 1}) {
    const float cells = p(axis) * per_meter_;
    const int truncated = static_cast<int>(cells);
    const int cell = truncated - (cells < static_cast<float>(truncated) ? 1 : 0);
    place.cell(axis) = cell;
    place.below(axis) = (cells - static_cast<float>(cell)) * static_cast<float>(cell_);
  }
  return place;
}

void SurfelMap::mark_neighbors(const Eigen::Vector2i& cell) {
  // Room for the neighbors of every cell marked here: nearest() reads without checks.
  constexpr int kRoom = 2 * kMaxRings;
  first_.reserve(cell.x() - kRoom, cell.y() - kRoom, cell.x() + kRoom, cell.y() + kRoom);
  for (int ring = 1; ring <= kMaxRings; ++ring) {
    for (const Eigen::Vector2i& offset : kRings.offsets[ring]) {
      std::int32_t& first = first_.at(cell.x() + offset.x(), cell.y() + offset.y());
      if (first == 0 || first < -ring) first = -ring;
    }
  }
}

/// A cell may hold several surfels, one for each side of a thin wall. Mean and normal are running
/// means over the points; surfels of hidden submaps are left as they are.
void SurfelMap::insert_point(const SurfacePoint& point, int owner) {
  const Eigen::Vector2i cell = place_of(point.p).cell;
  std::int32_t first = std::max(first_.get(cell.x(), cell.y()), 0);
  if (first == 0) {
    touched_.push_back(cell);
    mark_neighbors(cell);
  }
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
  first_.at(cell.x(), cell.y()) = static_cast<std::int32_t>(surfels_.size());
}

void SurfelMap::insert(const SE2& T_map_base, const PointScan& scan, int owner) {
  const Eigen::Matrix2f R = T_map_base.rotation().cast<float>();
  const Eigen::Vector2f t = T_map_base.p.cast<float>();
  for (const SurfacePoint& point : scan.points) {
    insert_point({R * point.p + t, R * point.normal}, owner);
  }
}

void SurfelMap::clear() {
  for (const Eigen::Vector2i& cell : touched_) {
    for (int y = cell.y() - kMaxRings; y <= cell.y() + kMaxRings; ++y) {
      std::int32_t* row = &first_.at(cell.x() - kMaxRings, y);
      std::fill(row, row + 2 * kMaxRings + 1, 0);
    }
  }
  touched_.clear();
  surfels_.clear();
}

const Surfel* SurfelMap::nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal,
                                 int rings) const {
  const Place place = place_of(p);
  const std::int32_t here = first_.get(place.cell.x(), place.cell.y());
  const int last_ring = std::min(rings, kMaxRings);
  int ring = here > 0 ? 0 : -here;
  if (here == 0 || ring > last_ring) return nullptr;
  const Gaps gaps_x(place.below.x(), static_cast<float>(cell_));
  const Gaps gaps_y(place.below.y(), static_cast<float>(cell_));
  const std::int32_t* first = &first_.cells()[first_.index(place.cell.x(), place.cell.y())];
  const std::ptrdiff_t width = first_.width();
  const Surfel* best = nullptr;
  float best_distance = std::numeric_limits<float>::max();
  for (; ring <= last_ring; ++ring) {
    for (const Eigen::Vector2i& offset : kRings.offsets[ring]) {
      std::int32_t i = first[offset.y() * width + offset.x()];
      if (i <= 0 || gaps_x.to(offset.x()) + gaps_y.to(offset.y()) >= best_distance) continue;
      for (; i != 0; i = surfels_[i - 1].next) {
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

}  // namespace trident::slam
