// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Compressed pictures, read back.
#include "trident_sim/image_codec.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "rays/textures/picture_file.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr int kWidth = 48, kHeight = 32;

/// Red to the left, blue to the right, green downwards.
ImageSample make_picture(const std::string& encoding) {
  ImageSample image;
  image.encoding = encoding;
  image.width = kWidth;
  image.height = kHeight;
  const bool is_mono = encoding == "mono8";
  image.bytes_per_row = kWidth * (is_mono ? 1 : 3);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const auto red = static_cast<std::uint8_t>(5 * (kWidth - 1 - column));
      const auto green = static_cast<std::uint8_t>(8 * row);
      const auto blue = static_cast<std::uint8_t>(5 * column);
      if (is_mono) {
        image.data.push_back(green);
      } else if (encoding == "rgb8") {
        image.data.insert(image.data.end(), {red, green, blue});
      } else {
        image.data.insert(image.data.end(), {blue, green, red});
      }
    }
  }
  return image;
}

PictureFile read_back(const std::vector<std::uint8_t>& bytes) {
  const ScratchFolder folder;
  const std::string file = folder.path() + "/picture";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return read_picture(file);
}

/// Largest difference of a channel from make_picture("rgb8").
int worst_error(const PictureFile& picture) {
  const ImageSample expected = make_picture("rgb8");
  int worst = 0;
  for (std::size_t i = 0; i < expected.data.size(); ++i) {
    worst = std::max(worst, std::abs(picture.rgba[4 * (i / 3) + i % 3] - expected.data[i]));
  }
  return worst;
}

TEST(ImageCodec, ColorsArriveWhateverTheirOrder) {
  for (const char* encoding : {"rgb8", "bgr8"}) {
    for (const bool as_png : {false, true}) {
      CompressedPicture out;
      compress_picture(make_picture(encoding), {as_png, 95, 3}, out);
      EXPECT_EQ(out.format, std::string(encoding) +
                                (as_png ? "; png compressed bgr8" : "; jpeg compressed bgr8"));
      const PictureFile picture = read_back(out.data);
      ASSERT_EQ(picture.columns, kWidth);
      ASSERT_EQ(picture.rows, kHeight);
      EXPECT_LE(worst_error(picture), as_png ? 0 : 16) << out.format;
    }
  }
}

TEST(ImageCodec, GrayStaysGray) {
  CompressedPicture out;
  compress_picture(make_picture("mono8"), {}, out);
  EXPECT_EQ(out.format, "mono8; jpeg compressed ");
  EXPECT_NEAR(read_back(out.data).rgba[4 * (20 * kWidth + 7)], 8 * 20, 6);
}

TEST(ImageCodec, QualityCounts) {
  CompressedPicture fine, coarse;
  compress_picture(make_picture("rgb8"), {false, 95, 1}, fine);
  compress_picture(make_picture("rgb8"), {false, 10, 1}, coarse);
  EXPECT_LT(coarse.data.size(), fine.data.size());
}

TEST(ImageCodec, WhatCannotBeWrittenIsReported) {
  ImageSample empty;
  empty.encoding = "rgb8";
  CompressedPicture out;
  EXPECT_TRUE(contains(error_of([&] {
                         compress_picture(empty, {false, 95, 3}, out);
                       }),
                       "picture cannot be written as a JPEG: Empty JPEG image"));
  EXPECT_TRUE(contains(error_of([&] {
                         compress_picture(empty, {true, 95, 3}, out);
                       }),
                       "picture cannot be written as a PNG: Invalid IHDR data"));
}

/// As cv::imdecode() with IMREAD_UNCHANGED gives them.
std::vector<std::uint16_t> read_16_bits(const std::vector<std::uint8_t>& bytes, std::size_t first) {
  struct Source {
    const std::uint8_t* at;
  } source{bytes.data() + first};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &source, [](png_structp from, png_bytep to, png_size_t size) {
    auto* const rest = static_cast<Source*>(png_get_io_ptr(from));
    std::memcpy(to, rest->at, size);
    rest->at += size;
  });
  png_read_info(png, info);
  EXPECT_EQ(png_get_bit_depth(png, info), 16);
  EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_GRAY);
  png_set_swap(png);
  const std::size_t width = png_get_image_width(png, info);
  std::vector<std::uint16_t> values(width * png_get_image_height(png, info));
  for (std::size_t row = 0; row < values.size() / width; ++row) {
    png_read_row(png, reinterpret_cast<png_bytep>(&values[row * width]), nullptr);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return values;
}

template <class Depth>
ImageSample make_depths(const std::string& encoding, const std::vector<Depth>& depths) {
  ImageSample image;
  image.encoding = encoding;
  image.width = static_cast<std::uint32_t>(depths.size());
  image.height = 1;
  image.bytes_per_row = image.width * static_cast<std::uint32_t>(sizeof(Depth));
  image.data.resize(depths.size() * sizeof(Depth));
  std::memcpy(image.data.data(), depths.data(), image.data.size());
  return image;
}

TEST(ImageCodec, DepthsInMetersArriveWithinTheirStep) {
  const std::vector<float> depths{0.5F,
                                  1.0F,
                                  3.3F,
                                  9.9F,
                                  10.1F,
                                  std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::infinity(),
                                  0.01F};
  CompressedPicture out;
  compress_depth(make_depths("32FC1", depths), {10.0, 100.0, 1}, out);
  EXPECT_EQ(out.format, "32FC1; compressedDepth png");
  std::int32_t format = -1;
  float ab[2];
  std::memcpy(&format, out.data.data(), 4);
  std::memcpy(ab, out.data.data() + 4, 8);
  EXPECT_EQ(format, 0);
  const auto inverse = read_16_bits(out.data, 12);
  ASSERT_EQ(inverse.size(), depths.size());
  for (std::size_t i = 0; i < 4; ++i) {
    const float back = ab[0] / (static_cast<float>(inverse[i]) - ab[1]);
    EXPECT_NEAR(back, depths[i], 1.1F * depths[i] * depths[i] / ab[0]) << depths[i];
  }
  for (const std::size_t none : {4u, 5u, 6u}) EXPECT_EQ(inverse[none], 0u) << depths[none];
  EXPECT_EQ(inverse[7], 65535u) << "nearer than can be encoded";
}

TEST(ImageCodec, DepthsInMillimetersArriveExactly) {
  CompressedPicture out;
  compress_depth(make_depths<std::uint16_t>("16UC1", {0, 512, 9999, 10001}), {10.0, 100.0, 1}, out);
  EXPECT_EQ(out.format, "16UC1; compressedDepth png");
  EXPECT_EQ(read_16_bits(out.data, 12), (std::vector<std::uint16_t>{0, 512, 9999, 0}));
}

TEST(ImageCodec, LabelsArriveExactly) {
  CompressedPicture out;
  compress_picture(make_depths<std::uint16_t>("mono16", {0, 1, 258, 65535}), {}, out);
  EXPECT_EQ(out.format, "mono16; png compressed ");
  EXPECT_EQ(read_16_bits(out.data, 0), (std::vector<std::uint16_t>{0, 1, 258, 65535}));
}

TEST(ImageCodec, OtherEncodingsAreRefused) {
  CompressedPicture out;
  EXPECT_TRUE(
      contains(error_of([&] { compress_picture(make_depths<float>("32FC1", {1}), {}, out); }),
               "'32FC1' cannot be compressed"));
  EXPECT_TRUE(contains(error_of([&] { compress_depth(make_picture("rgb8"), {}, out); }),
                       "'rgb8' has no depths"));
}

}  // namespace
}  // namespace trident::sim
