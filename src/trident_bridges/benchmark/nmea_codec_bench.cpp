// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nmea_codec_bench [SECONDS]: how many sentences one core frames and reads, and how many it writes,
// by CPU time. The mix is what a boat sends: GGA, RMC, VTG, GLL, ZDA, GSA, GSV, GST, HDT, ROT, XDR,
// VHW, DPT, MWV.
#include <ctime>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "trident_bridges/nmea/receive/receiver.h"
#include "trident_bridges/nmea/send/gnss_talker.h"
#include "trident_bridges/nmea/send/instrument_talker.h"
#include "trident_bridges/nmea/sentence_framer.h"

namespace trident::bridges::nmea {
namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Keeps what a boat sends, or counts it.
struct Recorder : TalkerSink {
  void on_sentence(std::string_view sentence, SimTime) override {
    ++count;
    bytes += sentence.size();
    if (keeps) stream += sentence;
  }
  void on_problem(std::string_view, const Refusal&) override { ++problems; }

  bool keeps = true;
  std::string stream;
  std::size_t count = 0, bytes = 0, problems = 0;
};

/// A boat's instruments, 5 times a second.
void sail(int first, int last, GnssTalker& gnss, InstrumentTalker& instruments) {
  for (int i = first; i < last; ++i) {
    GnssEpoch epoch;
    epoch.stamp = SimTime::from_seconds(0.2 * i);
    epoch.fix = GnssEpoch::Fix::kFixed;
    epoch.latitude_deg = 63.4389 + 1e-6 * i;
    epoch.longitude_deg = 10.399 - 1e-6 * i;
    epoch.altitude_m = 41.0;
    epoch.horizontal_stddev_m = 0.01;
    epoch.vertical_stddev_m = 0.02;
    epoch.satellites = 12;
    epoch.geoid_separation_m = 39.5;
    gnss.set_velocity({1.5, 0.5});
    instruments.set_ground_velocity({1.5, 0.5});
    gnss.on_epoch(epoch);
    instruments.on_attitude(epoch.stamp, {0.001 * i, 0.05, -0.02, 0.01});
    instruments.on_water_velocity(epoch.stamp, {1.6, 0.0});
    instruments.on_depth(epoch.stamp, {4.5, {}, 100.0});
    instruments.on_wind(epoch.stamp, {false, 5.0, 1.0});
  }
}

/// Reads everything and uses the fixes.
struct Reader : SentenceSink, ReceiverSink, ProblemSink {
  void on_sentence(const Sentence& sentence) override { receiver.read(sentence, {}); }
  void on_refusal(const Refusal&, std::string_view) override { ++problems; }
  void on_problem(const Refusal&, const Sentence&) override { ++problems; }
  void on_fix(const NavsatFix& fix) override { sum += fix.latitude_deg; }

  SentenceFramer framer;
  Receiver receiver{ReceiverParams{}, *this, *this};
  double sum = 0.0;
  std::size_t problems = 0;
};

void report(const char* what, std::size_t sentences, std::size_t bytes, double seconds) {
  std::printf("%-8s %10.0f sentences/s  %8.1f Mbit/s  %6.1f ns/sentence\n", what,
              static_cast<double>(sentences) / seconds, 8e-6 * static_cast<double>(bytes) / seconds,
              1e9 * seconds / static_cast<double>(sentences));
}

int main_of(double seconds) {
  Recorder recorder;
  SentenceSender sender(TalkerParams{}, recorder);
  GnssTalker gnss(sender, UtcClock());
  InstrumentTalker instruments(sender);
  sail(0, 1'000, gnss, instruments);
  const std::size_t in_stream = recorder.count;

  Reader reader;
  const Span<const std::uint8_t> bytes(
      reinterpret_cast<const std::uint8_t*>(recorder.stream.data()), recorder.stream.size());
  std::size_t rounds = 0;
  double begin = cpu_s(), now = begin;
  for (; now - begin < seconds; ++rounds, now = cpu_s()) reader.framer.feed(bytes, reader);
  report("read", rounds * in_stream, rounds * bytes.size(), now - begin);

  recorder.keeps = false;
  recorder.count = recorder.bytes = 0;
  begin = cpu_s();
  now = begin;
  for (int i = 1'000; now - begin < seconds; i += 1'000, now = cpu_s()) {
    sail(i, i + 1'000, gnss, instruments);
  }
  report("write", recorder.count, recorder.bytes, now - begin);
  if (reader.problems + recorder.problems > 0 || reader.sum == 0.0) {
    std::fprintf(stderr, "%zu problems\n", reader.problems + recorder.problems);
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace trident::bridges::nmea

int main(int argc, char** argv) {
  return trident::bridges::nmea::main_of(argc > 1 ? std::atof(argv[1]) : 2.0);
}
