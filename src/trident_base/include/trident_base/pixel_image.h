// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/error.h"

namespace trident {

/// A picture as its file has it: 1 grey, 2 grey and alpha, 3 RGB or 4 RGB and alpha; row 0 on top.
struct PixelImage {
  int width = 0;                       ///< columns
  int height = 0;                      ///< rows
  int channels = 1;                    ///< samples of a pixel, 1 to 4
  int white = 255;                     ///< the brightest sample
  std::vector<std::uint16_t> samples;  ///< height x width x channels

  /// The last channel; 0: transparent.
  bool has_alpha() const { return channels == 2 || channels == 4; }
};

/// How large a picture may be. 1 km x 1 km at 5 cm are 4e8 cells; pictures beyond that are mistakes
/// in the header.
struct PixelImageLimits {
  long least_side = 1;             ///< of width and height
  long most_side = 400'000'000;    ///< of width and height
  long most_pixels = 400'000'000;  ///< width times height
};

/// A picture that cannot be used; `what()` names the file and the reason.
class PixelImageError : public Error {
 public:
  /// Whether the file cannot be read at all, or what it holds is wrong.
  enum class Kind { kCannotBeRead, kBad };
  /// `text` is complete, with the name of the file.
  PixelImageError(Kind kind, const std::string& text) : Error(text), kind_(kind) {}
  /// Callers answer a missing file otherwise than a damaged one.
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Reads a PGM (P2, P5; up to 65535) or a PNG (any: palettes become RGB); the first bytes decide
/// which. Throws PixelImageError naming the file.
PixelImage read_pixel_image(const std::string& path, const PixelImageLimits& limits = {});

}  // namespace trident
