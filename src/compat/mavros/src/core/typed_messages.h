// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Payloads of messages as structs; for sources alone, as dialect.h is.
#pragma once

#include <string>
#include <utility>

#include "core/vehicle_side.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::mavros {

/// Calls `handler` with the payload of each message of that struct's type.
template <class Payload, class Handler>
void on(VehicleSide& vehicle, Handler handler) {
  vehicle.on(bridges::mavlink::PayloadTraits<Payload>::kId,
             [handler = std::move(handler)](const Message& message) {
               handler(bridges::mavlink::unpack<Payload>(message));
             });
}

/// Sends a payload as a message of this node.
template <class Payload>
void send(VehicleSide& vehicle, const Payload& payload) {
  vehicle.send(bridges::mavlink::pack(payload, vehicle.self()));
}

/// Sends a payload that has a target: the vehicle.
template <class Payload>
void send_to_target(VehicleSide& vehicle, Payload payload) {
  payload.target_system = vehicle.target().system;
  payload.target_component = vehicle.target().component;
  send(vehicle, payload);
}

/// Text of a field of characters, which ends at its first zero or with the field.
template <std::size_t kSize>
std::string text_of(const char (&field)[kSize]) {  // NOLINT: as the generator makes them
  std::size_t length = 0;
  while (length < kSize && field[length] != '\0') ++length;
  return std::string(field, length);
}

}  // namespace trident::mavros
