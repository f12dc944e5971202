// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/bag_file.h"

#include <bzlib.h>
#include <roslz4/lz4s.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0\n";
// Larger sizes than these are damage, and are not allocated.
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
constexpr std::size_t kLargestHeader = std::size_t{1} << 20;
constexpr std::size_t kLargestChunk = std::size_t{1} << 30;
constexpr std::size_t kBlock = std::size_t{1} << 20;
constexpr std::size_t kMaxReported = 20;
// Every chunk's header has this field; rosbag writes it first.
constexpr char kChunkField[] = "compression=";

enum Op : std::uint8_t {
  kMessageData = 2,
  kBagHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// A little-endian number that need not be aligned; the format's numbers are all of this kind.
std::uint32_t u32(const char* from) {
  std::uint32_t value = 0;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

/// An array or text of `each` bytes an element begins at `at` of a message of `size` bytes; moves
/// behind it. Throws Error where that is not within the message.
void skip_array(const char* bytes, std::size_t size, std::size_t each, std::size_t& at) {
  if (size < 4 || at > size - 4) throw Error("cut short");
  const std::uint64_t length = u32(bytes + at);
  at += 4;
  if (length * each > size - at) {
    throw Error("an array of " + std::to_string(length) + " elements in " + std::to_string(size) +
                " bytes");
  }
  at += static_cast<std::size_t>(length) * each;
}

/// A number of a field; false when the field is not there or has another size.
bool number(const std::map<std::string, std::string>& fields, const char* name,
            std::uint32_t& value) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(value)) return false;
  value = u32(found->second.data());
  return true;
}

/// The kind of a record, or -1 where its header does not have one.
int op_of(const std::map<std::string, std::string>& fields) {
  const auto found = fields.find("op");
  return found != fields.end() && found->second.size() == 1
             ? static_cast<std::uint8_t>(found->second[0])
             : -1;
}

std::string text(const std::map<std::string, std::string>& fields, const char* name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : found->second;
}

/// The length of a record's data. Some writers give the two kinds of index a wrong one; their
/// number of entries is right.
std::uint64_t data_size(int op, const std::map<std::string, std::string>& fields,
                        std::uint32_t written) {
  constexpr std::uint64_t kIndexEntry = 12, kChunkInfoEntry = 8;  // [byte]
  std::uint32_t count = 0;
  if (op != kIndexData && op != kChunkInfo) return written;
  if (!number(fields, "count", count)) return written;
  return count * (op == kIndexData ? kIndexEntry : kChunkInfoEntry);
}

/// A stream that ends early yields what it has up to there: messages before the damage are used.
bool decompress_bzip2(std::string& stored, std::string& into) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw Error("out of memory");
  stream.next_in = stored.data();
  stream.avail_in = static_cast<unsigned>(stored.size());
  stream.next_out = into.data();
  stream.avail_out = static_cast<unsigned>(into.size());
  int code = BZ_OK;
  while (code == BZ_OK && stream.avail_out > 0) {
    const unsigned left = stream.avail_in;
    code = BZ2_bzDecompress(&stream);
    if (code == BZ_OK && stream.avail_in == 0 && left == 0) break;
  }
  into.resize(into.size() - stream.avail_out);
  BZ2_bzDecompressEnd(&stream);
  return code == BZ_STREAM_END;
}

bool decompress_lz4(std::string& stored, std::string& into) {
  auto size = static_cast<unsigned>(into.size());
  const int code = roslz4_buffToBuffDecompress(stored.data(), static_cast<unsigned>(stored.size()),
                                               into.data(), &size);
  into.resize(std::min<std::size_t>(size, into.size()));
  return code == ROSLZ4_OK;
}

}  // namespace

BagFile::BagFile(std::string path) : path_(std::move(path)) {
  struct stat about {};
  if (stat(path_.c_str(), &about) != 0)
    throw Error(std::string("cannot be opened: ") + strerror(errno));
  if (!S_ISREG(about.st_mode)) throw Error("is no regular file, legal: a rosbag");
  file_.open(path_, std::ios::binary);
  if (!file_) throw Error(std::string("cannot be opened: ") + strerror(errno));
  file_size_ = static_cast<std::uint64_t>(about.st_size);
  std::string magic;
  if (!read_at(0, kMagicSize, magic) || magic != kMagic) {
    throw Error("is no rosbag of format 2.0");
  }
  walk();
}

std::vector<BagFile::Message> BagFile::messages(const std::vector<std::string>& topics) const {
  const std::set<std::string> wanted(topics.begin(), topics.end());
  std::vector<Message> found;
  for (const Message& message : messages_) {
    if (wanted.count(connections_[message.connection].topic) != 0) found.push_back(message);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Message& a, const Message& b) { return a.time < b.time; });
  return found;
}

/// Behind all chunks there is nothing but the index, which is not used.
bool BagFile::is_in_index(std::uint64_t record) const {
  return index_begin_ != 0 && index_begin_ < file_size_ &&
         (record >= index_begin_ || last_op_ == kIndexData);
}

void BagFile::walk() {
  std::uint64_t at = kMagicSize;
  while (at < file_size_) {
    const std::uint64_t record = at;
    if (take_record(at)) continue;
    at = next_chunk_after(record + 1);
    if (at == file_size_ && is_in_index(record)) return;
    leave_out(record, at < file_size_
                          ? "no whole record; reading continues at offset " + std::to_string(at)
                          : "no whole record, and nothing behind it");
  }
}

/// Moves `at` behind a whole record; false if there is no such record.
bool BagFile::take_record(std::uint64_t& at) {
  Record record;
  record.at = at;
  if (!read_record(record) || !take(record)) return false;
  last_op_ = record.op;
  at = std::min(record.begin + record.size, file_size_);
  return true;
}

/// A record is the length of its header, the header, the length of its data, and these. Only a
/// chunk may reach beyond the end of the file: what it has up to there is used.
bool BagFile::read_record(Record& record) {
  std::string word;
  std::string header;
  if (!read_at(record.at, 4, word)) return false;
  const std::uint32_t header_size = u32(word.data());
  if (header_size > kLargestHeader || !read_at(record.at + 4, header_size, header)) return false;
  record.begin = record.at + 8 + header_size;
  if (!parse_fields({header.data(), header.size()}, record.fields)) return false;
  if (!read_at(record.begin - 4, 4, word)) return false;
  record.op = op_of(record.fields);
  record.size = data_size(record.op, record.fields, u32(word.data()));
  return record.op == kChunk || record.begin + record.size <= file_size_;
}

/// Takes over what a record says; false: it is no such record.
bool BagFile::take(const Record& record) {
  switch (record.op) {
    case kBagHeader:
      take_bag_header(record.fields);
      return true;
    case kChunk:
      return take_chunk(record.at, record.fields, record.begin, record.size);
    case kMessageData:
      take_loose_message(record);
      return true;
    case kConnection:
      return take_loose_connection(record);
    default:
      return record.op == kIndexData || record.op == kChunkInfo;
  }
}

void BagFile::take_bag_header(const Fields& fields) {
  const std::string encryptor = text(fields, "encryptor");
  if (!encryptor.empty()) {
    throw Error("is encrypted by " + encryptor + ", legal: a plain rosbag");
  }
  const std::string index = text(fields, "index_pos");
  if (index.size() == sizeof(index_begin_)) {
    std::memcpy(&index_begin_, index.data(), sizeof(index_begin_));
  }
}

/// A recording that was never closed ends with records that no chunk encloses yet.
void BagFile::take_loose_message(const Record& record) {
  chunks_.push_back({record.at, record.begin, record.size, record.size, "none"});
  take_message(record.fields, chunks_.size() - 1, 0, record.size);
}

bool BagFile::take_loose_connection(const Record& record) {
  std::string data;
  if (record.size > kLargestHeader || !read_at(record.begin, record.size, data)) return false;
  take_connection(record.fields, {data.data(), data.size()});
  return true;
}

/// How a chunk is stored whose data begin there; false where its header does not say so.
bool BagFile::read_chunk(const Fields& fields, std::uint64_t begin, Chunk& chunk) const {
  std::uint32_t size = 0;
  chunk.compression = text(fields, "compression");
  const std::set<std::string> known = {"none", "bz2", "lz4"};
  if (known.count(chunk.compression) == 0 || !number(fields, "size", size)) return false;
  if (size > kLargestChunk || begin >= file_size_) return false;
  chunk.begin = begin;
  chunk.size = size;
  return true;
}

bool BagFile::take_chunk(std::uint64_t record, const Fields& fields, std::uint64_t begin,
                         std::size_t stored) {
  Chunk chunk;
  if (!read_chunk(fields, begin, chunk)) return false;
  chunk.record = record;
  chunk.stored = static_cast<std::size_t>(std::min<std::uint64_t>(stored, file_size_ - begin));
  if (chunk.stored < stored) {
    leave_out(begin + chunk.stored, "the file ends within a chunk, " +
                                        std::to_string(stored - chunk.stored) + " bytes early");
  }
  const std::string content = content_of(chunk);
  chunks_.push_back(chunk);
  index_chunk(chunks_.size() - 1, {content.data(), content.size()});
  if (content.size() < chunk.size && chunk.stored == stored) {
    leave_out(record, "damaged " + chunk.compression + " data: " + std::to_string(content.size()) +
                          " of " + std::to_string(chunk.size) + " bytes of the chunk are whole");
  }
  return true;
}

void BagFile::index_chunk(std::size_t number_of_chunk, Span content) {
  std::size_t at = 0;
  while (index_record(number_of_chunk, content, at)) {
  }
  if (at != content.size && content.size == chunks_[number_of_chunk].size) {
    leave_out(chunks_[number_of_chunk].record,
              "the chunk's records from byte " + std::to_string(at) + " of " +
                  std::to_string(content.size) + " on are damaged");
  }
}

/// Moves `at` behind the record of a chunk that begins there; false: none does.
bool BagFile::index_record(std::size_t number_of_chunk, Span content, std::size_t& at) {
  const std::size_t left = content.size - at;
  if (left < 8) return false;
  const std::uint32_t header_size = u32(content.data + at);
  if (header_size > left - 8) return false;
  Fields fields;
  if (!parse_fields({content.data + at + 4, header_size}, fields)) return false;
  const std::size_t begin = at + 8 + header_size;
  const std::uint32_t size = u32(content.data + begin - 4);
  if (size > content.size - begin) return false;
  if (!index_data(number_of_chunk, fields, content, {begin, size})) return false;
  at = begin + size;
  return true;
}

/// Messages and connections alone lie within chunks.
bool BagFile::index_data(std::size_t number_of_chunk, const Fields& fields, Span content,
                         Part data) {
  switch (op_of(fields)) {
    case kConnection:
      take_connection(fields, {content.data + data.begin, data.size});
      return true;
    case kMessageData:
      return take_message(fields, number_of_chunk, data.begin, data.size);
    default:
      return false;
  }
}

bool BagFile::take_message(const Fields& fields, std::size_t chunk, std::size_t begin,
                           std::size_t size) {
  std::uint32_t id = 0;
  const std::string time = text(fields, "time");
  if (!number(fields, "conn", id) || time.size() != 8) return false;
  const auto connection = connection_of_id_.find(id);
  if (connection == connection_of_id_.end()) return false;
  Message message;
  message.time.sec = u32(time.data());
  message.time.nsec = u32(time.data() + 4);
  message.connection = connection->second;
  message.chunk = chunk;
  message.begin = begin;
  message.size = size;
  messages_.push_back(message);
  return true;
}

void BagFile::take_connection(const Fields& fields, Span data) {
  Fields about;
  Connection connection;
  if (!number(fields, "conn", connection.id) || !parse_fields(data, about)) return;
  connection.topic = text(fields, "topic");
  connection.type = text(about, "type");
  connection.md5 = text(about, "md5sum");
  if (connection_of_id_.emplace(connection.id, connections_.size()).second) {
    connections_.push_back(std::move(connection));
  }
}

/// Where the next record lies that may be a chunk; the file's size if there is no such record.
std::uint64_t BagFile::next_chunk_after(std::uint64_t at) {
  constexpr std::uint64_t kLead = 8;  // lengths of the header and of its first field
  const std::size_t overlap = std::strlen(kChunkField);
  std::string block;
  for (std::uint64_t from = at; from + overlap < file_size_; from += kBlock) {
    const auto size =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBlock + overlap - 1, file_size_ - from));
    if (!read_at(from, size, block)) break;
    for (auto found = block.find(kChunkField); found != std::string::npos;
         found = block.find(kChunkField, found + 1)) {
      if (from + found >= at + kLead) return from + found - kLead;
    }
  }
  return file_size_;
}

bool BagFile::read_at(std::uint64_t at, std::size_t size, std::string& into) {
  if (at > file_size_ || size > file_size_ - at) return false;
  into.resize(size);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(at));
  file_.read(into.data(), static_cast<std::streamsize>(size));
  return file_.gcount() == static_cast<std::streamsize>(size);
}

/// What a chunk holds, decompressed, as far as it is whole.
std::string BagFile::content_of(const Chunk& chunk) {
  std::string stored;
  if (!read_at(chunk.begin, chunk.stored, stored)) return "";
  if (chunk.compression == "none") return stored;
  std::string content(chunk.size, '\0');
  if (chunk.compression == "bz2") {
    decompress_bzip2(stored, content);
  } else {
    decompress_lz4(stored, content);
  }
  return content;
}

BagFile::Span BagFile::data_of(const Message& message) {
  if (loaded_ != message.chunk) {
    content_ = content_of(chunks_[message.chunk]);
    loaded_ = message.chunk;
  }
  if (message.begin + message.size > content_.size()) throw Error("the file has changed");
  return {content_.data() + message.begin, message.size};
}

void BagFile::leave_out(std::uint64_t at, const std::string& what) {
  if (damage_.size() == kMaxReported) damage_.push_back("more damage is not reported");
  if (damage_.size() < kMaxReported) {
    damage_.push_back("damaged at offset " + std::to_string(at) + ": " + what);
  }
}

void BagFile::check_lengths(const std::string& type, const std::uint8_t* data, std::size_t size) {
  const char* bytes = reinterpret_cast<const char*>(data);
  std::size_t at = 0;
  if (type == "sensor_msgs/LaserScan") {
    at = 12;  // sequence and stamp
    skip_array(bytes, size, 1, at);
    at += 28;  // seven numbers
    skip_array(bytes, size, 4, at);
    skip_array(bytes, size, 4, at);
  } else if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") {
    constexpr std::size_t kSmallestTransform = 76;
    if (size >= 4 && u32(bytes) > size / kSmallestTransform) {
      skip_array(bytes, size, kSmallestTransform, at);
    }
  }
}

bool BagFile::parse_fields(Span header, Fields& fields) {
  std::size_t at = 0;
  while (at < header.size) {
    if (header.size - at < 4) return false;
    const std::uint32_t size = u32(header.data + at);
    at += 4;
    if (size > header.size - at) return false;
    const std::string field(header.data + at, size);
    const auto equals = field.find('=');
    if (equals == std::string::npos || equals == 0) return false;
    fields[field.substr(0, equals)] = field.substr(equals + 1);
    at += size;
  }
  return !fields.empty();
}

}  // namespace trident::slam
