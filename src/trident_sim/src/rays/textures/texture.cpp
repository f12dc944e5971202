// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "picture_file.h"

namespace trident::sim {
namespace {

/// Whole pixels to the left of `x`, and how far it is from there to the next.
struct Place {
  int before;
  float share;
};
Place place(float x) {
  int before = static_cast<int>(x);
  if (static_cast<float>(before) > x) --before;
  return {before, x - static_cast<float>(before)};
}

/// `i` brought into [0, n) by whole turns.
int wrapped(int i, int n) {
  if (i >= 0 && i < n) return i;
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

/// Half the size; each pixel the mean of four, of fewer at the end of an odd side.
Texture::Level halved(const Texture::Level& from) {
  Texture::Level to{(from.columns + 1) / 2, (from.rows + 1) / 2, {}};
  to.rgba.reserve(4 * static_cast<std::size_t>(to.columns) * static_cast<std::size_t>(to.rows));
  for (int row = 0; row < to.rows; ++row) {
    const int low = std::min(2 * row + 1, from.rows - 1);
    for (int column = 0; column < to.columns; ++column) {
      const int right = std::min(2 * column + 1, from.columns - 1);
      for (int channel = 0; channel < 4; ++channel) {
        int sum = 2;
        for (const int y : {2 * row, low}) {
          for (const int x : {2 * column, right}) {
            sum += from.rgba[4 * (static_cast<std::size_t>(y) *
                                      static_cast<std::size_t>(from.columns) +
                                  static_cast<std::size_t>(x)) +
                             static_cast<std::size_t>(channel)];
          }
        }
        to.rgba.push_back(static_cast<std::uint8_t>(sum / 4));
      }
    }
  }
  return to;
}

/// The level whose pixels are about as large as what a ray stands for.
std::size_t level_for(float width_px, std::size_t levels) {
  if (!(width_px > 1.414F)) return 0;
  int exponent = 0;
  std::frexp(width_px * 1.414F, &exponent);  // of 1.41 to 2.83 pixels: one level down
  return std::min(static_cast<std::size_t>(exponent - 1), levels - 1);
}

}  // namespace

Texture read_texture(const std::string& file) {
  PictureFile picture = read_picture(file);
  Texture texture;
  texture.levels.push_back({picture.columns, picture.rows, std::move(picture.rgba)});
  while (texture.levels.back().columns > 1 || texture.levels.back().rows > 1) {
    texture.levels.push_back(halved(texture.levels.back()));
  }
  return texture;
}

Eigen::Vector3f Texture::at(const Eigen::Vector2f& uv, float width_px) const {
  constexpr float kFarOff = 1e6F;  // beyond, float does not resolve pixels
  if (!(uv.cwiseAbs().maxCoeff() < kFarOff)) return Eigen::Vector3f::Zero();
  const Level& level = levels[level_for(width_px, levels.size())];
  // One turn of the picture first, lest pixels overflow.
  const float u = place(uv.x()).share, v = place(uv.y()).share;
  const Place x = place(u * static_cast<float>(level.columns) - 0.5F);
  const Place y = place((1.0F - v) * static_cast<float>(level.rows) - 0.5F);
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    const float weight =
        (dx == 0 ? 1.0F - x.share : x.share) * (dy == 0 ? 1.0F - y.share : y.share);
    const std::size_t pixel = static_cast<std::size_t>(wrapped(y.before + dy, level.rows)) *
                                  static_cast<std::size_t>(level.columns) +
                              static_cast<std::size_t>(wrapped(x.before + dx, level.columns));
    const std::uint8_t* const c = &level.rgba[4 * pixel];
    color += weight * Eigen::Vector3f(c[0], c[1], c[2]);
  }
  return color * (1.0F / 255.0F);
}

}  // namespace trident::sim
