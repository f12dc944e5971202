// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// fusion_benchmark SUITE FIRST_SEED SEEDS: a line of JSON for each run of the filter of a team.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "team_run.h"
#include "trident_base/random_stream.h"
#include "trident_estimation/filter/history.h"

namespace trident::estimation {
namespace {

using Eigen::VectorXd;

constexpr double kDuration_s = 90.0;
constexpr double kSettled_s = 30.0;
constexpr double kOutage_s = 60.0;
constexpr double kDelay_s = 1.0;

const char* name_of(FilterKind kind) { return kind == FilterKind::kEkf ? "ekf" : "ukf"; }

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// Sums of NIS and of sizes: their ratio is 1 for a filter that is right.
std::pair<double, double> nis_sums(const TeamRun& run) {
  std::pair<double, double> sums;
  for (const auto& [nis, size] : run.nis) {
    sums.first += nis;
    sums.second += size;
  }
  return sums;
}

void print_errors(const TeamRun& run) {
  std::printf("\"rms_m\": [%.6f, %.6f, %.6f]", std::sqrt(run.square_error[0]),
              std::sqrt(run.square_error[1]), std::sqrt(run.square_error[2]));
}

int wrongly_accused(const TeamRun& run) {
  return static_cast<int>(
      std::count_if(run.reports.begin(), run.reports.end(),
                    [](const auto& one) { return one.second.trust.inflation > 1.0; }));
}

void print_run(const char* suite, std::uint64_t seed, FilterKind kind, const std::string& what,
               const TeamRun& run) {
  const auto [nis, size] = nis_sums(run);
  std::printf("{\"suite\": \"%s\", \"seed\": %llu, \"kind\": \"%s\", \"what\": \"%s\", ", suite,
              static_cast<unsigned long long>(seed), name_of(kind), what.c_str());
  print_errors(run);
  std::printf(
      ", \"worst_ugv_m\": %.6f, \"nees\": %.6f, \"nees_end\": %.6f, \"nis\": %.6f, \"nis_size\": "
      "%.0f, \"accused\": %d}\n",
      run.worst_error[kUgv], mean(run.nees), run.nees.back(), nis, size, wrongly_accused(run));
}

void consistency(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kDuration_s;
  const TeamScene scene = make_scene(options);
  for (const FilterKind kind : {FilterKind::kEkf, FilterKind::kUkf}) {
    print_run("consistency", seed, kind, "all", run(scene, {kind, kSettled_s, false, {}}));
  }
  for (const char* end : {"/pose", "/gnss"}) {
    const auto uses = [end](const std::string& source) { return ends_with(source, end); };
    print_run("consistency", seed, FilterKind::kEkf, end,
              run(scene, {FilterKind::kEkf, kSettled_s, false, uses}));
  }
}

void outliers(std::uint64_t seed) {
  for (const double share : {0.0, 0.2}) {
    SceneOptions options;
    options.seed = seed;
    options.duration = kDuration_s;
    options.outliers = share;
    print_run("outliers", seed, FilterKind::kEkf, share > 0.0 ? "with" : "without",
              run(make_scene(options), {FilterKind::kEkf, kSettled_s, true, {}}));
  }
}

// The UGV's GNSS goes after 30 s; the whole minute after that is judged.
void outage(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.gnss_gone_from = kSettled_s;
  options.duration = kSettled_s + kOutage_s;
  options.is_ugv_followed = true;
  const TeamScene scene = make_scene(options);
  const auto blind = [](const std::string& source) { return source != "uav/sees/ugv"; };
  print_run("outage", seed, FilterKind::kEkf, "seen",
            run(scene, {FilterKind::kEkf, kSettled_s, true, {}}));
  print_run("outage", seed, FilterKind::kEkf, "unseen",
            run(scene, {FilterKind::kEkf, kSettled_s, true, blind}));
}

// All measurements come up to a second late, in the order of their arrival, five batches a second.
void delays(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kSettled_s;
  const TeamScene scene = make_scene(options);
  RandomStream delay(seed, "fusion_benchmark/delay");
  std::vector<std::pair<double, std::size_t>> arrivals;
  for (std::size_t i = 0; i < scene.measurements.size(); ++i) {
    arrivals.emplace_back(scene.measurements[i].stamp.seconds() + kDelay_s * delay.uniform(i, 0),
                          i);
  }
  std::sort(arrivals.begin(), arrivals.end());
  for (const FilterKind kind : {FilterKind::kEkf, FilterKind::kUkf}) {
    const TeamRun sorted = run(scene, {kind, 0.0, true, {}});
    History late(first_belief(scene, kind), SimTime::from_seconds(kDelay_s), TrustParams{});
    std::vector<Measurement> batch;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      batch.push_back(scene.measurements[arrivals[i].second]);
      const bool is_last = i + 1 == arrivals.size();
      if (!is_last &&
          std::floor(5.0 * arrivals[i].first) == std::floor(5.0 * arrivals[i + 1].first)) {
        continue;
      }
      for (const Outcome& one : late.add_all(std::move(batch))) {
        refused += one.kind == Outcome::Kind::kRefused ? 1 : 0;
      }
      batch.clear();
    }
    const Filter& newest = late.newest();
    std::printf(
        "{\"suite\": \"delays\", \"seed\": %llu, \"kind\": \"%s\", \"refused\": %zu, "
        "\"difference\": %.3e}\n",
        static_cast<unsigned long long>(seed), name_of(kind), refused,
        std::max((newest.state() - sorted.state).cwiseAbs().maxCoeff(),
                 (newest.covariance() - sorted.covariance).cwiseAbs().maxCoeff()));
  }
}

// Each of two stations has a filter of its own: one hears the UGV's GNSS, the other what the UAV
// sees. Twice a second each takes in where the other one believes the UGV to be.
void sharing(std::uint64_t seed, bool is_shared) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kSettled_s + kOutage_s;
  const TeamScene scene = make_scene(options);
  const SimTime keep = SimTime::from_seconds(1.0);
  History first(first_belief(scene, FilterKind::kEkf), keep), second = first;
  constexpr Eigen::Index kFirst = TeamModel::kDofs * static_cast<Eigen::Index>(kUgv);
  const auto pose_of = [&](const Filter& filter, SimTime stamp, const char* source) {
    return world_pose({stamp, source}, kUgv, TeamModel::robot(filter.state(), kUgv).T_world_base,
                      filter.covariance().block(kFirst, kFirst, 6, 6), is_shared);
  };
  std::vector<double> whole, pose;
  auto next = scene.measurements.begin();
  for (std::size_t tick = 1; tick < scene.truth.size(); ++tick) {
    std::vector<Measurement> one, other;
    for (; next != scene.measurements.end() && next->stamp <= tick_time(tick); ++next) {
      if (next->source != "uav/sees/ugv") one.push_back(*next);
      if (next->source != "ugv/gnss") other.push_back(*next);
    }
    first.add_all(std::move(one));
    second.add_all(std::move(other));
    if (tick % 15 != 0) continue;
    const Filter a = first.at(tick_time(tick)).value(), b = second.at(tick_time(tick)).value();
    first.add(pose_of(b, tick_time(tick), "second/ugv"));
    second.add(pose_of(a, tick_time(tick), "first/ugv"));
    if (tick_time(tick).seconds() < kSettled_s) continue;
    whole.push_back(nees(first.newest(), scene.truth[tick]));
    pose.push_back(nees(first.newest(), scene.truth[tick], kFirst, 6));
  }
  std::printf(
      "{\"suite\": \"sharing\", \"seed\": %llu, \"what\": \"%s\", \"nees\": %.6f, \"nees_end\": "
      "%.6f, \"pose_nees\": %.6f, \"error_m\": %.6f}\n",
      static_cast<unsigned long long>(seed), is_shared ? "intersection" : "naive", mean(whole),
      whole.back(), mean(pose), position_error(first.newest(), scene.truth.back(), kUgv));
}

// A GNSS receiver whose covariance is a 25th of the true one.
void lies(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kDuration_s;
  TeamScene scene = make_scene(options);
  for (Measurement& one : scene.measurements) {
    if (one.source == "uav/gnss") one.R /= 25.0;
  }
  const TeamRun run_ = run(scene, {FilterKind::kEkf, kSettled_s, true, {}});
  std::string named;
  for (const auto& [source, report] : run_.reports) {
    if (report.trust.inflation > 1.0) named += (named.empty() ? "" : " ") + source;
  }
  print_run("lies", seed, FilterKind::kEkf, named, run_);
}

void speed(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kDuration_s;
  options.is_every_tick = true;
  const TeamScene scene = make_scene(options);
  const auto ten = [](const std::string& source) { return source != "uav/altitude"; };
  for (const FilterKind kind : {FilterKind::kEkf, FilterKind::kUkf}) {
    std::printf("{\"suite\": \"speed\", \"kind\": \"%s\", \"cpu_s_per_s\": %.6f}\n", name_of(kind),
                run(scene, {kind, 0.0, true, ten}).cpu_s / kDuration_s);
  }
}

// Tracks from above, with ellipses of what is believed every ten seconds.
void picture(std::uint64_t seed) {
  SceneOptions options;
  options.seed = seed;
  options.duration = kSettled_s + kOutage_s;
  options.gnss_gone_from = kSettled_s;
  options.is_ugv_followed = true;
  const TeamScene scene = make_scene(options);
  for (const bool is_seen : {true, false}) {
    History history(first_belief(scene, FilterKind::kEkf), SimTime{});
    auto next = scene.measurements.begin();
    for (std::size_t tick = 1; tick < scene.truth.size(); ++tick) {
      for (; next != scene.measurements.end() && next->stamp <= tick_time(tick); ++next) {
        if (is_seen || next->source != "uav/sees/ugv") history.add(*next);
      }
      if (tick % 30 != 0) continue;
      const Filter filter = history.at(tick_time(tick)).value();
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Index first = TeamModel::kDofs * static_cast<Eigen::Index>(i);
        const VectorXd p = TeamModel::robot(filter.state(), i).T_world_base.p;
        const VectorXd truth = TeamModel::robot(scene.truth[tick], i).T_world_base.p;
        const Eigen::Matrix2d P = filter.covariance().block<2, 2>(first, first);
        std::printf(
            "{\"suite\": \"picture\", \"seen\": %s, \"t\": %.3f, \"robot\": %zu, \"p\": [%.4f, "
            "%.4f], \"truth\": [%.4f, %.4f], \"covariance\": [%.6e, %.6e, %.6e]}\n",
            is_seen ? "true" : "false", tick_time(tick).seconds(), i, p.x(), p.y(), truth.x(),
            truth.y(), P(0, 0), P(0, 1), P(1, 1));
      }
    }
  }
}

void sharing_both(std::uint64_t seed) {
  sharing(seed, true);
  sharing(seed, false);
}

int benchmark(const std::string& suite, std::uint64_t first, std::uint64_t seeds) {
  const std::pair<const char*, void (*)(std::uint64_t)> suites[] = {{"consistency", consistency},
                                                                    {"outliers", outliers},
                                                                    {"outage", outage},
                                                                    {"delays", delays},
                                                                    {"sharing", sharing_both},
                                                                    {"lies", lies},
                                                                    {"speed", speed},
                                                                    {"picture", picture}};
  for (const auto& [name, function] : suites) {
    if (suite != name) continue;
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) function(seed);
    return 0;
  }
  std::fprintf(stderr, "fusion_benchmark: no suite '%s'\n", suite.c_str());
  return 2;
}

}  // namespace
}  // namespace trident::estimation

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: fusion_benchmark SUITE FIRST_SEED SEEDS\n");
    return 2;
  }
  return trident::estimation::benchmark(argv[1], std::strtoull(argv[2], nullptr, 10),
                                        std::strtoull(argv[3], nullptr, 10));
}
