// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/device_watch.h"

#include <cstdio>

namespace trident::bridges::modbus {
namespace {

/// "12.345 s  "
std::string time_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%10.3f s  ", seconds);
  return text;
}

std::string value_line(const RegisterEntry& entry, const Value& value) {
  std::string text = entry.name + " = " + value_to_text(value);
  const ValueType& type = entry.layout.type;
  if (type.kind == ValueKind::kBits) {
    const auto word = static_cast<std::uint64_t>(as_double(value.numbers.at(0)));
    for (std::size_t bit = 0; bit < type.bits.size(); ++bit) {
      if (((word >> bit) & 1U) != 0) text += " " + type.bits[bit];
    }
  }
  return text + (entry.unit.empty() ? "" : " " + entry.unit);
}

}  // namespace

DeviceWatch::DeviceWatch(const RegisterMap& map, const LinkOptions& options, PollLoop& loop,
                         std::function<void(const std::string& line)> print)
    : loop_(loop),
      print_(std::move(print)),
      begin_s_(loop.now_s()),
      blocks_(read_blocks(map).size()),
      client_(map, map.spec.transport.kind == TransportKind::kTcp,
              {[this](std::size_t entry, const Value& value) {
                 print_(time_text(loop_.now_s() - begin_s_) +
                        value_line(client_.map().entries[entry], value));
               },
               [this](const std::string& kind, const std::string& text) {
                 print_(time_text(loop_.now_s() - begin_s_) + kind + ": " + text);
               },
               [this](bool answers) {
                 print_(time_text(loop_.now_s() - begin_s_) + "unit " +
                        std::to_string(client_.map().spec.unit) +
                        (answers ? " answers" : " does not answer"));
               }}),
      device_(client_, loop),
      link_(map.spec.transport, Role::kClient, options, loop,
            {[this](const LinkFrame& frame) { device_.receive(frame); },
             [this](PeerId peer) { device_.open(link_, peer); },
             [this](PeerId) { device_.close(); },
             [this](const std::string&, const std::string& text) { print_(text); },
             [this](const std::string& text) { print_(text); },
             {}}) {
  poll();
}

DeviceWatch::~DeviceWatch() { loop_.cancel(poll_call_); }

void DeviceWatch::poll() {
  poll_call_ = loop_.call_after(1.0 / client_.map().spec.poll, [this] { poll(); });
  device_.poll();
}

}  // namespace trident::bridges::modbus
