// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps/map_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "trident_base/pixel_image.h"
#include "trident_base/string_util.h"
#include "trident_base/yaml_config.h"

namespace trident::maps {
namespace {

namespace fs = std::filesystem;

constexpr std::array kKnownKeys{"image",       "resolution", "origin", "occupied_thresh",
                                "free_thresh", "negate",     "mode"};
constexpr unsigned char kWhite = 254, kGray = 205, kBlack = 0;  // map_saver's

/// Files of other programs have keys of their own, which map_server ignores as well.
ConfigNode known_keys_only(const ConfigNode& node) {
  ConfigNode result = node;
  result.keys.clear();
  result.items.clear();
  result.key_lines.clear();
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const auto is_key = [&](const char* known) { return node.keys[i] == known; };
    if (std::none_of(kKnownKeys.begin(), kKnownKeys.end(), is_key)) continue;
    result.keys.push_back(node.keys[i]);
    result.items.push_back(node.items[i]);
    result.key_lines.push_back(node.key_lines[i]);
  }
  return result;
}

PixelImage read_picture(const std::string& path) {
  try {
    return read_pixel_image(path);
  } catch (const PixelImageError& error) {
    const bool is_there = error.kind() == PixelImageError::Kind::kBad;
    throw MapFileError(is_there ? MapFileError::Kind::kBadImage : MapFileError::Kind::kNoSuchFile,
                       error.what());
  }
}

/// The mean of a pixel's samples, 0 ... 255. Alpha counts in trinary maps, as in map_server: a
/// transparent white pixel is unknown.
double brightness(const PixelImage& image, const std::uint16_t* pixel, MapMode mode) {
  const int colors = image.channels - (image.has_alpha() && mode != MapMode::kTrinary ? 1 : 0);
  double sum = 0.0;
  for (int i = 0; i < colors; ++i) sum += pixel[i];
  return sum / colors * (255.0 / image.white);
}

/// Of a pixel between white (0) and black (1), in the modes trinary and scale of map_server.
std::int8_t occupancy_of_darkness(double dark, bool is_transparent, const MapFile& file) {
  if (dark > file.occupied_thresh) return OccupancyGrid::kOccupied;
  if (dark < file.free_thresh) return OccupancyGrid::kFree;
  if (file.mode == MapMode::kTrinary || is_transparent) return OccupancyGrid::kUnknown;
  // 1 to 99, as map_server: 0 and 100 are kept for what is free and what is occupied.
  const double between = (dark - file.free_thresh) / (file.occupied_thresh - file.free_thresh);
  return static_cast<std::int8_t>(1.0 + 98.0 * between);
}

std::int8_t occupancy(const PixelImage& image, const std::uint16_t* pixel, const MapFile& file) {
  double bright = brightness(image, pixel, file.mode);
  if (file.negate != 0) bright = 255.0 - bright;
  if (file.mode == MapMode::kRaw) {
    // Raw pixels are percent of occupancy themselves.
    return bright > 100.0 ? OccupancyGrid::kUnknown : static_cast<std::int8_t>(bright);
  }
  return occupancy_of_darkness((255.0 - bright) / 255.0,
                               image.has_alpha() && pixel[image.channels - 1] == 0, file);
}

/// Written to a temporary file next to it, which is then renamed.
void write_file(const std::string& path, const std::string& bytes) {
  // Who reads the map at this moment has the old file or the new one, never half of it.
  const std::string part = path + ".part";
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(part, path, error);
  if (out && !error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  throw Error("'" + path + "' cannot be written" + (error ? ": " + error.message() : ""));
}

template <class... Args>
std::string formatted(const char* format, Args... args) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, args...);  // NOLINT: a printf on purpose
  return text.data();
}

/// Rows of an image go down, those of the grid up: the last row of the grid is written first. The
/// three greys are those of map_saver.
std::string pgm_of(const OccupancyGrid& grid, const SaveThresholds& thresholds) {
  std::string bytes = formatted("P5\n# CREATOR: map_saver.cpp %.3f m/pix\n%d %d\n255\n",
                                grid.resolution, grid.width, grid.height);
  bytes.reserve(bytes.size() + grid.cells.size());
  for (int row = grid.height - 1; row >= 0; --row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::int8_t cell = grid.cells[grid.index(column, row)];
      unsigned char pixel = kGray;
      if (cell >= 0 && cell <= thresholds.free) {
        pixel = kWhite;
      } else if (cell >= thresholds.occupied) {
        pixel = kBlack;
      }
      bytes.push_back(static_cast<char>(pixel));
    }
  }
  return bytes;
}

}  // namespace

void MapFile::validate() const {
  if (image.empty()) throw Error("image: '', legal: the name of a .pgm or .png file");
  if (free_thresh >= occupied_thresh) {
    throw Error("free_thresh: " + number_text(free_thresh) +
                ", legal: less than occupied_thresh (" + number_text(occupied_thresh) + ")");
  }
}

void SaveThresholds::validate() const {
  if (occupied < 1 || occupied > 100) {
    throw Error("--occ: " + std::to_string(occupied) + ", legal: 1 to 100");
  }
  if (free < 0 || free > 100) {
    throw Error("--free: " + std::to_string(free) + ", legal: 0 to 100");
  }
  if (free >= occupied) {
    throw Error("--free: " + std::to_string(free) + ", legal: less than --occ (" +
                std::to_string(occupied) + ")");
  }
}

/// The kind of an error is what map_server's service returns: a missing file, metadata or an image
/// that cannot be used.
OccupancyGrid load_map(const std::string& yaml_path) {
  std::error_code error;
  if (!fs::is_regular_file(yaml_path, error)) {
    throw MapFileError(MapFileError::Kind::kNoSuchFile,
                       "map '" + yaml_path + "' is not a file that can be read");
  }
  MapFile file;
  try {
    const ConfigNode node = parse_yaml(read_config_file(yaml_path), yaml_path);
    file = load_config_node<MapFile>(known_keys_only(node), yaml_path);
  } catch (const Error& problem) {
    throw MapFileError(MapFileError::Kind::kBadMetadata, problem.what());
  }
  try {
    return load_map_image(file, fs::path(yaml_path).parent_path().string());
  } catch (const MapFileError& problem) {
    throw MapFileError(problem.kind(), yaml_path + ": " + problem.what());
  }
}

OccupancyGrid load_map_image(const MapFile& file, const std::string& folder) {
  const PixelImage image = read_picture((fs::path(folder) / file.image).string());
  OccupancyGrid grid;
  grid.width = image.width;
  grid.height = image.height;
  grid.resolution = file.resolution;
  grid.T_map_origin = SE2::from_xy_yaw(file.origin.x(), file.origin.y(), file.origin.z());
  grid.cells.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const std::uint16_t* pixel = image.samples.data();
  for (int row = image.height - 1; row >= 0; --row) {  // a picture begins at its top
    for (int column = 0; column < image.width; ++column, pixel += image.channels) {
      grid.cells[grid.index(column, row)] = occupancy(image, pixel, file);
    }
  }
  return grid;
}

void save_map(const std::string& base, const OccupancyGrid& grid,
              const SaveThresholds& thresholds) {
  thresholds.validate();
  write_file(base + ".pgm", pgm_of(grid, thresholds));
  const SE2& T = grid.T_map_origin;
  // The thresholds are map_saver's, whatever the grid was cut with: they divide its three grays.
  write_file(base + ".yaml",
             "image: " + fs::path(base + ".pgm").filename().string() + "\n" +
                 formatted("resolution: %f\norigin: [%f, %f, %f]\nnegate: 0\noccupied_thresh: "
                           "0.65\nfree_thresh: 0.196\n\n",
                           grid.resolution, T.p.x(), T.p.y(), T.angle));
}

}  // namespace trident::maps
