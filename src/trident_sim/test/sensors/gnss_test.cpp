// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "models.h"
#include "sensors/gnss/geoid_grid.h"
#include "test_world.h"

namespace trident::sim {
namespace {

using FixType = GnssStatusSample::FixType;

constexpr double kLatitude = 47.4, kLongitude = 8.5;

WorldSpec on_earth() {
  WorldSpec spec = weightless(0.01);
  spec.spherical = {kLatitude, kLongitude, 400.0, 0.0};
  return spec;
}

/// A receiver at 10 Hz, at (10, 20, 2) in the world.
ModelSpec receiver(const ParamList& params) {
  ModelSpec model = make_body("rover", SphereShape{0.1}, at(10, 20, 2));
  SensorSpec sensor;
  sensor.name = "gnss";
  sensor.type = "gps";
  sensor.update_rate_hz = 10.0;
  sensor.params.name = "sensor";
  ParamList all{{"robotNamespace", "r"}};
  all.insert(all.end(), params.begin(), params.end());
  sensor.plugins.push_back(make_plugin("p", "libtrident_gnss.so", all));
  model.links[0].sensors.push_back(sensor);
  return model;
}

struct Listener {
  explicit Listener(TestWorld& world)
      : fix(world->ports().find_out<GnssFixSample>("r/fix")),
        status(world->ports().find_out<GnssStatusSample>("r/gnss_status")) {
    fix->add_listener();
    status->add_listener();
  }
  OutPort<GnssFixSample>* fix;
  OutPort<GnssStatusSample>* status;
};

/// Of a fix, from where the antenna is [m].
Eigen::Vector3d error_enu(const GnssFixSample& fix) {
  const GeographicLib::LocalCartesian earth(kLatitude, kLongitude, 400.0);
  Eigen::Vector3d p;
  earth.Forward(fix.latitude_deg, fix.longitude_deg, fix.altitude_m, p.x(), p.y(), p.z());
  return p - Eigen::Vector3d(10, 20, 2);
}

TEST(Gnss, ErrorsHaveTheSpreadThatIsReportedForEachFix) {
  struct Case {
    ParamList params;
    FixType type;
    double horizontal_m, vertical_m;
  };
  const Case cases[] = {{{{"rtk", "false"}}, FixType::kSingle, 1.5, 3.0},
                        {{{"floatTime", "0"}, {"fixedTime", "1e5"}}, FixType::kFloat, 0.2, 0.4},
                        {{{"floatTime", "0"}, {"fixedTime", "0"}, {"fixedVerticalStdDev", "0.03"}},
                         FixType::kFixed,
                         0.01,
                         0.03}};
  for (const Case& one : cases) {
    TestWorld world(on_earth());
    world.add(receiver(one.params));
    const Listener heard(world);
    constexpr int kSamples = 2000;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
    for (int i = 0; i < kSamples; ++i) {
      world->step(10);
      const Eigen::Vector3d error = error_enu(heard.fix->value);
      sum += error;
      squares += error.cwiseAbs2();
    }
    EXPECT_EQ(heard.fix->count(), 2000u);
    EXPECT_EQ(heard.status->value.fix_type, one.type);
    EXPECT_EQ(heard.status->value.satellites, 12);
    EXPECT_EQ(heard.status->value.stddev_horizontal_m, one.horizontal_m);
    EXPECT_EQ(heard.status->value.stddev_vertical_m, one.vertical_m);
    EXPECT_EQ(heard.fix->value.covariance_enu[8], one.vertical_m * one.vertical_m);
    const Eigen::Vector3d stddev(one.horizontal_m, one.horizontal_m, one.vertical_m);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sum[axis] / kSamples, 0.0, 4.0 * stddev[axis] / std::sqrt(kSamples));
      EXPECT_NEAR(std::sqrt(squares[axis] / kSamples), stddev[axis],
                  4.0 * stddev[axis] / std::sqrt(2.0 * kSamples));
    }
  }
}

TEST(Gnss, AFixGetsBetterWithTime) {
  TestWorld world(on_earth());
  world.add(receiver({{"floatTime", "2"}, {"fixedTime", "6"}}));
  const Listener heard(world);
  world->step(150);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kSingle);
  world->step(200);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kFloat);
  world->step(300);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kFixed);
  world->reset();
  world->step(150);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kSingle);
}

TEST(Gnss, UnderARoofThereIsNoFixAndAllStartsAgain) {
  TestWorld world(on_earth());
  Model& rover =
      world.add(receiver({{"floatTime", "0.5"}, {"fixedTime", "1"}, {"skyView", "true"}}));
  world.add(make_static("roof", BoxShape{{100, 100, 0.1}}, at(200, 20, 5)));
  const Listener heard(world);
  world->step(200);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kFixed) << "its own body hides nothing";
  const std::uint64_t fixes = heard.fix->count();
  world->set_model_pose(rover, at(200, 20, 2));
  world->step(100);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kNone);
  EXPECT_LT(heard.status->value.satellites, 4);
  EXPECT_EQ(heard.fix->count(), fixes) << "no position without a fix";
  world->set_model_pose(rover, at(10, 20, 2));
  world->step(20);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kSingle);
  world->step(200);
  EXPECT_EQ(heard.status->value.fix_type, FixType::kFixed);
}

TEST(Gnss, ReportsTheGeoidsSeparationWhereItsDataAre) {
  if (find_egm96_grid().empty()) GTEST_SKIP() << "proj-data is not installed";
  TestWorld world(on_earth());
  world.add(receiver({{"geoidModel", "egm96-15"}}));
  const Listener heard(world);
  world->step(20);
  // The geoid rises from 46 to 49 m above the ellipsoid around Zurich.
  EXPECT_NEAR(heard.status->value.geoid_separation_m, 47.5, 1.5);
}

TEST(Gnss, BadElementsAreRefusedByName) {
  const auto refusal = [](const ParamList& params) {
    TestWorld world(on_earth());
    return error_of([&] { world.add(receiver(params)); });
  };
  EXPECT_TRUE(contains(refusal({{"floatTime", "5"}, {"fixedTime", "2"}}), "<fixedTime>"));
  EXPECT_TRUE(contains(refusal({{"satellites", "-1"}}), "<satellites>"));
  EXPECT_TRUE(contains(refusal({{"singleVerticalStdDev", "-1"}}), "<singleVerticalStdDev>"));
  EXPECT_TRUE(contains(refusal({{"geoidModel", "flat-earth"}}), "<geoidModel>"));
}

}  // namespace
}  // namespace trident::sim
