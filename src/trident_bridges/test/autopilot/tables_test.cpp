// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "trident_bridges/autopilot/fence.h"
#include "trident_bridges/autopilot/modes.h"
#include "trident_bridges/autopilot/parameter_table.h"

namespace trident::bridges {
namespace {

constexpr Flavor kFlavors[] = {Flavor::kPx4, Flavor::kArduPilot};
constexpr VehicleClass kClasses[] = {VehicleClass::kMultirotor, VehicleClass::kGround,
                                     VehicleClass::kVessel};

TEST(ParameterTable, HoldsWhatEveryFlavorNeeds) {
  for (const Flavor flavor : kFlavors) {
    for (const VehicleClass vehicle : kClasses) {
      const ParameterTable table(flavor, vehicle, 7);
      EXPECT_NO_THROW(limits_of(table, flavor, vehicle));
      std::set<std::string> names;
      for (const Parameter& parameter : table.all()) {
        EXPECT_LE(parameter.name.size(), 16U) << parameter.name;
        EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
        EXPECT_GE(parameter.value, parameter.min) << parameter.name;
        EXPECT_LE(parameter.value, parameter.max) << parameter.name;
        EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
      }
      EXPECT_EQ(table.value(flavor == Flavor::kPx4 ? "MAV_SYS_ID" : "SYSID_THISMAV"), 7.0);
    }
  }
}

TEST(ParameterTable, RefusesWhatIsNotLegal) {
  ParameterTable table(Flavor::kArduPilot, VehicleClass::kMultirotor, 1);
  EXPECT_EQ(table.set("LAND_SPEED", 1.0).text, "LAND_SPEED: 1, legal: 30 to 200 cm/s");
  EXPECT_EQ(table.set("FRAME_CLASS", 1.5).text, "FRAME_CLASS: 1.5, legal: whole numbers, 0 to 17");
  EXPECT_NE(table.set("RTL_ALTT", 100.0).text.find("RTL_ALT"), std::string::npos);
  EXPECT_FALSE(table.set("RTL_ALT", std::numeric_limits<double>::quiet_NaN()).is_good());
  EXPECT_EQ(table.value("RTL_ALT"), 1500.0);
  EXPECT_TRUE(table.set("RTL_ALT", 2000.0).is_good());
  EXPECT_EQ(table.value("RTL_ALT"), 2000.0);
}

TEST(Modes, HaveTheNumbersOfTheirFlavor) {
  const auto number = [](Flavor flavor, VehicleClass vehicle, const char* name) {
    return find_mode(flavor, vehicle, std::string_view(name))->custom_mode;
  };
  EXPECT_EQ(number(Flavor::kPx4, VehicleClass::kMultirotor, "AUTO.MISSION"), 0x04040000U);
  EXPECT_EQ(number(Flavor::kPx4, VehicleClass::kMultirotor, "OFFBOARD"), 0x00060000U);
  EXPECT_EQ(number(Flavor::kArduPilot, VehicleClass::kMultirotor, "GUIDED"), 4U);
  EXPECT_EQ(number(Flavor::kArduPilot, VehicleClass::kVessel, "GUIDED"), 15U);
  EXPECT_EQ(find_mode(Flavor::kArduPilot, VehicleClass::kGround, std::string_view("LAND")),
            nullptr);
}

TEST(Modes, HaveNumbersOfTheirOwn) {
  for (const Flavor flavor : kFlavors) {
    for (const VehicleClass vehicle : kClasses) {
      std::set<std::uint32_t> numbers;
      for (const ModeEntry& mode : modes_of(flavor, vehicle)) {
        EXPECT_TRUE(numbers.insert(mode.custom_mode).second) << mode.name;
      }
    }
  }
}

TEST(Fence, NamesWhatIsBroken) {
  Fence fence;
  fence.home_m = {100, 0, 2};
  fence.radius_m = 50;
  fence.height_m = 20;
  fence.regions = {{true, {{80, -20}, {120, -20}, {120, 20}, {80, 20}}, {0, 0}, 0.0},
                   {false, {}, {110, 0}, 3.0}};
  EXPECT_FALSE(fence.breach({100, 0, 10}));
  EXPECT_EQ(*fence.breach({160, 0, 10}), "fence: 60 m from home, limit 50 m");
  EXPECT_EQ(*fence.breach({100, 0, 25}), "fence: 23 m above home, limit 20 m");
  EXPECT_EQ(*fence.breach({100, 30, 10}), "fence: (100, 30) m is outside of inclusion 0");
  EXPECT_EQ(*fence.breach({111, 0, 10}), "fence: (111, 0) m is inside of exclusion 1");
}

TEST(Fence, FindsTheInsideOfAConcavePolygon) {
  const std::vector<Eigen::Vector2d> corners = {{0, 0}, {10, 0}, {10, 10}, {5, 5}, {0, 10}};
  EXPECT_TRUE(is_inside(corners, {2, 5}));
  EXPECT_FALSE(is_inside(corners, {5, 8}));
  EXPECT_FALSE(is_inside(corners, {-1, 5}));
}

}  // namespace
}  // namespace trident::bridges
