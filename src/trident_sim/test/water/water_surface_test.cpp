// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The tile of the sea: how true it is, that it repeats, and where rays hit it.
#include "sea_rays/water_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "sea_view.h"

namespace trident::sim {
namespace {

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kZ = Eigen::Vector3d::UnitZ();
constexpr double kNowhere = std::numeric_limits<double>::infinity();

Eigen::Vector2d within(Draw& draw, double half_m) {
  return {draw.uniform(-half_m, half_m), draw.uniform(-half_m, half_m)};
}

/// Where a ray comes through the surface, by small steps and bisection.
double hit_by_steps(const WaterSurface& water, const Ray& ray, double t_max) {
  constexpr double kStep = 0.004;
  const auto gap = [&](double t) {
    const Eigen::Vector3d p = ray.p_world_origin + t * ray.direction_world;
    return p.z() - water.height_m(p.head<2>());
  };
  const bool is_above = gap(0.0) > 0.0;
  for (double t = kStep; t <= t_max; t += kStep) {
    if ((gap(t) > 0.0) == is_above) continue;
    double before = t - kStep, after = t;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (before + after);
      ((gap(middle) > 0.0) == is_above ? before : after) = middle;
    }
    return after;
  }
  return kNowhere;
}

TEST(WaterTransform, IsTheSumOfAllWaves) {
  constexpr std::size_t n = 32;
  ComplexGrid grid(n);
  struct Wave {
    std::size_t p, q;
    std::complex<double> value;
  };
  const std::vector<Wave> waves = {
      {0, 0, {0.5, -1.0}}, {1, 5, {1.0, 2.0}}, {31, 0, {-0.7, 0.1}}, {16, 30, {0.2, 0.3}}};
  for (const Wave& wave : waves) {
    grid.re[wave.p * n + wave.q] = static_cast<float>(wave.value.real());
    grid.im[wave.p * n + wave.q] = static_cast<float>(wave.value.imag());
  }
  WaterTransform transform(n);
  transform(grid);
  for (std::size_t i = 0; i < n * n; ++i) {
    std::complex<double> sum;
    for (const Wave& wave : waves) {
      const auto turns = static_cast<double>(wave.p * (i / n) + wave.q * (i % n)) / n;
      sum += wave.value * std::polar(1.0, 2.0 * std::acos(-1.0) * turns);
    }
    ASSERT_NEAR(grid.re[i], sum.real(), 1e-5) << i;
    ASSERT_NEAR(grid.im[i], sum.imag(), 1e-5) << i;
  }
}

TEST(WaterSurface, OfStillWaterIsHitAtItsLevel) {
  TestWorld world(sea_spec({{"spectrum", "none"}}, "0.7"));
  Draw draw("still");
  RayScene& scene = scene_on_water(world, {0, 0, 2});
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p(draw.uniform(-500, 500), draw.uniform(-500, 500), draw.uniform(-9, 9));
    const Ray ray{p, draw.direction()};
    const RayHit hit = cast_one(scene, ray);
    const double expected = (0.7 - p.z()) / ray.direction_world.z();
    if (expected < 0.0) {
      EXPECT_FALSE(hit.is_hit());
      continue;
    }
    ASSERT_NEAR(hit.distance_m, expected, 1e-9 * (1.0 + expected));
    EXPECT_EQ(hit.shape, scene.surface_shape());
    EXPECT_TRUE(is_near(hit.normal_world, p.z() > 0.7 ? kZ : Eigen::Vector3d(-kZ), 1e-12));
  }
}

TEST(WaterSurface, AboutAHullIsWhatTheHullFeels) {
  // Height 0.3 m, the waves of config/environments/sea_state_2.yaml, boats as far as 3 km away.
  TestWorld world(sea_spec(jonswap("0.3", "4")));
  const WaveField& waves = waves_of(*world);
  Draw draw("hulls");
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (int moment = 0; moment < 6; ++moment) {
    world->step(37);
    for (int boat = 0; boat < 3; ++boat) {
      const Eigen::Vector2d middle = within(draw, 3000.0);
      WaterSurface water(*world);
      ASSERT_TRUE(water.follow({middle.x(), middle.y(), 1.0}));
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d p = middle + within(draw, 1.5);
        const double error = water.height_m(p) - waves.elevation_m(p, world->time().seconds());
        sum += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
      }
    }
  }
  const double rms = std::sqrt(sum / count);
  RecordProperty("rms_mm", std::to_string(1e3 * rms));
  RecordProperty("worst_mm", std::to_string(1e3 * worst));
  EXPECT_LT(rms, 0.01);
  EXPECT_LT(worst, 0.03);
}

TEST(WaterSurface, DriftsFromTheSeaWithTheDistanceAsDocumented) {
  TestWorld world(sea_spec(jonswap("0.3", "4")));
  const WaveField& waves = waves_of(*world);
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow({0, 0, 1}));
  Draw draw("drift");
  for (const double part : {0.05, 0.1, 0.2}) {
    const double distance_m = part * water.pattern().length_m;
    double error = 0.0, sea = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double angle = draw.uniform(-3.2, 3.2);
      const Eigen::Vector2d p = distance_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const double truth = waves.elevation_m(p, world->time().seconds());
      error += std::pow(water.height_m(p) - truth, 2);
      sea += truth * truth;
    }
    EXPECT_NEAR(std::sqrt(error / sea), 1.8 * part, 0.6 * 1.8 * part) << part;
  }
}

TEST(WaterSurface, OfARegularSeaIsTrueEverywhere) {
  for (const char* model : {"linear", "gerstner"}) {
    ParamList params = regular("0.5", "5");
    params.push_back({"model", model});
    TestWorld world(sea_spec(params));
    const WaveField& waves = waves_of(*world);
    Draw draw("regular");
    for (int moment = 0; moment < 3; ++moment) {
      world->step(113);
      WaterSurface water(*world);
      ASSERT_TRUE(water.follow({0, 0, 1}));
      for (int i = 0; i < 300; ++i) {
        const Eigen::Vector2d p = within(draw, 2000.0);
        ASSERT_NEAR(water.height_m(p), waves.elevation_m(p, world->time().seconds()), 0.02)
            << model;
      }
    }
  }
}

TEST(WaterSurface, OfGerstnersSeaIsTrueNearby) {
  ParamList params = jonswap("0.5", "4");
  params.push_back({"model", "gerstner"});
  TestWorld world(sea_spec(params));
  const WaveField& waves = waves_of(*world);
  Draw draw("gerstner");
  for (int moment = 0; moment < 3; ++moment) {
    world->step(71);
    const Eigen::Vector2d middle = within(draw, 800.0);
    WaterSurface water(*world);
    ASSERT_TRUE(water.follow({middle.x(), middle.y(), 1.0}));
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d p = middle + within(draw, 1.5);
      EXPECT_NEAR(water.height_m(p), waves.elevation_m(p, world->time().seconds()), 0.05);
    }
  }
}

TEST(WaterSurface, RepeatsAndIsTheSeeds) {
  const auto heights = [](std::uint64_t seed, bool shifted) {
    WorldOptions options;
    options.seed = seed;
    TestWorld world(sea_spec(jonswap("0.4", "5")), options);
    world->step(50);
    WaterSurface water(*world);
    EXPECT_TRUE(water.follow({3, 4, 1}));
    const WaterPattern& pattern = water.pattern();
    const Eigen::Vector2d shift =
        shifted ? Eigen::Vector2d(pattern.length_m * (3.0 * pattern.axis - 2.0 * pattern.across))
                : Eigen::Vector2d::Zero();
    Draw draw("places");
    std::vector<double> result;
    for (int i = 0; i < 200; ++i) result.push_back(water.height_m(within(draw, 60.0) + shift));
    return result;
  };
  const std::vector<double> here = heights(1, false), there = heights(1, true),
                            other = heights(2, false);
  EXPECT_EQ(heights(1, false), here);
  double difference = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_NEAR(there[i], here[i], 1e-9);
    difference = std::max(difference, std::abs(other[i] - here[i]));
  }
  EXPECT_GT(difference, 0.05);
}

TEST(WaterSurface, IsHitWhereSmallStepsHitIt) {
  TestWorld world(sea_spec(jonswap("1.5", "4"), "0.3"));
  world->step(33);
  const Eigen::Vector3d middle(40.0, -70.0, 0.0);
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow(middle));
  Draw draw("march");
  int hit_count = 0;
  for (int i = 0; i < 400; ++i) {
    // Above, within and below the waves; steep and grazing.
    const Eigen::Vector3d p = middle + draw.point(3.0);
    Eigen::Vector3d d = draw.direction();
    if (i % 2 == 0) d.z() *= 0.1;
    if (i % 20 == 0) d.x() = 0.0;
    const Ray ray{p, d.normalized()};
    const WaterHit water_hit = water.find_hit(ray, 40.0);
    EXPECT_EQ(water_hit.begins_below, p.z() < water.height_m(p.head<2>()));
    const double expected = hit_by_steps(water, ray, 40.0);
    if (expected == kNowhere || water_hit.t == kNowhere) {
      EXPECT_EQ(water_hit.t, expected) << i;
      continue;
    }
    ++hit_count;
    // A crest that a step jumps over is hit earlier.
    EXPECT_LT(water_hit.t, expected + 1e-6) << i;
    const Eigen::Vector3d at = p + water_hit.t * ray.direction_world;
    EXPECT_NEAR(at.z(), water.height_m(at.head<2>()), 1e-9) << i;
    if (water_hit.t < expected - 1e-6) {
      EXPECT_LT(std::abs(p.z() + (water_hit.t + 0.002) * ray.direction_world.z() -
                         water.height_m((at + 0.002 * ray.direction_world).head<2>())),
                1e-4)
          << i;
    }
  }
  EXPECT_GT(hit_count, 150);
}

TEST(WaterSurface, IsGrazedOrMissed) {
  TestWorld world(sea_spec(regular("0.4", "4")));
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow({0, 0, 1}));
  const Eigen::Vector2d along = water.pattern().axis;
  const Ray level{{0, 0, water.highest_m() + 1e-4}, {along.x(), along.y(), 0.0}};
  EXPECT_EQ(water.find_hit(level, kNowhere).t, kNowhere);
  Ray lower = level;
  // From a trough's side through the air below the crest, level with the highest node less 5 mm.
  lower.p_world_origin.z() = 0.4 - 0.005;
  lower.p_world_origin.head<2>() = 0.5 * (water.pattern().length_m / 8.0) * along;
  const double t = water.find_hit(lower, 1000.0).t;
  EXPECT_GT(t, 0.0);
  EXPECT_LT(t, water.pattern().length_m / 8.0);
  EXPECT_NEAR(t, hit_by_steps(water, lower, 30.0), 1e-6);
}

TEST(WaterSurface, FarAwayIsALevelWithSlopes) {
  TestWorld world(sea_spec(jonswap("0.3", "4"), "0.5"));
  RayScene& scene = scene_on_water(world, {0, 0, 10});
  int level = 0, sloped = 0;
  for (int i = 0; i < 200; ++i) {
    const double azimuth = 0.03 * i;
    const Eigen::Vector3d d =
        Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), -0.003).normalized();
    const RayHit hit = cast_one(scene, {{0, 0, 10.5}, d});
    ASSERT_TRUE(hit.is_hit());
    level += std::abs((10.5 + hit.distance_m * d.z()) - 0.5) < 1e-6 ? 1 : 0;
    sloped += hit.normal_world.head<2>().norm() > 0.01 ? 1 : 0;
  }
  EXPECT_EQ(level, 200);
  EXPECT_GT(sloped, 150);
}

TEST(WaterSurface, HasTheHeightsThatTheSpectrumAsksFor) {
  TestWorld world(sea_spec(jonswap("0.6", "4")));
  Draw draw("heights");
  double sum = 0.0, squares = 0.0;
  constexpr int kRays = 20000;
  for (int moment = 0; moment < 40; ++moment) {
    world->step(173);
    RayScene& scene = scene_on_water(world, {0, 0, 30});
    for (int i = 0; i < kRays / 40; ++i) {
      const Eigen::Vector2d p = within(draw, 100.0);
      const double height = 30.0 - range(scene, {p.x(), p.y(), 30.0}, -kZ);
      sum += height;
      squares += height * height;
    }
  }
  EXPECT_NEAR(sum / kRays, 0.0, 0.01);
  EXPECT_NEAR(4.0 * std::sqrt(squares / kRays), 0.6, 0.05 * 0.6);
}

TEST(WaterSurface, FadesWithTheSea) {
  // Growing from nothing at time zero.
  ParamList params = jonswap("0.5", "4");
  params.push_back({"ramp_time", "3"});
  TestWorld world(sea_spec(params));
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow({0, 0, 1}));
  EXPECT_EQ(water.highest_m(), 0.0);
  EXPECT_EQ(water.height_m({0.3, 0.4}), 0.0);
  world->step(100);
  ASSERT_TRUE(water.follow({0, 0, 1}));
  const WaveField& waves = waves_of(*world);
  EXPECT_NEAR(water.height_m({0.3, 0.4}), waves.elevation_m({0.3, 0.4}, 1.0), 0.01);
}

/// A sea of any water, put where plugins put theirs.
class OwnSea : public Sea {
 public:
  explicit OwnSea(std::unique_ptr<const Water> water) : water_(std::move(water)) {}
  const Water& water() const override { return *water_; }
  const Current& current() const override { return current_; }
  double depth_m(const Eigen::Vector2d&, double) const override { return 10.0; }

 private:
  std::unique_ptr<const Water> water_;
  Current current_{CurrentParams{}};
};

void put_sea(TestWorld& world, std::unique_ptr<const Water> water) {
  auto* const port = world->ports().advertise<SeaSample>(kSeaPort, PortRank::kState);
  port->value.sea = std::make_shared<OwnSea>(std::move(water));
}

TEST(WaterSurface, FadesTowardsTheShoreAsTheWavesDo) {
  // A beach that rises by one in twenty along x, dry from x = 0 on.
  WaveParams params;
  params.spectrum = WaveSpectrum::kJonswap;
  params.significant_height = 0.6;
  params.shore_depth = 1.0;
  auto waves = std::make_unique<WaveField>(
      params, 3, [](const Eigen::Vector2d& p, double) { return -0.05 * p.x(); });
  const WaveField& truth = *waves;
  TestWorld world;
  put_sea(world, std::move(waves));
  WaterSurface water(*world);
  ASSERT_TRUE(water.follow({-10, 0, 1}));
  EXPECT_EQ(water.height_m({3.0, 2.0}), 0.0);
  Draw draw("shore");
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d p = Eigen::Vector2d(-10, 0) + within(draw, 1.5);
    EXPECT_NEAR(water.height_m(p), truth.elevation_m(p, 0.0), 0.02);
    const Ray ray{{p.x(), p.y(), 1.0}, Eigen::Vector3d(0.9, 0.1, -0.2).normalized()};
    const double t = water.find_hit(ray, kNowhere).t, expected = hit_by_steps(water, ray, 40.0);
    EXPECT_NEAR(t, expected, 0.01);
  }
  // Rays find it as well where they know all of a square to be open, or dry.
  int open = 0, dry = 0, fading = 0;
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector2d p = within(draw, i % 2 == 0 ? 150.0 : 20.0);
    const Ray ray{{p.x(), p.y(), 3.0},
                  Eigen::Vector3d(0.6, 0.5, draw.uniform(-1.0, -0.2)).normalized()};
    const WaterHit water_hit = water.find_hit(ray, kNowhere);
    const Eigen::Vector3d p_hit = ray.p_world_origin + water_hit.t * ray.direction_world;
    const WaterReach reach = water.reach(ray);
    EXPECT_LE(reach.first, water_hit.t);
    EXPECT_GE(reach.last, water_hit.t);
    const double cosine = -water.normal(p_hit.head<2>()).dot(ray.direction_world);
    EXPECT_LE(cosine, water.cos_most(ray, reach) + 1e-9);
    EXPECT_LE(water.cos_most(ray, reach), water.cos_most(ray));
    EXPECT_NEAR(p_hit.z(), water.height_m(p_hit.head<2>()), 1e-6) << p_hit.transpose();
    const double strength = truth.strength(p_hit.head<2>(), 0.0);
    EXPECT_EQ(water.strength(p_hit.head<2>()), strength);
    ++(strength == 1.0 ? open : strength == 0.0 ? dry : fading);
  }
  EXPECT_GT(std::min({open, dry, fading}), 20);
}

TEST(WaterSurface, OfOtherWaterIsItsLevel) {
  TestWorld world;
  put_sea(world, std::make_unique<StillWater>(0.4));
  EXPECT_NEAR(range(scene_on_water(world, {0, 0, 2}), {0, 0, 2}, -kZ), 1.6, 1e-12);
}

}  // namespace
}  // namespace trident::sim
