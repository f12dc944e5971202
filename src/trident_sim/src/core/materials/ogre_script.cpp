// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ogre_script.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "trident_base/error.h"

namespace trident::sim {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepest = 32;  ///< of blocks; OGRE's own nest five deep

struct Token {
  std::string text;  ///< "\n" ends a statement
  int line = 0;
};

/// "pass { ... }" or "ambient 1 0 0".
struct Statement {
  std::vector<std::string> words;
  std::vector<Statement> block;
  int line = 0;

  bool is(const char* word) const { return !words.empty() && words.front() == word; }
  const Statement* find(const char* word) const {
    const auto found = std::find_if(block.begin(), block.end(),
                                    [word](const Statement& child) { return child.is(word); });
    return found == block.end() ? nullptr : &*found;
  }
};

class Tokenizer {
 public:
  explicit Tokenizer(const std::string& text) : text_(text) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) take();
    return std::move(tokens_);
  }

 private:
  void add(std::string text) { tokens_.push_back({std::move(text), line_}); }
  bool starts(const char* with) const { return text_.compare(at_, 2, with) == 0; }
  static bool is_mark(char c) { return c == '\n' || c == '{' || c == '}'; }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  void skip_block_comment() {
    const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = std::min(end + 2, text_.size());
  }

  void take_mark(char c) {
    add(std::string(1, c));
    if (c == '\n') ++line_;
    ++at_;
  }

  /// Up to the closing quotation mark, or the end of the line.
  void take_quoted() {
    const std::size_t end = std::min(text_.find_first_of("\"\n", at_ + 1), text_.size());
    add(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end < text_.size() && text_[end] == '"' ? end + 1 : end;
  }

  void take_word() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n{}\"", at_), text_.size());
    add(text_.substr(at_, end - at_));
    at_ = end;
  }

  void take() {
    const char c = text_[at_];
    if (starts("//")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (starts("/*")) {
      skip_block_comment();
    } else if (is_mark(c)) {
      take_mark(c);
    } else if (c == '"') {
      take_quoted();
    } else if (is_blank(c)) {
      ++at_;
    } else {
      take_word();
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

class Parser {
 public:
  Parser(std::vector<Token> tokens, const std::string& label)
      : tokens_(std::move(tokens)), label_(label) {}

  std::vector<Statement> run() {
    std::vector<Statement> statements = read_block(0);
    if (at_ < tokens_.size()) refuse("'}' without its '{'");
    return statements;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    const int line = tokens_.empty() ? 1 : tokens_[std::min(at_, tokens_.size() - 1)].line;
    throw Error(label_ + ":" + std::to_string(line) + ": " + what);
  }
  bool sees(const char* text) const { return at_ < tokens_.size() && tokens_[at_].text == text; }
  bool sees_mark() const { return sees("\n") || sees("{") || sees("}"); }
  void skip_lines() {
    while (sees("\n")) ++at_;
  }

  /// Up to the end of the file or a '}', which stays.
  std::vector<Statement> read_block(int depth) {
    if (depth > kDeepest) refuse("blocks nest deeper than " + std::to_string(kDeepest));
    std::vector<Statement> statements;
    for (skip_lines(); at_ < tokens_.size() && !sees("}"); skip_lines()) {
      statements.push_back(read_statement(depth));
    }
    return statements;
  }

  Statement read_statement(int depth) {
    Statement statement;
    statement.line = tokens_[at_].line;
    while (at_ < tokens_.size() && !sees_mark()) {
      statement.words.push_back(tokens_[at_++].text);
    }
    skip_lines();
    // The brace may stand in the next line.
    if (!sees("{")) return statement;
    ++at_;
    statement.block = read_block(depth + 1);
    if (!sees("}")) refuse("the block of line " + std::to_string(statement.line) + " has no '}'");
    ++at_;
    return statement;
  }

  std::vector<Token> tokens_;
  const std::string& label_;
  std::size_t at_ = 0;
};

/// Colours of three or four numbers; the fourth of `specular` may be its shininess, as the fourth
/// or fifth number; what is not a number is not a colour.
/// The words behind the first, all of them numbers; else nothing.
std::optional<std::vector<double>> numbers_of(const Statement& statement) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i < statement.words.size(); ++i) {
    std::istringstream word(statement.words[i]);
    double value = 0.0;
    if (!(word >> value) || !word.eof()) return std::nullopt;
    numbers.push_back(value);
  }
  return numbers;
}

void read_color(const Statement& pass, const char* name, const std::string& label,
                Eigen::Vector4d& color) {
  const Statement* const statement = pass.find(name);
  if (statement == nullptr) return;
  const std::optional<std::vector<double>> numbers = numbers_of(*statement);
  // As "ambient vertexcolour", which takes the colors of the vertices.
  if (!numbers) return;
  const std::vector<double>& rgba = *numbers;
  if (rgba.size() < 3) {
    throw Error(label + ":" + std::to_string(statement->line) + ": '" + name + "' has " +
                std::to_string(rgba.size()) + " numbers, must have red, green and blue");
  }
  const bool has_alpha = rgba.size() > (std::string(name) == "specular" ? 4U : 3U);
  color = Eigen::Vector4d(rgba[0], rgba[1], rgba[2], has_alpha ? rgba[3] : 1.0);
  color = color.cwiseMax(0.0).cwiseMin(1.0);
}

void read_pass(const Statement& pass, const std::string& label, OgreMaterial& material) {
  read_color(pass, "ambient", label, material.ambient);
  read_color(pass, "diffuse", label, material.diffuse);
  read_color(pass, "specular", label, material.specular);
  read_color(pass, "emissive", label, material.emissive);
  const Statement* const unit = pass.find("texture_unit");
  const Statement* const texture = unit != nullptr ? unit->find("texture") : nullptr;
  if (texture != nullptr && texture->words.size() > 1) material.texture = texture->words[1];
}

/// "material NAME : PARENT"; either may be of several words.
std::pair<std::string, std::string> names_of(const Statement& statement) {
  std::string name, parent;
  std::string* target = &name;
  for (std::size_t i = 1; i < statement.words.size(); ++i) {
    const std::string& word = statement.words[i];
    if (word == ":") {
      target = &parent;
    } else {
      *target += (target->empty() ? "" : " ") + word;
    }
  }
  return {name, parent};
}

/// What a material begins as: its parent, of the same script or one of Gazebo's.
OgreMaterial inherited(const std::string& parent,
                       const std::map<std::string, OgreMaterial>& script) {
  if (const auto above = script.find(parent); above != script.end()) return above->second;
  const OgreMaterial* const known = find_ogre_material(parent);
  return known != nullptr ? *known : OgreMaterial();
}

std::vector<std::string> scripts_in(const std::string& path) {
  std::error_code ignored;
  const auto is_script = [](const fs::path& file) { return file.extension() == ".material"; };
  std::vector<std::string> files;
  if (is_script(path)) files.push_back(path);
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    if (is_script(entry.path())) files.push_back(entry.path().string());
  }
  // The order of a directory differs between file systems.
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::map<std::string, OgreMaterial> parse_ogre_script(const std::string& text,
                                                      const std::string& label) {
  std::map<std::string, OgreMaterial> materials;
  for (const Statement& statement : Parser(Tokenizer(text).run(), label).run()) {
    if (!statement.is("material")) continue;
    const auto [name, parent] = names_of(statement);
    OgreMaterial material = inherited(parent, materials);
    // Later techniques are for weaker hardware, later passes are drawn over the first.
    const Statement* const technique = statement.find("technique");
    const Statement* const pass = technique != nullptr ? technique->find("pass") : nullptr;
    if (pass != nullptr) read_pass(*pass, label, material);
    materials[name] = material;
  }
  return materials;
}

const OgreScripts::Materials& OgreScripts::read(const std::string& file, const WarningSink& warn) {
  // A script is read once, and one that cannot be read is reported once.
  const auto [known, is_new] = files_.try_emplace(file);
  if (!is_new) return known->second;
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  try {
    known->second = parse_ogre_script(text.str(), file);
  } catch (const Error& error) {
    warn(std::string("material script ") + error.what() + "; its materials are not known");
  }
  return known->second;
}

const OgreMaterial* OgreScripts::find(const std::string& path, const std::string& name,
                                      const WarningSink& warn) {
  for (const std::string& file : scripts_in(path)) {
    const Materials& materials = read(file, warn);
    if (const auto it = materials.find(name); it != materials.end()) return &it->second;
  }
  return nullptr;
}

}  // namespace trident::sim
