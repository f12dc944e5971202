// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/session_file.h"

#include <cstdio>
#include <fstream>
#include <sstream>

#include "trident_base/sha256.h"

namespace trident {
namespace {

constexpr char kName[] = "trident graph_slam_2d session ";
constexpr int kVersion = 1;
constexpr std::size_t kDigestLength = 64;

std::string header() { return kName + std::to_string(kVersion) + "\n"; }

std::string digest_of(const std::string& bytes) {
  Sha256 sha;
  sha.update(bytes.data(), bytes.size());
  return sha.hex_digest();
}

}  // namespace

void write_session_file(const std::string& path, const BinaryWriter& contents) {
  const std::string unfinished = path + ".new";
  std::ofstream file(unfinished, std::ios::binary);
  file << header() << digest_of(contents.bytes()) << '\n' << contents.bytes();
  file.close();
  if (!file) throw Error(unfinished + ": cannot be written");
  if (std::rename(unfinished.c_str(), path.c_str()) != 0) {
    throw Error(path + ": cannot be replaced by " + unfinished);
  }
}

BinaryReader read_session_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string bytes = text.str();
  const std::string name(kName);
  if (bytes.compare(0, name.size(), name) != 0) {
    throw Error(path + ": is no session of graph_slam_2d");
  }
  const std::size_t end = bytes.find('\n');
  const std::string version = bytes.substr(name.size(), end - name.size());
  if (version != std::to_string(kVersion)) {
    throw Error(path + ": version '" + version + "', legal: " + std::to_string(kVersion));
  }
  const std::size_t begin = end + 1 + kDigestLength + 1;
  if (bytes.size() < begin) throw Error(path + ": is cut off in its head");
  std::string contents = bytes.substr(begin);
  if (digest_of(contents) != bytes.substr(end + 1, kDigestLength)) {
    throw Error(path + ": the checksum does not fit; the file is cut off or damaged");
  }
  return {std::move(contents), path};
}

}  // namespace trident
