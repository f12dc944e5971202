// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/signing_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "trident_base/error.h"
#include "trident_base/hex_digit.h"
#include "trident_base/regular_file.h"

namespace trident::bridges::mavlink {
namespace {

constexpr const char* kFirstLine = "trident signing times 1";

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(path + ": " + what + ": " + std::strerror(errno));
}

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

void write_all(const Descriptor& file, const std::string& path, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file.number(), text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) fail(path, "cannot be written");
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

void write_and_sync(const std::string& path, const std::string& text) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (file.number() < 0) fail(path, "cannot be written");
  write_all(file, path, text);
  if (::fsync(file.number()) != 0) fail(path, "cannot be synced");
}

void sync_folder(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? "." : parent;
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0 || ::fsync(opened.number()) != 0) fail(folder, "cannot be synced");
}

void check_mode(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) fail(path, "signing key cannot be read");
  if ((about.st_mode & 0077U) == 0) return;
  char mode[8];
  std::snprintf(mode, sizeof mode, "%03o", static_cast<unsigned>(about.st_mode & 0777U));
  throw Error(path + ": a signing key of mode " + mode + ", which others can use; legal: 600, 400");
}

/// False: what stands there to the end is no list of streams.
bool read_streams(std::istream& in, SigningMemory& memory) {
  unsigned system = 0, component = 0, link = 0;
  SigningTime time = 0;
  while (in >> system >> component >> link >> time) {
    if (system >= 256 || component >= 256 || link >= 256) return false;
    const Address source{static_cast<std::uint8_t>(system), static_cast<std::uint8_t>(component)};
    memory.streams[{source, static_cast<std::uint8_t>(link)}] = time;
  }
  return in.eof();
}

}  // namespace

SigningKey read_signing_key(const std::string& path) {
  check_no_device(path, "a file with 64 hexadecimal digits");
  check_mode(path);
  std::ifstream file(path);
  std::string digits, more;
  file >> digits >> more;
  SigningKey key{};
  bool is_legal = digits.size() == 2 * key.size() && more.empty();
  for (std::size_t i = 0; is_legal && i < key.size(); ++i) {
    const int high = hex_digit(digits[2 * i]), low = hex_digit(digits[2 * i + 1]);
    is_legal = high >= 0 && low >= 0;
    key[i] = static_cast<std::uint8_t>(high * 16 + low);
  }
  if (!is_legal) {
    throw Error(path + ": a signing key of " + std::to_string(digits.size()) +
                " characters, legal: 64 hexadecimal digits");  // The key itself is not shown.
  }
  return key;
}

SigningMemory SigningFile::load() {
  SigningMemory memory;
  check_no_device(path_, "a file with signing times");
  std::ifstream file(path_);
  if (!file) {
    if (std::filesystem::exists(path_)) fail(path_, "signing times cannot be read");
    return memory;
  }
  std::string line;
  std::getline(file, line);
  const bool is_legal =
      line == kFirstLine && static_cast<bool>(file >> memory.newest) && read_streams(file, memory);
  if (!is_legal) {
    throw Error(path_ + ": not the signing times that '" + kFirstLine + "' announces; delete it");
  }
  return memory;
}

void SigningFile::save(const SigningMemory& memory) {
  std::ostringstream text;
  text << kFirstLine << '\n' << memory.newest << '\n';
  for (const auto& [stream, time] : memory.streams) {
    text << int{stream.source.system} << ' ' << int{stream.source.component} << ' '
         << int{stream.link} << ' ' << time << '\n';
  }
  const std::string draft = path_ + ".new";
  write_and_sync(draft, text.str());
  if (std::rename(draft.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced");
  sync_folder(path_);
}

}  // namespace trident::bridges::mavlink
