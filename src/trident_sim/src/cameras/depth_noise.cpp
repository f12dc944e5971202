// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "depth_noise.h"

#include <algorithm>
#include <limits>

#include "image_noise.h"

namespace trident::sim {

double DepthNoise::stddev_m(double depth_m) const {
  switch (model) {
    case DepthNoiseModel::kKinect:
      return 0.0012 + 0.0019 * (depth_m - 0.4) * (depth_m - 0.4);
    case DepthNoiseModel::kD435:
      return std::min(depth_m * depth_m * subpixel_error_px / (focal_px * baseline_m),
                      max_stddev_m);
    default:
      return 0.0;
  }
}

void DepthNoise::apply(std::uint64_t key, std::vector<float>& depths) const {
  if (model == DepthNoiseModel::kNone) return;
  const PixelNoise noise(key);
  for (std::size_t first = 0; first < depths.size(); first += kPacketLanes) {
    // Numbers are drawn by the pixel's index, so that
    // threads and earlier pictures do not change them.
    const PacketFloats normals = noise.normals(first / kPacketLanes);
    const std::size_t count = std::min(kPacketLanes, depths.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      float& depth = depths[first + i];
      const double truth = depth;
      depth = truth > min_m && truth < max_m
                  ? static_cast<float>(truth + stddev_m(truth) * static_cast<double>(normals[i]))
                  : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace trident::sim
