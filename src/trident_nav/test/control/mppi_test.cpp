// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "control/mppi/lanes.h"
#include "control/mppi/mppi_model.h"
#include "control/scene.h"
#include "trident_base/yaml_config.h"

namespace trident::nav::testing {
namespace {

Drive corner_drive(int threads) {
  ControlSetup setup = jackal();
  setup.threads = threads;
  const auto controller = make_controller("mppi", setup, parse_yaml("{batch_size: 500}", "test"));
  return drive(*controller, setup, corner_scene(setup.footprint));
}

TEST(Mppi, TwoThreadsGiveTheBitsOfOne) { EXPECT_TRUE(are_equal(corner_drive(1), corner_drive(2))); }

TEST(Mppi, ProcessorsWithoutAvx2GiveTheSameBits) {
  const Drive wide = corner_drive(1);
  force_plain_lanes(true);
  const Drive plain = corner_drive(1);
  force_plain_lanes(false);
  EXPECT_TRUE(are_equal(wide, plain));
}

TEST(Mppi, TheSeedIsWhatDiffersBetweenRuns) {
  ControlSetup setup = jackal();
  const Scene scene = corner_scene(setup.footprint);
  const ConfigNode params = parse_yaml("{batch_size: 300}", "test");
  const Drive first = drive(*make_controller("mppi", setup, params), setup, scene);
  EXPECT_TRUE(are_equal(first, drive(*make_controller("mppi", setup, params), setup, scene)));
  setup.seed = 2;
  EXPECT_FALSE(are_equal(first, drive(*make_controller("mppi", setup, params), setup, scene)));
}

TEST(MppiModel, TheFootprintsCoverContainsEachOfItsPoints) {
  for (const ControlSetup& setup : {jackal(), car(), omni_robot(), burger()}) {
    const auto cover = cover_footprint(setup.footprint);
    for (const Point2& p : setup.footprint.points) {
      const bool is_in = std::any_of(cover.begin(), cover.end(), [&](const CoverCircle& circle) {
        return std::hypot(p.x - static_cast<double>(circle.x),
                          p.y - static_cast<double>(circle.y)) <=
               static_cast<double>(circle.radius) + 1e-6;
      });
      EXPECT_TRUE(is_in) << p.x << " " << p.y;
    }
  }
}

TEST(Lanes, TheAngleIsThatOfTheLibrary) {
  for (int i = 0; i < 1000; ++i) {
    const double angle = -3.1415 + 0.00628 * i;
    const auto x = static_cast<float>(2.0 * std::cos(angle));
    const auto y = static_cast<float>(2.0 * std::sin(angle));
    EXPECT_NEAR(static_cast<double>(absolute_angle(y, x)), std::fabs(angle), 2e-4);
  }
}

}  // namespace
}  // namespace trident::nav::testing
