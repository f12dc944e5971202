// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// Numbers in the byte order of the machine, one after the other.
class BinaryWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const char* begin = reinterpret_cast<const char*>(&value);
    bytes_.append(begin, sizeof(T));
  }
  void put_pose(const SE2& T) {
    put(T.p.x());
    put(T.p.y());
    put(T.angle);
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put<std::uint64_t>(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what BinaryWriter wrote; running out of bytes is an Error that names the file.
class BinaryReader {
 public:
  BinaryReader(std::string bytes, std::string label)
      : bytes_(std::move(bytes)), label_(std::move(label)) {}

  template <class T>
  T get() {
    T value;
    need(sizeof(T));
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  SE2 get_pose() {
    SE2 T;
    T.p.x() = get<double>();
    T.p.y() = get<double>();
    T.angle = get<double>();
    return T;
  }
  template <class T>
  std::vector<T> get_all() {
    const auto count = static_cast<std::size_t>(get<std::uint64_t>());
    if (count > (bytes_.size() - at_) / sizeof(T)) fail();
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }
  std::size_t get_count(std::size_t smallest_size) {
    const auto count = static_cast<std::size_t>(get<std::uint64_t>());
    if (count > (bytes_.size() - at_) / smallest_size) fail();
    return count;
  }
  [[noreturn]] void fail() const {
    throw Error(label_ + ": byte " + std::to_string(at_) + ": the session's contents are damaged");
  }

 private:
  void need(std::size_t size) const {
    if (bytes_.size() - at_ < size) fail();
  }

  std::string bytes_;
  std::string label_;
  std::size_t at_ = 0;
};

}  // namespace trident::slam
