// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "package_index.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace trident::sim {
namespace fs = std::filesystem;
namespace {

using tinyxml2::XMLElement;

constexpr char kPrefix[] = "${prefix}";
/// Workspaces nest deeper only by a link that leads back.
constexpr int kDeepest = 8;
/// In an installation packages lie directly in "share".
constexpr int kDeepestInstalled = 1;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string without_spaces(const char* text) {
  std::string result(text == nullptr ? "" : text);
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  result.erase(std::remove_if(result.begin(), result.end(), is_space), result.end());
  return result;
}

bool depends_on(const XMLElement& manifest, const std::string& package) {
  for (const char* tag :
       {"depend", "build_depend", "build_export_depend", "buildtool_depend",
        "buildtool_export_depend", "exec_depend", "run_depend", "doc_depend", "test_depend"}) {
    for (auto* element = manifest.FirstChildElement(tag); element != nullptr;
         element = element->NextSiblingElement(tag)) {
      if (without_spaces(element->GetText()) == package) return true;
    }
  }
  return false;
}

std::string with_prefix(std::string value, const std::string& folder) {
  for (auto at = value.find(kPrefix); at != std::string::npos;
       at = value.find(kPrefix, at + folder.size())) {
    value.replace(at, sizeof(kPrefix) - 1, folder);
  }
  return value;
}

/// Of the elements named `package` in an <export>, in their order; backquotes would run a program.
void append_exported(const XMLElement& list, const std::string& package,
                     const std::string& attribute, const std::string& folder,
                     std::vector<std::string>& values) {
  for (auto* element = list.FirstChildElement(package.c_str()); element != nullptr;
       element = element->NextSiblingElement(package.c_str())) {
    const char* const value = element->Attribute(attribute.c_str());
    if (value == nullptr || std::string(value).find('`') != std::string::npos) continue;
    values.push_back(with_prefix(value, folder));
  }
}

}  // namespace

std::string PackageIndex::find(std::string_view package) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Package& known : packages()) {
    if (known.name == package) return known.folder;
  }
  return "";
}

const std::vector<std::string>& PackageIndex::exports(const std::string& package,
                                                      const std::string& attribute) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto [entry, is_new] = exports_.try_emplace({package, attribute});
  if (is_new) entry->second = read_exports(package, attribute);
  return entry->second;
}

void PackageIndex::append_exports(const Package& known, const std::string& package,
                                  const std::string& attribute, std::vector<std::string>& values) {
  tinyxml2::XMLDocument document;
  if (document.Parse(known.manifest.c_str(), known.manifest.size()) != tinyxml2::XML_SUCCESS) {
    return;
  }
  const XMLElement* const root = document.FirstChildElement("package");
  if (root == nullptr || (known.name != package && !depends_on(*root, package))) return;
  for (auto* list = root->FirstChildElement("export"); list != nullptr;
       list = list->NextSiblingElement("export")) {
    append_exported(*list, package, attribute, known.folder, values);
  }
}

std::vector<std::string> PackageIndex::read_exports(const std::string& package,
                                                    const std::string& attribute) const {
  std::vector<std::string> values;
  for (const Package& known : packages()) {
    // Most manifests need not be parsed.
    if (known.manifest.find("<" + package) == std::string::npos) continue;
    append_exports(known, package, attribute, values);
  }
  return values;
}

const std::vector<PackageIndex::Package>& PackageIndex::packages() const {
  if (!is_read_) {
    for (const std::string& root : roots_) {
      const bool is_installation = fs::path(root).lexically_normal().filename() == "share";
      crawl(root, is_installation ? kDeepestInstalled : kDeepest);
    }
    is_read_ = true;
  }
  return packages_;
}

void PackageIndex::crawl(const std::string& folder, int depth) const {
  std::vector<std::string> below;
  std::error_code ignored;
  bool is_closed = depth == 0;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name == "package.xml") return add(folder);
    if (name == "CATKIN_IGNORE" || name == "rospack_nosubdirs") is_closed = true;
    if (name[0] != '.' && entry.is_directory(ignored)) below.push_back(entry.path().string());
  }
  if (is_closed) return;
  std::sort(below.begin(), below.end());
  for (const std::string& path : below) crawl(path, depth - 1);
}

void PackageIndex::add(const std::string& folder) const {
  Package package{"", folder, read_text(fs::path(folder) / "package.xml")};
  tinyxml2::XMLDocument document;
  document.Parse(package.manifest.c_str(), package.manifest.size());
  if (const XMLElement* const root = document.FirstChildElement("package")) {
    const XMLElement* const name = root->FirstChildElement("name");
    if (name != nullptr) package.name = without_spaces(name->GetText());
  }
  if (package.name.empty()) package.name = fs::path(folder).lexically_normal().filename().string();
  const bool is_known = std::any_of(packages_.begin(), packages_.end(), [&](const Package& other) {
    return other.name == package.name;
  });
  if (!is_known) packages_.push_back(std::move(package));
}

}  // namespace trident::sim
