// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vessel_control_params.h"

#include "trident_base/string_util.h"

namespace trident::control {

void SpeedParams::validate() const {
  if (cruise > max) {
    throw Error("cruise = " + number_text(cruise) + " m/s, legal is at most max, " +
                number_text(max) + " m/s");
  }
}

VesselControlParams load_vessel_control(const std::string& path) {
  return load_yaml<VesselControlParams>(path);
}

}  // namespace trident::control
