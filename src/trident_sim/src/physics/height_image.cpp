// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "height_image.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include "trident_base/error.h"

namespace trident {
namespace {

/// A field of 8193 x 8193 samples needs 0.5 GB; more is a mistake.
constexpr int kMaxSide = 8193;

void check_sides(const std::string& file, long columns, long rows) {
  if (columns >= 2 && rows >= 2 && columns <= kMaxSide && rows <= kMaxSide) return;
  throw Error("image '" + file + "' has " + std::to_string(columns) + " x " + std::to_string(rows) +
              " pixels, legal: 2 x 2 to " + std::to_string(kMaxSide) + " x " +
              std::to_string(kMaxSide));
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

  static void keep_error(png_structp png, png_const_charp text) {
    static_cast<PngReader*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}

  std::FILE* in;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
  std::vector<png_byte> bytes;  ///< big-endian, 2 of each sample
  std::vector<png_bytep> row_starts;
};

/// Both return false, with `error` set, when libpng jumps back. No object is made between the
/// setjmp and the calls that may jump.
bool read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_init_io(reader.png, reader.in);
  png_read_info(reader.png, reader.info);
  png_set_strip_alpha(reader.png);
  png_set_expand(reader.png);
  png_set_expand_16(reader.png);
  if ((png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_COLOR) != 0) {
    png_set_rgb_to_gray_fixed(reader.png, PNG_ERROR_ACTION_NONE, PNG_RGB_TO_GRAY_DEFAULT,
                              PNG_RGB_TO_GRAY_DEFAULT);
  }
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

HeightImage read_png(const std::string& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                           std::fclose);
  if (in == nullptr) throw Error("image '" + file + "' cannot be read");
  PngReader reader(in.get());
  const auto refuse = [&] { throw Error("image '" + file + "' is a bad PNG: " + reader.error); };
  if (reader.info == nullptr || !read_header(reader)) refuse();
  const auto columns = static_cast<long>(png_get_image_width(reader.png, reader.info));
  const auto rows = static_cast<long>(png_get_image_height(reader.png, reader.info));
  check_sides(file, columns, rows);
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  reader.bytes.resize(stride * static_cast<std::size_t>(rows));
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
    reader.row_starts.push_back(reader.bytes.data() + row * stride);
  }
  if (!read_rows(reader)) refuse();
  HeightImage image{static_cast<int>(columns), static_cast<int>(rows), {}};
  image.brightness.reserve(static_cast<std::size_t>(columns * rows));
  for (const png_bytep row : reader.row_starts) {
    for (long i = 0; i < columns; ++i) {
      image.brightness.push_back(static_cast<float>(256 * row[2 * i] + row[2 * i + 1]) / 65535.0F);
    }
  }
  return image;
}

/// The next number of a PGM header, behind white space and comments; -1 when there is none.
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

HeightImage read_pgm(const std::string& file, std::istream& in, bool binary) {
  const long columns = next_number(in), rows = next_number(in), white = next_number(in);
  if (columns < 0 || rows < 0 || white < 1 || white > 65535) {
    throw Error("image '" + file + "' is a bad PGM: its header has no width, height and white " +
                "value in 1 to 65535");
  }
  check_sides(file, columns, rows);
  if (binary) in.get();
  HeightImage image{static_cast<int>(columns), static_cast<int>(rows), {}};
  image.brightness.reserve(static_cast<std::size_t>(columns * rows));
  for (long i = 0; i < columns * rows; ++i) {
    long value = binary ? in.get() : next_number(in);
    if (binary && white > 255) value = 256 * value + in.get();
    if (!in || value < 0 || value > white) {
      throw Error("image '" + file + "' is a bad PGM: pixel " + std::to_string(i) + " of " +
                  std::to_string(columns * rows) + " is missing or above " + std::to_string(white));
    }
    image.brightness.push_back(static_cast<float>(value) / static_cast<float>(white));
  }
  return image;
}

}  // namespace

HeightImage read_height_image(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  char magic[2] = {};
  in.read(magic, 2);
  if (!in) throw Error("image '" + file + "' cannot be read");
  if (magic[0] == 'P' && (magic[1] == '2' || magic[1] == '5')) {
    return read_pgm(file, in, magic[1] == '5');
  }
  if (magic[0] == '\x89' && magic[1] == 'P') return read_png(file);
  throw Error("image '" + file + "' is neither a PNG nor a PGM (P2, P5)");
}

HeightImage read_heights(const HeightmapShape& shape) {
  HeightImage image = read_height_image(shape.file);
  std::vector<float>& values = image.brightness;
  const float brightest = *std::max_element(values.begin(), values.end());
  const double scale = brightest > 0.0F ? shape.size.z() / brightest : 0.0;
  for (float& value : values) value = static_cast<float>(scale * value);
  return image;
}

}  // namespace trident
