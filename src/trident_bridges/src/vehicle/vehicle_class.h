// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_bridges/autopilot/vehicle.h"
#include "trident_bridges/mavlink/vehicles.h"

namespace trident::bridges::mavlink {

/// The autopilot's own names.
inline Flavor flavor_of(AutopilotFlavour flavour) {
  return flavour == AutopilotFlavour::kPx4 ? Flavor::kPx4 : Flavor::kArduPilot;
}

/// What moves a vehicle of that kind, as its autopilot sees it.
inline VehicleClass class_of(VehicleKind kind) {
  if (kind == VehicleKind::kRover) return VehicleClass::kGround;
  return kind == VehicleKind::kBoat ? VehicleClass::kVessel : VehicleClass::kMultirotor;
}

}  // namespace trident::bridges::mavlink
