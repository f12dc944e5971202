// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string>

#include "sdf_convert.h"
#include "trident_base/se3.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

/// The joint in the frame of the outermost model, its links named with `prefix`. Throws Error that
/// names joint, field, value and what is legal.
JointSpec convert_joint(const sdf::Joint& from, const std::string& prefix, const SE3& T_root_model,
                        const ConvertContext& context);

}  // namespace trident::sim
