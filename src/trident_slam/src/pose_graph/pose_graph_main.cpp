// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0

// pose_graph FILE [option value ...] [--strict]: optimises a g2o file and prints a JSON object.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/shown_text.h"
#include "trident_base/string_util.h"
#include "trident_slam/incremental_pose_graph.h"
#include "trident_slam/pose_graph_ceres.h"
#include "trident_slam/pose_graph_g2o.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {
namespace {

struct Settings {
  std::string file;
  std::string out;
  std::string before;
  bool is_ceres = false;
  bool is_incremental = false;
  bool is_strict = false;  // information that is not positive semidefinite is an error
  RobustKernel kernel = RobustKernel::kNone;
  PoseGraphOptions options;
  CeresOptions ceres;
};

template <class Value>
Value choice(const std::string& option, const std::string& text,
             const std::map<std::string, Value>& values) {
  const auto found = values.find(text);
  if (found != values.end()) return found->second;
  std::vector<std::string> known;
  known.reserve(values.size());
  for (const auto& [name, value] : values) known.push_back(name);
  throw Error(option + ": unknown " + unknown_name_text(text, known));
}

double number(const std::string& option, const std::string& text) {
  const std::optional<double> value = number_from_text(text);
  if (!value) throw Error(option + ": '" + text + "' is not a number");
  return *value;
}

const std::map<std::string, PoseGraphStart> kStarts{{"auto", PoseGraphStart::kAuto},
                                                    {"file", PoseGraphStart::kGraph},
                                                    {"chordal", PoseGraphStart::kChordal}};
const std::map<std::string, TrustStrategy> kStrategies{
    {"gauss_newton", TrustStrategy::kGaussNewton},
    {"levenberg_marquardt", TrustStrategy::kLevenbergMarquardt},
    {"dogleg", TrustStrategy::kDogleg}};

constexpr char kIncremental[] = "--incremental";
constexpr char kStrict[] = "--strict";

using Take = std::function<void(const std::string&)>;
/// What takes the value of each option, by its name.
using Takers = std::map<std::string, Take>;

void add_search_takers(Settings& settings, Takers& takers) {
  PoseGraphOptions& options = settings.options;
  takers["--init"] = [&](auto& text) { options.start = choice("--init", text, kStarts); };
  takers["--strategy"] = [&](auto& text) {
    options.strategy = choice("--strategy", text, kStrategies);
  };
  takers["--robust"] = [&](auto& text) {
    options.is_graduated = text == "gnc";
    if (text != "gnc") settings.kernel = robust_kernel_from_name(text);
  };
  takers["--scale"] = [&](auto& text) { options.graduated_scale = number("--scale", text); };
  takers["--iterations"] = [&](auto& text) {
    options.max_iterations = static_cast<int>(number("--iterations", text));
  };
  takers["--tolerance"] = [&](auto& text) {
    options.relative_tolerance = number("--tolerance", text);
  };
}

void add_ceres_takers(CeresOptions& ceres, Takers& takers) {
  const auto keep_in = [](std::string& field) {
    return [&field](const std::string& text) { field = text; };
  };
  takers["--ceres_linear_solver"] = keep_in(ceres.linear_solver);
  takers["--ceres_preconditioner"] = keep_in(ceres.preconditioner);
  takers["--ceres_trust_strategy"] = keep_in(ceres.trust_strategy);
  takers["--ceres_dogleg_type"] = keep_in(ceres.dogleg_type);
  takers["--ceres_loss_function"] = keep_in(ceres.loss_function);
}

Takers takers_of(Settings& settings) {
  Takers takers;
  takers["--out"] = [&](auto& text) { settings.out = text; };
  takers["--before"] = [&](auto& text) { settings.before = text; };
  takers["--solver"] = [&](auto& text) {
    settings.is_ceres = choice<bool>("--solver", text, {{"trident", false}, {"ceres", true}});
  };
  add_search_takers(settings, takers);
  add_ceres_takers(settings.ceres, takers);
  return takers;
}

std::vector<std::string> names_of(const Takers& takers) {
  std::vector<std::string> names;
  names.reserve(takers.size() + 2);
  for (const auto& [name, take] : takers) names.push_back(name);
  names.emplace_back(kIncremental);
  names.emplace_back(kStrict);
  return names;
}

/// Own Gauss-Newton steps on squared errors.
bool is_plain(const Settings& settings) {
  return !settings.is_ceres && !settings.options.is_graduated &&
         settings.kernel == RobustKernel::kNone;
}

/// Throws Error for options that exclude each other.
void check_combination(const Settings& settings) {
  const bool is_graduated = settings.options.is_graduated;
  if (settings.is_incremental && !is_plain(settings)) {
    throw Error("--incremental needs --solver trident and no --robust");
  }
  if (settings.is_ceres && is_graduated) throw Error("--robust gnc needs --solver trident");
}

/// Takes an option that has no value; false: it has one, or is unknown.
bool take_flag(const std::string& name, Settings& settings) {
  if (name != kStrict && name != kIncremental) return false;
  (name == kStrict ? settings.is_strict : settings.is_incremental) = true;
  return true;
}

void parse_options(int argc, char** argv, const Takers& takers, Settings& settings) {
  for (int k = 2; k < argc; ++k) {
    const std::string name = argv[k];
    if (take_flag(name, settings)) continue;
    const auto found = takers.find(name);
    if (found == takers.end()) {
      throw Error("unknown option " + unknown_name_text(name, names_of(takers)));
    }
    if (++k == argc) throw Error(name + " needs a value");
    found->second(argv[k]);
  }
}

Settings parse(int argc, char** argv) {
  Settings settings;
  settings.options.start = PoseGraphStart::kAuto;
  settings.options.tries_both_starts = true;
  const Takers takers = takers_of(settings);
  if (argc < 2) {
    throw Error("usage: pose_graph FILE.g2o [OPTION VALUE ...]; options: " +
                join(names_of(takers)));
  }
  settings.file = argv[1];
  parse_options(argc, argv, takers, settings);
  settings.ceres.start = settings.options.start;
  settings.ceres.max_iterations = settings.options.max_iterations;
  settings.ceres.relative_tolerance = settings.options.relative_tolerance;
  check_combination(settings);
  return settings;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The graph as a robot adds it: its vertices in their order, each with the edges to those before.
template <class Group>
PoseGraphReport optimize_as_it_grows(PoseGraph<Group>& graph) {
  std::vector<std::vector<typename PoseGraph<Group>::Edge>> edges(graph.vertices().size());
  for (const auto& edge : graph.edges()) {
    edges[std::max(graph.index(edge.from), graph.index(edge.to))].push_back(edge);
  }
  IncrementalPoseGraph<Group> growing;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto& vertex = graph.vertices()[k];
    growing.add(vertex.id, vertex.T_map_vertex, edges[k]);
  }
  PoseGraphReport report;
  report.chi2_before = report.cost_before = report.chi2_start = pose_graph_chi2(graph);
  growing.finish();
  for (const auto& vertex : growing.graph().vertices()) {
    graph.set_pose(vertex.id, vertex.T_map_vertex);
  }
  report.chi2_after = report.cost_after = pose_graph_chi2(graph);
  report.iterations = growing.optimizations();
  report.has_converged = true;
  return report;
}

/// Of the edges that are not trusted.
template <class Group>
void set_kernels(PoseGraph<Group>& graph, const Settings& settings) {
  if (settings.kernel == RobustKernel::kNone) return;
  const double scale = settings.options.graduated_scale;
  for (std::size_t k = 0; k < graph.edges().size(); ++k) {
    if (graph.edges()[k].is_trusted) continue;
    graph.set_kernel(k, settings.kernel, scale > 0.0 ? scale : default_outlier_scale<Group>());
  }
}

template <class Group>
PoseGraphReport optimize(PoseGraph<Group>& graph, const Settings& settings) {
  if (settings.is_incremental) return optimize_as_it_grows(graph);
  set_kernels(graph, settings);
  if (settings.is_ceres) return make_ceres_solver<Group>(settings.ceres)->optimize(graph);
  return PoseGraphOptimizer<Group>(settings.options).optimize(graph);
}

/// Sets of vertices between which there is no edge.
template <class Group>
std::size_t count_parts(const PoseGraph<Group>& graph) {
  std::map<int, int> above;  // a vertex of the same part, itself at the top
  for (const auto& vertex : graph.vertices()) above[vertex.id] = vertex.id;
  const auto top = [&above](int id) {
    while (above[id] != id) id = above[id] = above[above[id]];
    return id;
  };
  for (const auto& edge : graph.edges()) above[top(edge.from)] = top(edge.to);
  return static_cast<std::size_t>(std::count_if(
      above.begin(), above.end(), [](const auto& entry) { return entry.first == entry.second; }));
}

template <class Group>
void print(const PoseGraph<Group>& graph, const PoseGraphReport& report, std::size_t indefinite,
           double read_s, double optimize_s) {
  std::printf("{\"kind\": \"%s\", \"vertices\": %zu, \"edges\": %zu,\n",
              PoseGraph<Group>::kDimension == 3 ? "SE2" : "SE3", graph.vertices().size(),
              graph.edges().size());
  std::printf(" \"parts\": %zu, \"indefinite\": %zu,\n", count_parts(graph), indefinite);
  std::printf(" \"chi2_before\": %.10g, \"chi2_start\": %.10g, \"chi2_after\": %.10g,\n",
              report.chi2_before, report.chi2_start, report.chi2_after);
  std::printf(" \"cost_before\": %.10g, \"cost_after\": %.10g,\n", report.cost_before,
              report.cost_after);
  std::printf(" \"start\": \"%s\", \"chi2_given_up\": %.10g,\n",
              report.is_start_chordal ? "chordal" : "file", report.chi2_given_up);
  std::printf(" \"iterations\": %d, \"converged\": %s,\n", report.iterations,
              report.has_converged ? "true" : "false");
  std::printf(" \"read_cpu_s\": %.6f, \"cpu_s\": %.6f,\n \"outliers\": [", read_s, optimize_s);
  const char* separator = "";
  for (std::size_t k = 0; k < report.weights.size(); ++k) {
    if (report.weights[k] >= 0.1) continue;
    std::printf("%s[%d, %d]", separator, graph.edges()[k].from, graph.edges()[k].to);
    separator = ", ";
  }
  std::printf("]}\n");
}

void run(const Settings& settings) {
  const double begin = cpu_seconds();
  G2oWarnings warnings;
  auto any_graph = read_g2o(
      settings.file,
      settings.is_strict ? IndefiniteInformation::kRefuse : IndefiniteInformation::kNearest,
      &warnings);
  const double read = cpu_seconds();
  if (!warnings.text.empty()) std::fprintf(stderr, "warning: %s\n", warnings.text.c_str());
  std::visit(
      [&](auto& graph) {
        if (!settings.before.empty()) write_g2o(graph, settings.before);
        const double start = cpu_seconds();
        const PoseGraphReport report = optimize(graph, settings);
        print(graph, report, warnings.indefinite, read - begin, cpu_seconds() - start);
        if (!settings.out.empty()) write_g2o(graph, settings.out);
      },
      any_graph);
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  try {
    trident::slam::run(trident::slam::parse(argc, argv));
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "%s\n", trident::with_short_words(error.what()).c_str());
    return 1;
  }
  return 0;
}
