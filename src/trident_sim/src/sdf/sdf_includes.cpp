// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_includes.h"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "sdf_schema.h"

namespace trident {
namespace {

using tinyxml2::XMLElement;

/// The URI of an `<include>` that says nothing else; "" of another.
std::string only_uri(const XMLElement& include) {
  const auto* uri = include.FirstChildElement();
  const bool is_plain = include.FirstAttribute() == nullptr && uri != nullptr &&
                        uri->NextSiblingElement() == nullptr &&
                        uri->Value() == std::string("uri") && uri->FirstAttribute() == nullptr &&
                        uri->GetText() != nullptr;
  return is_plain ? uri->GetText() : "";
}

/// The one model, actor or light of a file without errors.
std::optional<PlainInclude> read_include(const std::string& uri, const UriFinder& find) {
  std::error_code ignored;
  const std::string folder = find(uri);
  if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
  const std::string path = sdf::getModelFilePath(folder);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const sdf::SDFPtr document = make_document(text);
  sdf::ParserConfig config;
  config.SetFindCallback(find);
  sdf::Errors errors;
  if (!sdf::readFile(path, config, document, errors) || !errors.empty()) return std::nullopt;
  const sdf::ElementPtr element = document->Root()->GetFirstElement();
  if (!element || element->GetNextElement()) return std::nullopt;
  const std::string kind = element->GetName();
  if (kind != "model" && kind != "actor" && kind != "light") return std::nullopt;
  return PlainInclude{uri, element};
}

/// URIs of the includes; none when they are not all plain, or not all that there is.
std::vector<std::string> plain_uris(const XMLElement& world) {
  std::vector<std::string> uris;
  for (auto* child = world.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string tag = child->Value();
    if (tag == "model" || tag == "actor") return {};
    if (tag != "include") continue;
    const std::string uri = only_uri(*child);
    if (uri.empty() || std::count(uris.begin(), uris.end(), uri) > 0) return {};
    uris.push_back(uri);
  }
  return uris;
}

}  // namespace

std::vector<PlainInclude> read_plain_includes(const std::string& text, const UriFinder& find) {
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);  // as libsdformat reads it
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) return {};
  const auto* root = document.FirstChildElement("sdf");
  const auto* world = root == nullptr ? nullptr : root->FirstChildElement("world");
  if (world == nullptr || world->NextSiblingElement() != nullptr) return {};
  std::vector<PlainInclude> includes;
  for (const std::string& uri : plain_uris(*world)) {
    std::optional<PlainInclude> include = read_include(uri, find);
    if (!include) return {};
    includes.push_back(std::move(*include));
  }
  return includes;
}

}  // namespace trident
