// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <GeographicLib/Geoid.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/plugins/plugin_util.h"
#include "geoid_grid.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

using FixType = GnssStatusSample::FixType;

constexpr int kMinForFix = 4;      ///< satellites
constexpr double kMaskDeg = 10.0;  ///< nothing lower is used

/// What errors a kind of fix has [m].
struct FixErrors {
  double horizontal_m, vertical_m;
};

FixErrors read_errors(const PluginParams& params, const std::string& kind,
                      const FixErrors& fallback) {
  const Limits limits{0.0, 1e6};
  return {params.number(kind + "HorizontalStdDev", fallback.horizontal_m, limits),
          params.number(kind + "VerticalStdDev", fallback.vertical_m, limits)};
}

/// Directions towards satellites, which stand still, evenly over the sky above the mask.
std::vector<Eigen::Vector3d> make_sky(int satellites, const RandomStream& stream) {
  constexpr std::uint32_t kSkyChannel = 100;
  std::vector<Eigen::Vector3d> sky;
  const double lowest = std::sin(deg_to_rad(kMaskDeg));
  for (int i = 0; i < satellites; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const double z = lowest + (1.0 - lowest) * stream.uniform(number, kSkyChannel);
    const double azimuth = 2.0 * kPi * stream.uniform(number, kSkyChannel + 1);
    const double level = std::sqrt(1.0 - z * z);
    sky.emplace_back(level * std::cos(azimuth), level * std::sin(azimuth), z);
  }
  return sky;
}

/// Height of the geoid above the ellipsoid at the world's origin, where there are data: those of
/// GeographicLib for `<geoidModel>` (egm96-5), else PROJ's grid of EGM96, which is "egm96-15"; else
/// NaN. A model that a user asks for must be there.
double geoid_separation_m(const PluginContext& context) {
  const SphericalCoordinates& origin = context.world.spherical();
  const bool is_given = context.params.has("geoidModel");
  const std::string model = context.params.text("geoidModel", "egm96-5");
  try {
    return GeographicLib::Geoid(model)(origin.latitude_deg, origin.longitude_deg);
  } catch (const std::exception& error) {
    const std::string grid = find_egm96_grid();
    if (!grid.empty() && (!is_given || model == "egm96-15")) {
      return geoid_height_m(grid, origin.latitude_deg, origin.longitude_deg)
          .value_or(std::numeric_limits<double>::quiet_NaN());
    }
    if (is_given)
      context.params.refuse("geoidModel", model, std::string("data on disk: ") + error.what());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// libtrident_gnss.so: a receiver with RTK, as position fixes and, with each, how good it is.
/// With four satellites it has a single fix, with <rtkSatellites> in view for <floatTime> and
/// <fixedTime> [s] on end a float and a fixed one; without four it reports none, and no position.
/// Errors are white, of spreads that depend on the fix: <singleHorizontalStdDev>,
/// <singleVerticalStdDev>, <float...>, <fixed...> [m]. <satellites> (12) are in view, or with
/// <skyView> those of them that no collision hides. <fixTopic> (fix), <statusTopic> (gnss_status),
/// <rtk> (true), <geoidModel>.
class Gnss : public MeasuringPlugin {
 public:
  explicit Gnss(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        world_(context.world),
        link_(context.sensor != nullptr ? *context.link : required_link(context, "linkName")),
        T_link_antenna_(context.sensor != nullptr ? context.sensor->T_link_sensor : SE3()),
        clock_(context.sensor != nullptr ? context.sensor->update_rate_hz : 0.0),
        stream_(context.world.seed(), context.name),
        sky_(make_sky(context.params.integer("satellites", 12, {0.0, 64.0}), stream_)),
        rtk_{context.params.flag("rtk", true),
             context.params.integer("rtkSatellites", 6, {4.0, 64.0}),
             context.params.number("floatTime", 5.0, {0.0, 1e6}),
             context.params.number("fixedTime", 30.0, {0.0, 1e6})},
        sees_sky_(context.params.flag("skyView", false)) {
    const PluginParams& params = context.params;
    errors_ = {FixErrors{0.0, 0.0}, read_errors(params, "single", {1.5, 3.0}),
               read_errors(params, "float", {0.2, 0.4}),
               read_errors(params, "fixed", {0.01, 0.02})};
    if (rtk_.fixed_time_s < rtk_.float_time_s) {
      params.refuse("fixedTime", params.text("fixedTime", "30"),
                    "at least <floatTime>, " + params.text("floatTime", "5"));
    }
    const SphericalCoordinates& origin = world_.spherical();
    earth_.Reset(origin.latitude_deg, origin.longitude_deg, origin.elevation_m);
    R_enu_world_ = Eigen::AngleAxisd(deg_to_rad(origin.heading_deg), Eigen::Vector3d::UnitZ());
    fix_ = advertise<GnssFixSample>(context, scoped_topic(params, params.text("fixTopic", "fix")),
                                    PortRank::kSensor);
    status_ = advertise<GnssStatusSample>(
        context, scoped_topic(params, params.text("statusTopic", "gnss_status")),
        PortRank::kSensor);
    fix_->value.frame = status_->value.frame = params.text("frameName", link_.name);
    status_->value.geoid_separation_m = geoid_separation_m(context);
  }

  void reset() override { good_since_ = 0; }
  void state(StateArchive& archive) override { archive(good_since_); }

 protected:
  /// How long the view has been good is followed whether somebody listens or not.
  void measure(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info)) return;
    const Eigen::Vector3d p_world = link_.T_world_link() * T_link_antenna_.p;
    const int satellites = count_satellites(p_world);
    const FixType type = find_type(satellites, info);
    if (status_->wanted()) publish_status(info.end, type, satellites);
    if (fix_->wanted() && type != FixType::kNone) publish_fix(info, type, p_world);
  }

 private:
  int count_satellites(const Eigen::Vector3d& p_world) {
    if (!sees_sky_) return static_cast<int>(sky_.size());
    sight_.rays.resize(sky_.size());
    sight_.hits.resize(sky_.size());
    for (std::size_t i = 0; i < sky_.size(); ++i) {
      sight_.rays[i].p_world_origin = p_world;
      sight_.rays[i].direction_world = sky_[i];
    }
    RayFilter others;
    others.exclude_link = &link_;
    RayScene& scene = rays(world_, RayGeometry::kCollision);
    scene.refresh();
    scene.cast({sight_.rays.data(), sight_.rays.size()}, {sight_.hits.data(), sight_.hits.size()},
               others);
    return static_cast<int>(std::count_if(sight_.hits.begin(), sight_.hits.end(),
                                          [](const RayHit& hit) { return !hit.is_hit(); }));
  }

  bool is_enough_for_rtk(int satellites) const {
    return rtk_.is_there && satellites >= rtk_.satellites;
  }

  FixType find_type(int satellites, const StepInfo& info) {
    const bool may_use_rtk = is_enough_for_rtk(satellites);
    if (!may_use_rtk) good_since_ = info.sample;
    if (satellites < kMinForFix) return FixType::kNone;
    if (!may_use_rtk) return FixType::kSingle;
    const double good_s = static_cast<double>(info.sample - good_since_) * info.dt_s;
    if (good_s < rtk_.float_time_s) return FixType::kSingle;
    return good_s < rtk_.fixed_time_s ? FixType::kFloat : FixType::kFixed;
  }

  const FixErrors& errors_of(FixType type) const { return errors_[static_cast<std::size_t>(type)]; }

  void publish_status(SimTime stamp, FixType type, int satellites) {
    GnssStatusSample& value = status_->value;
    value.stamp = stamp;
    value.fix_type = type;
    value.stddev_horizontal_m = errors_of(type).horizontal_m;
    value.stddev_vertical_m = errors_of(type).vertical_m;
    value.satellites = satellites;
    status_->publish();
  }

  void publish_fix(const StepInfo& info, FixType type, const Eigen::Vector3d& p_world) {
    const double h = errors_of(type).horizontal_m, v = errors_of(type).vertical_m;
    const GaussianNoise3 noise{Eigen::Vector3d::Zero(), {h, h, v}};
    const Eigen::Vector3d p_enu =
        R_enu_world_ * p_world + noise.sample(stream_, clock_.count_at(info), 0);
    GnssFixSample& value = fix_->value;
    value.stamp = info.end;
    value.covariance_enu = {h * h, 0, 0, 0, h * h, 0, 0, 0, v * v};
    earth_.Reverse(p_enu.x(), p_enu.y(), p_enu.z(), value.latitude_deg, value.longitude_deg,
                   value.altitude_m);
    fix_->publish();
  }

  /// Carrier-phase positioning (real-time kinematic), as the parameters set it.
  struct Rtk {
    bool is_there;
    int satellites;                     ///< seen, at the least
    double float_time_s, fixed_time_s;  ///< of a good view, until there is such a fix
  };

  /// Rays to the satellites, kept to save their memory.
  struct Sight {
    std::vector<Ray> rays;
    std::vector<RayHit> hits;
  };

  World& world_;
  Link& link_;
  SE3 T_link_antenna_;
  SampleClock clock_;
  RandomStream stream_;
  std::vector<Eigen::Vector3d> sky_;
  Rtk rtk_;
  bool sees_sky_;
  std::array<FixErrors, 4> errors_{};  ///< by FixType
  GeographicLib::LocalCartesian earth_;
  Eigen::Matrix3d R_enu_world_;
  OutHandle<GnssFixSample> fix_;
  OutHandle<GnssStatusSample> status_;
  Sight sight_;
  std::uint64_t good_since_ = 0;  ///< number of the step since when the view is good enough for RTK
};

const PluginRegistrar kTridentGnss(
    "libtrident_gnss.so", factory_of<Gnss>(),
    PluginExample{"<floatTime>0.1</floatTime><fixedTime>0.3</fixedTime>",
                  {},
                  {"satellites", "rtkSatellites", "floatTime", "fixedTime",
                   "singleHorizontalStdDev", "fixedVerticalStdDev"},
                  R"(<sensor name="example" type="gps"><update_rate>50</update_rate></sensor>)"});

}  // namespace

}  // namespace trident::sim
