// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::slam {

/// The value that a chi-squared variable of `degrees` >= 1 degrees of freedom stays below with a
/// probability in (0, 1), to about 14 digits. Throws Error for what is outside.
double chi_squared_quantile(double probability, int degrees);

}  // namespace trident::slam
