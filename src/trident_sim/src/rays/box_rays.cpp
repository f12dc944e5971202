// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Rays against a box, lane by lane in float; loops over lanes are for vector instructions.
#include "box_rays.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace trident::sim {
namespace {

template <unsigned kLanes, class Value = float>
struct alignas(64) Lanes : std::array<Value, kLanes> {};

float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a < b ? b : a; }

/// Both are worked out in any case, as vectors are.
template <class Value>
Value chosen(int first, Value a, Value b) {
  return first != 0 ? a : b;
}

/// Embree's rays, component by component.
struct RayLanes {
  const float *org_x, *org_y, *org_z, *dir_x, *dir_y, *dir_z, *t_min;
  float* t_max;

  RayLanes(RTCRayN* rays, unsigned count)
      : org_x(&RTCRayN_org_x(rays, count, 0)),
        org_y(&RTCRayN_org_y(rays, count, 0)),
        org_z(&RTCRayN_org_z(rays, count, 0)),
        dir_x(&RTCRayN_dir_x(rays, count, 0)),
        dir_y(&RTCRayN_dir_y(rays, count, 0)),
        dir_z(&RTCRayN_dir_z(rays, count, 0)),
        t_min(&RTCRayN_tnear(rays, count, 0)),
        t_max(&RTCRayN_tfar(rays, count, 0)) {}
};

/// Where rays begin, seen from the middle of the box but in the axes of its scene.
template <unsigned kLanes>
struct Origins {
  Lanes<kLanes> x, y, z;
  Lanes<kLanes> slack_m;  ///< by which roundings may displace a ray where it hits the box

  Origins(const Eigen::Vector3d& p, const RayLanes& rays) {
    // In two floats, lest it is rounded: two boxes far from the origin must still lie side by side.
    const Eigen::Vector3f high = p.cast<float>(), low = (p - high.cast<double>()).cast<float>();
    constexpr float kSlack = 2.4e-7F;  // two units in the last place
    for (unsigned i = 0; i < kLanes; ++i) {
      x[i] = (rays.org_x[i] - high.x()) - low.x();
      y[i] = (rays.org_y[i] - high.y()) - low.y();
      z[i] = (rays.org_z[i] - high.z()) - low.z();
      slack_m[i] = kSlack * (std::abs(x[i]) + std::abs(y[i]) + std::abs(z[i]));
    }
  }
};

/// Where rays cross the two faces of one axis.
template <unsigned kLanes>
struct Slab {
  Lanes<kLanes> enter, leave;
  Lanes<kLanes, std::uint32_t> front, back;  ///< primitives

  /// Along a face both are infinite of one sign, or of both between them; not numbers on the edge.
  void cross(std::uint32_t low_face, const Eigen::Vector3f& axis, float half_m,
             const RayLanes& rays, const Origins<kLanes>& from) {
    const float u = axis.x(), v = axis.y(), w = axis.z();
    for (unsigned i = 0; i < kLanes; ++i) {
      const float origin = u * from.x[i] + v * from.y[i] + w * from.z[i];
      const float direction = u * rays.dir_x[i] + v * rays.dir_y[i] + w * rays.dir_z[i];
      const float inverse = 1.0F / direction, half = half_m + from.slack_m[i];
      const float low = (-half - origin) * inverse, high = (half - origin) * inverse;
      enter[i] = smaller(low, high);
      leave[i] = larger(low, high);
      const std::uint32_t backwards = direction < 0.0F ? 2U : 0U;
      front[i] = low_face + backwards;
      back[i] = low_face + 2U - backwards;
    }
  }
};

/// Rays of a packet and a box.
template <unsigned kLanes>
class Crossing {
 public:
  Crossing(const TracedShape& box, const RayLanes& rays, const int* valid) {
    const Origins<kLanes> from(box.p_scene_shape, rays);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      slabs_[axis].cross(4U * axis, box.R_scene_shape.col(axis).cast<float>(),
                         static_cast<float>(box.half_size[axis]), rays, from);
    }
    const auto& [x, y, z] = slabs_;
    for (unsigned i = 0; i < kLanes; ++i) {
      enter_[i] = larger(larger(x.enter[i], y.enter[i]), z.enter[i]);
      leave_[i] = smaller(smaller(x.leave[i], y.leave[i]), z.leave[i]);
    }
    for (unsigned i = 0; i < kLanes; ++i) {
      from_outside_[i] = enter_[i] >= rays.t_min[i] ? -1 : 0;
    }
    for (unsigned i = 0; i < kLanes; ++i) {
      t_[i] = chosen(from_outside_[i], enter_[i], leave_[i]);
    }
    for (unsigned i = 0; i < kLanes; ++i) {
      hit_[i] = valid[i] & (enter_[i] <= leave_[i] ? -1 : 0) & (t_[i] >= rays.t_min[i] ? -1 : 0) &
                (t_[i] <= rays.t_max[i] ? -1 : 0);
    }
  }

  bool any_hit() const {
    int any = 0;
    for (unsigned i = 0; i < kLanes; ++i) any |= hit_[i];
    return any != 0;
  }
  /// Puts in what a ray that hits the box makes of a number that Embree keeps.
  template <class Value>
  void keep(const Lanes<kLanes, Value>& values, Value* kept) const {
    for (unsigned i = 0; i < kLanes; ++i) kept[i] = chosen(hit_[i], values[i], kept[i]);
  }
  template <class Value>
  void keep(Value value, Value* kept) const {
    for (unsigned i = 0; i < kLanes; ++i) kept[i] = chosen(hit_[i], value, kept[i]);
  }
  const Lanes<kLanes>& t() const { return t_; }

  /// The last face of those through which a ray enters, or the first through which it leaves.
  Lanes<kLanes, unsigned> primitives() const {
    const auto& [x, y, z] = slabs_;
    Lanes<kLanes, unsigned> front, back;
    // One choice a loop: more are not turned into vectors.
    for (unsigned i = 0; i < kLanes; ++i) {
      front[i] = chosen(enter_[i] == y.enter[i], y.front[i], x.front[i]);
      back[i] = chosen(leave_[i] == y.leave[i], y.back[i], x.back[i]);
    }
    for (unsigned i = 0; i < kLanes; ++i) {
      front[i] = chosen(enter_[i] == z.enter[i], z.front[i], front[i]);
      back[i] = chosen(leave_[i] == z.leave[i], z.back[i], back[i]);
    }
    for (unsigned i = 0; i < kLanes; ++i) front[i] = chosen(from_outside_[i], front[i], back[i]);
    return front;
  }

 private:
  std::array<Slab<kLanes>, 3> slabs_;
  Lanes<kLanes> enter_, leave_, t_;
  Lanes<kLanes, int> from_outside_, hit_;  ///< -1, or 0
};

template <unsigned kLanes>
void intersect(const TracedShape& box, const RTCIntersectFunctionNArguments& asked) {
  const RayLanes rays(RTCRayHitN_RayN(asked.rayhit, kLanes), kLanes);
  const Crossing<kLanes> crossing(box, rays, asked.valid);
  if (!crossing.any_hit()) return;
  RTCHitN* const hits = RTCRayHitN_HitN(asked.rayhit, kLanes);
  crossing.keep(crossing.t(), rays.t_max);
  crossing.keep(crossing.primitives(), &RTCHitN_primID(hits, kLanes, 0));
  crossing.keep(asked.geomID, &RTCHitN_geomID(hits, kLanes, 0));
  crossing.keep(asked.context->instID[0], &RTCHitN_instID(hits, kLanes, 0, 0));
}

template <unsigned kLanes>
void occlude(const TracedShape& box, const RTCOccludedFunctionNArguments& asked) {
  const RayLanes rays(asked.ray, kLanes);
  const Crossing<kLanes> crossing(box, rays, asked.valid);
  if (crossing.any_hit()) crossing.keep(-std::numeric_limits<float>::infinity(), rays.t_max);
}

}  // namespace

void intersect_box(const TracedShape& box, const RTCIntersectFunctionNArguments& asked) {
  switch (asked.N) {
    case 16:
      return intersect<16>(box, asked);
    case 8:
      return intersect<8>(box, asked);
    case 4:
      return intersect<4>(box, asked);
    default:
      return intersect<1>(box, asked);
  }
}

void occlude_box(const TracedShape& box, const RTCOccludedFunctionNArguments& asked) {
  switch (asked.N) {
    case 16:
      return occlude<16>(box, asked);
    case 8:
      return occlude<8>(box, asked);
    case 4:
      return occlude<4>(box, asked);
    default:
      return occlude<1>(box, asked);
  }
}

}  // namespace trident::sim
