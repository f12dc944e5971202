// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "height_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trident_base/pixel_image.h"

namespace trident::sim {
namespace {

/// A field of 8193 x 8193 samples needs 0.5 GB; more is a mistake.
constexpr PixelImageLimits kLimits{2, 8193, 8193L * 8193L};

/// Colours as Rec. 709 weighs them, as libpng does.
float brightness(const PixelImage& image, const std::uint16_t* pixel) {
  const auto white = static_cast<float>(image.white);
  if (image.channels < 3) return static_cast<float>(pixel[0]) / white;
  const int gray = 6968 * pixel[0] + 23434 * pixel[1] + 2366 * pixel[2];  // < 2^31
  return static_cast<float>(gray) / 32768.0F / white;
}

}  // namespace

HeightImage read_height_image(const std::string& file) {
  const PixelImage picture = read_pixel_image(file, kLimits);
  HeightImage image{picture.width, picture.height, {}};
  const auto channels = static_cast<std::size_t>(picture.channels);
  image.brightness.reserve(picture.samples.size() / channels);
  for (std::size_t i = 0; i < picture.samples.size(); i += channels) {
    image.brightness.push_back(brightness(picture, &picture.samples[i]));
  }
  return image;
}

HeightImage read_heights(const HeightmapShape& shape) {
  HeightImage image = read_height_image(shape.file);
  std::vector<float>& values = image.brightness;
  const float brightest = *std::max_element(values.begin(), values.end());
  const double scale = brightest > 0.0F ? shape.size.z() / brightest : 0.0;
  for (float& value : values) value = static_cast<float>(scale * value);
  return image;
}

}  // namespace trident::sim
