// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/line_reader.h"

#include <bzlib.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "trident_base/error.h"

namespace trident::slam {

class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;
  /// At most `size` bytes; 0 at the end, and then `damage` says whether that was the real end.
  virtual std::size_t read(char* into, std::size_t size, std::string& damage) = 0;
  /// Bytes of the file that were used so far.
  virtual double position() const = 0;
  /// Bytes that are best read at once.
  virtual std::size_t chunk() const = 0;
  double file_size = 0.0;
};

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
/// A scan of 64 beams at 40,000 columns, say, fits in.
constexpr std::size_t kLongestLine = std::size_t{1} << 26;

// zlib's gzread passes plain text through unchanged.
class PlainOrGzip : public ByteSource {
 public:
  explicit PlainOrGzip(int descriptor) : file_(gzdopen(descriptor, "rb")) {
    if (file_ == nullptr) throw Error("out of memory for reading");
    gzbuffer(file_, kChunk);
  }
  ~PlainOrGzip() override { gzclose(file_); }

  std::size_t read(char* into, std::size_t size, std::string& damage) override {
    const int count = gzread(file_, into, static_cast<unsigned>(size));
    int code = Z_OK;
    const char* text = gzerror(file_, &code);
    if (code == Z_BUF_ERROR) damage = "the gzip data ends too early (truncated file)";
    if (code != Z_OK && code != Z_BUF_ERROR) {
      damage = std::string("damaged gzip data: ") + (code == Z_ERRNO ? strerror(errno) : text);
    }
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  double position() const override { return static_cast<double>(gzoffset(file_)); }
  std::size_t chunk() const override { return kChunk; }

 private:
  gzFile file_;
};

// Several streams one after another are one file, as parallel compressors write them.
class Bzip2 : public ByteSource {
 public:
  explicit Bzip2(int descriptor) : file_(fdopen(descriptor, "rb")), input_(kChunk) {
    if (file_ == nullptr) throw Error("out of memory for reading");
    open_stream();
  }
  ~Bzip2() override {
    BZ2_bzDecompressEnd(&stream_);
    std::fclose(file_);
  }

  std::size_t read(char* into, std::size_t size, std::string& damage) override {
    stream_.next_out = into;
    stream_.avail_out = static_cast<unsigned>(size);
    while (stream_.avail_out == size && damage.empty()) {
      if (stream_.avail_in == 0 && !refill()) {
        if (!is_between_streams_) damage = "the bzip2 data ends too early (truncated file)";
        break;
      }
      decompress(damage);
    }
    return size - stream_.avail_out;
  }
  double position() const override { return consumed_; }
  /// A whole block of 900 kB: what is in the cache of it is not there any more when a scan has been
  /// worked on, and that would double the time of reading.
  std::size_t chunk() const override { return std::size_t{1} << 20; }

 private:
  void open_stream() {
    char* const next_in = stream_.next_in;
    const unsigned avail_in = stream_.avail_in;
    stream_.bzalloc = nullptr;
    stream_.bzfree = nullptr;
    stream_.opaque = nullptr;
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw Error("out of memory for reading");
    stream_.next_in = next_in;
    stream_.avail_in = avail_in;
  }
  bool refill() {
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<unsigned>(std::fread(input_.data(), 1, input_.size(), file_));
    consumed_ += stream_.avail_in;
    return stream_.avail_in > 0;
  }
  void decompress(std::string& damage) {
    if (is_between_streams_) {
      char* const next_out = stream_.next_out;
      const unsigned avail_out = stream_.avail_out;
      BZ2_bzDecompressEnd(&stream_);
      open_stream();
      stream_.next_out = next_out;
      stream_.avail_out = avail_out;
    }
    const int code = BZ2_bzDecompress(&stream_);
    is_between_streams_ = code == BZ_STREAM_END;
    if (code != BZ_OK && code != BZ_STREAM_END) damage = "damaged bzip2 data";
  }

  std::FILE* file_;
  std::vector<char> input_;
  bz_stream stream_{};
  double consumed_ = 0.0;
  bool is_between_streams_ = false;
};

/// A device may be endless; a pipe ends with its writer.
void refuse_folder_and_device(const std::string& path, mode_t mode) {
  if (S_ISDIR(mode)) throw Error(path + ": is a folder, expected a log file");
  if (!S_ISREG(mode) && !S_ISFIFO(mode)) {
    throw Error(path + ": is a device, expected a log file");
  }
}

bool begins_as_bzip2(std::FILE* file) {
  char magic[3] = {};
  return std::fread(magic, 1, sizeof(magic), file) == 3 && std::memcmp(magic, "BZh", 3) == 0;
}

std::unique_ptr<ByteSource> open_source(const std::string& path) {
  if (path == "-") return std::make_unique<PlainOrGzip>(dup(STDIN_FILENO));
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (file == nullptr) throw Error(path + ": cannot be opened: " + strerror(errno));
  struct stat about {};
  fstat(fileno(file.get()), &about);
  refuse_folder_and_device(path, about.st_mode);
  const bool is_bzip2 = begins_as_bzip2(file.get());
  const int descriptor = dup(fileno(file.get()));
  file.reset();  // before the descriptor goes back to the beginning: both share their place
  lseek(descriptor, 0, SEEK_SET);
  std::unique_ptr<ByteSource> source;
  if (is_bzip2) {
    source = std::make_unique<Bzip2>(descriptor);
  } else {
    source = std::make_unique<PlainOrGzip>(descriptor);
  }
  source->file_size = static_cast<double>(about.st_size);
  return source;
}

}  // namespace

LineReader::LineReader(std::string path) : path_(std::move(path)), source_(open_source(path_)) {}

LineReader::~LineReader() = default;

bool LineReader::fill() {
  if (!damage_.empty()) return false;
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t old_size = buffer_.size();
  buffer_.resize(old_size + source_->chunk());
  const std::size_t count = source_->read(&buffer_[old_size], source_->chunk(), damage_);
  buffer_.resize(old_size + count);
  return count > 0;
}

/// A file without line ends is no log, and would fill the memory.
void LineReader::check_length(std::size_t bytes) const {
  if (bytes <= kLongestLine) return;
  throw Error(path_ + ":" + std::to_string(line_number_ + 1) + ": a line of more than " +
              std::to_string(kLongestLine >> 20) + " MiB, expected a log file");
}

/// The end of a line is searched for only in what has been read since the last look. The last line
/// of a file that is still being written has no end; it is handed out and marked as open.
bool LineReader::next(std::string_view& line) {
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = buffer_.find('\n', begin_ + searched);
    if (end != std::string::npos) {
      line = std::string_view(buffer_).substr(begin_, end - begin_);
      begin_ = end + 1;
      break;
    }
    searched = buffer_.size() - begin_;
    check_length(searched);
    if (fill()) continue;
    if (begin_ == buffer_.size()) return false;
    line = std::string_view(buffer_).substr(begin_);
    begin_ = buffer_.size();
    is_last_line_open_ = true;
    break;
  }
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_number_;
  return true;
}

double LineReader::progress() const {
  return source_->file_size > 0.0 ? source_->position() / source_->file_size : 0.0;
}

}  // namespace trident::slam
