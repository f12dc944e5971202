// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "cameras/camera_renderer.h"
#include "cameras/depth_noise.h"
#include "cameras/picture_products.h"
#include "core/plugins/plugin_util.h"
#include "trident_base/random_stream.h"
#include "trident_sim/samples.h"

namespace trident::sim {

/// What one camera of a sensor is and publishes.
struct CameraSetup {
  CameraSpec spec;
  CameraModel model;
  /// Of P alone: its middle column [pixels], and how far right of the left camera of a stereo pair
  /// this one is [m].
  double rectified_cx = 0.0, baseline_m = 0.0;
  std::optional<Projection> projection;  ///< all of P, in place of these two
  std::string frame;
  DepthRange depth_range;
  DepthNoise depth_noise;
  DepthFormat depth_format = DepthFormat::kMeters;
  LabelKind label_kind = LabelKind::kModel;
  /// Full names of ports; "": not published.
  struct Topics {
    std::string image, info, depth, depth_info, cloud, labels, boxes;
  } topics;
  std::string owner;  ///< begins errors
};

/// The ports of one camera. All that listeners want comes from one picture.
class CameraOutputs {
 public:
  CameraOutputs(const PluginContext& context, const CameraSetup& setup);

  /// From now on the angle of view along a row is this; none: as the file has it. Throws Error when
  /// the distortion is too strong for it, and leaves all as it was.
  void set_angle_of_view(const std::optional<double>& angle_rad);
  /// Draws, if anybody wants it, and publishes. `number` of the picture since the last reset.
  void measure(const SE3& T_world_sensor, SimTime stamp, std::uint64_t number);

 private:
  struct Wants {
    bool image, depth, cloud, labels, boxes;
    bool picture() const { return image || depth || cloud || labels || boxes; }
  };
  Wants wants() const;
  void publish_infos(SimTime stamp);
  void publish_depths(SimTime stamp);
  void publish_labels(const Wants& wanted, SimTime stamp);

  World& world_;
  const CameraSetup setup_;
  CameraSetup now_;  ///< `setup_` with the angle of view that was set
  std::unique_ptr<CameraRenderer> renderer_;
  RandomStream stream_;
  Picture picture_;
  OutHandle<ImageSample> image_, depth_, labels_;
  OutHandle<CameraInfoSample> info_, depth_info_;
  OutHandle<ImageCloudSample> cloud_;
  OutHandle<BoundingBoxesSample> boxes_;
};

}  // namespace trident::sim
