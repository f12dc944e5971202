// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// modbus_tool check MAP...            all that is wrong with maps
// modbus_tool print MAP               its values by table and address
// modbus_tool watch WHERE MAP [--seconds S] [--unit N] [--allow-remote]
//                                     a device's values as they change; WHERE is HOST:PORT or a
//                                     serial device
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_bridges/transport/epoll_loop.h"
#include "trident_bridges_ros/modbus/device_watch.h"
#include "trident_bridges_ros/modbus/map_listing.h"
#include "trident_bridges_ros/modbus/message_lookup.h"

namespace trident::bridges::modbus {
namespace {

using Words = std::vector<std::string>;

int check(const Words& files) {
  MessageLookup lookup;
  std::size_t count = 0;
  for (const std::string& file : files) {
    std::vector<ConfigError> errors = errors_of_map(read_config_file(file), file);
    if (errors.empty()) {
      errors = errors_of_topics(
          load_register_map(file),
          [&](const std::string& type) -> const MessageDefinition& { return lookup.get(type); });
    }
    for (const ConfigError& error : errors) std::printf("%s\n", error.what());
    if (errors.empty()) std::printf("%s: no errors\n", file.c_str());
    count += errors.size();
  }
  return count == 0 ? 0 : 1;
}

/// HOST:PORT, or a path.
void set_address(const std::string& where, TransportSpec& transport) {
  const std::size_t colon = where.rfind(':');
  if (where.find('/') != std::string::npos) {
    transport.kind = TransportKind::kRtu;
    transport.device = where;
    return;
  }
  transport.kind = TransportKind::kTcp;
  transport.host = where.substr(0, colon);
  if (colon != std::string::npos) {
    transport.port =
        static_cast<std::uint16_t>(option_count("PORT", where.substr(colon + 1), 1, 65535));
  }
}

struct WatchOptions {
  std::string where, map;
  double seconds = 1e9;
  bool is_once = false;
  int unit = 0;
  bool allow_remote = false;
};

WatchOptions read_watch_options(const Words& words) {
  WatchOptions options;
  Words places;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--seconds" && has_value) {
      options.seconds = option_number("--seconds", words[++i], 0.0, 1e9);
    } else if (words[i] == "--unit" && has_value) {
      options.unit = static_cast<int>(option_count("--unit", words[++i], 1, 247));
    } else if (words[i] == "--once") {
      options.is_once = true;
    } else if (words[i] == "--allow-remote") {
      options.allow_remote = true;
    } else {
      places.push_back(words[i]);
    }
  }
  if (places.size() != 2) throw Error("watch needs HOST:PORT, or a serial device, and MAP.yaml");
  options.where = places[0];
  options.map = places[1];
  return options;
}

int watch(const Words& words) {
  const WatchOptions options = read_watch_options(words);
  RegisterMap map = load_register_map(options.map);
  set_address(options.where, map.spec.transport);
  if (options.unit != 0) map.spec.unit = options.unit;
  EpollLoop loop;
  LinkOptions link;
  link.allow_remote = options.allow_remote;
  DeviceWatch device(map, link, loop, [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  });
  const double end_s = loop.now_s() + options.seconds;
  while (loop.now_s() < end_s && !(options.is_once && device.has_all())) loop.run_once(0.05);
  return options.is_once && !device.has_all() ? 1 : 0;
}

int run(const Words& words) {
  const std::string command = words.empty() ? "" : words[0];
  const Words rest(words.begin() + (words.empty() ? 0 : 1), words.end());
  if (command == "check" && !rest.empty()) return check(rest);
  if (command == "watch") return watch(rest);
  if (command == "print" && rest.size() == 1) {
    std::printf("%s", map_listing(load_register_map(rest[0])).c_str());
    return 0;
  }
  throw Error("legal: check MAP..., print MAP, watch HOST:PORT MAP");
}

}  // namespace
}  // namespace trident::bridges::modbus

int main(int argc, char** argv) {
  try {
    return trident::bridges::modbus::run({argv + 1, argv + argc});
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "modbus: %s\n", error.what());
    return 1;
  }
}
