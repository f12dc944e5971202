// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "core/environment/wind_field.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

using FieldList = std::vector<std::pair<std::string, std::string>>;

/// 3 x 2 columns, two points each; u = 0 .. 11.
FieldList valid_fields() {
  return {{"min_x", "-4.5"},
          {"min_y", "2"},
          {"n_x", "3"},
          {"n_y", "2"},
          {"res_x", "0.5"},
          {"res_y", "1e1"},
          {"vertical_spacing_factors", "0.0 1.0"},
          {"bottom_z", "0 0 0 1 1 1"},
          {"top_z", "5 5 5 +6 6 6"},
          {"u", "0 1 2 3 4 5 6 7 8 9 10 11"},
          {"v", "0 0 0 0 0 0 -1 -1 -1 -1 -1 -1"},
          {"w", "0.1 0.1 0.1 0.1 0.1 0.1 0.1 0.1 0.1 0.1 0.1 0.1"}};
}

/// As RotorS' own file: a blank after the colon, the numbers on the next line.
std::string text_of(const FieldList& fields) {
  std::string text;
  for (const auto& [name, numbers] : fields) {
    text.append(name).append(": \n").append(numbers).append("\n");
  }
  return text;
}

void expect_valid(const WindGrid& grid) {
  EXPECT_EQ(grid.min_x_m, -4.5);
  EXPECT_EQ(grid.min_y_m, 2.0);
  EXPECT_EQ(grid.n_x, 3u);
  EXPECT_EQ(grid.n_y, 2u);
  EXPECT_EQ(grid.res_x_m, 0.5);
  EXPECT_EQ(grid.res_y_m, 10.0);
  EXPECT_EQ(grid.spacing_factors, (std::vector<double>{0, 1}));
  EXPECT_EQ(grid.bottom_z_m, (std::vector<double>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(grid.top_z_m, (std::vector<double>{5, 5, 5, 6, 6, 6}));
  ASSERT_EQ(grid.v_world.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(grid.v_world[i], Eigen::Vector3d(static_cast<double>(i), i < 6 ? 0 : -1, 0.1));
  }
}

class WindFieldFile : public testing::Test {
 protected:
  WindGrid read(const std::string& text) { return read_wind_grid(folder_.write("wind.txt", text)); }
  std::string refusal(const std::string& text) {
    return error_of([&] { read(text); });
  }
  ScratchFolder folder_;
};

TEST_F(WindFieldFile, IsReadInTheFormOfRotors) { expect_valid(read(text_of(valid_fields()))); }

TEST_F(WindFieldFile, FieldsMayStandInAnyOrder) {
  FieldList fields = valid_fields();
  std::reverse(fields.begin(), fields.end());
  expect_valid(read(text_of(fields)));
}

TEST_F(WindFieldFile, BlanksAndLineEndsDoNotMatter) {
  std::string one_line, windows = text_of(valid_fields());
  for (const auto& [name, numbers] : valid_fields()) {
    one_line.append(name).append(":\t").append(numbers).append("  ");
  }
  expect_valid(read(one_line));
  for (std::size_t i = windows.find('\n'); i != std::string::npos; i = windows.find('\n', i + 2)) {
    windows.insert(i, "\r");
  }
  expect_valid(read(windows));
  FieldList wrapped = valid_fields();
  for (auto& [name, numbers] : wrapped) std::replace(numbers.begin(), numbers.end(), ' ', '\n');
  expect_valid(read(text_of(wrapped)));
}

TEST_F(WindFieldFile, EachMissingFieldIsNamed) {
  for (std::size_t i = 0; i < valid_fields().size(); ++i) {
    FieldList fields = valid_fields();
    const std::string name = fields[i].first;
    fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(i));
    const std::string error = refusal(text_of(fields));
    EXPECT_TRUE(contains(error, "wind.txt: field '" + name + "' is missing"));
    EXPECT_TRUE(contains(error, "has min_x, min_y, n_x, n_y, res_x, res_y, vertical_spacing"));
  }
  EXPECT_TRUE(contains(refusal(""), "field 'min_x' is missing"));
}

TEST_F(WindFieldFile, EachFieldRefusesWhatIsNoNumber) {
  for (std::size_t i = 0; i < valid_fields().size(); ++i) {
    for (const char* word : {"much", "nan", "inf", "1.5x", "0x10", "--1", "+-1", "1,5"}) {
      FieldList fields = valid_fields();
      fields[i].second = word;
      const std::string error = refusal(text_of(fields));
      EXPECT_TRUE(contains(error, "wind.txt:" + std::to_string(2 * i + 2) + ": "));
      EXPECT_TRUE(contains(error, fields[i].first + " has '" + word + "', expected a finite"));
    }
  }
}

TEST_F(WindFieldFile, EachFieldRefusesANumberTooManyOrTooFew) {
  for (std::size_t i = 0; i < valid_fields().size(); ++i) {
    const std::string name = valid_fields()[i].first;
    FieldList more = valid_fields(), none = valid_fields();
    more[i].second += " 7";
    none[i].second = "";
    if (name != "vertical_spacing_factors") {
      EXPECT_TRUE(contains(refusal(text_of(more)),
                           "wind.txt:" + std::to_string(2 * i + 1) + ": " + name + " has "));
    }
    EXPECT_TRUE(contains(refusal(text_of(none)), name + " has 0 numbers, expected "));
  }
}

struct BadField {
  std::string name, numbers, expected;
};
void PrintTo(const BadField& bad, std::ostream* out) { *out << bad.name << ": " << bad.numbers; }

class WindFieldRefuses : public WindFieldFile, public testing::WithParamInterface<BadField> {};

TEST_P(WindFieldRefuses, AndSaysWhatIsLegal) {
  FieldList fields = valid_fields();
  const auto field = std::find_if(fields.begin(), fields.end(), [](const auto& candidate) {
    return candidate.first == GetParam().name;
  });
  ASSERT_NE(field, fields.end());
  field->second = GetParam().numbers;
  const auto line = std::to_string(2 * (field - fields.begin()) + 1);
  EXPECT_TRUE(contains(refusal(text_of(fields)),
                       "wind.txt:" + line + ": " + GetParam().name + " " + GetParam().expected));
}
INSTANTIATE_TEST_SUITE_P(
    Fields, WindFieldRefuses,
    testing::Values(
        BadField{"n_x", "1", "is '1', expected a whole number in [2, 1e+06]"},
        BadField{"n_x", "-3", "is '-3', expected a whole number in [2, 1e+06]"},
        BadField{"n_y", "2.5", "is '2.5', expected a whole number in [2, 1e+06]"},
        BadField{"n_y", "1e7", "is '1e+07', expected a whole number in [2, 1e+06]"},
        BadField{"res_x", "0", "is '0', expected a number > 0"},
        BadField{"res_y", "-2", "is '-2', expected a number > 0"},
        BadField{"vertical_spacing_factors", "0.5", "has 1 numbers, expected at least 2"},
        BadField{"vertical_spacing_factors", "0 0.5 0.5 1",
                 "has '0.5' as number 3, expected more than the one before, 0.5"},
        BadField{"vertical_spacing_factors", "0 0.6 0.4",
                 "has '0.4' as number 3, expected more than the one before, 0.6"},
        BadField{"vertical_spacing_factors", "-0.1 1",
                 "has '-0.1' as number 1, expected a number in [0, 1]"},
        BadField{"vertical_spacing_factors", "0 100",
                 "has '100' as number 2, expected a number in [0, 1]"},
        BadField{"bottom_z", "0 0 0 1 1", "has 5 numbers, expected n_x n_y = 6"},
        BadField{"top_z", "5 5 5 6 6 6 7", "has 7 numbers, expected n_x n_y = 6"},
        BadField{"top_z", "5 5 5 6 1 6",
                 "has '1' as number 5, expected more than bottom_z of that column, 1"},
        BadField{"u", "1 2 3",
                 "has 3 numbers, expected n_x n_y times the number of vertical_spacing_factors = "
                 "12"}));

TEST_F(WindFieldFile, UnknownRepeatedAndLostWordsAreNamed) {
  const std::string valid = text_of(valid_fields());
  EXPECT_TRUE(contains(refusal(valid + "bottom_y: 3\n"),
                       "wind.txt:25: unknown field 'bottom_y'; did you mean 'bottom_z'?"));
  EXPECT_TRUE(contains(refusal(valid + "n_x: 3\n"),
                       "wind.txt:25: field 'n_x' is given twice, first in line 5"));
  EXPECT_TRUE(contains(refusal("3\n" + valid), "wind.txt:1: '3' stands before any field"));
  EXPECT_TRUE(contains(refusal(valid + "min_x"), "wind.txt:25: w has 'min_x', expected a finite"));
}

TEST_F(WindFieldFile, AFileThatIsNotThereIsNamed) {
  EXPECT_TRUE(contains(error_of([] { read_wind_grid("/nowhere/wind.txt"); }),
                       "/nowhere/wind.txt: cannot be read"));
}

}  // namespace
}  // namespace trident::sim
