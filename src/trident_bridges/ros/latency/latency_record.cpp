// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "latency_record.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "trident_base/error.h"

namespace trident::bridges {

LatencyRecord::LatencyRecord(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0) {
    throw Error("record " + file + ": " + std::strerror(errno));
  }
  bytes_ = static_cast<std::uint64_t>(status.st_size);
  memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (memory_ == MAP_FAILED || bytes_ < sizeof(Header) || header().magic != kMagic ||
      bytes_ != sizeof(Header) + 2 * sizeof(std::int64_t) * header().capacity) {
    throw Error("record " + file + " is no record of latencies");
  }
  size_ = header().capacity;
}

LatencyRecord::~LatencyRecord() { munmap(memory_, bytes_); }

std::atomic<std::int64_t>& LatencyRecord::sent_ns(std::uint64_t number) const {
  return reinterpret_cast<std::atomic<std::int64_t>*>(&header() + 1)[number];
}

std::atomic<std::int64_t>& LatencyRecord::received_ns(std::uint64_t number) const {
  return sent_ns(size_ + number);
}

void LatencyRecord::note_sent(std::uint64_t number, std::int64_t time_ns) {
  sent_ns(number) = time_ns;
  ++header().sent;
}

void LatencyRecord::note_received(std::uint64_t number, std::int64_t time_ns) {
  if (number >= size_) {
    ++header().unknown;
  } else if (has_received(number)) {
    ++header().doubles;
  } else {
    received_ns(number) = time_ns;
    ++header().received;
  }
}

std::int64_t monotonic_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace trident::bridges
