// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nmea_replay FILE [URL [SPEED]]: sends the sentences of a recording, in which binary messages may
// stand, too, at the times in it. URL: of an endpoint, default tcp-l://:10110; a server, a serial
// line or a pseudo-terminal waits for somebody to be there. SPEED: 2 is twice as fast, 0 as fast as
// the peer takes it; default 1.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_base/regular_file.h"
#include "trident_bridges/nmea/receive/replay_pacer.h"
#include "trident_bridges/nmea/sentence_framer.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"

namespace trident::bridges {
namespace {

constexpr double kLingerS = 1.0;  ///< after the last sentence, for what a slow line still holds

/// A sentence and when it was sent.
struct Timed {
  double due_s = 0.0;
  std::string text;
};

/// Keeps the sentences of a recording.
struct Recording : nmea::SentenceSink {
  void on_sentence(const nmea::Sentence& sentence) override {
    constexpr const char* kDigits = "0123456789ABCDEF";
    const unsigned sum = nmea::checksum_of(sentence.text().substr(1));
    std::string text(sentence.text());
    text += {'*', kDigits[sum / 16], kDigits[sum % 16], '\r', '\n'};
    sentences.push_back({pacer.due_s(sentence), std::move(text)});
  }
  void on_refusal(const nmea::Refusal&, std::string_view) override { ++refused; }

  nmea::ReplayPacer pacer;
  std::vector<Timed> sentences;
  std::size_t refused = 0;
};

Recording read_recording(const std::string& path) {
  check_no_device(path, "a recording");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path + ": cannot be read, legal: a recording with sentences");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  nmea::FramerParams params;
  params.max_length = nmea::SentenceFramer::kMaxLength;
  nmea::SentenceFramer framer(params);
  Recording recording;
  framer.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, recording);
  std::fprintf(stderr, "%s: %zu sentences, %zu refused, %llu bytes of other things\n", path.c_str(),
               recording.sentences.size(), recording.refused,
               static_cast<unsigned long long>(framer.counts().skipped));
  if (recording.sentences.empty()) {
    throw Error(path + ": has no sentence with a right checksum, legal: a recording with some");
  }
  return recording;
}

EndpointOptions options_of(const std::string& url) {
  EndpointOptions options;
  options.url = url;
  options.default_port = options.default_bind_port = 10110;
  options.default_baud = 4800;
  return options;
}

void replay(const Recording& recording, const std::string& url, double speed) {
  EpollLoop loop;
  EndpointEvents events;
  bool is_heard = false;
  events.joined = [&](PeerId, const std::string& address) {
    std::fprintf(stderr, "%s is there\n", address.c_str());
    is_heard = true;
  };
  events.warning = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
  const auto endpoint = open_endpoint(options_of(url), loop, std::move(events));
  std::fprintf(stderr, "%s\n", endpoint->name().c_str());
  while (!is_heard) loop.run_once(1.0);
  const double begin_s = loop.now_s();
  for (const Timed& timed : recording.sentences) {
    const double due_s = speed > 0.0 ? begin_s + timed.due_s / speed : begin_s;
    do {
      loop.run_once(std::max(0.0, due_s - loop.now_s()));
    } while (loop.now_s() < due_s);
    const auto* const data = reinterpret_cast<const std::uint8_t*>(timed.text.data());
    endpoint->send_to_all({data, timed.text.size()});
  }
  const double end_s = loop.now_s() + kLingerS;
  while (loop.now_s() < end_s) loop.run_once(end_s - loop.now_s());
  const EndpointCounts counts = endpoint->counts();
  std::fprintf(stderr, "%llu bytes sent, %llu sentences cut\n",
               static_cast<unsigned long long>(counts.sent_bytes),
               static_cast<unsigned long long>(counts.cut));
}

}  // namespace
}  // namespace trident::bridges

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.size() > 3) {
    std::fprintf(stderr, "usage: nmea_replay FILE [URL [SPEED]]\n");
    return 2;
  }
  try {
    const std::string url = words.size() > 1 ? words[1] : "tcp-l://:10110";
    const double speed =
        words.size() > 2 ? trident::option_number("SPEED", words[2], 0.0, 1e6) : 1.0;
    trident::bridges::replay(trident::bridges::read_recording(words[0]), url, speed);
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "nmea_replay: %s\n", error.what());
    return 1;
  }
  return 0;
}
