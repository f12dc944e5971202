// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trident::sim {

/// The packages below some folders, as rospack finds them: by the name in their package.xml, the
/// first of a name counts, and nothing is looked for below a package, a CATKIN_IGNORE or a
/// rospack_nosubdirs. Folders are read when first asked for. May be used from any thread.
class PackageIndex {
 public:
  explicit PackageIndex(std::vector<std::string> folders) : roots_(std::move(folders)) {}

  /// Folder of the package, or "".
  std::string find(std::string_view package) const;

  /// What packages export to `package`: the values of `<export><PACKAGE ATTRIBUTE="…"/>`, of those
  /// that depend on it directly and of itself, with `${prefix}` replaced by the exporting package's
  /// folder (rospack's `plugins`). Shell commands in backquotes are not run: such a value is left
  /// out.
  const std::vector<std::string>& exports(const std::string& package,
                                          const std::string& attribute) const;

  const std::vector<std::string>& roots() const { return roots_; }

 private:
  struct Package {
    std::string name, folder, manifest;
  };
  const std::vector<Package>& packages() const;
  void crawl(const std::string& folder, int depth) const;
  void add(const std::string& folder) const;
  static void append_exports(const Package& known, const std::string& package,
                             const std::string& attribute, std::vector<std::string>& values);
  std::vector<std::string> read_exports(const std::string& package,
                                        const std::string& attribute) const;

  std::vector<std::string> roots_;
  mutable std::mutex mutex_;
  mutable bool is_read_ = false;
  mutable std::vector<Package> packages_;
  mutable std::map<std::pair<std::string, std::string>, std::vector<std::string>> exports_;
};

}  // namespace trident::sim
