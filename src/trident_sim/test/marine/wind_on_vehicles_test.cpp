// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "boat_world.h"
#include "quad_world.h"
#include "sample_statistics.h"
#include "trident_base/angle.h"
#include "trident_sim/samples/text_sample.h"
#include "trident_sim/samples/vector_sample.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

PluginSpec steady_wind(const char* speed, const char* direction = "0") {
  return make_sea({{"wind", {{"speed", speed}, {"direction", direction}}}});
}

double surge(const Model& boat) {
  const SE3 T = boat.T_world_model();
  return (T.R.conjugate() * boat.links[0]->v_world_at(T.p)).x();
}

/// Apparent wind: a boat before the wind drifts where C (w - u)^2 = X_u u + X_uu u^2.
TEST(WindOnVessels, DriveABoatToTheBalanceOfApparentWindAndDrag) {
  TestWorld world(ocean({steady_wind("12")}));
  const Model& boat = world.add(make_boat("wamv"));
  world->step(12000);
  const double u = surge(boat);
  EXPECT_NEAR(0.5 * (12.0 - u) * (12.0 - u), 51.3 * u + 72.4 * u * u, 0.01 * 72.0);
  EXPECT_GT(u, 0.3);
}

TEST(WindOnVessels, TurnsABoatAndLeavesCalmOnesAlone) {
  TestWorld calm(ocean({steady_wind("0")})), windy(ocean({steady_wind("12", "0.7")}));
  const Model &at_rest = calm.add(make_boat("wamv")), &turned = windy.add(make_boat("wamv"));
  calm->step(500);
  windy->step(500);
  EXPECT_NEAR(at_rest.links[0]->w_world().z(), 0.0, 1e-12);
  EXPECT_LT(turned.links[0]->w_world().z(), -1e-3);  // -2 C u v
}

TEST(WindOnAircraft, RotorsFeelTheEnvironmentsWind) {
  const auto drift = [](const std::vector<PluginSpec>& plugins, const ParamList& wind) {
    TestWorld world(ocean(plugins));
    QuadOptions options;
    options.rotor_drag = 1e-4;
    ModelSpec spec = make_quad(options);
    if (!wind.empty())
      spec.plugins.push_back(make_plugin("w", "librotors_gazebo_wind_plugin.so", wind));
    Model& quad = world.add(std::move(spec));
    auto* const port = world->ports().find_in<ActuatorCommand>("quad/gazebo/command/motor_speed");
    EXPECT_NE(port, nullptr);
    ActuatorCommand command;
    const std::vector<double> speeds(4, 500.0);
    command.angular_velocities.assign({speeds.data(), speeds.size()});
    if (port != nullptr) port->write(command);
    world->step(100);
    return quad.bodies[0]->velocity().x();
  };
  const ParamList silent{{"robotNamespace", "quad"}, {"linkName", "base_link"}};
  const double still = drift({}, {}), windy = drift({steady_wind("5")}, {});
  EXPECT_NEAR(still, 0.0, 1e-9);
  EXPECT_GT(windy, 1e-3);
  // RotorS' plugin without a speed of its own passes it on; with one, that counts.
  EXPECT_NEAR(drift({steady_wind("5")}, silent), windy, 1e-3 * windy);
  ParamList own = silent;
  own.push_back({"windSpeedMean", "5"});
  own.push_back({"windDirection", "-1 0 0"});
  EXPECT_NEAR(drift({steady_wind("5")}, own), -windy, 1e-3 * windy);
}

PluginSpec vrx_wind(ParamList more = {}) {
  more.insert(more.end(), {{"wind_direction", "90"}, {"wind_mean_velocity", "8"}});
  PluginSpec plugin = make_plugin("wind", "libusv_gazebo_wind_plugin.so", more);
  ParamNode object{"wind_obj", "", {}, {}};
  object.children = {{"name", "hull", {}, {}},
                     {"link_name", "link", {}, {}},
                     {"coeff_vector", "0.5 0.5 0.33", {}, {}}};
  plugin.params.children.push_back(object);
  return plugin;
}

TEST(VrxWind, PushesByApparentWindOrAsVrxByWindOverGround) {
  const auto push = [](const char* legacy) {
    TestWorld world([&] {
      WorldSpec spec = weightless(0.01);
      spec.plugins = {vrx_wind({{"legacy_vrx", legacy}})};
      return spec;
    }());
    Model& hull = world.add(make_body("hull", BoxShape{{1, 1, 1}}, at(0, 0, 0), 100.0));
    world->set_model_twist(hull, {0.0, 3.0, 0.0}, Eigen::Vector3d::Zero());
    world->step();
    return (hull.bodies[0]->velocity().y() - 3.0) * 100.0 / 0.01;
  };
  EXPECT_NEAR(push("false"), 0.5 * 25.0, 1e-6);
  EXPECT_NEAR(push("true"), 0.5 * 64.0, 1e-6);
}

TEST(VrxWind, ReportsItsWindAndGustsHaveTheirSpread) {
  WorldSpec spec = weightless(0.1);
  spec.plugins = {vrx_wind({{"var_wind_gain_constants", "1.5"},
                            {"var_wind_time_constants", "2"},
                            {"random_seed", "10"},
                            {"update_rate", "10"}})};
  TestWorld world(spec);
  auto* const speed = world->ports().find_out<NumberSample>("vrx/debug/wind/speed");
  auto* const direction = world->ports().find_out<NumberSample>("vrx/debug/wind/direction");
  ASSERT_NE(speed, nullptr);
  speed->add_listener();
  direction->add_listener();
  std::vector<double> speeds;
  for (int i = 0; i < 60000; ++i) {
    world->step();
    speeds.push_back(speed->value.value);
  }
  // 3000 independent gusts: the mean within 3 sigma, the spread within 5 %.
  EXPECT_NEAR(statistics_of(speeds).mean, 8.0, 0.1);
  EXPECT_NEAR(statistics_of(speeds).stddev, 1.5, 0.075);
  double product = 0.0;
  for (std::size_t i = 0; i + 20 < speeds.size(); ++i) {
    product += (speeds[i] - 8.0) * (speeds[i + 20] - 8.0) / static_cast<double>(speeds.size());
  }
  EXPECT_NEAR(product / 2.25, std::exp(-1.0), 0.06);  // after one time constant
  EXPECT_EQ(direction->value.value, 90.0);
  EXPECT_NEAR(find_air(*world)->wind({0, 0, 0}).y(), speeds.back(), 1e-12);
}

TEST(VrxWind, BadInputIsRefused) {
  const auto refusal = [](const ParamList& elements) {
    return error_of([&] { TestWorld world(ocean({vrx_wind(elements)})); });
  };
  EXPECT_TRUE(
      contains(refusal({{"var_wind_time_constants", "0"}}), "<var_wind_time_constants> is '0'"));
  EXPECT_TRUE(
      contains(refusal({{"var_wind_gain_constants", "-1"}}), "<var_wind_gain_constants> is '-1'"));
  EXPECT_TRUE(contains(error_of([] {
                         TestWorld world(ocean({vrx_wind(), steady_wind("3")}));
                       }),
                       "another plugin gives the world's wind already"));
  TestWorld world(ocean({vrx_wind()}));
  ModelSpec spec = make_body("hull", BoxShape{{1, 1, 1}}, at(0, 0, 0));
  spec.links[0].name = "deck";
  world.add(spec);
  world->step(3);
  EXPECT_EQ(world.report_count(Severity::kError, "<wind_obj> names link 'link'"), 1U);
}

/// A mast that turns and moves, with an anemometer.
struct Mast {
  explicit Mast(const ParamList& more, double yaw = 0.0)
      : world([] {
          WorldSpec spec = weightless(0.01);
          spec.plugins = {steady_wind("5")};
          return spec;
        }()) {
    ModelSpec spec =
        make_body("mast", BoxShape{{1, 1, 1}}, SE3::from_xyz_rpy({0, 0, 3}, 0, 0, yaw));
    ParamList params{{"robotNamespace", "m"}, {"linkName", "link"}};
    params.insert(params.end(), more.begin(), more.end());
    spec.plugins.push_back(make_plugin("anemometer", "libtrident_anemometer.so", params));
    model = &world.add(spec);
    velocity = world->ports().find_out<VectorSample>("m/wind");
    reading = world->ports().find_out<WindReadingSample>("m/wind_reading");
    velocity->add_listener();
    reading->add_listener();
  }
  TestWorld world;
  Model* model;
  OutPort<VectorSample>* velocity;
  OutPort<WindReadingSample>* reading;
};

TEST(Anemometer, MeasuresApparentWindInItsFrame) {
  Mast mast({}, 0.5);
  mast.world->set_model_twist(*mast.model, {2.0, 1.0, 0.0}, Eigen::Vector3d::Zero());
  mast.world->step();
  const Eigen::Vector3d expected =
      Eigen::AngleAxisd(-0.5, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(3.0, -1.0, 0.0);
  EXPECT_TRUE(is_near(mast.velocity->value.value, expected, 1e-9));
  EXPECT_EQ(mast.velocity->value.frame, "link");
  EXPECT_FALSE(mast.reading->value.is_true);
  EXPECT_NEAR(mast.reading->value.speed_m_s, std::sqrt(10.0), 1e-9);
}

TEST(Anemometer, ReportsWhereTheWindComesFromClockwise) {
  // The wind blows to +x; a bow that points to +x has it from astern, one that points to +y from
  // port, which is 270 degrees.
  for (const auto& [yaw, from] : {std::pair{0.0, 180.0}, {90.0, 270.0}, {-90.0, 90.0}}) {
    Mast mast(ParamList{{"reference", "true"}}, deg_to_rad(yaw));
    mast.world->set_model_twist(*mast.model, {9.0, 1.0, 0.0}, Eigen::Vector3d::Zero());
    mast.world->step();
    EXPECT_TRUE(mast.reading->value.is_true);
    EXPECT_NEAR(rad_to_deg(mast.reading->value.angle_rad), from, 1e-6) << yaw;
    EXPECT_NEAR(mast.reading->value.speed_m_s, 5.0, 1e-9);
  }
}

TEST(Anemometer, NoiseHasItsSpreadWithAnyListeners) {
  Mast mast(ParamList{{"gaussianNoise", "0.3"}, {"bias", "0.1 0 0"}}),
      other(ParamList{{"gaussianNoise", "0.3"}, {"bias", "0.1 0 0"}});
  other.reading->remove_listener();
  std::vector<double> x, y;
  for (int i = 0; i < 4000; ++i) {
    mast.world->step();
    other.world->step();
    x.push_back(mast.velocity->value.value.x());
    y.push_back(mast.velocity->value.value.y());
  }
  EXPECT_EQ(mast.velocity->value.value, other.velocity->value.value);
  EXPECT_NEAR(statistics_of(x).mean, 5.1, 0.02);
  EXPECT_NEAR(statistics_of(x).stddev, 0.3, 0.015);
  EXPECT_NEAR(statistics_of(y).stddev, 0.3, 0.015);
}

TEST(Anemometer, HasItsRateAndRefusesBadInput) {
  Mast mast(ParamList{{"updateRate", "10"}});
  mast.world->step(100);
  EXPECT_EQ(mast.velocity->count(), 10U);
  EXPECT_TRUE(contains(error_of([] {
                         Mast bad(ParamList{{"reference", "felt"}});
                       }),
                       "<reference> is 'felt', expected apparent or true"));
  EXPECT_TRUE(contains(error_of([] {
                         Mast bad(ParamList{{"gaussianNoise", "-1"}});
                       }),
                       "<gaussianNoise>"));
}

}  // namespace
}  // namespace trident::sim
