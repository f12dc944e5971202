// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/pixel_image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <istream>
#include <memory>

namespace trident {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw PixelImageError(PixelImageError::Kind::kBad, "image '" + path + "' " + problem);
}

void check_size(const std::string& path, long width, long height, const PixelImageLimits& limits) {
  const auto is_side = [&limits](long side) {
    return side >= limits.least_side && side <= limits.most_side;
  };
  if (is_side(width) && is_side(height) && width <= limits.most_pixels / height) return;
  const auto square = [](long side) { return std::to_string(side) + " x " + std::to_string(side); };
  const bool is_by_side = limits.most_side < limits.most_pixels;
  refuse(path, "has " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels, legal: " + square(limits.least_side) + " to " +
                   (is_by_side ? square(limits.most_side)
                               : std::to_string(limits.most_pixels) + " in all"));
}

/// libpng's objects, and the buffers that its error handling would leak.
struct PngReader {
  explicit PngReader(std::FILE* open_file) : in(open_file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, keep_error, ignore_warning);
    info = png == nullptr ? nullptr : png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // libpng expects its error handler not to return.
  static void keep_error(png_structp png, png_const_charp text) {
    static_cast<PngReader*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}

  std::FILE* in;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
  std::vector<png_byte> bytes;
  std::vector<png_bytep> row_starts;
};

/// Both return false, with `error` set, when libpng jumps back. No object is made between the
/// setjmp and the calls that may jump.
bool read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_init_io(reader.png, reader.in);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);  // palettes to RGB, 1, 2 and 4 bits to 8, transparency to alpha
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_rows(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, reader.row_starts.data());
  png_read_end(reader.png, nullptr);
  return true;
}

/// The picture whose rows have been read.
PixelImage image_of(const PngReader& reader, long width, long height) {
  const bool is_wide = png_get_bit_depth(reader.png, reader.info) == 16;
  PixelImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.channels = png_get_channels(reader.png, reader.info);
  image.white = is_wide ? 65535 : 255;
  image.samples.resize(static_cast<std::size_t>(width * height * image.channels));
  const png_byte* bytes = reader.bytes.data();
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    // PNG has samples of two bytes with the high byte first.
    image.samples[i] = is_wide ? static_cast<std::uint16_t>(256 * bytes[2 * i] + bytes[2 * i + 1])
                               : std::uint16_t{bytes[i]};
  }
  return image;
}

PixelImage read_png(const std::string& path, const PixelImageLimits& limits) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(path.c_str(), "rb"),
                                                           std::fclose);
  if (in == nullptr) refuse(path, "cannot be read");
  PngReader reader(in.get());
  if (reader.info == nullptr || !read_header(reader)) refuse(path, "is a bad PNG: " + reader.error);
  const auto width = static_cast<long>(png_get_image_width(reader.png, reader.info));
  const auto height = static_cast<long>(png_get_image_height(reader.png, reader.info));
  // The size is checked before rows are read: a small
  // file may claim a picture that fills the memory.
  check_size(path, width, height, limits);
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  reader.bytes.resize(stride * static_cast<std::size_t>(height));
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
    reader.row_starts.push_back(reader.bytes.data() + row * stride);
  }
  if (!read_rows(reader)) refuse(path, "is a bad PNG: " + reader.error);
  return image_of(reader, width, height);
}

/// The next number of a PGM, behind white space and comments; -1 if there is no number.
long next_number(std::istream& in) {
  while (true) {
    in >> std::ws;
    if (in.peek() != '#') break;
    std::string comment;
    std::getline(in, comment);
  }
  long number = -1;
  return in >> number ? number : -1;
}

[[noreturn]] void refuse_short(const std::string& path, const PixelImage& image,
                               std::size_t found) {
  refuse(path, "ends after " + std::to_string(found) + " of the " + std::to_string(image.width) +
                   " x " + std::to_string(image.height) + " pixels that its header says");
}

void read_plain(const std::string& path, std::istream& in, PixelImage& image) {
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const long value = next_number(in);
    if (value == -1) refuse_short(path, image, i);
    if (value < 0 || value > image.white) {
      refuse(path, "has the value " + std::to_string(value) + " in row " +
                       std::to_string(i / static_cast<std::size_t>(image.width)) +
                       ", legal: 0 to " + std::to_string(image.white));
    }
    image.samples[i] = static_cast<std::uint16_t>(value);
  }
}

void read_binary(const std::string& path, std::istream& in, PixelImage& image) {
  in.get();  // the one white space that ends the header
  // Netpbm's rule: two bytes, the high one first, where the white value does not fit into one.
  const std::size_t bytes_each = image.white > 255 ? 2 : 1;
  const std::size_t columns = static_cast<std::size_t>(image.width);
  std::vector<char> row(columns * bytes_each);
  for (std::size_t first = 0; first < image.samples.size(); first += columns) {
    in.read(row.data(), static_cast<std::streamsize>(row.size()));
    const auto found = static_cast<std::size_t>(in.gcount()) / bytes_each;
    if (found < columns) refuse_short(path, image, first + found);
    for (std::size_t i = 0; i < columns; ++i) {
      const auto high = static_cast<unsigned char>(row[i * bytes_each]);
      const int value =
          bytes_each == 1 ? high : 256 * high + static_cast<unsigned char>(row[i * bytes_each + 1]);
      image.samples[first + i] = static_cast<std::uint16_t>(value);
    }
  }
}

std::size_t bytes_left(std::istream& in) {
  const auto here = in.tellg();
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(here);
  return static_cast<std::size_t>(end - here);
}

/// How many pixels of a PGM the rest of the file can hold. A white space precedes the pixels; plain
/// ones take two characters each.
std::size_t most_pixels_left(std::istream& in, bool is_binary, long white) {
  const std::size_t left = std::max<std::size_t>(1, bytes_left(in));
  if (!is_binary) return left / 2;
  return (left - 1) / (white < 256 ? 1 : 2);
}

PixelImage read_pgm(const std::string& path, std::istream& in, bool is_binary,
                    const PixelImageLimits& limits) {
  const long width = next_number(in), height = next_number(in), white = next_number(in);
  if (white < 1 || white > 65535) {
    refuse(path,
           "is a bad PGM: its header has no width, height and white value, legal: 1 to 65535");
  }
  check_size(path, width, height, limits);
  PixelImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.white = static_cast<int>(white);
  // A header that promises more than the file holds is refused before memory is allocated for it.
  const std::size_t most = most_pixels_left(in, is_binary, white);
  if (most < static_cast<std::size_t>(width * height)) refuse_short(path, image, most);
  image.samples.resize(static_cast<std::size_t>(width * height));
  if (is_binary) {
    read_binary(path, in, image);
  } else {
    read_plain(path, in, image);
  }
  return image;
}

}  // namespace

PixelImage read_pixel_image(const std::string& path, const PixelImageLimits& limits) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 2> magic{};
  if (!in.is_open()) {
    throw PixelImageError(PixelImageError::Kind::kCannotBeRead,
                          "image '" + path + "' cannot be read");
  }
  in.read(magic.data(), magic.size());
  const std::string begin(magic.data(), static_cast<std::size_t>(in.gcount()));
  // The content decides and not the name's ending.
  if (begin == "P2" || begin == "P5") return read_pgm(path, in, begin == "P5", limits);
  if (begin == "\x89P") return read_png(path, limits);
  refuse(path, "is neither a PNG nor a PGM (P2, P5)");
}

}  // namespace trident
