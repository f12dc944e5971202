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

}  // namespace

std::string markdown_table(const std::vector<DocumentRow>& rows) {
  std::string table =
      "| key | type | default | legal values | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const DocumentRow& row : rows) {
    table += '|' + cell('`' + row.key + '`') + cell(row.type) + cell(row.default_value) +
             cell(row.legal) + cell(row.doc) + '\n';
  }
  return table;
}

}  // namespace trident::config_detail
