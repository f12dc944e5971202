// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "session_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "trident_base/regular_file.h"
#include "trident_base/sha256.h"

namespace trident::slam {
namespace {

constexpr char kName[] = "trident graph_slam_2d session ";
constexpr int kVersion = 2;
constexpr std::size_t kDigestLength = 64;
constexpr char kUnfinished[] = ".new";

std::string header() { return kName + std::to_string(kVersion) + "\n"; }

std::string digest_of(const std::string& bytes) {
  Sha256 sha;
  sha.update(bytes.data(), bytes.size());
  return sha.hex_digest();
}

/// A file that is on the disk, not only in the system's buffers, after `keep`.
class NewFile {
 public:
  explicit NewFile(std::string path)
      : path_(std::move(path)),
        file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (file_ < 0) fail();
  }
  ~NewFile() { close(file_); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(file_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail();
      done += static_cast<std::size_t>(count);
    }
  }
  void keep() {
    if (fsync(file_) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(path_ + ": cannot be written: " + std::strerror(errno));
  }

  std::string path_;
  int file_;
};

/// After this a file's new name survives a loss of power, too, where the file system can do it.
void keep_folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path();
  const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

}  // namespace

void write_session_file(const std::string& path, const BinaryWriter& contents) {
  const std::string unfinished = path + kUnfinished;
  {
    NewFile file(unfinished);
    file.write(header() + digest_of(contents.bytes()) + "\n");
    file.write(contents.bytes());
    file.keep();
  }
  if (std::rename(unfinished.c_str(), path.c_str()) != 0) {
    throw Error(path + ": cannot be replaced by " + unfinished + ": " + std::strerror(errno));
  }
  keep_folder_of(path);
}

/// Name, version and checksum are read before anything else: a file that is cut off or damaged must
/// not become a map that looks right.
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
  if (digest_of(contents) + '\n' != bytes.substr(end + 1, kDigestLength + 1)) {
    throw Error(path + ": the checksum does not fit; the file is cut off or damaged");
  }
  return {std::move(contents), path};
}

}  // namespace trident::slam
