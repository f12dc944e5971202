// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_budget.h"

#include <unistd.h>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr char kElement[] = "trident:max_rays";
constexpr double kMaxRays = 2e7, kMaxAllowed = 1e9;
/// Of directions, hits, what is measured and what is published, at most.
constexpr double kBytesPerRay = 200.0;
constexpr double kGibibyte = 1073741824.0;

double half_of_memory() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

std::string gibibytes(double bytes) {
  char text[32];  // NOLINT: of snprintf
  std::snprintf(text, sizeof(text), "%.1f GiB", bytes / kGibibyte);
  return text;
}

}  // namespace

void check_ray_count(const RayCount& count, const ParamNode& sensor, const std::string& owner) {
  const double most = PluginParams(sensor, owner).number(kElement, kMaxRays, {1.0, kMaxAllowed});
  const std::string asked = owner + ": " + number_text(count.columns) + " x " +
                            number_text(count.rows) + " " + count.what;
  if (!(count.rays() <= most)) {
    throw Error(asked + " are " + number_text(count.rays()) + " rays, must be at most " +
                number_text(most) + " (<" + kElement + "> of the sensor)");
  }
  const double bytes = kBytesPerRay * count.rays();
  if (bytes <= half_of_memory()) return;
  throw Error(asked + " would take " + gibibytes(bytes) + " of memory, must be at most " +
              gibibytes(half_of_memory()) + ", half of this machine's");
}

}  // namespace trident::sim
