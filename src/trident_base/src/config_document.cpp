// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/config_document.h"

namespace trident::config_detail {
namespace {

// A bar would end the cell, a line break the table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') {
      result += "\\|";
    } else {
      result += c == '\n' ? ' ' : c;
    }
  }
  return ' ' + result + " |";
}

// A cell is no paragraph: of many choices the first ones stand for all; an error lists them.
std::string shortened(const std::string& legal) {
  constexpr std::size_t kLongest = 120;
  const std::string more = ", ...";
  if (legal.size() <= kLongest) return legal;
  return legal.substr(0, legal.rfind(", ", kLongest - more.size())) + more;
}

}  // namespace

std::string markdown_table(const std::vector<DocumentRow>& rows) {
  std::string table =
      "| key | type | default | legal values | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const DocumentRow& row : rows) {
    table += '|' + cell('`' + row.key + '`') + cell(row.type) + cell(row.default_value) +
             cell(shortened(row.legal)) + cell(row.doc) + '\n';
  }
  return table;
}

}  // namespace trident::config_detail
