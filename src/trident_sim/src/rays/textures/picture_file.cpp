// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "picture_file.h"

#include <png.h>

#include <csetjmp>
#include <fstream>
#include <iterator>
#include <utility>

#include "jpeg_errors.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// 16384 x 16384 pixels need 0.8 GB; more is a mistake.
constexpr unsigned kMaxSide = 16384;

void check_size(unsigned width, unsigned height, const std::string& file) {
  if (width <= kMaxSide && height <= kMaxSide) return;
  throw Error("texture '" + file + "' has " + std::to_string(width) + " x " +
              std::to_string(height) + " pixels, legal: up to " + std::to_string(kMaxSide) +
              " a side");
}

/// Frees what libpng holds, also when reading fails.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

PictureFile read_png(const std::vector<std::uint8_t>& bytes, const std::string& file) {
  PngImage png;
  const auto refuse = [&] {
    throw Error("texture '" + file + "' cannot be read as a PNG: " + png.image.message);
  };
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0) refuse();
  check_size(png.image.width, png.image.height, file);
  // With alpha, which would else be laid upon a background.
  png.image.format = PNG_FORMAT_RGBA;
  PictureFile picture{static_cast<int>(png.image.width), static_cast<int>(png.image.height), {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(png.image));
  if (png_image_finish_read(&png.image, nullptr, picture.rgba.data(), 0, nullptr) == 0) refuse();
  return picture;
}

/// libjpeg's decoder. Its errors are jumps; no object with a destructor lives across one.
class JpegDecoder {
 public:
  explicit JpegDecoder(const std::vector<std::uint8_t>& bytes) {
    info_.err = &errors_.base;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, bytes.data(), bytes.size());
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&info_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool start() {
    if (setjmp(errors_.jump) != 0) return false;
    jpeg_read_header(&info_, TRUE);
    info_.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&info_);
    return true;
  }
  /// `rgba` has room for width() x height() pixels.
  bool read(std::uint8_t* rgba) {
    if (setjmp(errors_.jump) != 0) return false;
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW row = rgba + std::size_t{4} * info_.output_width * info_.output_scanline;
      jpeg_read_scanlines(&info_, &row, 1);
    }
    jpeg_finish_decompress(&info_);
    return true;
  }
  unsigned width() const { return info_.output_width; }
  unsigned height() const { return info_.output_height; }
  const char* message() const { return errors_.message.data(); }

 private:
  JpegErrors errors_;
  jpeg_decompress_struct info_{};
};

PictureFile read_jpeg(const std::vector<std::uint8_t>& bytes, const std::string& file) {
  JpegDecoder decoder(bytes);
  const auto refuse = [&] {
    throw Error("texture '" + file + "' cannot be read as a JPEG: " + decoder.message());
  };
  if (!decoder.start()) refuse();
  check_size(decoder.width(), decoder.height(), file);
  PictureFile picture{static_cast<int>(decoder.width()), static_cast<int>(decoder.height()), {}};
  picture.rgba.resize(std::size_t{4} * decoder.width() * decoder.height());
  if (!decoder.read(picture.rgba.data())) refuse();
  return picture;
}

}  // namespace

PictureFile read_picture(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("texture '" + file + "' cannot be opened");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  const bool is_jpeg = bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8;
  return is_jpeg ? read_jpeg(bytes, file) : read_png(bytes, file);
}

}  // namespace trident::sim
