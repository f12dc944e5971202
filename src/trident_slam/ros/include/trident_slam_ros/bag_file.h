// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "trident_base/error.h"

namespace trident::slam {

/// A rosbag (format 2.0) read record by record. It needs no index, so that recordings that were
/// never closed are read; what is damaged is left out and reported with its offset, and what is
/// whole next to it is used. rosbag_storage believes every length and offset in a file, and
/// crashes. Source of the format: http://wiki.ros.org/Bags/Format/2.0
class BagFile {
 public:
  /// A publisher of one topic, as it was recorded; a topic may have several.
  struct Connection {
    std::uint32_t id = 0;  ///< in the file
    std::string topic;     ///< resolved name
    std::string type;      ///< "package/Message"
    std::string md5;       ///< of the message's definition, 32 hexadecimal digits
  };
  /// Where a message lies; its data are read by instantiate().
  struct Message {
    ros::Time time;              ///< when it was recorded
    std::size_t connection = 0;  ///< index into connections()
    std::size_t chunk = 0;       ///< number of the chunk, in file order
    std::size_t begin = 0;       ///< of its data within the chunk [byte]
    std::size_t size = 0;        ///< [byte]
  };

  /// Throws Error when it cannot be opened, is no bag of format 2.0, or is encrypted.
  explicit BagFile(std::string path);

  /// Of whole records, in the order in which they were found.
  const std::vector<Connection>& connections() const { return connections_; }
  /// What was left out, a sentence each, with its offset in the file.
  const std::vector<std::string>& damage() const { return damage_; }
  /// Messages of some topics by the time of their recording; of equal times as they lie in the
  /// file.
  std::vector<Message> messages(const std::vector<std::string>& topics) const;
  /// The topic that a message of this bag was recorded on.
  const std::string& topic(const Message& message) const {
    return connections_[message.connection].topic;
  }

  /// The message as an `M`; null when it is one of another type. Throws Error, which names the
  /// offset, when its data are no such message.
  template <class M>
  boost::shared_ptr<M> instantiate(const Message& message);

 private:
  /// Where the data of a chunk lie in the file.
  struct Chunk {
    std::uint64_t record = 0;  ///< offset of the record
    std::uint64_t begin = 0;   ///< offset of its data
    std::size_t stored = 0;    ///< bytes in the file
    std::size_t size = 0;      ///< bytes when decompressed
    std::string compression;
  };
  using Fields = std::map<std::string, std::string>;
  struct Span {
    const char* data = nullptr;
    std::size_t size = 0;
  };

  /// Where a record lies, and its header.
  struct Record {
    std::uint64_t at = 0;     ///< offset of the record
    std::uint64_t begin = 0;  ///< offset of its data
    std::uint64_t size = 0;   ///< of its data [byte]
    int op = -1;              ///< what kind it is of
    Fields fields;
  };

  bool is_in_index(std::uint64_t record) const;
  void walk();
  bool take_record(std::uint64_t& at);
  bool read_record(Record& record);
  bool take(const Record& record);
  void take_bag_header(const Fields& fields);
  void take_loose_message(const Record& record);
  bool take_loose_connection(const Record& record);
  bool read_chunk(const Fields& fields, std::uint64_t begin, Chunk& chunk) const;
  bool take_chunk(std::uint64_t record, const Fields& fields, std::uint64_t begin,
                  std::size_t stored);
  /// Bytes of a chunk's content.
  struct Part {
    std::size_t begin = 0;
    std::size_t size = 0;
  };
  void index_chunk(std::size_t number_of_chunk, Span content);
  bool index_record(std::size_t number_of_chunk, Span content, std::size_t& at);
  bool index_data(std::size_t number_of_chunk, const Fields& fields, Span content, Part data);
  bool take_message(const Fields& fields, std::size_t chunk, std::size_t begin, std::size_t size);
  void take_connection(const Fields& fields, Span data);
  std::uint64_t next_chunk_after(std::uint64_t at);
  bool read_at(std::uint64_t at, std::size_t size, std::string& into);
  std::string content_of(const Chunk& chunk);
  Span data_of(const Message& message);
  void leave_out(std::uint64_t at, const std::string& what);
  /// Throws Error when an array in `data` claims to be longer than the message.
  static void check_lengths(const std::string& type, const std::uint8_t* data, std::size_t size);
  static bool parse_fields(Span header, Fields& fields);

  std::string path_;
  std::ifstream file_;
  std::uint64_t file_size_ = 0;
  int last_op_ = 0;                ///< of the last whole record
  std::uint64_t index_begin_ = 0;  ///< where the writer says that all chunks have ended; 0: nowhere
  std::vector<Connection> connections_;
  std::map<std::uint32_t, std::size_t> connection_of_id_;
  std::vector<Chunk> chunks_;
  std::vector<Message> messages_;
  std::vector<std::string> damage_;
  std::size_t loaded_ = static_cast<std::size_t>(-1);  ///< the chunk that is in `content_`
  std::string content_;
};

template <class M>
boost::shared_ptr<M> BagFile::instantiate(const Message& message) {
  const Connection& connection = connections_[message.connection];
  if (connection.md5 != ros::message_traits::MD5Sum<M>::value()) return nullptr;
  const std::string where = "message at offset " + std::to_string(chunks_[message.chunk].record) +
                            " + " + std::to_string(message.begin) + " (" + connection.topic + ")";
  try {
    const Span data = data_of(message);
    // The stream reads only, but is made of a pointer that could write.
    std::string copy(data.data, data.size);
    auto* bytes = reinterpret_cast<std::uint8_t*>(copy.data());
    check_lengths(connection.type, bytes, copy.size());
    ros::serialization::IStream stream(bytes, static_cast<std::uint32_t>(copy.size()));
    const auto result = boost::make_shared<M>();
    ros::serialization::deserialize(stream, *result);
    return result;
  } catch (const std::exception& error) {
    throw Error(where + ": no whole " + connection.type + " (" + error.what() + ")");
  }
}

}  // namespace trident::slam
