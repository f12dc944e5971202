// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/pose_graph.h"

namespace trident::slam {
namespace {

constexpr std::array<std::pair<const char*, RobustKernel>, 5> kNames{{
    {"none", RobustKernel::kNone},
    {"huber", RobustKernel::kHuber},
    {"cauchy", RobustKernel::kCauchy},
    {"dcs", RobustKernel::kDcs},
    {"geman_mcclure", RobustKernel::kGemanMcClure},
}};

}  // namespace

RobustKernel robust_kernel_from_name(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& [text, kernel] : kNames) {
    if (text == name) return kernel;
    known.emplace_back(text);
  }
  throw Error("unknown robust kernel " + unknown_name_text(name, known));
}

std::string robust_kernel_name(RobustKernel kernel) {
  for (const auto& [text, known] : kNames) {
    if (known == kernel) return text;
  }
  throw Error("robust kernel " + std::to_string(static_cast<int>(kernel)) + " is unknown");
}

RobustValue evaluate_robust_kernel(RobustKernel kernel, double scale, double squared_error) {
  const double s = squared_error;
  const double c2 = scale * scale;
  switch (kernel) {
    case RobustKernel::kNone:
      break;
    case RobustKernel::kHuber: {
      if (s <= c2) break;
      const double e = std::sqrt(s);
      return {2.0 * scale * e - c2, scale / e};
    }
    case RobustKernel::kCauchy:
      return {c2 * std::log1p(s / c2), c2 / (c2 + s)};
    case RobustKernel::kDcs: {
      if (s <= c2) break;
      const double switched = 2.0 * c2 / (c2 + s);
      return {c2 * (3.0 * s - c2) / (s + c2), switched * switched};
    }
    case RobustKernel::kGemanMcClure: {
      const double kept = c2 / (c2 + s);
      return {s * kept, kept * kept};
    }
  }
  return {s, 1.0};
}

}  // namespace trident::slam
