// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string>

#include "sdf_convert.h"

namespace trident::sim {

/// A sensor of the link named `link`; `what` names that link in errors. Throws Error for a rate
/// that is negative or not finite.
SensorSpec convert_sensor(const sdf::Sensor& from, const std::string& link, const std::string& what,
                          const ConvertContext& context);

}  // namespace trident::sim
