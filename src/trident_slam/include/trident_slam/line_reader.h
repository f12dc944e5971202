// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace trident::slam {

/// Bytes of a file as they are after decompression; see `LineReader`.
class ByteSource;

/// The lines of a text file, one after another, in a buffer that is as large as the longest line.
/// What the file is (plain, gzip, bzip2) is determined from its first bytes, never from its name.
class LineReader {
 public:
  /// "-" is the standard input (plain text). Throws Error when the file cannot be opened.
  explicit LineReader(std::string path);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;
  ~LineReader();

  /// False at the end. `line` has no line feed and is valid until the next call.
  bool next(std::string_view& line);

  const std::string& path() const { return path_; }  ///< as given, for errors
  /// Of the last line, from 1.
  std::size_t line_number() const { return line_number_; }
  /// True when the last line ended with the file and not with a line feed.
  bool is_last_line_open() const { return is_last_line_open_; }
  /// Part of the file's bytes that is read, 0 .. 1; 0 where the length is unknown.
  double progress() const;
  /// Empty, or why the file ended before its end (damaged or truncated compression).
  const std::string& damage() const { return damage_; }

 private:
  bool fill();
  void check_length(std::size_t bytes) const;

  std::string path_;
  std::unique_ptr<ByteSource> source_;
  std::string buffer_;     // not yet given out: [begin_, buffer_.size())
  std::size_t begin_ = 0;  // of the next line
  std::size_t line_number_ = 0;
  bool is_last_line_open_ = false;
  std::string damage_;
};

}  // namespace trident::slam
