// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "texture.h"

#include <png.h>

#include <cmath>

#include "trident_base/error.h"

namespace trident {
namespace {

/// Frees what libpng holds, also when reading fails.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

/// 16384 x 16384 pixels need 0.8 GB; more is a mistake.
constexpr png_uint_32 kMaxSide = 16384;

/// `i` brought into [0, n) by whole turns.
int wrapped(double i, int n) {
  const double turned = i - n * std::floor(i / n);
  return std::min(n - 1, static_cast<int>(turned));
}

}  // namespace

Texture read_texture(const std::string& file) {
  PngImage png;
  const auto refuse = [&](const std::string& why) {
    throw Error("texture '" + file + "' cannot be read as a PNG: " + why);
  };
  if (png_image_begin_read_from_file(&png.image, file.c_str()) == 0) refuse(png.image.message);
  if (png.image.width > kMaxSide || png.image.height > kMaxSide) {
    refuse("it has " + std::to_string(png.image.width) + " x " + std::to_string(png.image.height) +
           " pixels, legal: up to " + std::to_string(kMaxSide) + " a side");
  }
  // With alpha, which would else be laid upon a background.
  png.image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(png.image));
  if (png_image_finish_read(&png.image, nullptr, rgba.data(), 0, nullptr) == 0) {
    refuse(png.image.message);
  }
  Texture texture{static_cast<int>(png.image.width), static_cast<int>(png.image.height), {}};
  texture.rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    if (i % 4 != 3) texture.rgb.push_back(rgba[i]);
  }
  return texture;
}

Eigen::Vector3d Texture::at(const Eigen::Vector2f& uv) const {
  if (!uv.allFinite()) return Eigen::Vector3d::Zero();
  const double right = static_cast<double>(uv.x()) * columns - 0.5;
  const double down = (1.0 - static_cast<double>(uv.y())) * rows - 0.5;
  const double left = std::floor(right), top = std::floor(down);
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    const double weight =
        (dx == 0 ? left + 1.0 - right : right - left) * (dy == 0 ? top + 1.0 - down : down - top);
    const std::size_t pixel = static_cast<std::size_t>(wrapped(top + dy, rows)) * columns +
                              static_cast<std::size_t>(wrapped(left + dx, columns));
    const std::uint8_t* const c = &rgb[3 * pixel];
    color += weight / 255.0 * Eigen::Vector3d(c[0], c[1], c[2]);
  }
  return color;
}

}  // namespace trident
