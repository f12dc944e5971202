// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string>
#include <vector>

namespace trident::sim {

class SdfSources;

/// Blanks the elements of an SDF text that libsdformat cannot read, included files aside, and lists
/// each of them in `odd`. Throws Error when that leaves nothing to read, or takes more than a
/// hundred.
void leave_out_unreadable(std::string& text, const std::string& label,
                          std::vector<std::string>& odd);

/// Gives models, links, joints and their parts that share a name with one before them in the same
/// parent a name of their own, and takes models without any link out of a world: one of them would
/// make libsdformat drop more. A model that has none because its include is left out is not
/// reported.
void repair_elements(const sdf::ElementPtr& root, const SdfSources& sources,
                     std::vector<std::string>& odd);

}  // namespace trident::sim
