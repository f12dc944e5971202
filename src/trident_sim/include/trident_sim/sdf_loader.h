// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "trident_sim/model_spec.h"
#include "trident_sim/resources.h"

namespace trident::sim {

/// Receives one line per thing a user should know but that does not stop the load.
using WarningSink = std::function<void(const std::string&)>;

/// Reads SDF 1.4 to 1.9 worlds. Throws Error naming file and line or element; with
/// OddElements::kLeaveOut only where nothing is left to load. All loads of a process may be called
/// from any thread, but go one at a time.
WorldSpec load_world_file(const std::string& path, const Resources& resources,
                          const WarningSink& warn, OddElements odd = OddElements::kRefuse);
/// The same of a text; `label` names it in errors, and relative paths are looked for as Resources
/// does without a base folder.
WorldSpec load_world_string(const std::string& xml, const std::string& label,
                            const Resources& resources, const WarningSink& warn,
                            OddElements odd = OddElements::kRefuse);

/// Reads the one model of an SDF or URDF text (`<sdf>`, `<model>` or `<robot>`). `label` names
/// the source in errors.
ModelSpec load_model_string(const std::string& xml, const std::string& label,
                            const Resources& resources, const WarningSink& warn,
                            OddElements odd = OddElements::kRefuse);

}  // namespace trident::sim
