// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "xml_cut.h"

#include <algorithm>
#include <cstring>

namespace trident::sim {
namespace {

constexpr auto kNone = std::string::npos;

std::size_t behind(const std::string& xml, std::size_t from, const char* what) {
  const std::size_t at = xml.find(what, from);
  return at == kNone ? xml.size() : at + std::strlen(what);
}

/// The end of the tag that begins at `begin`: attributes may hold a '>'.
std::size_t tag_end(const std::string& xml, std::size_t begin) {
  char quote = 0;
  for (std::size_t i = begin; i < xml.size(); ++i) {
    const char c = xml[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return xml.size();
}

/// Where markup that is no element ends, or `begin` for a tag of an element.
std::size_t skip_other_markup(const std::string& xml, std::size_t begin) {
  if (xml.compare(begin, 4, "<!--") == 0) return behind(xml, begin, "-->");
  if (xml.compare(begin, 9, "<![CDATA[") == 0) return behind(xml, begin, "]]>");
  if (xml.compare(begin, 2, "<?") == 0) return behind(xml, begin, "?>");
  if (xml.compare(begin, 2, "<!") == 0) return tag_end(xml, begin);
  return begin;
}

/// Behind the element whose start tag begins at `begin`.
std::size_t element_end(const std::string& xml, std::size_t begin) {
  int depth = 0;
  for (std::size_t at = begin; at < xml.size();) {
    if (const std::size_t next = skip_other_markup(xml, at); next != at) {
      at = xml.find('<', next);
      continue;
    }
    const std::size_t end = tag_end(xml, at);
    if (xml[at + 1] == '/') {
      --depth;
    } else if (xml[end - 2] != '/') {
      ++depth;
    }
    if (depth <= 0) return end;
    at = xml.find('<', end);
  }
  return xml.size();
}

bool is_start_of(const std::string& xml, std::size_t at, const std::string& name) {
  if (xml.compare(at + 1, name.size(), name) != 0) return false;
  const std::size_t next = at + 1 + name.size();
  return next < xml.size() && std::strchr(" \t\r\n/>", xml[next]) != nullptr;
}

}  // namespace

void blank_late_declarations(std::string& xml) {
  const std::size_t first = xml.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  for (std::size_t at = xml.find("<?xml "); at != std::string::npos;
       at = xml.find("<?xml ", at + 1)) {
    if (at <= first) continue;
    const std::size_t end = std::min(xml.size(), behind(xml, at, "?>"));
    std::replace_if(
        xml.begin() + static_cast<std::ptrdiff_t>(at),
        xml.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c != '\n'; }, ' ');
  }
}

std::string cut_element(std::string& xml, int line, const std::string& name, int skipped) {
  std::size_t counted = 0;
  int here = 1;
  for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    here += static_cast<int>(std::count(xml.begin() + static_cast<std::ptrdiff_t>(counted),
                                        xml.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    counted = at;
    if (here > line) break;
    if (const std::size_t next = skip_other_markup(xml, at); next != at) {
      at = next;
      continue;
    }
    if (here < line || !is_start_of(xml, at, name) || skipped-- > 0) {
      ++at;
      continue;
    }
    const std::size_t end = element_end(xml, at);
    std::string cut = xml.substr(at, end - at);
    // Line breaks stay, so that what is read later has its own line numbers.
    std::replace_if(
        xml.begin() + static_cast<std::ptrdiff_t>(at),
        xml.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c != '\n'; }, ' ');
    return cut;
  }
  return "";
}

}  // namespace trident::sim
