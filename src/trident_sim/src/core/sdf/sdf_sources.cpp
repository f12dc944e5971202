// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_sources.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sdf/sdf.hh>

#include "sdf_repair.h"
#include "trident_base/error.h"
#include "xml_cut.h"

namespace trident::sim {
namespace fs = std::filesystem;
namespace {

using tinyxml2::XMLElement;

/// Followed by the name of a copy.
constexpr char kCopyUri[] = "model://trident_sdf_copy";
constexpr char kNotFound[] = " not found; searched: ";

std::string uri_of(const XMLElement& include) {
  const XMLElement* const uri = include.FirstChildElement("uri");
  const char* const text = uri == nullptr ? nullptr : uri->GetText();
  return text == nullptr ? "" : text;
}

/// Not by a tag alone: plugins have a <robotNamespace>.
bool is_urdf(const std::string& text) {
  tinyxml2::XMLDocument document;
  document.Parse(text.c_str(), text.size());
  const XMLElement* const root = document.RootElement();
  return root != nullptr && root->Name() == std::string("robot");
}

/// Replaces what stands alone between two tags.
void replace_content(std::string& text, const std::string& content, const std::string& by) {
  constexpr char kBlank[] = " \t\r\n";
  for (auto at = text.find(content); at != std::string::npos; at = text.find(content, at)) {
    const auto before = at == 0 ? std::string::npos : text.find_last_not_of(kBlank, at - 1);
    const auto behind = text.find_first_not_of(kBlank, at + content.size());
    const bool is_alone = before != std::string::npos && behind != std::string::npos &&
                          text[before] == '>' && text[behind] == '<';
    if (is_alone) text.replace(at, content.size(), by);
    at += is_alone ? by.size() : content.size();
  }
}

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace

/// Includes are followed before libsdformat sees the text: a file that includes itself, or expands
/// to too much, is refused by name.
SdfSources::SdfSources(std::string text, const std::string& label, Find find, std::string searched,
                       OddList& odd, const WarningSink& warn)
    : text_(std::move(text)),
      label_(label),
      find_(std::move(find)),
      searched_(std::move(searched)),
      odd_(odd),
      warn_(warn) {
  const Size size = visit(text_, label_, 0);
  if (size.elements > limits_.elements || size.bytes > limits_.bytes) {
    throw Error(label_ + ": it has " + number(size.elements) + " elements in " +
                number(size.bytes) + " bytes, legal: at most " + number(limits_.elements) +
                " and " + number(limits_.bytes));
  }
}

SdfSources::~SdfSources() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

/// Once per URI: a search goes over all folders of the paths.
const SdfSources::Found& SdfSources::look_up(const std::string& uri) const {
  const auto [entry, is_new] = found_.try_emplace(uri);
  Found& found = entry->second;
  if (!is_new) return found;
  found.path = found.file = find_(uri);
  std::error_code ignored;
  if (!fs::is_directory(found.path, ignored)) return found;
  const bool is_model = fs::exists(fs::path(found.path) / "model.config", ignored) ||
                        fs::exists(fs::path(found.path) / "manifest.xml", ignored);
  found.file = is_model ? sdf::getModelFilePath(found.path) : "";
  return found;
}

std::string SdfSources::find(const std::string& uri) const {
  if (uri.rfind(kCopyUri, 0) == 0) return folder_ + uri.substr(std::size(kCopyUri) - 1);
  const Found& found = look_up(uri);
  const auto known = files_.find(found.file);
  return known == files_.end() || known->second.copy.empty() ? found.path : known->second.copy;
}

std::string SdfSources::original(const std::string& path) const {
  for (const auto& [name, file] : files_) {
    if (!file.copy.empty() && file.copy == path) return name;
  }
  return path;
}

namespace {

/// A plugin's elements mean what the plugin takes them for.
bool is_include(const XMLElement& element, const XMLElement& parent) {
  return element.Name() == std::string("include") && parent.Name() != std::string("plugin");
}

}  // namespace

/// A text that is no XML is left to libsdformat, whose message names the place.
SdfSources::Size SdfSources::visit(std::string& text, const std::string& label, int depth) {
  Size size{0, text.size()};
  if (size.bytes > limits_.bytes) return size;
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);  // as libsdformat reads it
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return size;
  std::vector<Include> cut;
  if (document.RootElement() != nullptr && document.RootElement()->Name() != std::string("robot")) {
    visit_includes(*document.RootElement(), label, depth, size, cut);
  }
  for (const Include& include : cut) cut_element(text, include.line, "include", include.before);
  name_copies(text);
  return size;
}

/// A file that a URI names by its path libsdformat reads without asking for the copy, and without
/// end if it leads back to itself: such a URI is replaced by one that only find() knows.
void SdfSources::name_copies(std::string& text) const {
  for (const auto& [uri, found] : found_) {
    const bool is_path = !uri.empty() && (uri.front() == '/' || uri.rfind("file:", 0) == 0);
    const auto file = files_.find(found.file);
    if (!is_path || file == files_.end() || file->second.copy.empty()) continue;
    replace_content(text, uri, kCopyUri + file->second.copy.substr(folder_.size()));
  }
}

/// Says so of an include in `parent`, and notes that the model lacks something.
void SdfSources::leave_out(const XMLElement& parent, const std::string& label, int line,
                           const std::string& fault) {
  if (parent.Name() == std::string("model")) {
    lossy_models_.insert(label + ":" + number(static_cast<std::uint64_t>(parent.GetLineNum())));
  }
  std::string where = label;
  where.append(":").append(std::to_string(line)).append(": <include>").append(fault);
  if (fault.find(kNotFound) != std::string::npos && odd_.policy == OddElements::kRefuse) {
    warn_(where);
  } else {
    odd_.add(where);
  }
}

/// An include is named by its line and how many that stay are before it in that line: tinyxml2
/// knows no columns.
void SdfSources::visit_includes(const XMLElement& parent, const std::string& label, int depth,
                                Size& size, std::vector<Include>& cut) {
  ++size.elements;
  int line = 0, stay = 0;
  for (auto* child = parent.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (!is_include(*child, parent)) {
      visit_includes(*child, label, depth, size, cut);
      continue;
    }
    if (child->GetLineNum() != line) stay = 0;
    line = child->GetLineNum();
    const std::string uri = uri_of(*child);
    const std::string fault = uri.empty() ? " has no <uri>" : follow(uri, depth, size);
    if (fault.empty()) {
      ++stay;
      continue;
    }
    cut.push_back({line, stay});
    leave_out(parent, label, line, fault);
  }
}

std::string SdfSources::open(const std::string& path, int depth, File& file) {
  std::error_code failed;
  if (!fs::exists(path, failed)) return "does not exist";
  const std::uint64_t bytes = fs::is_regular_file(path, failed) ? fs::file_size(path, failed) : 0;
  if (failed || bytes > limits_.bytes) {
    return "is no file of at most " + number(limits_.bytes) + " bytes";
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string before{std::istreambuf_iterator<char>(stream), {}};
  file.text = before;
  blank_late_declarations(file.text);
  file.is_open = true;
  file.size = visit(file.text, path, depth);
  file.is_open = false;
  if (file.text != before) save_copy(file);
  return "";
}

/// Counts elements and bytes as often as a file is included, as expanding it would.
std::string SdfSources::follow(const std::string& uri, int depth, Size& size) {
  const std::string what = " of '" + uri + "'";
  const std::string path = look_up(uri).file;
  if (path.empty()) return what + kNotFound + searched_;
  const auto too_deep = [&](int deepest) {
    return what + " makes " + std::to_string(deepest) + " includes in each other, legal: at most " +
           std::to_string(limits_.depth);
  };
  if (depth == limits_.depth) return too_deep(depth + 1);
  const auto [entry, is_new] = files_.try_emplace(path);
  File& file = entry->second;
  if (file.is_open) return what + " leads back to itself (" + path + ")";
  if (is_new) {
    if (std::string fault = open(path, depth + 1, file); !fault.empty()) {
      files_.erase(entry);
      return what + ": " + path + " " + fault;
    }
  }
  const int height = file.size.height + 1;
  if (depth + height > limits_.depth) return too_deep(depth + height);
  const Size all{size.elements + file.size.elements, size.bytes + file.size.bytes,
                 std::max(size.height, height)};
  if (all.elements > limits_.elements || all.bytes > limits_.bytes) {
    return what + " would make " + number(all.elements) + " elements in " + number(all.bytes) +
           " bytes, legal: at most " + number(limits_.elements) + " and " + number(limits_.bytes);
  }
  size = all;
  return "";
}

/// libsdformat reads included files by their names, so that a changed text needs a file of its own.
/// The files live as long as the sources.
void SdfSources::save_copy(File& file) {
  if (folder_.empty()) {
    std::string pattern = (fs::temp_directory_path() / "trident_sdf_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw Error(label_ + ": no folder for temporary files: " + pattern);
    }
    folder_ = pattern;
  }
  if (file.copy.empty()) file.copy = folder_ + "/" + std::to_string(++copies_) + ".sdf";
  std::ofstream(file.copy, std::ios::binary) << file.text;
}

/// Names with "::" that libsdformat cannot resolve are read with "__" in a second attempt.
void SdfSources::repair(std::string& text, const std::string& label) {
  try {
    leave_out_unreadable(text, label, odd_.texts);
  } catch (const sdf::Exception& error) {
    for (auto at = text.find("::"); at != std::string::npos; at = text.find("::", at)) {
      text.replace(at, 2, "__");
    }
    odd_.texts.push_back(label + ": its scoped names do not fit together (" + error.GetErrorStr() +
                         "); 'a::b' is read as 'a__b'");
    leave_out_unreadable(text, label, odd_.texts);
  }
}

void SdfSources::repair_files() {
  sdf::Console::Instance()->SetQuiet(true);
  for (auto& [path, file] : files_) {
    if (is_urdf(file.text)) continue;  // which libsdformat converts
    const std::string before = file.text;
    try {
      repair(file.text, path);
    } catch (const Error& error) {
      odd_.texts.push_back(std::string(error.what()) + "; left out");
      file.text = "<sdf version='1.6'/>";
    }
    if (file.text != before) save_copy(file);
  }
  for (auto& [path, file] : files_) {
    const std::string before = file.text;
    name_copies(file.text);
    if (file.text != before) save_copy(file);
  }
  name_copies(text_);
}

bool SdfSources::repair_text() {
  const std::string before = text_;
  repair(text_, label_);
  return text_ != before;
}

}  // namespace trident::sim
