// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "principal_moments.h"

#include <Eigen/Eigenvalues>
#include <sstream>

namespace trident::sim {

std::string uneven_moments(const Eigen::Matrix3d& inertia) {
  constexpr double kMaxRatio = 1.5;
  const Eigen::Vector3d moments =  // in ascending order
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (moments[2] <= kMaxRatio * (moments[0] + moments[1])) return "";
  std::ostringstream text;
  text << "principal moments of inertia are " << moments[0] << ", " << moments[1] << " and "
       << moments[2] << " kg m^2; of a body none is larger than the sum of the other two";
  return text.str();
}

}  // namespace trident::sim
