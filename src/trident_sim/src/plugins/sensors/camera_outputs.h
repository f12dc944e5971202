// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../../cameras/camera_renderer.h"
#include "../../cameras/depth_noise.h"
#include "../../cameras/picture_products.h"
#include "../plugin_util.h"
#include "trident_base/random_stream.h"
#include "trident_sim/samples.h"

namespace trident {

/// What one camera of a sensor is and tells.
struct CameraSetup {
  CameraSpec spec;
  CameraModel model;
  /// Of P alone: its middle column [pixels], and how far right of the left camera of a stereo pair
  /// this one is [m].
  double rectified_cx = 0.0, baseline_m = 0.0;
  std::string frame;
  DepthRange depth_range;
  DepthNoise depth_noise;
  DepthFormat depth_format = DepthFormat::kMetres;
  LabelKind label_kind = LabelKind::kModel;
  /// Full names of ports; "": not told.
  struct Topics {
    std::string image, info, depth, depth_info, cloud, labels, boxes;
  } topics;
  std::string owner;  ///< begins errors
};

/// The ports of one camera. All that listeners want comes from one picture.
class CameraOutputs {
 public:
  CameraOutputs(const PluginContext& context, const CameraSetup& setup);

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
  CameraSetup setup_;
  CameraRenderer renderer_;
  RandomStream stream_;
  Picture picture_;
  OutHandle<ImageSample> image_, depth_, labels_;
  OutHandle<CameraInfoSample> info_, depth_info_;
  OutHandle<ImageCloudSample> cloud_;
  OutHandle<BoundingBoxesSample> boxes_;
};

}  // namespace trident
