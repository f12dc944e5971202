// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/offline_program.h"

#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "matchers/correlative_match.h"
#include "process_cost.h"
#include "trident_base/error.h"
#include "trident_base/shown_text.h"
#include "trident_base/string_util.h"
#include "trident_slam/offline_run.h"
#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {
namespace {

/// Names of the methods that `has` is true for.
template <class Has>
std::string methods_that(const Has& has) {
  const Registry<Slam2dFactory> registry = builtin_slam_2d();
  std::vector<std::string> names;
  for (const std::string& name : registry.names()) {
    if (has(registry.get(name))) names.push_back(name);
  }
  return join(names);
}

std::string methods_with_sessions() {
  return methods_that([](const Slam2dFactory& method) { return method.has_sessions; });
}

std::string methods_without_odometry() {
  return methods_that([](const Slam2dFactory& method) { return method.maps_without_odometry; });
}

/// A command line that says too little, or what no option is.
class UsageError : public Error {
  using Error::Error;
};

std::string usage(const std::string& program) {
  return "usage: " + program +
         " FILE --method NAME [--config FILE.yaml] --out DIR [--NAME VALUE ...]\n"
         "NAME: " +
         join(builtin_slam_2d().names()) + "\n" + methods_with_sessions() +
         ": --session FILE: continue it, or with `mode: localization` in "
         "the config localize\n"
         "  in it; --start X,Y,YAW [m, rad]: there; --keep-session FILE: write it\n"
         "slam_offline: FILE is a CARMEN log (.log, .clf; plain, gzip, bzip2), '-' the standard "
         "input;\n"
         "  --laser front|rear\n"
         "slam_offline_bag: FILE is a rosbag; --scan TOPIC --odom TOPIC --imu TOPIC\n"
         "  --odom-frame F --base-frame F\n"
         "--progress: names each scan before it is worked on\n"
         "--no-odometry: poses by scans alone (" +
         methods_without_odometry() +
         ")\n"
         "Writes trajectory.tum, causal.tum, map.pgm, map.yaml and timing.json into DIR.\n";
}

/// %n is how far sscanf has read: "1,2,3x" is an error.
SE2 read_start(const std::string& text) {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  int read = 0;
  const int fields = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &x, &y, &yaw, &read);
  if (fields != 3 || static_cast<std::size_t>(read) != text.size()) {
    throw Error("--start " + text + ": legal: X,Y,YAW [m, m, rad]");
  }
  return SE2::from_xy_yaw(x, y, yaw);
}

void take_file(const std::string& word, OfflineCommand& options) {
  if (!options.log_file.empty()) throw Error("one log at a time, got also " + word);
  options.log_file = word;
}

/// False: `word` is no option that stands alone.
bool take_flag(const std::string& word, OfflineCommand& options) {
  if (word == "--progress") {
    options.shows_scans = true;
  } else if (word == "--no-odometry") {
    options.uses_odometry = false;
  } else {
    return false;
  }
  return true;
}

/// Options of the source of scans differ between programs, and are handed to it as they are.
void take_value(const std::string& word, const std::string& value,
                const std::vector<std::string>& source_options, OfflineCommand& options) {
  static const std::map<std::string, std::string OfflineCommand::*> kTexts = {
      {"--method", &OfflineCommand::method},
      {"--config", &OfflineCommand::config_file},
      {"--out", &OfflineCommand::out_dir},
      {"--session", &OfflineCommand::session},
      {"--keep-session", &OfflineCommand::kept_session}};
  if (word == "--odom-frame" && value.empty()) options.uses_odometry = false;
  if (const auto text = kTexts.find(word); text != kTexts.end()) {
    options.*text->second = value;
  } else if (word == "--start") {
    options.T_map_base = read_start(value);
  } else if (std::find(source_options.begin(), source_options.end(), word) !=
             source_options.end()) {
    options.source[word.substr(2)] = value;
  } else {
    throw UsageError("unknown option " + word);
  }
}

void require_complete(const OfflineCommand& options) {
  if (options.log_file.empty() || options.method.empty() || options.out_dir.empty()) {
    throw UsageError("FILE, --method and --out are needed");
  }
}

/// By hand, as options of the source are not known here but passed in.
OfflineCommand parse(int argc, char** argv, const std::vector<std::string>& source_options) {
  OfflineCommand options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.size() < 2 || word[0] != '-') {
      take_file(word, options);
    } else if (!take_flag(word, options)) {
      if (++i == argc) throw Error(word + ": a value must follow");
      take_value(word, argv[i], source_options, options);
    }
  }
  require_complete(options);
  return options;
}

// A line per percent; without a known length a line per 500 scans.
class ProgressLine {
 public:
  void operator()(std::size_t scans, double part) {
    const int percent = static_cast<int>(100.0 * part);
    const bool is_due = part > 0.0 ? percent != percent_ : scans % 500 == 0;
    if (!is_due) return;
    percent_ = percent;
    std::fprintf(stderr, "%s%3d %% %zu scans%s", is_terminal_ ? "\r" : "", percent, scans,
                 is_terminal_ ? "" : "\n");
  }
  void finish() const {
    if (is_terminal_) std::fputc('\n', stderr);
  }

 private:
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  int percent_ = -1;
};

// One JSON object by the names of what was estimated.
std::string calibration_text(const std::vector<CalibrationEstimate>& estimates) {
  std::string text = "{";
  for (const CalibrationEstimate& estimate : estimates) {
    char entry[160];
    std::snprintf(entry, sizeof(entry),
                  "%s\"%s\": {\"value\": %.6f, \"sigma\": %.6f, \"is_observed\": %s}",
                  text.size() > 1 ? ", " : "", estimate.name, estimate.value, estimate.sigma,
                  estimate.is_observed ? "true" : "false");
    text += entry;
  }
  return text + "}";
}

void write_timing(const OfflineCommand& options, const OfflineResult& result,
                  std::size_t bad_lines) {
  const ProcessCost cost = process_cost();
  char text[768];
  std::snprintf(text, sizeof(text),
                "{\"method\": \"%s\", \"scans\": %zu, \"unused_scans\": %zu, "
                "\"scan_problems\": %zu, \"log_problems\": %zu, \"cpu_s\": %.3f, "
                "\"peak_rss_mb\": %.1f, \"stamps_back\": %zu, \"stamp_jumps\": %zu, "
                "\"slowest_scan\": %zu, \"slowest_scan_cpu_s\": %.4f, "
                "\"most_lookups_of_a_search\": %" PRId64 ", \"odometry_calibration\": ",
                options.method.c_str(), result.scans, result.unused_scans,
                result.scan_problems.count(), bad_lines, cost.cpu_s, cost.peak_rss_mb,
                result.stamps_back, result.stamp_jumps, result.slowest_scan,
                result.slowest_scan_cpu_s, kMaxLookups);
  const std::string path = options.out_dir + "/timing.json";
  std::ofstream file(path);
  file << text << calibration_text(result.odometry_calibration) << "}\n";
  file.flush();
  if (!file) throw Error(path + ": cannot be written");
}

/// The first few in full and the number of all: a log with a million bad lines is one screen.
void print_problems(const char* what, const LogProblems& problems) {
  for (const std::string& text : problems.texts()) std::cerr << "warning: " << text << '\n';
  if (problems.count() > problems.texts().size()) {
    std::cerr << "warning: " << problems.count() << ' ' << what << " in all\n";
  }
}

/// Checked before the log is opened: an hour of work must not end in an option that does not fit.
Slam2dSession* with_sessions(Slam2d* slam, const OfflineCommand& options) {
  auto* able = dynamic_cast<Slam2dSession*>(slam);
  const bool is_wanted = !options.session.empty() || !options.kept_session.empty();
  if (is_wanted && able == nullptr) {
    throw Error("--method " + options.method +
                " has no sessions; legal: " + methods_with_sessions());
  }
  return able;
}

void load_session(Slam2dSession* slam, const OfflineCommand& options) {
  const std::optional<SE2>& T_map_base = options.T_map_base;
  slam->load_session(options.session,
                     T_map_base ? SessionStart::kGivenPose : SessionStart::kSessionEnd,
                     T_map_base.value_or(SE2::identity()));
}

void show_scan(std::size_t scan, std::int64_t stamp_ns) {
  std::fprintf(stderr, "scan %zu, stamp %.6f s\n", scan, 1e-9 * static_cast<double>(stamp_ns));
}

void leave_odometry(Slam2d* slam, const std::string& method) {
  auto* able = dynamic_cast<Slam2dOdometryUse*>(slam);
  if (able == nullptr) {
    throw Error("--no-odometry: " + method +
                " needs odometry; legal: " + methods_without_odometry());
  }
  able->set_uses_odometry(false);
}

/// Of a log that has no odometry; a method that cannot do without has one that stands still.
void leave_missing_odometry(Slam2d* slam) {
  auto* able = dynamic_cast<Slam2dOdometryUse*>(slam);
  if (able == nullptr) return;
  std::cerr << "poses come from the scans alone, as with --no-odometry\n";
  able->set_uses_odometry(false);
}

std::unique_ptr<ScanSource> open_log(const OfflineCommand& options, const OpenSource& open) {
  std::unique_ptr<ScanSource> log = open(options);
  if (const std::string chosen = log->chosen(); !chosen.empty()) std::cerr << chosen << '\n';
  return log;
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error(path + ": cannot be made: " + error.message());
}

/// What the log has shown is printed also when the run fails, since it often is the reason.
OfflineResult run_log(const OfflineCommand& options, ScanSource& log, Slam2d& slam) {
  ProgressLine progress;
  OfflineResult result;
  try {
    result = run_offline(log, slam, options.out_dir, std::ref(progress),
                         options.shows_scans ? OfflineScanBegins(show_scan) : nullptr);
  } catch (const Error& problem) {
    print_problems("problems of the log", log.problems());
    throw Error(options.log_file + ": " + problem.what());
  }
  progress.finish();
  print_problems("problems of the log", log.problems());
  print_problems("problems of scans", result.scan_problems);
  if (!result.stamp_problem.empty()) std::cerr << "warning: " << result.stamp_problem << '\n';
  return result;
}

void run(const OfflineCommand& options, const OpenSource& open) {
  const Slam2dFactory method = builtin_slam_2d().get(options.method);
  const std::unique_ptr<Slam2d> slam = method(Slam2dSetup(options.config_file));
  if (!options.uses_odometry) leave_odometry(slam.get(), options.method);
  Slam2dSession* const session = with_sessions(slam.get(), options);
  const std::unique_ptr<ScanSource> log = open_log(options, open);
  if (options.uses_odometry && !log->has_odometry()) leave_missing_odometry(slam.get());
  if (!options.session.empty()) load_session(session, options);
  make_folder(options.out_dir);
  const OfflineResult result = run_log(options, *log, *slam);
  if (!options.kept_session.empty()) session->save_session(options.kept_session);
  write_timing(options, result, log->problems().count());
}

}  // namespace

int run_offline_program(int argc, char** argv, const std::vector<std::string>& source_options,
                        const OpenSource& open) {
  const std::string name = std::filesystem::path(argv[0]).filename().string();
  if (argc == 2 && (std::string(argv[1]) == "-h" || std::string(argv[1]) == "--help")) {
    std::cout << usage(name);
    return 0;
  }
  try {
    run(parse(argc, argv, source_options), open);
  } catch (const UsageError& error) {
    std::cerr << name << ": " << with_short_words(error.what()) << '\n' << usage(name);
    return 1;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << with_short_words(error.what()) << '\n';
    return 1;
  }
  return 0;
}

}  // namespace trident::slam
