// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// slam_live LOG --nodes N --rate HZ --seconds S --out DIR [--repeat K]: how long do scans wait
// while a large graph is optimised? Builds a graph of N nodes as fast as possible, writes it as a
// session, continues it in real time while an optimisation of the whole graph is always running,
// and prints what it measured as JSON. With --repeat it feeds the whole log, each scan K times, and
// reports the memory.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <future>
#include <iostream>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_base/shown_text.h"
#include "trident_slam/carmen_log.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/low_priority.h"

namespace trident::slam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kUsage[] =
    "usage: slam_live LOG --out DIR [--nodes N] [--rate HZ] [--seconds S] [--repeat K]\n";
constexpr double kMapPeriodS = 5.0;       // between maps
constexpr double kAutosavePeriodS = 5.0;  // between sessions

struct Command {
  std::string log;
  std::string out;
  int nodes = 5000;
  double rate = 20.0;
  double seconds = 60.0;
  int repeat = 0;
};

constexpr int kMaxCount = 1000000000;
constexpr double kMaxSeconds = 1e6;
constexpr double kMaxRateHz = 1e4;

int count(const std::string& option, const std::string& text, int low) {
  return static_cast<int>(option_count(option, text, low, kMaxCount));
}

Command parse(const std::vector<std::string>& words) {
  Command command;
  const std::map<std::string, std::function<void(const std::string&)>> options = {
      {"--out", [&](const std::string& text) { command.out = text; }},
      {"--nodes", [&](const std::string& text) { command.nodes = count("--nodes", text, 2); }},
      {"--rate",
       [&](const std::string& text) {
         command.rate = option_number("--rate", text, 0.1, kMaxRateHz);
       }},
      {"--seconds",
       [&](const std::string& text) {
         command.seconds = option_number("--seconds", text, 0.0, kMaxSeconds);
       }},
      {"--repeat", [&](const std::string& text) { command.repeat = count("--repeat", text, 0); }}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto option = options.find(words[i]);
    if (option == options.end()) {
      command.log = words[i];
    } else if (i + 1 == words.size()) {
      throw Error("option " + words[i] + " needs a value; " + kUsage);
    } else {
      option->second(words[++i]);
    }
  }
  if (command.log.empty() || command.out.empty()) throw Error(kUsage);
  return command;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Memory of this process now [MB].
double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  double resident = 0.0;
  file >> pages >> resident;
  return resident * 4096.0 / 1e6;
}

/// Longest and other waits of a kind [ms].
class Waits {
 public:
  void add(double seconds) { values_.push_back(1e3 * seconds); }
  double at(double part) {
    if (values_.empty()) return 0.0;
    std::sort(values_.begin(), values_.end());
    return values_[static_cast<std::size_t>(part * static_cast<double>(values_.size() - 1))];
  }
  std::string json() {
    char text[160];
    std::snprintf(text, sizeof(text),
                  "{\"count\": %zu, \"median_ms\": %.2f, \"p99_ms\": %.2f, \"max_ms\": %.2f}",
                  values_.size(), at(0.5), at(0.99), at(1.0));
    return text;
  }

 private:
  std::vector<double> values_;
};

/// Work that is begun every so often from a snapshot, and how long both take.
class Periodic {
 public:
  explicit Periodic(double period_s) : period_s_(period_s) {}

  void begin_if_due(double now_s, const std::function<std::function<void()>()>& snapshot) {
    const bool is_busy =
        running_.valid() && running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    if (now_s < next_s_ || is_busy) return;
    if (running_.valid()) works.add(running_.get());
    next_s_ = now_s + period_s_;
    const Clock::time_point begin = Clock::now();
    std::function<void()> work = snapshot();
    snapshots.add(seconds_since(begin));
    running_ = std::async(std::launch::async, [work = std::move(work)] {
      lower_priority_of_this_thread();
      const Clock::time_point start = Clock::now();
      work();
      return seconds_since(start);
    });
  }
  void end() {
    if (running_.valid()) works.add(running_.get());
  }

  Waits snapshots;
  Waits works;

 private:
  double period_s_;
  double next_s_ = 0.0;
  std::future<double> running_;
};

/// Reads scans until the graph has so many nodes. Returns the scans that were read.
std::size_t build(CarmenLog& log, int nodes, GraphSlam2d& slam, Waits& waits) {
  ScanRecord record;
  std::size_t scans = 0;
  while (slam.nodes() < nodes) {
    if (!log.next(record)) {
      throw Error("the log ends with " + std::to_string(slam.nodes()) +
                  " nodes, needed: " + std::to_string(nodes));
    }
    const Clock::time_point begin = Clock::now();
    slam.add_scan(record.scan, record.T_odom_base);
    waits.add(seconds_since(begin));
    ++scans;
  }
  return scans;
}

struct Live {
  Waits waits;  ///< from a scan's arrival until its pose, or a newer one's, is known
  std::size_t replaced = 0;
  std::size_t realigned = 0;
  SE2 T_map_base;  ///< of the last scan
  Periodic maps{kMapPeriodS};
  Periodic autosaves{kAutosavePeriodS};
};

/// Scans arrive at `rate`; the newest is used, as in the asynchronous node.
void run_live(CarmenLog& log, const Command& command, GraphSlam2d& slam, Live& live) {
  std::vector<ScanRecord> records;
  for (ScanRecord record;
       static_cast<double>(records.size()) < command.seconds * command.rate && log.next(record);) {
    records.push_back(record);
  }
  const Clock::time_point begin = Clock::now();
  bool was_busy = false;
  for (std::size_t next = 0; next < records.size();) {
    const auto arrival_s = [&](std::size_t i) { return static_cast<double>(i) / command.rate; };
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(arrival_s(next))));
    const auto arrived = static_cast<std::size_t>(seconds_since(begin) * command.rate);
    const std::size_t newest = std::clamp(arrived, next, records.size() - 1);
    live.T_map_base = slam.add_scan(records[newest].scan, records[newest].T_odom_base).T_map_base;
    const double now_s = seconds_since(begin);
    live.replaced += newest - next;
    for (; next <= newest; ++next) live.waits.add(now_s - arrival_s(next));
    if (was_busy && !slam.is_busy()) ++live.realigned;
    if (!slam.is_busy()) slam.realign();
    was_busy = slam.is_busy();
    live.maps.begin_if_due(now_s, [&slam] { return [draw = slam.map_snapshot()] { draw(); }; });
    live.autosaves.begin_if_due(now_s, [&slam, &command] {
      return [write = slam.session_snapshot(), file = command.out + "/autosave.posegraph"] {
        write(file);
      };
    });
  }
  live.maps.end();
  live.autosaves.end();
}

void measure_waits(const Command& command) {
  CarmenLog log(command.log);
  GraphSlamOptions options;
  options.keep_scans = false;
  const std::string session = command.out + "/built.posegraph";
  Waits building;
  std::size_t scans = 0;
  {
    GraphSlam2d slam(options);
    scans = build(log, command.nodes, slam, building);
    slam.save_session(session);
  }
  options.is_asynchronous = true;
  GraphSlam2d slam(options);
  const Clock::time_point begin = Clock::now();
  slam.load_session(session);
  const double load_s = seconds_since(begin);
  const int loops = slam.loops_closed();
  Live live;
  const double idle_mb = resident_mb();
  run_live(log, command, slam, live);
  std::printf(
      "{\"nodes\": %d, \"edges\": %zu, \"scans_built\": %zu, \"scan_ms_built\": %s, "
      "\"load_s\": %.2f, \"rate_hz\": %g, \"wait\": %s, \"replaced\": %zu, "
      "\"realigned\": %zu, \"loops_before\": %d, \"loops_after\": %d, "
      "\"map_snapshot\": %s, \"map\": %s, \"session_snapshot\": %s, \"session\": %s, "
      "\"last_x_y_yaw\": [%.4f, %.4f, %.5f], "
      "\"rss_idle_mb\": %.1f, \"rss_live_mb\": %.1f}\n",
      slam.nodes(), slam.graph_view().edges.size(), scans, building.json().c_str(), load_s,
      command.rate, live.waits.json().c_str(), live.replaced, live.realigned, loops,
      slam.loops_closed(), live.maps.snapshots.json().c_str(), live.maps.works.json().c_str(),
      live.autosaves.snapshots.json().c_str(), live.autosaves.works.json().c_str(),
      live.T_map_base.p.x(), live.T_map_base.p.y(), live.T_map_base.angle, idle_mb, resident_mb());
}

void measure_memory(const Command& command) {
  GraphSlamOptions options;
  options.keep_scans = false;
  GraphSlam2d slam(options);
  CarmenLog log(command.log);
  std::size_t scans = 0;
  const double before_mb = resident_mb();
  for (ScanRecord record; log.next(record);) {
    for (int i = 0; i < command.repeat; ++i) slam.add_scan(record.scan, record.T_odom_base);
    scans += static_cast<std::size_t>(command.repeat);
  }
  std::printf("{\"scans\": %zu, \"nodes\": %d, \"rss_before_mb\": %.1f, \"rss_after_mb\": %.1f}\n",
              scans, slam.nodes(), before_mb, resident_mb());
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  try {
    const trident::slam::Command command = trident::slam::parse({argv + 1, argv + argc});
    command.repeat > 0 ? trident::slam::measure_memory(command)
                       : trident::slam::measure_waits(command);
  } catch (const std::exception& error) {
    std::cerr << "slam_live: " << trident::with_short_words(error.what()) << '\n';
    return 1;
  }
  return 0;
}
