// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "wind_field.h"

namespace trident::sim {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";
constexpr double kMaxColumns = 1e6;  ///< along one axis

/// Those of the files that rotors_gazebo_wind_plugin reads, in their order.
const std::vector<std::string>& field_names() {
  static const std::vector<std::string> names{
      "min_x",    "min_y", "n_x", "n_y", "res_x", "res_y", "vertical_spacing_factors",
      "bottom_z", "top_z", "u",   "v",   "w"};
  return names;
}

/// std::from_chars, which no locale changes; it knows no plus sign.
std::optional<double> parse_number(std::string_view word) {
  // A sign is taken off once: "+-1" is no number.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// The fields of a file by name, and what may be asked of them.
class FieldFile {
 public:
  explicit FieldFile(const std::string& path) : path_(path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw Error(path + ": cannot be read");
    parse(text.str());
  }

  double number(const std::string& name) const {
    expect_size(name, 1, "1");
    return find(name).values.front();
  }
  double positive(const std::string& name) const {
    const double value = number(name);
    if (!(value > 0.0)) refuse(name, value, "a number > 0");
    return value;
  }
  std::size_t count(const std::string& name) const {
    const double value = number(name);
    if (value != std::floor(value) || value < 2.0 || value > kMaxColumns) {
      refuse(name, value, "a whole number in [2, " + number_text(kMaxColumns) + "]");
    }
    return static_cast<std::size_t>(value);
  }
  const std::vector<double>& list(const std::string& name) const { return find(name).values; }
  const std::vector<double>& list(const std::string& name, std::size_t size,
                                  const std::string& size_text) const {
    expect_size(name, size, size_text + " = " + std::to_string(size));
    return find(name).values;
  }

  [[noreturn]] void refuse(const std::string& name, double value,
                           const std::string& expected) const {
    throw Error(at(find(name).line) + name + " is '" + number_text(value) + "', expected " +
                expected);
  }
  [[noreturn]] void refuse_size(const std::string& name, const std::string& expected) const {
    const Field& field = find(name);
    throw Error(at(field.line) + name + " has " + std::to_string(field.values.size()) +
                " numbers, expected " + expected);
  }
  [[noreturn]] void refuse_entry(const std::string& name, std::size_t index,
                                 const std::string& expected) const {
    const Field& field = find(name);
    throw Error(at(field.line) + name + " has '" + number_text(field.values[index]) +
                "' as number " + std::to_string(index + 1) + ", expected " + expected);
  }

 private:
  struct Field {
    std::size_t line = 0;  ///< of its name
    std::vector<double> values;
  };

  std::string at(std::size_t line) const { return path_ + ":" + std::to_string(line) + ": "; }

  const Field& find(const std::string& name) const {
    const auto it = fields_.find(name);
    if (it == fields_.end()) {
      throw Error(path_ + ": field '" + name + "' is missing; a wind field has " +
                  join(field_names()));
    }
    return it->second;
  }

  void expect_size(const std::string& name, std::size_t size, const std::string& size_text) const {
    if (find(name).values.size() != size) refuse_size(name, size_text);
  }

  // Words end at blanks; one that ends with a colon opens a field, all others are its numbers.
  // Lines only count for errors.
  void parse(std::string_view text) {
    std::size_t line = 1;
    auto field = fields_.end();
    for (std::size_t i = 0; i < text.size();) {
      if (kBlanks.find(text[i]) != std::string_view::npos) {
        if (text[i++] == '\n') ++line;
        continue;
      }
      const std::size_t end = std::min(text.find_first_of(kBlanks, i), text.size());
      const std::string_view word = text.substr(i, end - i);
      if (word.back() == ':') {
        field = open(word.substr(0, word.size() - 1), line);
      } else if (field == fields_.end()) {
        throw Error(at(line) + "'" + std::string(word) + "' stands before any field, expected " +
                    "one of " + join(field_names()) + " with a colon");
      } else if (const auto value = parse_number(word)) {
        field->second.values.push_back(*value);
      } else {
        throw Error(at(line) + field->first + " has '" + std::string(word) +
                    "', expected a finite number, or the name of the next field with a colon");
      }
      i = end;
    }
  }

  std::map<std::string, Field>::iterator open(std::string_view name, std::size_t line) {
    const auto& known = field_names();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(at(line) + "unknown field " + unknown_name_text(name, known));
    }
    const auto [field, is_new] = fields_.try_emplace(std::string(name));
    if (!is_new) {
      throw Error(at(line) + "field '" + std::string(name) + "' is given twice, first in line " +
                  std::to_string(field->second.line));
    }
    field->second.line = line;
    return field;
  }

  std::string path_;
  std::map<std::string, Field> fields_;
};

/// Factors are heights between the ground (0) and the top (1) of a column, in rising order.
void check_spacing(const FieldFile& file) {
  const std::string name = "vertical_spacing_factors";
  const std::vector<double>& factors = file.list(name);
  if (factors.size() < 2) file.refuse_size(name, "at least 2");
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (!(factors[k] >= 0.0 && factors[k] <= 1.0)) {
      file.refuse_entry(name, k, "a number in [0, 1]");
    }
    if (k > 0 && !(factors[k] > factors[k - 1])) {
      file.refuse_entry(name, k, "more than the one before, " + number_text(factors[k - 1]));
    }
  }
}

void check_heights(const FieldFile& file, const WindGrid& grid) {
  for (std::size_t i = 0; i < grid.top_z_m.size(); ++i) {
    if (grid.top_z_m[i] > grid.bottom_z_m[i]) continue;
    file.refuse_entry("top_z", i,
                      "more than bottom_z of that column, " + number_text(grid.bottom_z_m[i]));
  }
}

}  // namespace

/// Each count is checked before the lists that depend on it, so that an error names its cause.
WindGrid read_wind_grid(const std::string& path) {
  const FieldFile file(path);
  WindGrid grid;
  grid.min_x_m = file.number("min_x");
  grid.min_y_m = file.number("min_y");
  grid.n_x = file.count("n_x");
  grid.n_y = file.count("n_y");
  grid.res_x_m = file.positive("res_x");
  grid.res_y_m = file.positive("res_y");
  grid.spacing_factors = file.list("vertical_spacing_factors");
  check_spacing(file);
  const std::size_t columns = grid.n_x * grid.n_y;
  grid.bottom_z_m = file.list("bottom_z", columns, "n_x n_y");
  grid.top_z_m = file.list("top_z", columns, "n_x n_y");
  check_heights(file, grid);
  // Values come in layers from the ground up; in a layer x runs fastest.
  const std::size_t points = columns * grid.n_z();
  const std::string points_text = "n_x n_y times the number of vertical_spacing_factors";
  const auto& u = file.list("u", points, points_text);
  const auto& v = file.list("v", points, points_text);
  const auto& w = file.list("w", points, points_text);
  grid.v_world.reserve(points);
  for (std::size_t i = 0; i < points; ++i) grid.v_world.emplace_back(u[i], v[i], w[i]);
  return grid;
}

}  // namespace trident::sim
