// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "picture_products.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace trident::sim {
namespace {

std::uint32_t packed(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return static_cast<std::uint32_t>(r) << 16 | static_cast<std::uint32_t>(g) << 8 | b;
}

std::uint32_t color_of(const std::vector<std::uint8_t>& colors, PixelFormat format,
                       std::size_t pixel) {
  if (format == PixelFormat::kMono8) return packed(colors[pixel], colors[pixel], colors[pixel]);
  const std::uint8_t* const c = &colors[3 * pixel];
  return format == PixelFormat::kRgb8 ? packed(c[0], c[1], c[2]) : packed(c[2], c[1], c[0]);
}

std::uint16_t to_millimeters(float depth_m) {
  const long millimeters = std::lround(1000.0 * static_cast<double>(depth_m));
  // REP 118: zero is no measurement, and 16 bits end at 65.535 m.
  return millimeters > 65535 ? 0 : static_cast<std::uint16_t>(millimeters);
}

}  // namespace

// REP 118: 32FC1 in meters or 16UC1 in millimeters, along the optical axis.
void write_depths(const std::vector<float>& depths, const DepthRange& range, DepthFormat format,
                  std::vector<std::uint8_t>& data) {
  if (format == DepthFormat::kMeters) {
    data.resize(depths.size() * sizeof(float));
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const float depth = range.holds(depths[i]) ? depths[i] : range.beyond;
      std::memcpy(&data[i * sizeof(float)], &depth, sizeof(float));
    }
    return;
  }
  data.resize(depths.size() * sizeof(std::uint16_t));
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const std::uint16_t depth = range.holds(depths[i]) ? to_millimeters(depths[i]) : 0;
    std::memcpy(&data[i * sizeof(depth)], &depth, sizeof(depth));
  }
}

void write_cloud(const Picture& picture, PixelFormat format, const CameraModel& model,
                 const ViewTable& table, const DepthRange& range, ImageCloudSample& cloud) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr int kSide = ViewTable::kSide;
  cloud.width = static_cast<std::uint32_t>(model.width);
  cloud.height = static_cast<std::uint32_t>(model.height);
  cloud.points.resize(picture.depths.size());
  cloud.is_dense = true;
  std::size_t pixel = 0;
  for (int row = 0; row < model.height; ++row) {
    for (int column = 0; column < model.width; ++column, ++pixel) {
      const ViewTable::Tile& tile = table.tile(column / kSide, row / kSide);
      const std::size_t lane = ViewTable::lane_of(column, row);
      const float depth = picture.depths[pixel];
      ImageCloudSample::Point& point = cloud.points[pixel];
      const bool is_seen = range.holds(depth);
      cloud.is_dense = cloud.is_dense && is_seen;
      // The table has the undistorted directions, so that
      // the cloud is right for a distorted picture, too.
      point.x = is_seen ? depth * tile.x[lane] : kNone;
      point.y = is_seen ? depth * tile.y[lane] : kNone;
      point.z = is_seen ? depth : kNone;
      point.rgb = color_of(picture.colors, format, pixel);
    }
  }
}

Labels::Labels(const RayScene& scene, LabelKind kind) {
  const std::vector<RayShape>& shapes = scene.shapes();
  labels_.reserve(shapes.size());
  for (const RayShape& shape : shapes) {
    const std::uint32_t id = kind == LabelKind::kModel ? shape.model_id : shape.link_id;
    if (names_.size() <= id) names_.resize(std::size_t{id} + 1);
    names_[id] = kind == LabelKind::kModel ? shape.model : shape.model + "::" + shape.link;
    // Label 0 is the background.
    labels_.push_back(id + 1);
  }
}

void write_labels(const std::vector<std::uint32_t>& shapes, const Labels& labels,
                  std::vector<std::uint8_t>& data) {
  data.resize(shapes.size() * sizeof(std::uint16_t));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto label =
        static_cast<std::uint16_t>(std::min<std::uint32_t>(labels.of(shapes[i]), 65535U));
    std::memcpy(&data[i * sizeof(label)], &label, sizeof(label));
  }
}

void write_boxes(const std::vector<std::uint32_t>& shapes, int width, const Labels& labels,
                 std::vector<BoundingBoxesSample::Box>& boxes) {
  boxes.assign(labels.highest(), {});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::uint32_t label = labels.of(shapes[i]);
    if (label == 0) continue;
    const auto x = static_cast<std::uint32_t>(i % static_cast<std::size_t>(width));
    const auto y = static_cast<std::uint32_t>(i / static_cast<std::size_t>(width));
    BoundingBoxesSample::Box& box = boxes[label - 1];
    if (box.pixels++ == 0) {
      box.label = label;
      box.name = labels.name(label);
      box.x_min = box.x_max = x;
      box.y_min = y;
    }
    box.x_min = std::min(box.x_min, x);
    box.x_max = std::max(box.x_max, x);
    // Rows come in rising order.
    box.y_max = y;
  }
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                             [](const BoundingBoxesSample::Box& box) { return box.pixels == 0; }),
              boxes.end());
}

}  // namespace trident::sim
