// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "run_files.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <map>
#include <utility>

#include "trident_base/error.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {
namespace {

/// States at 20 Hz and links at 2 Hz of simulated time: the same rows in every run.
constexpr std::int64_t kRecordPeriodNs = 50'000'000;
constexpr std::int64_t kLinkPeriodNs = 500'000'000;
constexpr const char* kStateColumns = "t,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
constexpr const char* kLinkColumns =
    "t,source,destination,distance,snr_db,mcs,delivered,lost,expired,refused,line_of_sight,"
    "relayed,offered\n";

std::FILE* open_for_writing(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) {
    throw Error("out_dir: '" + path + "' cannot be written: " + std::strerror(errno));
  }
  return file;
}

// The shortest text that reads back as the same number; a sixth of printf's time.
void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr);
}

std::string json_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    // JSON allows no control characters in a string.
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result;
}

/// Whether another run gives the same hash, and if not, who is to blame.
void write_notes(std::FILE* file, const Repeatability& repeatability) {
  const std::vector<Repeatability::Note> notes = repeatability.notes();
  std::fprintf(file, ", \"repeatable\": %s", notes.empty() ? "true" : "false");
  if (notes.empty()) return;
  std::fprintf(file, ", \"not_repeatable_kinds\": %zu, \"not_repeatable\": [",
               repeatability.kinds());
  const char* separator = "";
  for (const Repeatability::Note& note : notes) {
    std::fprintf(file, "%s{\"who\": \"%s\", \"t\": %.9g, \"why\": \"%s\", \"count\": %llu}",
                 separator, json_escaped(note.who).c_str(), note.time.seconds(),
                 json_escaped(note.why).c_str(), static_cast<unsigned long long>(note.count));
    separator = ", ";
  }
  std::fputs("]", file);
}

/// Messages between two robots.
struct Crossing {
  unsigned long long delivered = 0;
  unsigned long long offered = 0;  ///< to that robot alone, without what max_rate leaves out
};

/// How many have crossed by rules, by source and destination.
std::map<std::pair<std::string, std::string>, Crossing> relayed_messages(const World& world) {
  std::map<std::pair<std::string, std::string>, Crossing> result;
  const auto relay = find_relay(world);
  if (relay == nullptr) return result;
  for (const RelayFlow& flow : relay->flows()) {
    Crossing& crossing = result[{flow.source, flow.destination}];
    crossing.delivered += flow.counts.delivered;
    crossing.offered += flow.counts.offered - flow.counts.thinned;
  }
  return result;
}

/// Of a sum over so many.
void write_mean(std::FILE* file, double sum, std::uint64_t count) {
  std::fprintf(file, ", \"delay_mean_s\": %.9g",
               count > 0 ? sum / static_cast<double>(count) : 0.0);
}

/// Counts with their names, and the end of the object.
template <class Counts>
void write_counts(std::FILE* file, const Counts& counts) {
  counts.visit([file](const char* name, std::uint64_t count) {
    std::fprintf(file, ", \"%s\": %llu", name, static_cast<unsigned long long>(count));
  });
  std::fputs("}", file);
}

/// What has crossed by rules.
void write_relay(std::FILE* file, const RelayReport& relay) {
  std::fputs(", \"relay\": [", file);
  const char* separator = "";
  for (const RelayFlow& flow : relay.flows()) {
    std::fprintf(file,
                 "%s{\"rule\": \"%s\", \"reliable\": %s, \"deadline_s\": %.9g, \"source\": \"%s\", "
                 "\"destination\": \"%s\", \"first_s\": %.9g, \"delay_max_s\": %.9g",
                 separator, json_escaped(flow.rule).c_str(), flow.is_reliable ? "true" : "false",
                 flow.deadline_s, json_escaped(flow.source).c_str(),
                 json_escaped(flow.destination).c_str(), std::max(flow.counts.first_s, 0.0),
                 flow.counts.max_delay_s);
    write_mean(file, flow.counts.delay_s, flow.counts.delivered);
    write_counts(file, flow.counts);
    separator = ", ";
  }
  std::fputs("]", file);
}

/// What robots have called by radio.
void write_calls(std::FILE* file, const RelayReport& relay) {
  std::fputs(", \"calls\": [", file);
  const char* separator = "";
  for (const CallFlow& flow : relay.calls()) {
    std::fprintf(file,
                 "%s{\"rule\": \"%s\", \"deadline_s\": %.9g, \"caller\": \"%s\", "
                 "\"server\": \"%s\", \"delay_max_s\": %.9g",
                 separator, json_escaped(flow.rule).c_str(), flow.deadline_s,
                 json_escaped(flow.caller).c_str(), json_escaped(flow.server).c_str(),
                 flow.counts.max_delay_s);
    write_mean(file, flow.counts.delay_s, flow.counts.answered);
    write_counts(file, flow.counts);
    separator = ", ";
  }
  std::fputs("]", file);
}

}  // namespace

RunFiles::RunFiles(const std::string& folder, std::uint64_t seed) : folder_(folder), seed_(seed) {
  last_progress_ = std::chrono::steady_clock::now();
  if (folder_.empty()) return;
  states_ = open_for_writing(folder_ + "/states.csv");
  std::fputs(kStateColumns, states_);
  std::fflush(states_);  // there, whatever becomes of this process
  progress_ = open_for_writing(folder_ + "/progress.jsonl");
}

RunFiles::~RunFiles() {
  for (std::FILE** file : {&states_, &links_, &progress_}) close(file);
}

void RunFiles::close(std::FILE** file) {
  if (*file != nullptr) std::fclose(*file);
  *file = nullptr;
}

void RunFiles::restart() {
  if (states_ == nullptr) return;
  close(&states_);
  close(&links_);
  states_ = open_for_writing(folder_ + "/states.csv");
  std::fputs(kStateColumns, states_);
  std::fflush(states_);  // there, whatever becomes of this process
}

void RunFiles::record(const World& world) {
  if (states_ == nullptr) return;
  if (world.time().ns % kRecordPeriodNs == 0) record_states(world);
  if (world.time().ns % kLinkPeriodNs == 0) record_links(world);
}

void RunFiles::record_links(const World& world) {
  const auto radio = find_radio(world);
  if (radio == nullptr) return;
  if (links_ == nullptr) {
    links_ = open_for_writing(folder_ + "/links.csv");
    std::fputs(kLinkColumns, links_);
  }
  auto relayed = relayed_messages(world);
  for (const RadioLink& link : radio->links()) {
    const Crossing& messages = relayed[{link.source, link.destination}];
    std::fprintf(
        links_, "%.9g,%s,%s,%.9g,%.9g,%d,%llu,%llu,%llu,%llu,%d,%llu,%llu\n",
        world.time().seconds(), link.source.c_str(), link.destination.c_str(), link.distance_m,
        link.snr_db, link.mcs, static_cast<unsigned long long>(link.delivered),
        static_cast<unsigned long long>(link.lost), static_cast<unsigned long long>(link.expired),
        static_cast<unsigned long long>(link.refused), link.has_line_of_sight ? 1 : 0,
        messages.delivered, messages.offered);
  }
}

void RunFiles::record_states(const World& world) {
  for (const auto& [name, model] : world.models()) {
    const Link* link = model->canonical_link();
    if (model->is_static || link == nullptr) continue;
    // Pose and twist of the model's origin, in the world frame.
    const SE3 T = model->T_world_model();
    const Eigen::Vector3d v = link->v_world_at(T.p);
    const Eigen::Vector3d w = link->w_world();
    line_.clear();
    append_number(line_, world.time().seconds());
    line_ += ',' + name;
    for (const double value : {T.p.x(), T.p.y(), T.p.z(), T.R.x(), T.R.y(), T.R.z(), T.R.w(), v.x(),
                               v.y(), v.z(), w.x(), w.y(), w.z()}) {
      line_ += ',';
      append_number(line_, value);
    }
    line_ += '\n';
    std::fwrite(line_.data(), 1, line_.size(), states_);
  }
}

void RunFiles::progress(const World& world, SimTime end, std::size_t vehicles,
                        const std::string& state) {
  if (progress_ == nullptr) return;
  const auto now = std::chrono::steady_clock::now();
  const double wall_s = std::chrono::duration<double>(now - last_progress_).count();
  const double rtf = (world.time() - last_progress_time_).seconds() / std::max(wall_s, 1e-9);
  last_progress_ = now;
  last_progress_time_ = world.time();
  std::fprintf(progress_,
               "{\"sim_s\": %.3f, \"end_s\": %.3f, \"rtf\": %.2f, \"vehicles\": %zu, "
               "\"state\": \"%s\"}\n",
               world.time().seconds(), end.seconds(), rtf, vehicles, json_escaped(state).c_str());
  std::fflush(progress_);
}

void RunFiles::finish(const World& world, const End& end, const Repeatability& repeatability) {
  if (folder_.empty()) return;
  std::FILE* file = open_for_writing(folder_ + "/run.json");
  const double sim_s = end.simulated.seconds();
  std::fprintf(file,
               "{\"state_hash\": \"%s\", \"sim_s\": %.6f, \"wall_s\": %.6f, \"rtf\": %.4f, "
               "\"end_reason\": \"%s\", \"seed\": %llu, \"steps\": %llu, \"step_size_s\": %.9g, "
               "\"odd_elements\": %zu, \"world\": \"%s\"",
               world.state_hash().c_str(), world.time().seconds(), sim_s > 0.0 ? end.wall_s : 0.0,
               sim_s > 0.0 ? sim_s / end.wall_s : 0.0, json_escaped(end.reason).c_str(),
               static_cast<unsigned long long>(seed_),
               static_cast<unsigned long long>(world.step_count()), world.physics().max_step_size_s,
               world.odd_elements().size(), json_escaped(world.name()).c_str());
  if (!end.error.empty())
    std::fprintf(file, ", \"error\": \"%s\"", json_escaped(end.error).c_str());
  if (const auto relay = find_relay(world)) {
    write_relay(file, *relay);
    write_calls(file, *relay);
  }
  write_notes(file, repeatability);
  std::fputs("}\n", file);
  std::fclose(file);
  if (states_ != nullptr) std::fflush(states_);
  if (links_ != nullptr) std::fflush(links_);
}

}  // namespace trident::sim
