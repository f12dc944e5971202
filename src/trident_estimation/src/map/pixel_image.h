// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trident {

/// A picture as its file has it: 1 grey, 2 grey and alpha, 3 RGB or 4 RGB and alpha; row 0 on top.
struct PixelImage {
  int width = 0;
  int height = 0;
  int channels = 1;
  int white = 255;                     ///< the brightest sample
  std::vector<std::uint16_t> samples;  ///< height x width x channels

  bool has_alpha() const { return channels == 2 || channels == 4; }
};

/// Reads a PGM (P2, P5) or PNG, told apart by their first bytes. Throws MapFileError.
PixelImage read_pixel_image(const std::string& path);

}  // namespace trident
