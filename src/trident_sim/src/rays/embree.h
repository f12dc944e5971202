// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <cmath>
#include <memory>
#include <vector>

#include "ray_shape.h"

namespace trident::sim {

struct ReleaseDevice {
  using pointer = RTCDevice;
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  using pointer = RTCScene;
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  using pointer = RTCGeometry;
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using EmbreeDevice = std::unique_ptr<RTCDevice, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCScene, ReleaseScene>;
using EmbreeGeometry = std::unique_ptr<RTCGeometry, ReleaseGeometry>;

/// Embree's context with what the sensor does not see, for the callbacks.
struct CastContext {
  RTCIntersectContext embree;  ///< first: callbacks get its address
  const RayFilter* filter;
  bool shadows_only;  ///< only what casts shadows counts
};
/// For casts with `filter`; embree.filter is set where triangles must be asked one by one.
CastContext make_context(const RayFilter& filter, bool shadows_only, bool some_cast_no_shadow);

/// A component of a direction as Embree is given it. Embree 3.13.5 takes what is below 1e-18 for
/// positive, and loses whole coherent packets when some of that are negative: the beams of a lidar
/// that is all but level.
inline float traceable(float component) { return std::abs(component) < 1e-12F ? 0.0F : component; }

/// Builds on the calling thread alone, so that what it builds is always the same. Throws Error.
EmbreeDevice make_device();
enum class SceneUse { kFixed, kMoving };
EmbreeScene make_scene(RTCDevice device, SceneUse use);

/// How Embree intersects the boxes of a scene. As a shape of ours a box takes less than half the
/// time of its twelve triangles for a lidar's beams.
enum class BoxForm { kOwn, kTriangles };

/// Adds a shape to a scene, at R_scene_shape and p_scene_shape; `shape` must outlive it. Its number
/// there is the count of those before it. Not for planes.
void attach_shape(RTCDevice device, RTCScene scene, const TracedShape& shape, BoxForm boxes);
/// An instance of `part`, committed at its place.
EmbreeGeometry attach_instance(RTCDevice device, RTCScene scene, RTCScene part, const SE3& T);
void place_instance(RTCGeometry instance, const SE3& T_world_link);

}  // namespace trident::sim
