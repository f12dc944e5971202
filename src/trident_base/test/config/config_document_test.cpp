// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "config_example.h"

namespace trident {
namespace {

TEST(ConfigDocument, ListsEveryFieldFromTheSameVisit) {
  const std::string expected = R"(| key | type | default | legal values | meaning |
| --- | --- | --- | --- | --- |
| `name` | text | "firefly" |  | shown in rviz |
| `enable_logging` | bool | false | true, false |  |
| `mass` | number | 1.5 | > 0 | of the whole vehicle [kg] |
| `scale` | number | 1 | finite | a \| b |
| `slots` | whole number | 3 | in [0, 255] |  |
| `offset` | whole number | 0 | in [-9223372036854775808, 9223372036854775807] |  |
| `seed` | whole number | 0 | in [0, 18446744073709551615] |  |
| `timing` | choice | direct | direct, rotors | when a command acts |
| `spare` | map |  |  |  |
| `spare.force_constant` | number | 8.5e-06 | in [0, 1] | thrust per squared speed [N s^2] |
| `spare.direction` | whole number | 1 | in [-1, 1] | 1: counter-clockwise |
| `rotors` | list of map | [] |  | in the order of the mixer |
| `rotors[].force_constant` | number | 8.5e-06 | in [0, 1] | thrust per squared speed [N s^2] |
| `rotors[].direction` | whole number | 1 | in [-1, 1] | 1: counter-clockwise |
| `limits` | list of 2 number | [-1, 1] | in [-10, 10) | pitch, roll [rad] |
| `inertia` | list of 3 number | [1, 1, 1] | > 0 | principal moments [kg m^2] |
| `gains` | list of number | [] | finite |  |
| `max_range` | number | none | > 0 or infinite | none: unlimited [m] |
| `weights` | map of name: number | {} | in [0, 1] |  |
| `groups` | map of name: list of whole number | {} | in [-2147483648, 2147483647] |  |
| `modes` | list of choice | [] | direct, rotors |  |
)";
  EXPECT_EQ(document<VehicleConfig>(), expected);
}

TEST(ConfigDocument, OfManyChoicesTheFirstStandForAll) {
  std::string legal = "FIRST";
  while (legal.size() < 200) legal += ", ANOTHER";
  const std::string table =
      config_detail::markdown_table({{"turn", "choice", "none", legal, "where it looks"}});
  EXPECT_NE(table.find("| FIRST, ANOTHER"), std::string::npos);
  EXPECT_NE(table.find("ANOTHER, ... | where it looks"), std::string::npos) << table;
  EXPECT_EQ(table.find(legal), std::string::npos);
}

TEST(ConfigDocument, MarksRequiredKeys) {
  const std::string table = document<StrictConfig>();
  EXPECT_NE(table.find("| `rate` | number | **required** | > 0 | update rate [Hz] |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| `rotor` | map | **required** |  | the only rotor |"), std::string::npos)
      << table;
}

}  // namespace
}  // namespace trident
