// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_schema.h"

#include <tinyxml2.h>

#include <map>
#include <mutex>
#include <set>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

using tinyxml2::XMLElement;

/// Optional parts of the specification that cost much to clone.
struct Part {
  const char* tag_begin;
  const char* filename;
};
constexpr Part kBigParts[] = {
    {"<actor", "actor.sdf"},           {"<heightmap", "heightmap_shape.sdf"},
    {"<light", "light.sdf"},           {"<particle_emitter", "particle_emitter.sdf"},
    {"<population", "population.sdf"}, {"<sensor", "sensor.sdf"},
    {"<state", "state.sdf"},
};

using Filenames = std::set<std::string>;

Filenames unused_parts(const std::string& text) {
  Filenames unused;
  for (const Part& part : kBigParts) {
    if (text.find(part.tag_begin) == std::string::npos) unused.insert(part.filename);
  }
  return unused;
}

void delete_includes(XMLElement& element) {
  while (auto* include = element.FirstChildElement("include")) element.DeleteChild(include);
  for (auto* child = element.FirstChildElement("element"); child != nullptr;
       child = child->NextSiblingElement("element")) {
    delete_includes(*child);
  }
}

/// Builds element descriptions from the specification that is part of libsdformat.
class SchemaBuilder {
 public:
  explicit SchemaBuilder(const Filenames& left_out) : left_out_(left_out) {}

  /// The description in a file of the specification; the same object at every call.
  sdf::ElementPtr read(const std::string& filename) {
    if (const auto known = files_.find(filename); known != files_.end()) return known->second;
    const std::string& text = sdf::SDF::EmbeddedSpec(filename, true);
    tinyxml2::XMLDocument with_includes, without;
    if (with_includes.Parse(text.c_str()) != tinyxml2::XML_SUCCESS) {
      throw Error("libsdformat has no specification " + filename);
    }
    with_includes.DeepCopy(&without);
    delete_includes(*without.RootElement());
    tinyxml2::XMLPrinter printer(nullptr, true);
    without.Print(&printer);
    const auto document = std::make_shared<sdf::SDF>();
    if (!sdf::initString(printer.CStr(), document)) {
      throw Error("libsdformat cannot read its specification " + filename);
    }
    files_.emplace(filename, document->Root());
    add_includes(*with_includes.RootElement(), *document->Root());
    return document->Root();
  }

 private:
  /// As sdf::init() does, included descriptions follow those written out.
  void add_includes(const XMLElement& xml, sdf::Element& description) {
    unsigned int index = 0;
    for (auto* child = xml.FirstChildElement("element"); child != nullptr;
         child = child->NextSiblingElement("element")) {
      // <element copy_data="true"> is a property of its parent.
      if (child->BoolAttribute("copy_data")) continue;
      add_includes(*child, *description.GetElementDescription(index++));
    }
    for (auto* include = xml.FirstChildElement("include"); include != nullptr;
         include = include->NextSiblingElement("include")) {
      const std::string filename = include->Attribute("filename");
      if (left_out_.count(filename) == 0) description.AddElementDescription(read(filename));
    }
  }

  const Filenames& left_out_;
  std::map<std::string, sdf::ElementPtr> files_;
};

/// A copy that shares the descriptions of children.
sdf::ElementPtr shallow_copy(const sdf::Element& from) {
  auto copy = std::make_shared<sdf::Element>();
  copy->SetName(from.GetName());
  copy->SetRequired(from.GetRequired());
  copy->SetDescription(from.GetDescription());
  for (std::size_t i = 0; i < from.GetAttributeCount(); ++i) {
    const sdf::ParamPtr attribute = from.GetAttribute(static_cast<unsigned int>(i));
    copy->AddAttribute(attribute->GetKey(), attribute->GetTypeName(),
                       attribute->GetDefaultAsString(), attribute->GetRequired(),
                       attribute->GetDescription());
  }
  for (std::size_t i = 0; i < from.GetElementDescriptionCount(); ++i) {
    copy->AddElementDescription(from.GetElementDescription(static_cast<unsigned int>(i)));
  }
  return copy;
}

}  // namespace

sdf::SDFPtr make_document(const std::string& text) {
  static std::mutex mutex;
  static std::map<Filenames, sdf::ElementPtr> schemas;  // by what is left out
  const Filenames unused = unused_parts(text);
  const std::lock_guard<std::mutex> lock(mutex);
  sdf::ElementPtr& schema = schemas[unused];
  if (!schema) schema = SchemaBuilder(unused).read("root.sdf");
  auto document = std::make_shared<sdf::SDF>();
  document->Root(shallow_copy(*schema));
  return document;
}

}  // namespace trident::sim
