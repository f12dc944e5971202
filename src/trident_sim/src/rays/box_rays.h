// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include "ray_shape.h"

namespace trident::sim {

// A box as one primitive of Embree's, intersected by its three pairs of faces at once: less than
// half the time that its twelve triangles take. Two boxes side by side leave no slit for a ray.

/// Embree's callbacks for a box in its scene. The face hit is primitive 2 f, of the faces f -x, +x,
/// -y, +y, -z, +z; a ray that begins inside hits the face by which it leaves.
void intersect_box(const TracedShape& box, const RTCIntersectFunctionNArguments& asked);
void occlude_box(const TracedShape& box, const RTCOccludedFunctionNArguments& asked);

}  // namespace trident::sim
