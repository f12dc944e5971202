// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_repair.h"

#include <tinyxml2.h>

#include <set>
#include <utility>

#include "sdf_schema.h"
#include "sdf_sources.h"
#include "trident_base/error.h"
#include "xml_cut.h"

namespace trident::sim {
namespace {

/// Each cut costs another read of the whole text.
constexpr int kMaxCuts = 100;

std::string text_of(const std::string& element) {
  tinyxml2::XMLDocument document;
  document.Parse(element.c_str(), element.size());
  const auto* const root = document.RootElement();
  const bool is_value = root != nullptr && root->FirstChildElement() == nullptr;
  const std::string text = is_value && root->GetText() != nullptr ? root->GetText() : "";
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The names on the path to an element, from `/sdf/world[@name="w"]/scene/sky`.
std::vector<std::string> names_on(const std::string& xml_path) {
  std::vector<std::string> names;
  int depth = 0;
  for (const char c : xml_path) {
    if (c == '[') ++depth;
    if (depth == 0 && c == '/') {
      names.emplace_back();
    } else if (depth == 0 && !names.empty()) {
      names.back() += c;
    }
    if (c == ']') --depth;
  }
  return names;
}

/// What the specification wants there, e.g. "double, at least 0"; "" where it does not say.
std::string legal_value(const std::string& text, const std::string& xml_path) {
  sdf::ElementPtr element = make_document(text)->Root();
  const std::vector<std::string> names = names_on(xml_path);
  for (std::size_t i = 1; i < names.size() && element; ++i) {
    element = element->GetElementDescription(names[i]);
  }
  if (!element || !element->GetValue()) return "";
  const sdf::ParamPtr value = element->GetValue();
  std::string legal = value->GetTypeName();
  if (const auto least = value->GetMinValueAsString()) legal += ", at least " + *least;
  if (const auto most = value->GetMaxValueAsString()) legal += ", at most " + *most;
  return legal;
}

/// What a failed read says: the innermost element that it names, and why.
struct Failure {
  std::string name, xml_path, reason;
  int line = 0;
};

Failure find_failure(const sdf::Errors& errors) {
  constexpr char kBegin[] = "Error reading element <";
  Failure failure;
  for (const sdf::Error& error : errors) {
    const std::string& message = error.Message();
    if (message.rfind(kBegin, 0) != 0) {
      const bool is_include = error.Code() == sdf::ErrorCode::URI_LOOKUP;
      if (!is_include) failure.reason = message;
      continue;
    }
    failure.name = message.substr(sizeof(kBegin) - 1);
    failure.name.resize(failure.name.find('>'));
    failure.line = error.LineNumber().value_or(0);
    failure.xml_path = error.XmlPath().value_or("");
    break;
  }
  return failure;
}

std::string describe(const Failure& failure, const std::string& text, const std::string& cut,
                     const std::string& label) {
  std::string what = label + ":" + std::to_string(failure.line) + ": <" + failure.name + ">";
  const std::string value = text_of(cut);
  if (!failure.reason.empty()) return what + ": " + failure.reason;
  if (!value.empty()) what.append(" is '").append(value).append("'");
  const std::string legal = legal_value(text, failure.xml_path);
  return what + (legal.empty() ? " cannot be read" : ", legal: " + legal);
}

/// Whether libsdformat reads the text, its includes aside.
bool is_readable(const std::string& text, sdf::Errors& errors) {
  sdf::ParserConfig config;
  // Includes are followed elsewhere, and a missing one is no fault of this text.
  config.SetFindCallback([](const std::string&) { return std::string(); });
  errors.clear();
  const bool is_read = sdf::readString(text, config, make_document(text), errors);
  return is_read && find_failure(errors).name.empty();  // it reads on behind a bad <include>
}

using Names = std::set<std::string>;

std::string free_name(const std::string& name, const Names& taken) {
  int number = 1;
  while (taken.count(name + "_" + std::to_string(number)) > 0) ++number;
  return name + "_" + std::to_string(number);
}

bool is_named_part(const std::string& tag) {
  static const Names kNamed{"model", "link",   "joint", "collision", "visual",
                            "actor", "sensor", "light", "frame",     "physics"};
  return kNamed.count(tag) > 0;
}

/// Neither it nor a model in it has a link.
bool is_empty_model(const sdf::ElementPtr& element) {
  if (element->GetName() != "model" || element->HasElement("link")) return false;
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName() == "model" && !is_empty_model(child)) return false;
  }
  return true;
}

/// "FILE:LINE", as far as libsdformat knows them.
std::string place_of(const sdf::ElementPtr& element, const SdfSources& sources) {
  const std::string& path = element->FilePath();
  std::string place =
      path.empty() || path.front() != '/' ? sources.label() : sources.original(path);
  if (const auto line = element->LineNumber()) place += ":" + std::to_string(*line);
  return place;
}

/// Whether an include of the model, or of a model in it, has been reported as left out.
bool has_lost_include(const sdf::ElementPtr& model, const SdfSources& sources) {
  if (sources.has_lost_include(place_of(model, sources))) return true;
  for (auto child = model->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName() == "model" && has_lost_include(child, sources)) return true;
  }
  return false;
}

Names names_of_parts(const sdf::ElementPtr& parent) {
  Names names;
  for (auto child = parent->GetFirstElement(); child; child = child->GetNextElement()) {
    if (is_named_part(child->GetName())) names.insert(child->Get<std::string>("name"));
  }
  return names;
}

void rename_doubles(const sdf::ElementPtr& parent, const SdfSources& sources,
                    std::vector<std::string>& odd) {
  std::set<std::pair<std::string, std::string>> seen;
  Names taken = names_of_parts(parent);
  for (auto child = parent->GetFirstElement(); child; child = child->GetNextElement()) {
    if (!is_named_part(child->GetName())) continue;
    const auto name = child->Get<std::string>("name");
    if (seen.emplace(child->GetName(), name).second) continue;
    const std::string own = free_name(name, taken);
    taken.insert(own);
    child->GetAttribute("name")->SetFromString(own);
    if (child->GetName() == "physics") continue;
    std::string text = place_of(child, sources);
    text.append(": another <").append(child->GetName()).append("> is named '").append(name);
    odd.push_back(text.append("'; this one is called '").append(own).append("'"));
  }
}

}  // namespace

namespace {

/// Whether nothing is left when the part that failed is cut.
bool is_whole_document(const Failure& failure) {
  const bool is_root = failure.name.empty() || failure.name == "sdf" || failure.name == "world";
  return is_root || (failure.name == "model" && names_on(failure.xml_path).size() == 2);
}

}  // namespace

void leave_out_unreadable(std::string& text, const std::string& label,
                          std::vector<std::string>& odd) {
  sdf::Errors errors;
  for (int cuts = 0; !is_readable(text, errors); ++cuts) {
    const Failure failure = find_failure(errors);
    const std::string cut =
        is_whole_document(failure) ? "" : cut_element(text, failure.line, failure.name);
    if (cut.empty() || cuts == kMaxCuts) {
      std::string why = label + ": libsdformat cannot read it: ";
      why += errors.empty() ? "it is no SDF" : errors.front().Message();
      throw Error(why);
    }
    odd.push_back(describe(failure, text, cut, label) + "; left out");
  }
}

void repair_elements(const sdf::ElementPtr& root, const SdfSources& sources,
                     std::vector<std::string>& odd) {
  rename_doubles(root, sources, odd);
  for (auto child = root->GetFirstElement(); child;) {
    const auto next = child->GetNextElement();
    if (root->GetName() == "world" && is_empty_model(child)) {
      if (!has_lost_include(child, sources)) {
        odd.push_back(place_of(child, sources) + ": model '" + child->Get<std::string>("name") +
                      "' has no link; left out");
      }
      root->RemoveChild(child);
    } else if (child->GetName() != "plugin") {
      repair_elements(child, sources, odd);
    }
    child = next;
  }
}

}  // namespace trident::sim
