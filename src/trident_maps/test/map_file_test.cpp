// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps/map_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace trident::maps {
namespace {

namespace fs = std::filesystem;
using Kind = MapFileError::Kind;

const std::string kRest =
    "resolution: 0.1\norigin: [1.0, -2.0, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

class MapFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "trident_map_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string read(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  OccupancyGrid load(const std::string& image, const std::string& rest = kRest) const {
    return load_map(write("map.yaml", "image: " + image + "\n" + rest));
  }
  MapFileError error_of(const std::string& yaml) const {
    try {
      load_map(write("map.yaml", yaml));
    } catch (const MapFileError& error) {
      return error;
    }
    return {Kind::kNoSuchFile, "no error"};
  }
  void write_png(const std::string& name, png_uint_32 format, const void* pixels) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 2;
    image.height = 1;
    image.format = format;
    ASSERT_NE(png_image_write_to_file(&image, (folder_ / name).c_str(), 0, pixels, 0, nullptr), 0);
  }

  fs::path folder_;
};

using Cells = std::vector<std::int8_t>;

TEST_F(MapFileTest, BinaryPgmHasItsLastRowAtTheOrigin) {
  write("a.pgm", std::string("P5\n# a comment\n2 2\n255\n") + "\xfe" + '\0' + "\xcd" + "\xfe");
  const OccupancyGrid grid = load("a.pgm");
  EXPECT_EQ(grid.cells, (Cells{-1, 0, 0, 100}));
  EXPECT_DOUBLE_EQ(grid.resolution, 0.1);
  EXPECT_DOUBLE_EQ(grid.T_map_origin.p.y(), -2.0);
  EXPECT_DOUBLE_EQ(grid.T_map_origin.angle, 0.5);
}

TEST_F(MapFileTest, PlainAndSixteenBitPgmsAreTheSameMap) {
  write("plain.pgm", "P2\n3 1\n# grey\n1000\n1000 700 0\n");
  EXPECT_EQ(load("plain.pgm").cells, (Cells{0, -1, 100}));
  write("wide.pgm", std::string("P5 3 1 65535\n") + "\xff\xff\xcd\xcd" + std::string(2, '\0'));
  EXPECT_EQ(load("wide.pgm").cells, (Cells{0, -1, 100}));
}

TEST_F(MapFileTest, ModesAndNegate) {
  write("a.pgm", "P2 4 1 255 254 128 90 0\n");
  const auto with = [](const std::string& mode) { return kRest + "mode: " + mode + "\n"; };
  EXPECT_EQ(load("a.pgm", with("trinary")).cells, (Cells{0, -1, -1, 100}));
  // (127 / 255 - 0.196) / (0.65 - 0.196) = 0.6653, and 1 + 98 * 0.6653 = 66.2.
  EXPECT_EQ(load("a.pgm", with("scale")).cells, (Cells{0, 66, 98, 100}));
  EXPECT_EQ(load("a.pgm", with("raw")).cells, (Cells{-1, -1, 90, 0}));
  std::string negated = kRest;
  negated.replace(negated.find("negate: 0"), 9, "negate: 1");
  EXPECT_EQ(load("a.pgm", negated).cells, (Cells{100, -1, -1, 0}));
}

TEST_F(MapFileTest, PngsOfAnyKind) {
  const unsigned char gray[] = {254, 0};
  write_png("grey.png", PNG_FORMAT_GRAY, gray);
  EXPECT_EQ(load("grey.png").cells, (Cells{0, 100}));
  // Transparent white is unknown, opaque black (mean with alpha 63.75) occupied.
  const unsigned char rgba[] = {255, 255, 255, 0, 0, 0, 0, 255};
  write_png("rgba.png", PNG_FORMAT_RGBA, rgba);
  EXPECT_EQ(load("rgba.png").cells, (Cells{-1, 100}));
}

TEST_F(MapFileTest, KeysOfOtherToolsArePassedOver) {
  write("a.pgm", "P2 1 1 255 0\n");
  EXPECT_EQ(load("a.pgm", kRest + "cost_translation_table: [1, 2]\n").cells, Cells{100});
}

TEST_F(MapFileTest, AnErrorNamesFileFieldValueAndRange) {
  write("short.pgm", "P5 4 4 255\nabc");
  write("text.pgm", "hello");
  write("bad.png", "\x89PNG\r\n\x1a\n-----");
  write("a.pgm", "P2 1 1 255 0\n");
  struct Case {
    std::string yaml;
    Kind kind;
    std::string words;
  };
  const Case cases[] = {
      {"image: short.pgm\n" + kRest, Kind::kBadImage, "ends after 3 of the 4 x 4 pixels"},
      {"image: text.pgm\n" + kRest, Kind::kBadImage, "neither a PNG nor a PGM (P2, P5)"},
      {"image: bad.png\n" + kRest, Kind::kBadImage, "is a bad PNG"},
      {"image: none.pgm\n" + kRest, Kind::kNoSuchFile, "none.pgm' cannot be read"},
      {"image: a.pgm\nresolution: [\n", Kind::kBadMetadata, "map.yaml:"},
      {"image: a.pgm\nresolution: 0.1\n", Kind::kBadMetadata, "origin"},
      {"image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 1.5\n"
       "free_thresh: 0.1\n",
       Kind::kBadMetadata, "map.yaml:5: occupied_thresh"},
      {"image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.1\n"
       "free_thresh: 0.6\n",
       Kind::kBadMetadata, "less than occupied_thresh"},
      {"image: a.pgm\n" + kRest + "mode: grey\n", Kind::kBadMetadata, "trinary, scale, raw"},
  };
  for (const Case& c : cases) {
    const MapFileError error = error_of(c.yaml);
    EXPECT_EQ(error.kind(), c.kind) << error.what();
    EXPECT_NE(std::string(error.what()).find(c.words), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("map.yaml"), std::string::npos) << error.what();
  }
  EXPECT_THROW(load_map((folder_ / "nothing.yaml").string()), MapFileError);
}

TEST_F(MapFileTest, SavedAsMapSaverDoesAndReadBack) {
  OccupancyGrid grid;
  grid.width = 2;
  grid.height = 2;
  grid.resolution = 0.025;
  grid.T_map_origin = SE2::from_xy_yaw(-1.5, 2.25, 0.0);
  grid.cells = {0, 100, -1, 25};
  save_map((folder_ / "out").string(), grid);
  EXPECT_EQ(read("out.pgm"), std::string("P5\n# CREATOR: map_saver.cpp 0.025 m/pix\n2 2\n255\n") +
                                 "\xcd\xfe\xfe" + '\0');
  EXPECT_EQ(read("out.yaml"),
            "image: out.pgm\nresolution: 0.025000\norigin: [-1.500000, 2.250000, 0.000000]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n");
  EXPECT_EQ(load_map((folder_ / "out.yaml").string()).cells, (Cells{0, 100, -1, 0}));
  EXPECT_THROW(save_map((folder_ / "none" / "out").string(), grid), Error);
  EXPECT_THROW(save_map((folder_ / "out").string(), grid, {20, 30}), Error);
}

}  // namespace
}  // namespace trident::maps
