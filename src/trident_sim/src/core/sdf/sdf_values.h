// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <ignition/math/eigen3/Conversions.hh>
#include <initializer_list>
#include <optional>
#include <sdf/sdf.hh>
#include <string>

#include "trident_base/error.h"
#include "trident_base/se3.h"

namespace trident::sim {

// Reading single values out of libsdformat's objects.

inline SE3 to_se3(const ignition::math::Pose3d& pose) {
  return {ignition::math::eigen3::convert(pose.Rot()).normalized(),
          ignition::math::eigen3::convert(pose.Pos())};
}

inline Eigen::Vector3d to_eigen(const ignition::math::Vector3d& v) {
  return ignition::math::eigen3::convert(v);
}

/// The pose in `frame`; throws Error with `what`.
inline SE3 resolve(const sdf::SemanticPose& pose, const std::string& frame,
                   const std::string& what) {
  ignition::math::Pose3d result;
  const sdf::Errors errors = pose.Resolve(result, frame);
  if (!errors.empty()) throw Error(what + ": " + errors.front().Message());
  if (!(result.Pos().Length() <= 1e9)) {
    throw Error(what + ": <pose> is " + std::to_string(result.Pos().Length()) +
                " m away, must be within 1e9 m");
  }
  return to_se3(result);
}

/// The element at the end of a path of first children, or nullptr.
inline sdf::ElementPtr descend(sdf::ElementPtr element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    if (!element || !element->HasElement(name)) return nullptr;
    element = element->GetElement(name);
  }
  return element;
}

template <class T>
T value_or(const sdf::ElementPtr& root, std::initializer_list<const char*> path, T fallback) {
  const sdf::ElementPtr element = descend(root, path);
  return element ? element->Get<T>() : fallback;
}

/// Throws Error with `what` for one that is not finite.
inline std::optional<double> number_if_given(const sdf::ElementPtr& element, const char* name,
                                             const std::string& what) {
  if (!element->HasElement(name)) return std::nullopt;
  const double value = element->Get<double>(name);
  if (std::isfinite(value)) return value;
  throw Error(what + ": <" + name + "> is " + std::to_string(value) + ", must be a finite number");
}

}  // namespace trident::sim
