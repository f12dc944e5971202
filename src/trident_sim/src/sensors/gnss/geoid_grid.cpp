// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "geoid_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr std::streamoff kHeaderBytes = 40;
constexpr std::int32_t kMaxNodes = 100'000;  ///< a side
constexpr float kNoValue = -88.8888F;        ///< of nodes without a height

class GtxFile {
 public:
  explicit GtxFile(const std::string& name) : name_(name), stream_(name, std::ios::binary) {
    south_ = number<double>();
    west_ = number<double>();
    step_latitude_ = number<double>();
    step_longitude_ = number<double>();
    rows_ = number<std::int32_t>();
    columns_ = number<std::int32_t>();
    const bool has_origin = std::isfinite(south_) && std::isfinite(west_);
    const bool has_steps = step_latitude_ > 0.0 && step_longitude_ > 0.0;
    const auto is_count = [](std::int32_t nodes) { return nodes > 1 && nodes <= kMaxNodes; };
    if (!stream_.good() || !has_origin || !has_steps) refuse();
    if (!is_count(rows_) || !is_count(columns_)) refuse();
  }

  std::optional<double> height_m(double latitude_deg, double longitude_deg) {
    const double y = (latitude_deg - south_) / step_latitude_;
    const double turn = 360.0 / step_longitude_;
    double x = (longitude_deg - west_) / step_longitude_;
    // Longitudes count eastwards from the grid's edge, once around.
    x -= turn * std::floor(x / turn);
    const bool goes_round = std::abs(columns_ - turn) < 0.5;
    if (y < 0.0 || y > rows_ - 1 || (!goes_round && x > columns_ - 1)) return std::nullopt;
    const int row = std::min(static_cast<int>(y), rows_ - 2);
    const int column = std::min(static_cast<int>(x), goes_round ? columns_ - 1 : columns_ - 2);
    const int next = (column + 1) % columns_;
    const double up = y - row, right = x - column;
    const std::array<float, 4> nodes{node(row, column), node(row, next), node(row + 1, column),
                                     node(row + 1, next)};
    if (std::find(nodes.begin(), nodes.end(), kNoValue) != nodes.end()) return std::nullopt;
    return (1.0 - up) * ((1.0 - right) * nodes[0] + right * nodes[1]) +
           up * ((1.0 - right) * nodes[2] + right * nodes[3]);
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error("geoid '" + name_ + "' cannot be read: not a GTX file, or cut off");
  }

  /// Big-endian.
  template <class Number>
  Number number() {
    std::array<char, sizeof(Number)> bytes{};
    stream_.read(bytes.data(), bytes.size());
    std::reverse(bytes.begin(), bytes.end());
    Number value{};
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  float node(int row, int column) {
    const std::streamoff index = static_cast<std::streamoff>(row) * columns_ + column;
    stream_.seekg(kHeaderBytes + index * static_cast<std::streamoff>(sizeof(float)));
    const auto value = number<float>();
    if (!stream_.good() || !std::isfinite(value)) refuse();
    return value;
  }

  std::string name_;
  std::ifstream stream_;
  double south_ = 0.0, west_ = 0.0, step_latitude_ = 0.0, step_longitude_ = 0.0;  ///< [degrees]
  std::int32_t rows_ = 0, columns_ = 0;
};

}  // namespace

// PROJ's own search: the variable of its newer versions, that of older ones, Debian's folder.
std::string find_egm96_grid() {
  std::array<std::string, 3> folders{"", "", "/usr/share/proj"};
  if (const char* const data = std::getenv("PROJ_DATA")) folders[0] = data;
  if (const char* const lib = std::getenv("PROJ_LIB")) folders[1] = lib;
  for (const std::string& folder : folders) {
    std::string file = folder + "/egm96_15.gtx";
    std::error_code ignored;
    if (!folder.empty() && std::filesystem::exists(file, ignored)) return file;
  }
  return "";
}

std::optional<double> geoid_height_m(const std::string& gtx_file, double latitude_deg,
                                     double longitude_deg) {
  return GtxFile(gtx_file).height_m(latitude_deg, longitude_deg);
}

}  // namespace trident::sim
