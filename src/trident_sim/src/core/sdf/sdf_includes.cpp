// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_includes.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "sdf_schema.h"

namespace trident::sim {
namespace {

using tinyxml2::XMLElement;

/// What includes bring in, and what may hold it.
bool is_entity(const std::string& tag) {
  return tag == "world" || tag == "model" || tag == "actor" || tag == "light";
}
bool may_include(const std::string& tag) { return tag == "world" || tag == "model"; }

bool holds_include(const XMLElement& parent) {
  for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string tag = child->Value();
    if (tag == "include" || (tag != "plugin" && holds_include(*child))) return true;
  }
  return false;
}

bool is_empty_frame(const tinyxml2::XMLAttribute& attribute) {
  return attribute.Name() == std::string("frame") && *attribute.Value() == '\0';
}

/// A <pose> may have the empty `frame` of older versions.
bool is_plain_part(const XMLElement& part) {
  static const std::set<std::string> kPlain = {"uri", "name", "pose", "static"};
  const std::string tag = part.Value();
  if (kPlain.count(tag) == 0) return false;
  for (auto* attribute = part.FirstAttribute(); attribute; attribute = attribute->Next()) {
    if (tag != "pose" || !is_empty_frame(*attribute)) return false;
  }
  return part.GetText() != nullptr && part.FirstChildElement() == nullptr;
}

bool is_plain(const XMLElement& include) {
  std::set<std::string> seen;
  for (auto* part = include.FirstChildElement(); part; part = part->NextSiblingElement()) {
    if (part->Value() == std::string("plugin")) continue;
    if (!is_plain_part(*part) || !seen.insert(part->Value()).second) return false;
  }
  return seen.count("uri") > 0 && include.FirstAttribute() == nullptr;
}

/// As libsdformat does it.
/// A pose given with an include is one in the frame that holds it.
void set_pose(const sdf::ElementPtr& pose, const char* text) {
  for (const char* attribute : {"relative_to", "degrees", "rotation_format"}) {
    if (const sdf::ParamPtr param = pose->GetAttribute(attribute)) param->Reset();
  }
  pose->GetValue()->SetFromString(text);
}

void take_parts(const XMLElement& include, const sdf::ElementPtr& element) {
  const std::string kind = element->GetName();
  if (const auto* name = include.FirstChildElement("name")) {
    element->GetAttribute("name")->SetFromString(name->GetText());
    element->SetXmlPath("/sdf/" + kind + "[@name=\"" + name->GetText() + "\"]");
  }
  if (const auto* given = include.FirstChildElement("pose")) {
    set_pose(element->GetElement("pose"), given->GetText());
  }
  const auto* is_static = include.FirstChildElement("static");
  if (is_static != nullptr && kind == "model") {
    element->GetElement("static")->GetValue()->SetFromString(is_static->GetText());
  }
}

/// The plugins of an include stand behind those of its model. False: libsdformat must read them.
bool take_plugins(const XMLElement& include, const sdf::ElementPtr& element) {
  auto* plugin = include.FirstChildElement("plugin");
  if (plugin != nullptr && element->GetName() == "light") return false;
  for (; plugin != nullptr; plugin = plugin->NextSiblingElement("plugin")) {
    if (!element->HasElementDescription("plugin")) return false;
    tinyxml2::XMLPrinter text(nullptr, true);
    plugin->Accept(&text);
    sdf::Errors errors;
    const std::string document = std::string("<sdf version='") + SDF_VERSION + "'>";
    if (!sdf::readString(document + text.CStr() + "</sdf>", element->AddElement("plugin"),
                         errors) ||
        !errors.empty()) {
      return false;
    }
  }
  return true;
}

std::string model_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? sdf::getModelFilePath(path) : path;
}

/// `read`: of libsdformat, into a document and with a configuration.
template <class Read>
sdf::SDFPtr read_with_includes(const std::string& text, const UriFinder& find, sdf::Errors& errors,
                               const Read& read) {
  const PlainIncludes includes(text, find);
  sdf::ParserConfig config;
  config.SetFindCallback(
      [&](const std::string& uri) { return includes.have(uri) ? std::string() : find(uri); });
  sdf::SDFPtr document = make_document(text);
  if (!read(config, document)) return nullptr;
  includes.drop_lookup_errors(errors);
  if (includes.insert(document->Root())) return document;
  errors.clear();
  config.SetFindCallback(find);
  document = make_document(text);
  return read(config, document) ? document : nullptr;
}

}  // namespace

PlainIncludes::PlainIncludes(const std::string& text, const UriFinder& find) {
  if (text.find("<include") == std::string::npos) return;
  if (document_.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return;
  const XMLElement* const root = document_.FirstChildElement("sdf");
  if (root != nullptr && read_all(*root, find)) return;
  elements_.clear();
  uris_.clear();
}

bool PlainIncludes::read_all(const XMLElement& parent, const UriFinder& find) {
  const bool may = may_include(parent.Value());
  for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string tag = child->Value();
    if (tag == "plugin") continue;
    const bool is_read = tag == "include"   ? may && read(*child, find)
                         : may_include(tag) ? read_all(*child, find)
                                            : !holds_include(*child);
    if (!is_read) return false;
  }
  return true;
}

namespace {

/// The one entity that the file holds, if it may be included and libsdformat has no fault to find.
sdf::ElementPtr read_single_entity(const std::string& path, const UriFinder& find) {
  sdf::Errors errors;
  const sdf::SDFPtr document = read_sdf_file(path, find, errors);
  if (document == nullptr || !errors.empty()) return nullptr;
  const sdf::ElementPtr element = document->Root()->GetFirstElement();
  if (!element || element->GetNextElement()) return nullptr;
  const bool may_be_included = is_entity(element->GetName()) && element->GetName() != "world";
  return may_be_included ? element : nullptr;
}

}  // namespace

bool PlainIncludes::read(const XMLElement& include, const UriFinder& find) {
  if (!is_plain(include)) return false;
  const std::string uri = include.FirstChildElement("uri")->GetText();
  const std::string path = model_file(find(uri));
  if (path.empty()) return false;
  const sdf::ElementPtr element = read_single_entity(path, find);
  if (!element) return false;
  take_parts(include, element);
  if (!take_plugins(include, element)) return false;
  elements_[&include] = element;
  uris_.insert(uri);
  return true;
}

void PlainIncludes::drop_lookup_errors(sdf::Errors& errors) const {
  const auto is_expected = [this](const sdf::Error& error) {
    return error.Code() == sdf::ErrorCode::URI_LOOKUP &&
           std::any_of(uris_.begin(), uris_.end(), [&error](const std::string& uri) {
             return error.Message() == "Unable to find uri[" + uri + "]";
           });
  };
  errors.erase(std::remove_if(errors.begin(), errors.end(), is_expected), errors.end());
}

namespace {

using Entities = std::map<std::string, std::deque<sdf::ElementPtr>>;

Entities entities_of(const sdf::ElementPtr& parent) {
  Entities entities;
  for (auto child = parent->GetFirstElement(); child; child = child->GetNextElement()) {
    if (is_entity(child->GetName())) entities[child->GetName()].push_back(child);
  }
  return entities;
}

/// Whether an element has the entities of its text, one for one.
bool fits(const XMLElement& xml, const sdf::ElementPtr& parent) {
  Entities entities = entities_of(parent);
  for (auto* child = xml.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string tag = child->Value();
    if (!is_entity(tag)) continue;
    if (entities[tag].empty()) return false;
    const sdf::ElementPtr element = entities[tag].front();
    entities[tag].pop_front();
    if (may_include(tag) && !fits(*child, element)) return false;
  }
  return std::all_of(entities.begin(), entities.end(),
                     [](const auto& kind) { return kind.second.empty(); });
}

}  // namespace

bool PlainIncludes::insert(const sdf::ElementPtr& root) const {
  if (elements_.empty()) return true;
  const XMLElement& xml = *document_.FirstChildElement("sdf");
  if (!fits(xml, root)) return false;
  insert_children(xml, root);
  return true;
}

void PlainIncludes::insert_children(const XMLElement& xml, const sdf::ElementPtr& parent) const {
  if (!holds_include(xml)) return;
  Entities entities = entities_of(parent);
  for (auto* child = xml.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string tag = child->Value();
    sdf::ElementPtr element;
    if (tag == "include") {
      element = elements_.at(child);
    } else if (is_entity(tag)) {
      element = entities[tag].front();
      entities[tag].pop_front();
      if (may_include(tag)) insert_children(*child, element);
      parent->RemoveChild(element);
    } else {
      continue;
    }
    element->SetParent(parent);
    parent->InsertElement(element);
  }
}

sdf::SDFPtr read_sdf_text(const std::string& text, const UriFinder& find, sdf::Errors& errors) {
  return read_with_includes(text, find, errors, [&](const auto& config, const auto& document) {
    return sdf::readString(text, config, document, errors);
  });
}

sdf::SDFPtr read_sdf_file(const std::string& path, const UriFinder& find, sdf::Errors& errors) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return read_with_includes(text, find, errors, [&](const auto& config, const auto& document) {
    return sdf::readFile(path, config, document, errors);
  });
}

}  // namespace trident::sim
