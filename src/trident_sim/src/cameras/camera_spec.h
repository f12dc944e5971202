// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera_model.h"
#include "trident_base/noise.h"
#include "trident_base/se3.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

enum class PixelFormat { kRgb8, kBgr8, kMono8 };
/// As sensor_msgs/Image names it.
const char* encoding_name(PixelFormat format);
int channel_count(PixelFormat format);

/// Legal angles of view along a row [rad].
constexpr double kMinAngleOfView = 0.01, kMaxAngleOfView = 3.14;

/// `<lens><intrinsics>`, which stands in for the angle of view: CameraInfo's K [pixels].
struct Intrinsics {
  double fx = 277.0, fy = 277.0, cx = 160.0, cy = 120.0, s = 0.0;
};
/// `<lens><projection>`: CameraInfo's P [pixels]; what is drawn does not depend on it.
struct Projection {
  double fx = 277.0, fy = 277.0, cx = 160.0, cy = 120.0, tx = 0.0, ty = 0.0;
};

/// A `<camera>` element of a sensor (sdformat.org/spec, camera). It looks along x, z is up.
struct CameraSpec {
  std::string name;
  SE3 T_sensor_camera;
  int width = 320, height = 240;
  double angle_of_view_rad = 1.047;  ///< along a row
  PixelFormat format = PixelFormat::kRgb8;
  double near_m = 0.1, far_m = 100.0;  ///< along the axis; what is outside is not seen
  GaussianNoise noise;                 ///< of a colour, which is in [0, 1]
  Distortion distortion;
  std::optional<Intrinsics> intrinsics;
  std::optional<Projection> projection;
};

/// The cameras of a sensor, of which it has at least one. Throws Error that names sensor, element,
/// value and legal range: no pixels, or more than 16384 a side, an angle of view out of [0.01,
/// 3.14], focal lengths of a lens that are not positive, near not below far, an unknown format or
/// noise.
std::vector<CameraSpec> read_camera_specs(const SensorSpec& sensor, const std::string& owner);

}  // namespace trident::sim
