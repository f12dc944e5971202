// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_sim/samples.h"

namespace trident::sim {

// Pictures as image_transport's plugins send them (sensor_msgs/CompressedImage).

/// A compressed picture as sensor_msgs/CompressedImage carries it; reuse keeps its memory.
struct CompressedPicture {
  std::string format;  ///< "rgb8; jpeg compressed bgr8"
  /// A whole JPEG or PNG file; of depths after a header of 12 bytes.
  std::vector<std::uint8_t> data;
};

/// Of compressed_image_transport.
struct PictureCompression {
  bool as_png = false;    ///< without loss; 16 bits a pixel are always
  int jpeg_quality = 80;  ///< 1 to 100
  int png_level = 1;      ///< 1 to 9
};

/// Of compressed_depth_image_transport: depths in metres are sent as their inverse in 16 bits,
///   A / depth + B with A = q (q + 1), B = 1 - A / max,
/// those in millimetres as they are; 0 means no depth, as does what is beyond `max_m`.
struct DepthCompression {
  double max_m = 10.0, quantization = 100.0;  ///< of the formula above; q in 1/m
  int png_level = 1;                          ///< 1 to 9
};

/// Whether depths, "32FC1" or "16UC1", which compress_depth() takes; other encodings are for
/// compress_picture().
bool is_depth_encoding(const std::string& encoding);

/// Of "rgb8", "bgr8", "mono8" or "mono16". Throws Error for what cannot be written.
void compress_picture(const ImageSample& image, const PictureCompression& how,
                      CompressedPicture& out);
/// Of an encoding that is_depth_encoding(); always PNG. Throws Error for another one.
void compress_depth(const ImageSample& image, const DepthCompression& how, CompressedPicture& out);

}  // namespace trident::sim
