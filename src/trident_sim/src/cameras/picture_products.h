// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "camera_renderer.h"
#include "trident_sim/samples.h"

namespace trident::sim {

// What is made of a picture besides its colours.

/// Which depths count, along the axis [m]; both ends excluded, as in gazebo_plugins.
struct DepthRange {
  double min_m = 0.0, max_m = 0.0;
  float beyond = 0.0F;  ///< what stands for other depths in a 32FC1 picture

  bool holds(float depth) const {
    return depth > static_cast<float>(min_m) && depth < static_cast<float>(max_m);
  }
};

enum class DepthFormat { kMeters, kMillimeters };  ///< 32FC1; 16UC1, where 0 is "none"

void write_depths(const std::vector<float>& depths, const DepthRange& range, DepthFormat format,
                  std::vector<std::uint8_t>& data);

/// `colors` as `format` says.
void write_cloud(const Picture& picture, PixelFormat format, const CameraModel& model,
                 const ViewTable& table, const DepthRange& range, ImageCloudSample& cloud);

/// Labels of models, or of links one by one: a number per name, from 1 in name order.
enum class LabelKind { kModel, kLink };
class Labels {
 public:
  Labels(const RayScene& scene, LabelKind kind);
  /// 0: nothing.
  std::uint32_t of(std::uint32_t shape) const {
    return shape == Picture::kNothing ? 0 : labels_[shape];
  }
  std::uint32_t highest() const { return static_cast<std::uint32_t>(names_.size()); }
  const std::string& name(std::uint32_t label) const { return names_[label - 1]; }

 private:
  std::vector<std::uint32_t> labels_;  ///< by shape
  std::vector<std::string> names_;
};

/// As 16 bits a pixel; labels beyond 65535 are written as that.
void write_labels(const std::vector<std::uint32_t>& shapes, const Labels& labels,
                  std::vector<std::uint8_t>& data);
void write_boxes(const std::vector<std::uint32_t>& shapes, int width, const Labels& labels,
                 std::vector<BoundingBoxesSample::Box>& boxes);

}  // namespace trident::sim
