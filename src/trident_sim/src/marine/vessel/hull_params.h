// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::sim {

/// kPower: breadth(h) = breadth (h / draft)^exponent at the height h above the keel, wall-sided
/// above the design waterline; exponent 0 is a box, 0.5 a parabola, 1 a V. kCircle: a lying half
/// cylinder of diameter `breadth`, wall-sided above its axis.
enum class SectionShape { kPower, kCircle };
constexpr auto enum_names(SectionShape) {
  return std::array{EnumName{SectionShape::kPower, "power"},
                    EnumName{SectionShape::kCircle, "circle"}};
}

/// A slice of a hull between x - length / 2 and x + length / 2.
struct HullSection {
  double x = 0.0;
  double length = 0.0;
  double breadth = 0.0;
  double draft = 0.0;
  SectionShape shape = SectionShape::kPower;
  double exponent = 0.0;
  double freeboard = 0.5;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("x", x, "its middle, from CO [m]");
    ar.required("length", length, Range::positive(), "along x [m]");
    ar.required("breadth", breadth, Range::positive(),
                "of one hull at the design waterline; shape circle: its diameter [m]");
    ar.required("draft", draft, Range::positive(),
                "keel below the design waterline, CO's plane [m]");
    ar.field("shape", shape, "of the section");
    ar.field("exponent", exponent, Range{0.0, 4.0}, "of the shape power");
    ar.field("freeboard", freeboard, Range::non_negative(), "deck above the design waterline [m]");
  }
};

/// One hull, or several equal ones side by side. Empty: nothing floats.
struct HullParams {
  std::vector<double> offsets = {0.0};
  std::vector<HullSection> sections;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("offsets", offsets, "y of each hull's centreplane [m]");
    ar.field("sections", sections, "of one hull");
  }
};

}  // namespace trident::sim
