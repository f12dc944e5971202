// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "trident_base/config_types.h"
#include "trident_base/error.h"
#include "trident_base/occupancy_grid.h"

namespace trident::maps {

/// How the brightness of a pixel becomes the occupancy of a cell. With `dark`, 0 for a white and 1
/// for a black pixel (inverted where `negate` is 1):
///   trinary  occupied (100) above occupied_thresh, free (0) below free_thresh, else unknown (-1);
///   scale    as trinary, but what lies between grows from 1 to 99, and only transparent pixels
///            are unknown;
///   raw      the pixel's value (0 ... 255) itself, unknown above 100.
enum class MapMode { kTrinary, kScale, kRaw };
/// Names of the modes in YAML, those of map_server.
constexpr auto enum_names(MapMode) {
  return std::array{EnumName{MapMode::kTrinary, "trinary"}, EnumName{MapMode::kScale, "scale"},
                    EnumName{MapMode::kRaw, "raw"}};
}

/// The keys of a map's YAML file, those of map_server.
struct MapFile {
  std::string image;                                 ///< path, relative to the YAML file's folder
  double resolution = 0.05;                          ///< side of a cell [m]
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< x [m], y [m], yaw [rad] of cell (0, 0)
  double occupied_thresh = 0.65;                     ///< in [0, 1]
  double free_thresh = 0.196;                        ///< in [0, 1]
  int negate = 0;                                    ///< 1: white is occupied
  MapMode mode = MapMode::kTrinary;                  ///< how brightness becomes occupancy

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("image", image, "file of the picture, .pgm or .png");
    ar.required("resolution", resolution, Range::positive(), "side of a cell [m]");
    ar.required("origin", origin, Range::any(), "lower left corner: x, y [m], yaw [rad]");
    ar.required("occupied_thresh", occupied_thresh, Range{0.0, 1.0}, "darker is occupied");
    ar.required("free_thresh", free_thresh, Range{0.0, 1.0}, "brighter is free");
    ar.required("negate", negate, Range{0.0, 1.0}, "1: white is occupied");
    ar.field("mode", mode, "how brightness becomes occupancy");
  }
  /// Throws Error unless free_thresh < occupied_thresh and an image is named.
  void validate() const;
};

/// A map that cannot be read; `what()` names file, line or field, value and legal range.
class MapFileError : public Error {
 public:
  /// What is wrong decides how a caller answers (nav_msgs/LoadMap has a code for each).
  enum class Kind { kNoSuchFile, kBadMetadata, kBadImage };
  /// `text` is complete, see above.
  MapFileError(Kind kind, const std::string& text) : Error(text), kind_(kind) {}
  Kind kind() const { return kind_; }  ///< decides the code of an answer

 private:
  Kind kind_;
};

/// Reads a map's YAML file and its picture: PGM (plain or binary, 8 or 16 bit) or PNG (any). Keys
/// that map_server does not know are passed over, as it does. Throws MapFileError.
OccupancyGrid load_map(const std::string& yaml_path);

/// The same with the YAML file already read; `folder` is where a relative image lies.
OccupancyGrid load_map_image(const MapFile& file, const std::string& folder);

/// What map_saver's --occ and --free say [%].
struct SaveThresholds {
  int occupied = 65;  ///< this and above is drawn black
  int free = 25;      ///< this and below is drawn white

  /// Throws Error unless 1 <= free < occupied <= 100, map_saver's own limits.
  void validate() const;
};

/// Writes `base`.pgm and `base`.yaml as map_saver does, byte by byte, except that the YAML file
/// names the picture without its folder, so that both can be moved. Neither file is ever seen half
/// written. Throws Error naming the file.
void save_map(const std::string& base, const OccupancyGrid& grid,
              const SaveThresholds& thresholds = {});

}  // namespace trident::maps
