// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/plugins/radio_params.h"

#include <cmath>
#include <cstddef>
#include <sstream>

#include "comms/phy/vht.h"
#include "trident_base/error.h"
#include "trident_base/sim_time.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

/// Hands the words of an element to take(), so many at once; what take() returns false for is not
/// legal. Nothing is read where the element is missing. Throws Error.
template <class Take>
void read_groups(const PluginParams& params, const char* key, std::size_t size,
                 const char* expected, Take&& take) {
  const std::string text = params.text(key, "");
  const std::vector<std::string> all = words(text);
  if (all.size() % size != 0) params.refuse(key, text, expected);
  for (auto word = all.begin(); word != all.end(); word += static_cast<std::ptrdiff_t>(size)) {
    if (!take(&*word)) params.refuse(key, text, expected);
  }
}

/// Adaptive, or a number that is a mode at this width.
int read_rate(const PluginParams& params, int fallback, int width_mhz) {
  const std::string text =
      params.text("rate", fallback < 0 ? "adaptive" : std::to_string(fallback));
  if (text == "adaptive") return -1;
  const auto mcs = number_from_text(text);
  const bool is_whole = mcs && *mcs == static_cast<int>(*mcs);
  if (!is_whole || !vht::is_mode(static_cast<int>(*mcs), width_mhz)) {
    params.refuse("rate", text,
                  width_mhz == 20 ? "adaptive or an MCS, 0 to 8" : "adaptive or an MCS, 0 to 9");
  }
  return static_cast<int>(*mcs);
}

/// What is not among the elements stays.
void read_radio(const PluginParams& params, RadioParams* radio) {
  // Read so that it counts as known: there is no other standard here.
  params.text("standard", "802.11ac");
  // The 5 GHz band has channels 36 to 177.
  radio->channel = params.integer("channel", radio->channel, {36, 177});
  radio->width_mhz = params.choice("width", radio->width_mhz, {{"20", 20}, {"40", 40}, {"80", 80}});
  radio->tx_power_dbm = params.number("tx_power", radio->tx_power_dbm, {-30, 40});
  radio->noise_figure_db = params.number("noise_figure", radio->noise_figure_db, {0, 30});
  radio->carrier_sense_dbm = params.number("carrier_sense", radio->carrier_sense_dbm, {-100, -30});
  radio->mcs = read_rate(params, radio->mcs, radio->width_mhz);
  radio->has_short_guard =
      params.choice("guard", radio->has_short_guard, {{"long", false}, {"short", true}});
  radio->max_ampdu_bytes = static_cast<std::size_t>(
      params.integer("max_ampdu", static_cast<int>(radio->max_ampdu_bytes), {0, 1048575}));
  radio->broadcast_mbit_s =
      params.choice("broadcast_rate", radio->broadcast_mbit_s, {{"6", 6}, {"12", 12}, {"24", 24}});
  radio->tries = params.integer("tries", radio->tries, {1, 255});
  radio->queue_bytes = static_cast<std::size_t>(
      params.integer("queue_bytes", static_cast<int>(radio->queue_bytes), {2000, 1e9}));
  radio->is_base_station = params.flag("base_station", radio->is_base_station);
  const double processing_s = 1e-9 * static_cast<double>(radio->processing_ns);
  radio->processing_ns =
      SimTime::from_seconds(params.number("processing", processing_s, {0.0, 1.0})).ns;
}

void read_obstacles(const PluginParams& params, ObstacleParams* obstacles) {
  obstacles->penetration_db = params.number("penetration_db", obstacles->penetration_db, {0, 200});
  if (params.has("materials")) obstacles->materials.clear();
  read_groups(params, "materials", 2,
              "pairs of a part of a collision's name and a loss, 0 to 200 [dB]",
              [obstacles](const std::string* words) {
                const auto loss_db = number_from_text(words[1]);
                if (!loss_db || !(*loss_db >= 0.0 && *loss_db <= 200.0)) return false;
                obstacles->materials.emplace_back(words[0], *loss_db);
                return true;
              });
}

/// What is not among the elements stays.
void read_path_loss(const PluginParams& params, PathLossParams* path) {
  path->model = params.choice("path", path->model,
                              {{"two_ray", PathModel::kTwoRay},
                               {"log_distance", PathModel::kLogDistance},
                               {"free_space", PathModel::kFreeSpace}});
  path->exponent = params.number("exponent", path->exponent, {1, 6});
  path->shadowing.stddev_db = params.number("shadowing_sigma", path->shadowing.stddev_db, {0, 20});
  path->shadowing.decorrelation_m =
      params.number("decorrelation_distance", path->shadowing.decorrelation_m, {1, 1000});
  read_obstacles(params, &path->obstacles);
  path->polarization = params.choice(
      "polarization", path->polarization,
      {{"vertical", Polarization::kVertical}, {"horizontal", Polarization::kHorizontal}});
  path->water.relative_permittivity =
      params.number("permittivity", path->water.relative_permittivity, {1, 100});
  path->water.conductivity_s_m =
      params.number("conductivity", path->water.conductivity_s_m, {0, 10});
}

void read_outage_regions(const PluginParams& params, std::vector<OutageRegion>* regions) {
  if (params.has("outage_regions")) regions->clear();
  read_groups(params, "outage_regions", 3, "x, y and radius of each [m], the radius not negative",
              [regions](const std::string* words) {
                const auto x = number_from_text(words[0]), y = number_from_text(words[1]);
                const auto radius = number_from_text(words[2]);
                if (!x || !y || !radius) return false;
                regions->push_back({{*x, *y}, *radius});
                return std::isfinite(*x + *y + *radius) && *radius >= 0.0;
              });
}

}  // namespace

std::string radio_name(const PluginParams& params, const std::string& model) {
  const std::string text = params.text("robotNamespace", model);
  const std::size_t first = text.find_first_not_of('/');
  if (first == std::string::npos) return model;
  return text.substr(first, text.find_last_not_of('/') - first + 1);
}

void read_radio_end(const PluginParams& params, RadioEnd* end) {
  read_radio(params, &end->params);
  end->pattern = params.choice(
      "antenna", end->pattern,
      {{"isotropic", AntennaPattern::kIsotropic}, {"dipole", AntennaPattern::kDipole}});
  end->gain_dbi = params.number("gain", end->gain_dbi, {-30, 40});
  const double before_m = end->height_m;
  end->height_m = params.number("height", before_m, {-10, 100});
  end->T_link_antenna.p.z() += end->height_m - before_m;
}

std::vector<RadioOutage> read_outages(const PluginParams& params) {
  std::vector<RadioOutage> outages;
  read_groups(params, "outages", 2, "pairs of times [s], each begin before its end",
              [&outages](const std::string* words) {
                const auto begin = number_from_text(words[0]), end = number_from_text(words[1]);
                if (!begin || !end || !(*begin <= *end)) return false;
                outages.push_back({*begin, *end});
                return true;
              });
  return outages;
}

double read_status_rate_hz(const PluginParams& params, double fallback) {
  return params.number("status_rate", fallback, {0.01, 1000.0});
}

void read_radio_air(const PluginParams& params, RadioAir* air) {
  read_path_loss(params, &air->path);
  read_outage_regions(params, &air->outage_regions);
  air->status_rate_hz = read_status_rate_hz(params, air->status_rate_hz);
}

ParamNode as_elements(const std::map<std::string, std::string>& texts) {
  ParamNode node;
  // Keys of a rules file go through the same reader, limits and errors as elements of SDF.
  for (const auto& [name, text] : texts) node.children.push_back({name, text, {}, {}});
  return node;
}

void refuse_unread(const PluginParams& params) {
  const std::vector<std::string> unread = params.unread();
  if (unread.empty()) return;
  std::vector<std::string> known;
  for (const auto& [name, query] : params.queries()) known.push_back(name);
  throw Error(params.owner() + ": " + unknown_name_text(unread.front(), known));
}

}  // namespace trident::sim
