// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/image_codec.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "../rays/textures/jpeg_errors.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// Rows of pixels to be written.
struct Rows {
  const std::uint8_t* data;
  std::uint32_t width, height, bytes_per_row;
};

Rows rows_of(const ImageSample& image) {
  return {image.data.data(), image.width, image.height, image.bytes_per_row};
}

/// libjpeg's encoder. Its errors are jumps; no object with a destructor lives across one.
class JpegEncoder {
 public:
  JpegEncoder() {
    info_.err = &errors_.base;
    jpeg_create_compress(&info_);
  }
  ~JpegEncoder() {
    jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  bool write(const Rows& rows, J_COLOR_SPACE colors, int quality) {
    // libjpeg reports an error by a jump back to here.
    if (setjmp(errors_.jump) != 0) return false;
    jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = rows.width;
    info_.image_height = rows.height;
    info_.input_components = colors == JCS_GRAYSCALE ? 1 : 3;
    info_.in_color_space = colors;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      const std::uint8_t* const row =
          rows.data + std::size_t{info_.next_scanline} * rows.bytes_per_row;
      JSAMPROW pointer = const_cast<JSAMPROW>(row);  // libjpeg only reads it
      jpeg_write_scanlines(&info_, &pointer, 1);
    }
    jpeg_finish_compress(&info_);
    return true;
  }
  const unsigned char* bytes() const { return bytes_; }
  std::size_t size() const { return size_; }
  const char* message() const { return errors_.message.data(); }

 private:
  JpegErrors errors_;
  jpeg_compress_struct info_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

void append_jpeg(const Rows& rows, J_COLOR_SPACE colors, int quality,
                 std::vector<std::uint8_t>& out) {
  JpegEncoder encoder;
  if (!encoder.write(rows, colors, quality)) {
    throw Error(std::string("picture cannot be written as a JPEG: ") + encoder.message());
  }
  out.insert(out.end(), encoder.bytes(), encoder.bytes() + encoder.size());
}

/// How PNG is to read the bytes of a row.
struct PngLayout {
  int color_type, bit_depth;
  bool is_bgr;
};

/// libpng's encoder; as above.
class PngEncoder {
 public:
  PngEncoder()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &note_error, nullptr)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {}
  ~PngEncoder() { png_destroy_write_struct(&png_, &info_); }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

  bool write(const Rows& rows, const PngLayout& layout, int level, std::vector<std::uint8_t>& out) {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, &out, &append, nullptr);
    png_set_compression_level(png_, level);
    png_set_IHDR(png_, info_, rows.width, rows.height, layout.bit_depth, layout.color_type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    if (layout.is_bgr) png_set_bgr(png_);
    if (layout.bit_depth == 16) png_set_swap(png_);  // PNG is big-endian
    for (std::uint32_t row = 0; row < rows.height; ++row) {
      png_write_row(png_, rows.data + std::size_t{row} * rows.bytes_per_row);
    }
    png_write_end(png_, nullptr);
    return true;
  }
  const char* message() const { return message_.data(); }

 private:
  static void append(png_structp png, png_bytep bytes, png_size_t size) {
    auto* const out = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    out->insert(out->end(), bytes, bytes + size);
  }
  static void note_error(png_structp png, png_const_charp message) {
    auto* const self = static_cast<PngEncoder*>(png_get_error_ptr(png));
    std::snprintf(self->message_.data(), self->message_.size(), "%s", message);
    png_longjmp(png, 1);
  }

  std::array<char, 200> message_{};
  png_structp png_;
  png_infop info_;
};

void append_png(const Rows& rows, const PngLayout& layout, int level,
                std::vector<std::uint8_t>& out) {
  PngEncoder encoder;
  if (!encoder.write(rows, layout, level, out)) {
    throw Error(std::string("picture cannot be written as a PNG: ") + encoder.message());
  }
}

/// What decoders of compressed_depth_image_transport find before the PNG.
struct DepthHeader {
  std::int32_t format = 0;  ///< inverse depth
  float A = 0.0F, B = 0.0F;
};
static_assert(sizeof(DepthHeader) == 12, "as in compressed_depth_image_transport");

std::vector<std::uint16_t> inverse_depths(const ImageSample& image, float max_m,
                                          const DepthHeader& header) {
  std::vector<std::uint16_t> inverse(image.data.size() / sizeof(float));
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    float depth = 0.0F;
    std::memcpy(&depth, &image.data[i * sizeof(float)], sizeof(float));
    if (!(depth > 0.0F && depth < max_m)) continue;  // not a number, too
    // Inverse depth has its finest steps near the camera, as stereo has; zero is no depth.
    inverse[i] = static_cast<std::uint16_t>(std::min(header.A / depth + header.B, 65535.0F));
  }
  return inverse;
}

std::vector<std::uint16_t> depths_within(const ImageSample& image, double max_m) {
  std::vector<std::uint16_t> depths(image.data.size() / sizeof(std::uint16_t));
  std::memcpy(depths.data(), image.data.data(), depths.size() * sizeof(std::uint16_t));
  for (std::uint16_t& depth : depths) {
    if (depth > 1000.0 * max_m) depth = 0;
  }
  return depths;
}

}  // namespace

bool is_depth_encoding(const std::string& encoding) {
  return encoding == "32FC1" || encoding == "16UC1";
}

void compress_picture(const ImageSample& image, const PictureCompression& how,
                      CompressedPicture& out) {
  out.data.clear();
  const bool is_bgr = image.encoding == "bgr8", is_color = is_bgr || image.encoding == "rgb8";
  const bool is_deep = image.encoding == "mono16", as_png = how.as_png || is_deep;
  if (!is_color && !is_deep && image.encoding != "mono8") {
    throw Error("picture of encoding '" + image.encoding +
                "' cannot be compressed, legal: rgb8, bgr8, mono8, mono16");
  }
  // As compressed_image_transport writes it: its
  // subscriber learns the order of the channels from it.
  out.format = image.encoding + (as_png ? "; png compressed " : "; jpeg compressed ");
  if (is_color) out.format += "bgr8";
  if (as_png) {
    const int type = is_color ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY;
    append_png(rows_of(image), {type, is_deep ? 16 : 8, is_bgr}, how.png_level, out.data);
    return;
  }
  const J_COLOR_SPACE colors = is_bgr ? JCS_EXT_BGR : JCS_RGB;
  append_jpeg(rows_of(image), is_color ? colors : JCS_GRAYSCALE, how.jpeg_quality, out.data);
}

void compress_depth(const ImageSample& image, const DepthCompression& how, CompressedPicture& out) {
  if (!is_depth_encoding(image.encoding)) {
    throw Error("picture of encoding '" + image.encoding + "' has no depths, legal: 32FC1, 16UC1");
  }
  DepthHeader header;
  std::vector<std::uint16_t> values;
  if (image.encoding == "32FC1") {
    const auto max_m = static_cast<float>(how.max_m), q = static_cast<float>(how.quantization);
    // As compressed_depth_image_transport: a decoder computes A / (value - B), and max_m becomes 1.
    header.A = q * (q + 1.0F);
    header.B = 1.0F - header.A / max_m;
    values = inverse_depths(image, max_m, header);
  } else {
    values = depths_within(image, how.max_m);
  }
  out.format = image.encoding + "; compressedDepth png";
  out.data.resize(sizeof(header));
  std::memcpy(out.data.data(), &header, sizeof(header));
  const Rows rows{reinterpret_cast<const std::uint8_t*>(values.data()), image.width, image.height,
                  image.width * 2};
  append_png(rows, {PNG_COLOR_TYPE_GRAY, 16, false}, how.png_level, out.data);
}

}  // namespace trident::sim
