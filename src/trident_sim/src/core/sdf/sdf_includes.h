// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tinyxml2.h>

#include <functional>
#include <map>
#include <sdf/sdf.hh>
#include <set>
#include <string>

namespace trident::sim {

/// Where a URI leads; "" when it leads nowhere.
using UriFinder = std::function<std::string(const std::string&)>;

/// What the `<include>`s of a document bring in, read here because libsdformat clones the whole
/// specification, 40 ms, for each of them. All of them, of worlds and of models in each other, or
/// none: where one says more than <uri>, <name>, <pose>, <static> and <plugin>s, or its file is not
/// read without an error, libsdformat does it all and reports all errors.
class PlainIncludes {
 public:
  PlainIncludes(const std::string& text, const UriFinder& find);

  /// Whether libsdformat must not find what the URI names, because it is read here.
  bool have(const std::string& uri) const { return uris_.count(uri) > 0; }
  /// Takes the errors out that say so.
  void drop_lookup_errors(sdf::Errors& errors) const;
  /// Puts them into the document that libsdformat has read from the text, among their siblings in
  /// the order of the text. False, and nothing is changed, when the two do not fit together.
  bool insert(const sdf::ElementPtr& root) const;

 private:
  bool read_all(const tinyxml2::XMLElement& parent, const UriFinder& find);
  bool read(const tinyxml2::XMLElement& include, const UriFinder& find);
  void insert_children(const tinyxml2::XMLElement& xml, const sdf::ElementPtr& parent) const;

  tinyxml2::XMLDocument document_{true, tinyxml2::COLLAPSE_WHITESPACE};  // as libsdformat reads it
  std::map<const tinyxml2::XMLElement*, sdf::ElementPtr> elements_;      ///< by the `<include>`
  std::set<std::string> uris_;
};

/// Reads a text, or a file, into a document that knows the specification; what it includes comes by
/// `find`, which must be libsdformat's global one, too. None: it cannot be read.
sdf::SDFPtr read_sdf_text(const std::string& text, const UriFinder& find, sdf::Errors& errors);
sdf::SDFPtr read_sdf_file(const std::string& path, const UriFinder& find, sdf::Errors& errors);

}  // namespace trident::sim
