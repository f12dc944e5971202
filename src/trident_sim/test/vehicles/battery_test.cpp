// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "vehicles/battery/battery_cells.h"

namespace trident::sim {
namespace {

TEST(BatteryCells, AreFullAtFirst) {
  const BatteryCells cells({5.0, 4, 0.02});
  EXPECT_EQ(cells.charge_share(), 1.0);
  EXPECT_NEAR(cells.voltage_v(), 4 * 4.20, 1e-12);
}

TEST(BatteryCells, RestAtAVoltageThatGrowsWithTheCharge) {
  EXPECT_NEAR(BatteryCells::open_circuit_v(0.5), 3.84, 1e-12);
  EXPECT_NEAR(BatteryCells::open_circuit_v(0.525), 3.845, 1e-12);
  for (double share = 0.0; share < 1.0; share += 0.01) {
    EXPECT_LT(BatteryCells::open_circuit_v(share), BatteryCells::open_circuit_v(share + 0.01));
  }
}

TEST(BatteryCells, GiveThePowerThatIsDrawnAtTheVoltageThatIsLeft) {
  BatteryCells cells({5.0, 4, 0.05});
  cells.draw(200.0, 0.01);
  EXPECT_NEAR(cells.voltage_v() * cells.current_a(), 200.0, 1e-9);
  EXPECT_NEAR(cells.voltage_v() + 0.05 * cells.current_a(), 4 * 4.20, 1e-9) << "Kirchhoff";
}

TEST(BatteryCells, LoseTheChargeThatFlowed) {
  BatteryCells cells({2.0, 3, 0.0});
  double charge_ah = 0.0;
  for (int i = 0; i < 1000; ++i) {
    cells.draw(100.0, 0.1);
    charge_ah += cells.current_a() * 0.1 / 3600.0;
  }
  EXPECT_NEAR(2.0 * (1.0 - cells.charge_share()), charge_ah, 1e-9);
}

TEST(BatteryCells, GiveNothingOnceEmpty) {
  BatteryCells cells({0.01, 3, 0.01});
  for (int i = 0; i < 1000; ++i) cells.draw(100.0, 0.1);
  EXPECT_TRUE(cells.is_empty());
  cells.draw(100.0, 0.1);
  EXPECT_EQ(cells.current_a(), 0.0);
}

TEST(BatteryCells, GiveTheirGreatestPowerAtHalfTheirVoltage) {
  BatteryCells cells({5.0, 1, 0.1});
  cells.draw(1e6, 1e-6);
  EXPECT_NEAR(cells.voltage_v(), 2.1, 1e-6);
  EXPECT_NEAR(cells.voltage_v() * cells.current_a(), 4.2 * 4.2 / 0.4, 1e-6);
}

}  // namespace
}  // namespace trident::sim
