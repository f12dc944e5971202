// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/sdf_loader.h"

#include <console_bridge/console.h>
#include <malloc.h>
#include <tinyxml2.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sdf/sdf.hh>
#include <sstream>

#include "core/urdf/urdf_check.h"
#include "sdf_convert.h"
#include "sdf_includes.h"
#include "sdf_repair.h"
#include "sdf_schema.h"
#include "sdf_sources.h"
#include "trident_base/error.h"
#include "xml_cut.h"

namespace trident::sim {
namespace {

/// Lets one load go at a time, because libsdformat's URDF converter and its log have global state.
/// The last of those that waited gives the megabytes of documents back to the system.
class LoadTurn {
 public:
  LoadTurn() {
    ++loads_;
    mutex_.lock();
  }
  ~LoadTurn() {
    mutex_.unlock();
    if (--loads_ == 0) malloc_trim(0);
  }
  LoadTurn(const LoadTurn&) = delete;
  LoadTurn& operator=(const LoadTurn&) = delete;

 private:
  static inline std::mutex mutex_;
  static inline std::atomic<int> loads_{0};
};

std::string describe(const sdf::Error& error, const std::string& label) {
  std::string where = error.FilePath().value_or(label);
  if (where.empty() || where.front() == '<') where = label;
  if (error.LineNumber()) where += ":" + std::to_string(*error.LineNumber());
  return where + ": " + error.Message();
}

/// RotorS' published vehicles break the triangle inequality of inertia; what must hold, positive
/// definiteness, is checked by convert_inertial().
bool is_checked_elsewhere(const sdf::Error& error) {
  return error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID;
}

/// "__default__" is what libsdformat writes where the file says nothing.
bool is_given(const std::string& text) { return !text.empty() && text != "__default__"; }

/// Gazebo knows its materials by name alone; libsdformat refuses a script without its file.
void complete_material_scripts(const sdf::ElementPtr& element) {
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName() == "material" && child->HasElement("script")) {
      const auto script = child->GetElement("script");
      if (!is_given(script->Get<std::string>("name", "").first)) {
        child->RemoveChild(script);  // it names no material
        continue;
      }
      const auto uri = script->GetElement("uri");
      if (!is_given(uri->Get<std::string>())) uri->Set(std::string("gazebo.material"));
    }
    complete_material_scripts(child);
  }
}

/// An include that is not found leaves a hole in the world, not a broken file.
bool is_tolerable(const sdf::Error& error) {
  switch (error.Code()) {
    case sdf::ErrorCode::URI_LOOKUP:
    case sdf::ErrorCode::URI_INVALID:
    case sdf::ErrorCode::VERSION_DEPRECATED:
    case sdf::ErrorCode::ATTRIBUTE_DEPRECATED:
    case sdf::ErrorCode::ELEMENT_DEPRECATED:
      return true;
    default:
      return false;
  }
}

void raise_or_warn(const sdf::Errors& errors, const std::string& label, const WarningSink& warn) {
  for (const sdf::Error& error : errors) {
    if (!is_tolerable(error) && !is_checked_elsewhere(error)) throw Error(describe(error, label));
  }
  for (const sdf::Error& error : errors) {
    if (is_tolerable(error)) warn(describe(error, label));
  }
}

/// What libsdformat says of a document that has been repaired; the elements are looked at once more
/// when they are converted.
void note_or_warn(const sdf::Errors& errors, const std::string& label, const WarningSink& warn,
                  OddList& odd) {
  for (const sdf::Error& error : errors) {
    const std::string text = describe(error, label);
    const bool is_new = std::count(odd.texts.begin(), odd.texts.end(), text) == 0 &&
                        error.Message() != "Failed to load a world.";
    if (is_tolerable(error)) {
      warn(text);
    } else if (is_new && !is_checked_elsewhere(error)) {
      odd.vague.push_back(text);
    }
  }
}

/// libsdformat looks for what included files include by its global configuration.
class GlobalFinder {
 public:
  explicit GlobalFinder(UriFinder find) {
    sdf::ParserConfig::GlobalConfig().SetFindCallback(std::move(find));
  }
  ~GlobalFinder() {
    sdf::ParserConfig::GlobalConfig().SetFindCallback(
        [](const std::string&) { return std::string(); });
  }
  GlobalFinder(const GlobalFinder&) = delete;
  GlobalFinder& operator=(const GlobalFinder&) = delete;
};

/// A document with what it includes; null: libsdformat cannot read it.
struct ReadDocument {
  sdf::SDFPtr document;
  sdf::Errors errors;
};

/// What the first half of sdf::Root::LoadSdfString() does, in a fraction of its time.
ReadDocument read_document(const SdfSources& sources, const UriFinder& find) {
  sdf::Console::Instance()->SetQuiet(true);
  ReadDocument read;
  read.document = read_sdf_text(sources.text(), find, read.errors);
  if (read.document != nullptr) {
    complete_material_scripts(read.document->Root());
  } else {
    read.errors.emplace_back(sdf::ErrorCode::STRING_READ, "libsdformat cannot read it");
  }
  return read;
}

/// And the second half; appends to `errors`.
sdf::Root to_root(const ReadDocument& read, const UriFinder& find, sdf::Errors& errors) {
  errors = read.errors;
  sdf::Root root;
  if (read.document == nullptr) return root;
  sdf::ParserConfig config;
  config.SetFindCallback(find);
  const sdf::Errors load_errors = root.Load(read.document, config);
  errors.insert(errors.end(), load_errors.begin(), load_errors.end());
  return root;
}

sdf::Root load_strictly(const ReadDocument& read, const UriFinder& find, const std::string& label,
                        const WarningSink& warn) {
  sdf::Errors errors;
  sdf::Root root = to_root(read, find, errors);
  raise_or_warn(errors, label, warn);
  return root;
}

/// What is still wrong with a document that has been repaired as a text is repaired or noted.
sdf::Root load_leniently(const ReadDocument& read, const SdfSources& sources, const UriFinder& find,
                         const std::string& label, OddList& odd, const WarningSink& warn) {
  if (read.document != nullptr) repair_elements(read.document->Root(), sources, odd.texts);
  sdf::Errors errors;
  sdf::Root root = to_root(read, find, errors);
  if (read.document != nullptr) {
    note_or_warn(errors, label, warn, odd);
  } else {
    raise_or_warn(errors, label, warn);
  }
  return root;
}

/// As it is, or else without what libsdformat cannot read.
sdf::Root load_or_repair(SdfSources& sources, const std::string& label, OddList& odd,
                         const WarningSink& warn) {
  const UriFinder find = [&sources](const std::string& uri) { return sources.find(uri); };
  const GlobalFinder global(find);
  if (odd.policy == OddElements::kRefuse) {
    return load_strictly(read_document(sources, find), find, label, warn);
  }
  sources.repair_files();
  ReadDocument read;
  try {
    read = read_document(sources, find);
    return load_strictly(read, find, label, warn);
  } catch (const sdf::Exception&) {  // reported by what follows, or again
  } catch (const Error&) {
  }
  if (sources.repair_text() || read.document == nullptr) read = read_document(sources, find);
  return load_leniently(read, sources, find, label, odd, warn);
}

/// libsdformat and what it calls throw of their own at some damaged texts, and the URDF parser
/// writes about others to stderr.
sdf::Root load_root(SdfSources& sources, const std::string& label, OddList& odd,
                    const WarningSink& warn) {
  console_bridge::noOutputHandler();
  try {
    return load_or_repair(sources, label, odd, warn);
  } catch (const Error&) {
    throw;
  } catch (const sdf::Exception& error) {  // which is no std::exception
    throw Error(label + ": libsdformat cannot read it: " + error.GetErrorStr());
  } catch (const std::exception& error) {
    throw Error(label + ": libsdformat cannot read it: " + error.what());
  }
}

/// libsdformat takes the version for a number without a look.
void check_version(const tinyxml2::XMLElement& root, const std::string& label) {
  const char* const version = root.Attribute("version");
  const std::string text = version == nullptr ? "" : version;
  int major = 0, minor = 0, end = 0;
  if (std::sscanf(text.c_str(), "%1d.%2d%n", &major, &minor, &end) == 2 &&
      static_cast<std::size_t>(end) == text.size()) {
    return;
  }
  throw Error(label + ":" + std::to_string(root.GetLineNum()) + ": <sdf> version is '" + text +
              "', must be 1.2 to 1.9");
}

/// libsdformat reports no line for malformed XML; tinyxml2 does.
void check_well_formed(const std::string& xml, const std::string& label) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.c_str(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(label + ":" + std::to_string(document.ErrorLineNum()) +
                ": not well-formed XML: " + document.ErrorStr());
  }
  const tinyxml2::XMLElement* const root = document.RootElement();
  if (root != nullptr && std::string(root->Name()) == "sdf") check_version(*root, label);
}

std::string root_element(const std::string& xml) {
  tinyxml2::XMLDocument document;
  document.Parse(xml.c_str(), xml.size());
  const auto* root = document.RootElement();
  return root == nullptr ? "" : root->Name();
}

WorldSpec load_world(std::string xml, const std::string& label, const std::string& base_folder,
                     const Resources& resources, const WarningSink& warn, OddElements policy) {
  const LoadTurn turn;
  OddList odd{policy};
  blank_late_declarations(xml);
  check_well_formed(xml, label);
  if (root_element(xml) != "sdf") {
    throw Error(label + ": root element is <" + root_element(xml) + ">, expected <sdf>");
  }
  const auto find = [&](const std::string& uri) { return resources.find(uri, base_folder); };
  SdfSources sources(xml, label, find, resources.searched(), odd, warn);
  const sdf::Root root = load_root(sources, label, odd, warn);
  if (root.WorldCount() != 1) {
    throw Error(label + ": holds " + std::to_string(root.WorldCount()) +
                " <world> elements, expected 1");
  }
  const auto original = [&](const std::string& path) { return sources.original(path); };
  const std::size_t before = odd.texts.size();
  MissingFiles missing(odd, warn);
  WorldSpec spec = convert_world(
      *root.WorldByIndex(0), {resources, label, base_folder, warn, odd, missing, true, original});
  missing.close();
  odd.close(before);
  spec.odd_repeats = std::move(odd.repeats);
  spec.odd_elements = std::move(odd.texts);
  return spec;
}

}  // namespace

WorldSpec load_world_file(const std::string& path, const Resources& resources,
                          const WarningSink& warn, OddElements odd) {
  const std::string found = resources.find(path);
  if (found.empty() || std::filesystem::is_directory(found)) {
    throw Error("world file '" + path + "' not found; searched: as given, then " +
                resources.searched());
  }
  std::ifstream file(found, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw Error("world file '" + found + "' cannot be read");
  return load_world(text.str(), found, std::filesystem::path(found).parent_path().string(),
                    resources, warn, odd);
}

WorldSpec load_world_string(const std::string& xml, const std::string& label,
                            const Resources& resources, const WarningSink& warn, OddElements odd) {
  return load_world(xml, label, "", resources, warn, odd);
}

namespace {

/// The model of the document, or the only one of its only world; nullptr: the document has neither.
const sdf::Model* find_single_model(const sdf::Root& root) {
  if (root.Model() != nullptr) return root.Model();
  const bool is_world_of_one = root.WorldCount() == 1 && root.WorldByIndex(0)->ModelCount() == 1;
  return is_world_of_one ? root.WorldByIndex(0)->ModelByIndex(0) : nullptr;
}

}  // namespace

ModelSpec load_model_string(const std::string& xml, const std::string& label,
                            const Resources& resources, const WarningSink& warn,
                            OddElements policy) {
  const LoadTurn turn;
  OddList odd{policy};
  std::string text = xml;
  blank_late_declarations(text);
  check_well_formed(text, label);
  const std::string kind = root_element(text);
  if (kind == "robot") {
    check_urdf(text, label, warn, odd);
  } else if (kind == "model") {
    text = "<sdf version='1.4'>" + text.substr(text.find("<model")) + "</sdf>";
  } else if (kind != "sdf") {
    throw Error(label + ": root element is <" + kind + ">, expected <robot>, <sdf> or <model>");
  }
  const auto find = [&](const std::string& uri) { return resources.find(uri); };
  SdfSources sources(text, label, find, resources.searched(), odd, warn);
  const sdf::Root root = load_root(sources, label, odd, warn);
  const sdf::Model* const model = find_single_model(root);
  if (model == nullptr) throw Error(label + ": holds no <model>");
  const auto original = [&](const std::string& path) { return sources.original(path); };
  const std::size_t before = odd.texts.size();
  MissingFiles missing(odd, warn);
  ModelSpec spec =
      convert_model(*model, {resources, label, "", warn, odd, missing, kind != "robot", original});
  missing.close();
  odd.close(before);
  spec.odd_repeats = std::move(odd.repeats);
  spec.odd_elements = std::move(odd.texts);
  return spec;
}

}  // namespace trident::sim
