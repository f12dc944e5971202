// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "moving_parts.h"

#include <algorithm>
#include <limits>

namespace trident::sim {
namespace {

constexpr std::size_t kLanes = RayScene::kPacket;

PacketBounds turned(const PacketBounds& bounds, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& p) {
  const Eigen::Map<const Eigen::Vector3f> low(bounds.low.data()), high(bounds.high.data());
  const Eigen::Vector3d middle = R * (0.5F * (low + high)).cast<double>() + p;
  // The box about the turned box.
  const Eigen::Vector3d half = R.cwiseAbs() * (0.5F * (high - low)).cast<double>();
  PacketBounds result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    result.low[i] = static_cast<float>(middle[axis] - half[axis]);
    result.high[i] = static_cast<float>(middle[axis] + half[axis]);
  }
  return with_slack(result);
}

PacketBounds joined(const PacketBounds& a, const PacketBounds& b) {
  PacketBounds all;
  for (std::size_t i = 0; i < 3; ++i) {
    all.low[i] = std::min(a.low[i], b.low[i]);
    all.high[i] = std::max(a.high[i], b.high[i]);
  }
  return all;
}

}  // namespace

void MovingParts::clear() {
  parts_.clear();
  places_.clear();
  scene_.reset();
}

std::size_t MovingParts::add(RTCScene scene, const SE3& T_world_link) {
  Part part{};
  part.scene = scene;
  part.bounds_link = bounds_of(scene);
  set_place(part, T_world_link);
  parts_.push_back(std::move(part));
  places_.push_back(T_world_link);
  return parts_.size() - 1;
}

/// Keeps the inverse pose in single precision, in which rays are turned into the link's frame.
void MovingParts::set_place(Part& part, const SE3& T_world_link) {
  const Eigen::Matrix3d R = T_world_link.R.toRotationMatrix();
  part.bounds_world = turned(part.bounds_link, R, T_world_link.p);
  part.R_link_world = R.transpose().cast<float>();
  part.p_link_world = (-(R.transpose() * T_world_link.p)).cast<float>();
}

void MovingParts::place(std::size_t part, const SE3& T_world_link) {
  places_[part] = T_world_link;
  set_place(parts_[part], T_world_link);
  if (parts_[part].instance != nullptr) {
    place_instance(parts_[part].instance.get(), T_world_link);
  }
}

/// Up to kFew parts are tested one by one, by their boxes; more are instanced in a scene of their
/// own, whose tree is built again whenever one has moved.
void MovingParts::commit(RTCDevice device) {
  if (parts_.empty()) return;
  bounds_ = parts_.front().bounds_world;
  for (const Part& part : parts_) bounds_ = joined(bounds_, part.bounds_world);
  if (parts_.size() <= kFew) return;
  if (scene_ == nullptr) {
    scene_ = make_scene(device, SceneUse::kMoving);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      parts_[i].instance = attach_instance(device, scene_.get(), parts_[i].scene, places_[i]);
    }
  }
  rtcCommitScene(scene_.get());
}

/// Sixteen rays at once, component by component, so that the compiler vectorizes it.
void MovingParts::turn_into(const Part& part, const RTCRay16& rays, RTCRay16& turned) {
  turned = rays;
  const Eigen::Matrix3f& R = part.R_link_world;
  const Eigen::Vector3f& p = part.p_link_world;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = rays.org_x[i], y = rays.org_y[i], z = rays.org_z[i];
    turned.org_x[i] = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + p.x();
    turned.org_y[i] = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + p.y();
    turned.org_z[i] = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + p.z();
    const float u = rays.dir_x[i], v = rays.dir_y[i], w = rays.dir_z[i];
    turned.dir_x[i] = R(0, 0) * u + R(0, 1) * v + R(0, 2) * w;
    turned.dir_y[i] = R(1, 0) * u + R(1, 1) * v + R(1, 2) * w;
    turned.dir_z[i] = R(2, 0) * u + R(2, 1) * v + R(2, 2) * w;
  }
}

/// Each part shortens the rays that hit it (tfar), so that what lies behind is not found later.
void MovingParts::intersect(const Lanes& valid, RTCRayHit16& rays, CastContext& context) const {
  if (parts_.empty() || all_leave(bounds_, rays.ray)) return;
  alignas(64) Lanes near = valid;
  const PacketSlopes slopes(rays.ray);
  if (!keep_lanes_that_hit(bounds_, rays.ray, slopes, near)) return;
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  if (scene_ != nullptr) {
    rtcIntersect16(near.data(), scene_.get(), &context.embree, &rays);
    return;
  }
  alignas(64) RTCRayHit16 local;
  for (std::size_t number = 0; number < parts_.size(); ++number) {
    const Part& part = parts_[number];
    alignas(64) Lanes lanes = near;
    if (!keep_lanes_that_hit(part.bounds_world, rays.ray, slopes, lanes)) continue;
    turn_into(part, rays.ray, local.ray);
    std::fill_n(local.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(lanes.data(), part.scene, &context.embree, &local);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (lanes[i] == 0 || local.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      rays.ray.tfar[i] = local.ray.tfar[i];
      rays.hit.geomID[i] = local.hit.geomID[i];
      rays.hit.primID[i] = local.hit.primID[i];
      rays.hit.instID[0][i] = static_cast<unsigned>(number);
    }
  }
}

/// A shadow ray needs any hit: lanes that have one are left out of the parts that follow. Embree
/// marks it by tfar = -infinity.
void MovingParts::occlude(const Lanes& valid, RTCRay16& rays, CastContext& context) const {
  if (parts_.empty() || all_leave(bounds_, rays)) return;
  alignas(64) Lanes near = valid;
  const PacketSlopes slopes(rays);
  if (!keep_lanes_that_hit(bounds_, rays, slopes, near)) return;
  if (scene_ != nullptr) {
    rtcOccluded16(near.data(), scene_.get(), &context.embree, &rays);
    return;
  }
  alignas(64) RTCRay16 local;
  for (const Part& part : parts_) {
    alignas(64) Lanes lanes = near;
    if (!keep_lanes_that_hit(part.bounds_world, rays, slopes, lanes)) continue;
    turn_into(part, rays, local);
    rtcOccluded16(lanes.data(), part.scene, &context.embree, &local);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (lanes[i] == 0 || local.tfar[i] >= 0.0F) continue;
      rays.tfar[i] = -std::numeric_limits<float>::infinity();
      near[i] = 0;
    }
  }
}

}  // namespace trident::sim
