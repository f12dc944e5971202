// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::sim {

/// Blanks an element `<name …>` that begins in a line (from 1) of well-formed XML, with all that is
/// in it, after `skipped` of that name in that line; the lines keep their numbers. Returns what was
/// there, "" without such an element.
std::string cut_element(std::string& xml, int line, const std::string& name, int skipped = 0);

/// Blanks XML declarations that something stands before, such as a licence: tinyxml2 refuses what
/// the parser of older Gazebos took.
void blank_late_declarations(std::string& xml);

}  // namespace trident::sim
