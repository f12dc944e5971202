// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::sim {

/// Static pressure of the standard atmosphere's troposphere [Pa] at a geometric altitude above the
/// sea [m], up to 11 km (U.S. Standard Atmosphere 1976, equations 18 and 33a).
double standard_pressure_pa(double altitude_m);

}  // namespace trident::sim
