// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "seabed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

// 200 MB of heights: more is a header that does not belong to its values.
constexpr double kMaxPoints = 5e7;

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Reads a grid word by word and knows the line.
class AsciiGridReader {
 public:
  explicit AsciiGridReader(const BathymetryParams& params) : file_(params.file), in_(params.file) {
    if (!in_) throw Error("bathymetry '" + file_ + "' cannot be read");
  }

  GroundGrid read(const BathymetryParams& params) {
    read_header();
    GroundGrid grid;
    grid.columns = static_cast<int>(required("ncols", 2.0, 1e6, true));
    grid.rows = static_cast<int>(required("nrows", 2.0, 1e6, true));
    if (static_cast<double>(grid.columns) * grid.rows > kMaxPoints) {
      refuse("ncols x nrows = " + number_text(grid.columns) + " x " + number_text(grid.rows),
             "at most " + number_text(kMaxPoints) + " cells");
    }
    const double cell = required("cellsize", 1e-6, 1e6, false);
    grid.cell = {cell, cell};
    // Values are those of cells; xllcorner is half a cell from the first one's middle.
    grid.origin = {lower_left("xll", cell), lower_left("yll", cell)};
    grid.origin += params.offset.head<2>();
    read_values(params, &grid);
    return grid;
  }

 private:
  [[noreturn]] void refuse(const std::string& is, const std::string& legal) const {
    throw Error("bathymetry '" + file_ + "' line " + std::to_string(line_) + ": " + is +
                ", expected " + legal);
  }

  bool next_line() {
    std::string text;
    if (!std::getline(in_, text)) return false;
    ++line_;
    words_.clear();
    words_.str(text);
    return true;
  }

  std::optional<std::string> next_word() {
    std::string word;
    while (!(words_ >> word)) {
      if (!next_line()) return std::nullopt;
    }
    return word;
  }

  double number(const std::string& word, const std::string& what) const {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !std::isfinite(value)) {
      refuse(what + " is '" + word + "'", "a finite number");
    }
    return value;
  }

  void read_header() {
    while (const auto word = next_word()) {
      const char first = word->front();
      // The header of an ESRI ASCII grid has keys with
      // values, in any order; the first number ends it.
      if (std::isalpha(static_cast<unsigned char>(first)) == 0) {
        first_value_ = *word;
        return;
      }
      const std::string key = lower_case(*word);
      const auto value = next_word();
      header_[key] = number(value.value_or(""), key);
    }
  }

  double required(const std::string& key, double lowest, double highest, bool whole) const {
    const auto it = header_.find(key);
    if (it == header_.end()) refuse("the header has no " + key, "an ESRI ASCII grid");
    const double value = it->second;
    if (value < lowest || value > highest || (whole && value != std::floor(value))) {
      refuse(key + " is " + number_text(value), (whole ? "a whole number in [" : "a number in [") +
                                                    number_text(lowest) + ", " +
                                                    number_text(highest) + "]");
    }
    return value;
  }

  /// Of the middle of the first cell.
  double lower_left(const std::string& key, double cell) const {
    const auto corner = header_.find(key + "corner"), center = header_.find(key + "center");
    if (corner == header_.end() && center == header_.end()) {
      refuse("the header has neither " + key + "corner nor " + key + "center", "one of them");
    }
    return corner != header_.end() ? corner->second + 0.5 * cell : center->second;
  }

  /// The next number; `what` says which it is.
  double read_value(const std::string& what) {
    const auto no_data = header_.find("nodata_value");
    const auto word = first_value_ ? std::exchange(first_value_, std::nullopt) : next_word();
    if (!word) refuse("the file ends before " + what, "a number for every cell");
    const double value = number(*word, what);
    if (no_data != header_.end() && value == no_data->second) {
      refuse(what + " has no data (" + *word + ")", "a height for every cell");
    }
    return value;
  }

  void read_values(const BathymetryParams& params, GroundGrid* grid) {
    const double sign = params.positive == VerticalSense::kUp ? 1.0 : -1.0;
    grid->z_m.resize(static_cast<std::size_t>(grid->columns) *
                     static_cast<std::size_t>(grid->rows));
    // Rows run from the top of the map down.
    for (int row = grid->rows - 1; row >= 0; --row) {
      for (int column = 0; column < grid->columns; ++column) {
        const double value = read_value("row " + std::to_string(grid->rows - row) + " column " +
                                        std::to_string(column + 1));
        grid->z_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid->columns) +
                  static_cast<std::size_t>(column)] =
            static_cast<float>(sign * value + params.offset.z());
      }
    }
    if (const auto word = next_word()) refuse("'" + *word + "' follows the last cell", "nothing");
  }

  std::string file_;
  std::ifstream in_;
  std::istringstream words_;
  int line_ = 0;
  std::map<std::string, double> header_;
  std::optional<std::string> first_value_;  ///< which ended the header
};

}  // namespace

void BathymetryParams::validate() const {
  if (kind == BathymetryKind::kFile && file.empty()) {
    throw Error("bathymetry: file = '' must name a file for kind file");
  }
}

GroundGrid read_ascii_grid(const BathymetryParams& params) {
  return AsciiGridReader(params).read(params);
}

/// Bilinear between the four points about the place. Beyond the edge it continues at the edge's
/// height, so that no cliff stands where the survey ends.
double GroundGrid::height_m(const Eigen::Vector2d& place) const {
  const double x = std::clamp(place.x(), 0.0, columns - 1.0);
  const double y = std::clamp(place.y(), 0.0, rows - 1.0);
  const int column = std::min(static_cast<int>(x), columns - 2);
  const int row = std::min(static_cast<int>(y), rows - 2);
  const auto width = static_cast<std::size_t>(columns);
  const float* const low =
      z_m.data() + static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
  const double wx = x - column, wy = y - row;
  const double below = low[0] + wx * (low[1] - low[0]);
  const double above = low[width] + wx * (low[width + 1] - low[width]);
  return below + wy * (above - below);
}

/// Of one grid the highest point of each block of cells is kept: most questions are whether the
/// water is deep enough to ignore the ground, and a block's maximum answers them.
Seabed::Seabed(std::vector<GroundGrid> grids) : grids_(std::move(grids)) {
  if (grids_.size() != 1) return;
  const GroundGrid& grid = grids_[0];
  const auto blocks = [](int points) { return (points - 2) / kBlock + 1; };
  block_columns_ = blocks(grid.columns);
  for (int y = 0; y < blocks(grid.rows); ++y) {
    for (int x = 0; x < block_columns_; ++x) {
      float highest = -std::numeric_limits<float>::infinity();
      for (int row = y * kBlock; row <= std::min((y + 1) * kBlock, grid.rows - 1); ++row) {
        const int first = x * kBlock, last = std::min((x + 1) * kBlock, grid.columns - 1);
        const auto begin = grid.z_m.begin() + std::ptrdiff_t{row} * grid.columns;
        highest = std::max(highest, *std::max_element(begin + first, begin + last + 1));
      }
      block_highest_m_.push_back(highest);
    }
  }
}

double Seabed::depth_m(const Eigen::Vector2d& p_world, double enough) const {
  if (grids_.size() != 1) return depth_m(p_world);
  const GroundGrid& grid = grids_[0];
  const Eigen::Vector2d place = grid.place(p_world);
  const int column = static_cast<int>(std::clamp(place.x(), 0.0, grid.columns - 2.0));
  const int row = static_cast<int>(std::clamp(place.y(), 0.0, grid.rows - 2.0));
  // The highest point of the block bounds the depth from below.
  const int block = row / kBlock * block_columns_ + column / kBlock;
  const double depth = -static_cast<double>(block_highest_m_[static_cast<std::size_t>(block)]);
  return depth >= enough ? depth : -grid.height_m(place);
}

/// Where grids overlap the higher one counts; outside of all of them the nearest edge.
double Seabed::height_m(const Eigen::Vector2d& p_world) const {
  if (grids_.size() == 1) return grids_[0].height_m(grids_[0].place(p_world));
  double highest = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity(), at_edge = 0.0;
  for (const GroundGrid& grid : grids_) {
    const Eigen::Vector2d place = grid.place(p_world);
    if (grid.contains(place)) {
      highest = std::max(highest, grid.height_m(place));
      continue;
    }
    const Eigen::Vector2d edge(std::clamp(place.x(), 0.0, grid.columns - 1.0),
                               std::clamp(place.y(), 0.0, grid.rows - 1.0));
    const double away = (place - edge).cwiseProduct(grid.cell).squaredNorm();
    if (away >= nearest) continue;
    nearest = away;
    at_edge = grid.height_m(edge);
  }
  return std::isfinite(highest) ? highest : at_edge;
}

/// Over the points below the level only: land has no depth.
double Seabed::mean_depth_m(double level_m) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (const GroundGrid& grid : grids_) {
    for (const float z : grid.z_m) {
      if (z >= level_m) continue;
      sum += level_m - z;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace trident::sim
