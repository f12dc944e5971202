// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Pictures on disk.
#include "rays/textures/picture_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include <jpeglib.h>  // needs <cstdio>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

/// Left half red, right half blue; or with one channel, white and black.
void write_jpeg(const std::string& file, int columns, int rows, int channels) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  std::FILE* const out = std::fopen(file.c_str(), "wb");
  ASSERT_NE(out, nullptr);
  jpeg_stdio_dest(&info, out);
  info.image_width = static_cast<JDIMENSION>(columns);
  info.image_height = static_cast<JDIMENSION>(rows);
  info.input_components = channels;
  info.in_color_space = channels == 3 ? JCS_RGB : JCS_GRAYSCALE;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  jpeg_start_compress(&info, TRUE);
  std::vector<std::uint8_t> row;
  for (int column = 0; column < columns; ++column) {
    const bool is_left = column < columns / 2;
    row.push_back(is_left ? 255 : 0);
    if (channels == 3) row.insert(row.end(), {0, static_cast<std::uint8_t>(is_left ? 0 : 255)});
  }
  JSAMPROW pointer = row.data();
  for (int i = 0; i < rows; ++i) jpeg_write_scanlines(&info, &pointer, 1);
  jpeg_finish_compress(&info);
  std::fclose(out);
  jpeg_destroy_compress(&info);
}

const std::uint8_t* pixel(const PictureFile& picture, int column, int row) {
  return &picture.rgba[4 * static_cast<std::size_t>(row * picture.columns + column)];
}

TEST(PictureFile, AJpegIsReadWhateverItsName) {
  const ScratchFolder folder;
  const std::string file = folder.path() + "/wall.texture";
  write_jpeg(file, 48, 32, 3);
  const PictureFile picture = read_picture(file);
  ASSERT_EQ(picture.columns, 48);
  ASSERT_EQ(picture.rows, 32);
  ASSERT_EQ(picture.rgba.size(), 4u * 48u * 32u);
  for (const int row : {0, 17, 31}) {
    EXPECT_GT(pixel(picture, 4, row)[0], 245);
    EXPECT_LT(pixel(picture, 4, row)[2], 10);
    EXPECT_LT(pixel(picture, 44, row)[0], 10);
    EXPECT_GT(pixel(picture, 44, row)[2], 245);
  }
}

TEST(PictureFile, AGrayJpegIsGray) {
  const ScratchFolder folder;
  const std::string file = folder.path() + "/grey.jpg";
  write_jpeg(file, 32, 16, 1);
  const PictureFile picture = read_picture(file);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_GT(pixel(picture, 2, 8)[channel], 245);
    EXPECT_LT(pixel(picture, 29, 8)[channel], 10);
  }
}

TEST(PictureFile, WhatCannotBeReadIsNamed) {
  const ScratchFolder folder;
  const auto refusal = [](const std::string& file) {
    return error_of([&] { read_picture(file); });
  };
  EXPECT_TRUE(
      contains(refusal("/nowhere/wall.jpg"), "texture '/nowhere/wall.jpg' cannot be opened"));
  const std::string file = folder.path() + "/bad.jpg";
  std::ofstream(file) << "\xFF\xD8\xFF nothing of the kind";
  EXPECT_TRUE(contains(refusal(file), "bad.jpg' cannot be read as a JPEG: "));
  std::ofstream(file) << "GIF89a";
  EXPECT_TRUE(contains(refusal(file), "bad.jpg' cannot be read as a PNG: "));
}

}  // namespace
}  // namespace trident::sim
