// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "probe_options.h"

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

using Setters = std::map<std::string, std::function<void(const std::string&)>>;

Setters setters_of(ProbeOptions& options) {
  const auto text = [](std::string& field) {
    return [&field](const std::string& value) { field = value; };
  };
  const auto number = [](const char* name, double& field, double lo, double hi) {
    return [=, &field](const std::string& value) { field = option_number(name, value, lo, hi); };
  };
  const auto count = [](const char* name, std::uint64_t& field, std::int64_t lo, std::int64_t hi) {
    return [=, &field](const std::string& value) {
      field = static_cast<std::uint64_t>(option_count(name, value, lo, hi));
    };
  };
  return {{"--record", text(options.record)},
          {"--topic", text(options.topic)},
          {"--message", text(options.message)},
          {"--in", text(options.in)},
          {"--out", text(options.out)},
          {"--url", text(options.url)},
          {"--tlog", text(options.tlog)},
          {"--rate", number("--rate", options.rate, 0.0, 1e6)},
          {"--count", count("--count", options.count, 1, 100'000'000)},
          {"--window", count("--window", options.window, 1, 1'000'000)},
          {"--size", count("--size", options.size, 8, 100'000'000)},
          {"--limit_s", number("--limit_s", options.limit_s, 0.0, 1e6)}};
}

}  // namespace

ProbeOptions parse_probe_options(int argc, char** argv) {
  if (argc < 2) throw Error("a part is missing; legal: source, sink, listener, relay, bridge");
  ProbeOptions options;
  options.part = argv[1];
  const Setters setters = setters_of(options);
  for (int i = 2; i < argc; i += 2) {
    const std::string name = argv[i];
    const auto setter = setters.find(name);
    if (setter == setters.end()) {
      std::vector<std::string> known;
      for (const auto& [key, unused] : setters) known.push_back(key);
      throw Error("option " + unknown_name_text(name, known));
    }
    if (i + 1 == argc) throw Error("option " + name + " needs a value");
    setter->second(argv[i + 1]);
  }
  return options;
}

}  // namespace trident::bridges
