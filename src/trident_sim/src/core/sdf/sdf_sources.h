// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "odd_list.h"
#include "trident_sim/sdf_loader.h"

namespace tinyxml2 {
class XMLElement;
}

namespace trident::sim {

/// What a document may hold with all that it includes. libsdformat takes up to 32 kB for each
/// element, and follows an include that leads back to itself until there is no memory left.
struct SdfLimits {
  std::uint64_t elements = 100'000;
  std::uint64_t bytes = 64ULL << 20;
  int depth = 32;  ///< of includes in includes
};

/// A document and the files that it includes, as libsdformat is to read them: without includes that
/// lead nowhere, back to themselves or beyond the limits, and on demand without elements that it
/// cannot read. Files that need a change are read from copies, which live as long as this object.
class SdfSources {
 public:
  using Find = std::function<std::string(const std::string& uri)>;

  /// `searched`: where `find` looks, for messages. An include that is not found is reported to
  /// `warn` where odd elements are refused: it leaves a hole in the world, not a broken file.
  /// Throws Error when the document itself is beyond the limits.
  SdfSources(std::string text, const std::string& label, Find find, std::string searched,
             OddList& odd, const WarningSink& warn);
  ~SdfSources();
  SdfSources(const SdfSources&) = delete;
  SdfSources& operator=(const SdfSources&) = delete;

  const std::string& text() const { return text_; }
  const std::string& label() const { return label_; }
  /// The path that a URI leads to, that of the copy where there is one.
  std::string find(const std::string& uri) const;
  /// The file that a path names, if it is that of a copy; else the path.
  std::string original(const std::string& path) const;
  /// Leaves out what libsdformat cannot read of the included files, or of the document: see
  /// leave_out_unreadable(). Of a file that cannot be read at all nothing is left. Names like
  /// "a::b" that do not fit together, which libsdformat unfolds in old files, are read as "a__b".
  void repair_files();
  bool repair_text();  ///< whether it has changed
  /// Whether an include of the model that begins at "FILE:LINE" is left out.
  bool has_lost_include(const std::string& place) const { return lossy_models_.count(place) > 0; }

 private:
  struct Size {
    std::uint64_t elements = 0, bytes = 0;
    int height = 0;  ///< of includes in includes below
  };
  struct File {
    std::string text, copy;
    Size size;
    bool is_open = false;  ///< it is being read: an include of it leads back
  };
  struct Include {
    int line;
    int before;  ///< includes in that line that stay
  };
  Size visit(std::string& text, const std::string& label, int depth);
  void leave_out(const tinyxml2::XMLElement& parent, const std::string& label, int line,
                 const std::string& fault);
  void visit_includes(const tinyxml2::XMLElement& parent, const std::string& label, int depth,
                      Size& size, std::vector<Include>& cut);
  /// Why an include cannot be followed, or ""; adds its size.
  std::string follow(const std::string& uri, int depth, Size& size);
  /// What a URI leads to, and the file that is read for it, if that is a folder.
  struct Found {
    std::string path, file;
  };
  const Found& look_up(const std::string& uri) const;
  /// Reads the file and what it includes; why that cannot be, or "".
  std::string open(const std::string& path, int depth, File& file);
  void save_copy(File& file);
  void name_copies(std::string& text) const;
  void repair(std::string& text, const std::string& label);

  std::string text_, label_;
  Find find_;
  std::string searched_;
  OddList& odd_;
  const WarningSink& warn_;
  SdfLimits limits_;
  std::map<std::string, File> files_;           ///< by path
  mutable std::map<std::string, Found> found_;  ///< by URI
  std::set<std::string> lossy_models_;          ///< where they begin
  std::string folder_;                          ///< of the copies
  int copies_ = 0;
};

}  // namespace trident::sim
