// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "pain.h"
#include "trident_base/angle.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav::pains {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr double kPeriod_s = 0.1;
constexpr double kSensor_m = 0.3;  // above the ground

/// A box of 0.2 m, 1 m high, whose near face is at x = 6 in the middle of the costmap.
struct Box {
  double x0 = 6.0, x1 = 6.2, y0 = 4.9, y1 = 5.1;

  /// How far along a ray in the plane it is hit; infinite: it is not.
  double hit(double x, double y, double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    double near = 0.0, far = kNothing;
    for (const auto& [from, along, low, high] :
         {std::array{x, c, x0, x1}, std::array{y, s, y0, y1}}) {
      const double a = (low - from) / along, b = (high - from) / along;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far ? near : kNothing;
  }
};

/// An obstacle layer with the defaults of config/nav in a costmap that stands still.
class BoxWorld {
 public:
  explicit BoxWorld(const std::string& data_type) {
    Registry<LayerType> registry("layer");
    register_builtin_layers(registry);
    LayerSetup setup;
    setup.name = "obstacle_layer";
    setup.config = parse_yaml("{sources: {scan: {data_type: " + data_type +
                                  ", clearing: true, inf_is_valid: true, obstacle_range: 4.0, "
                                  "raytrace_range: 5.0}}}",
                              "scene");
    CostmapParams params;
    params.width = params.height = 10.0;
    params.robot_radius = 0.2;
    std::vector<std::unique_ptr<Layer>> layers;
    layers.push_back(make_layer(registry, "ObstacleLayer", setup));
    costmap_ = std::make_unique<Costmap>(params, std::move(layers));
  }

  /// Beams from x = `at`, y = 5: those that miss the box end in the background.
  void scan(double at, bool has_box, const std::function<Eigen::Vector3f(double)>& background) {
    constexpr int kBeams = 361;
    Observation observation;
    observation.stamp_s = now_s_;
    observation.groups = {{{at, 5.0, kSensor_m}, 0, kBeams}};
    for (int i = 0; i < kBeams; ++i) {
      const double angle = -0.5 * kPi + kPi * i / (kBeams - 1) + 1e-9;
      const double range_m = has_box ? box_.hit(at, 5.0, angle) : kNothing;
      BeamEnd end;
      end.p = std::isfinite(range_m)
                  ? Eigen::Vector3f(static_cast<float>(range_m * std::cos(angle)),
                                    static_cast<float>(range_m * std::sin(angle)), 0.0F)
                  : background(angle);
      end.is_hit = std::isfinite(range_m) || end.p.norm() < kBeyond_m;
      observation.ends.push_back(end);
    }
    dynamic_cast<BeamLayer&>(*costmap_->layer("obstacle_layer"))
        .find_source("scan")
        ->add(std::move(observation));
    costmap_->update({now_s_, {at, 5.0, 0.0}});
    now_s_ += kPeriod_s;
  }

  int marked_cells() const {
    const CostGrid grid = costmap_->grid();
    int count = 0;
    for (double x = box_.x0 - 0.075; x < box_.x1 + 0.1; x += 0.05) {
      for (double y = box_.y0 - 0.075; y < box_.y1 + 0.1; y += 0.05) {
        count += grid.at(x, y) == kLethalCost ? 1 : 0;
      }
    }
    return count;
  }

  /// A beam of this length has hit nothing.
  static constexpr double kBeyond_m = 29.0;

 private:
  Box box_;
  double now_s_ = 0.0;
  std::unique_ptr<Costmap> costmap_;
};

Eigen::Vector3f level(double range_m, double angle) {
  return {static_cast<float>(range_m * std::cos(angle)),
          static_cast<float>(range_m * std::sin(angle)), 0.0F};
}

struct Background {
  const char* name;
  const char* data_type;
  std::function<Eigen::Vector3f(double)> end;
};

std::vector<Background> backgrounds() {
  // Beams that rise pass the box at a height at which it is, and end above all that is marked.
  const auto high = [](double angle) {
    Eigen::Vector3f end = level(3.5, angle);
    end.z() = 2.5F;
    return end;
  };
  return {{"far", "LaserScan", [](double angle) { return level(20.0, angle); }},
          {"none", "LaserScan", [](double angle) { return level(30.0, angle); }},
          {"high", "PointCloud2", high}};
}

int scans_until_gone(const Background& background) {
  BoxWorld world(background.data_type);
  constexpr double kFrom_m = 4.8;
  for (int i = 0; i < 3; ++i) world.scan(kFrom_m, true, background.end);
  if (world.marked_cells() == 0) return 1000;  // it was never seen
  int scans = 0;
  while (world.marked_cells() > 0 && scans < 100) {
    world.scan(kFrom_m, false, background.end);
    ++scans;
  }
  return scans;
}

/// The fewest of the cells of the near face that are left while the robot backs off, of those that
/// were marked.
double kept_share(const Background& background) {
  BoxWorld world(background.data_type);
  double at = 5.0;
  for (int i = 0; i < 3; ++i) world.scan(at, true, background.end);
  const int marked = world.marked_cells();
  int least = marked;
  for (; at > 0.5; at -= 0.05) {
    world.scan(at, true, background.end);
    least = std::min(least, world.marked_cells());
  }
  return marked == 0 ? 0.0 : static_cast<double>(least) / marked;
}

}  // namespace

Pains obstacle_pains(bool /*is_quick*/) {
  Pains pains;
  for (const Background& background : backgrounds()) {
    pains.push_back(
        {"P4", "navigation#267, #662",
         std::string("box taken away, background ") + background.name + ": scans until it is gone",
         static_cast<double>(scans_until_gone(background)), 2.0, "scans", false, ""});
    pains.push_back({"P4", "navigation2#5476",
                     std::string("robot backs off to 5.5 m, background ") + background.name +
                         ": part of the box's marks that is left",
                     kept_share(background), 0.5, "1", true, ""});
  }
  return pains;
}

}  // namespace trident::nav::pains
