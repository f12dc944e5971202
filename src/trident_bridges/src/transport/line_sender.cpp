// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/line_sender.h"

#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace trident::bridges {
namespace {

constexpr std::size_t kLength = sizeof(std::uint32_t);

std::size_t queue_size(double byte_s, std::size_t queue_bytes) {
  if (byte_s == 0.0) return queue_bytes;
  const auto of_a_second = static_cast<std::size_t>(1.0 / byte_s);
  return std::min(queue_bytes, std::max(of_a_second, LineSender::kMinQueue));
}

}  // namespace

LineSender::LineSender(PollLoop& loop, EndpointCounts& counts, double byte_s,
                       std::size_t queue_bytes)
    : loop_(loop),
      counts_(counts),
      schedule_(byte_s),
      queue_(queue_size(byte_s, queue_bytes)),
      departure_(loop) {}

void LineSender::attach(int descriptor) { descriptor_ = descriptor; }

void LineSender::detach() {
  descriptor_ = -1;
  departure_.cancel();
  queue_.clear();
  rest_ = 0;
  is_blocked_ = false;
}

bool LineSender::take(Bytes block) {
  if (descriptor_ < 0 || block.empty()) return false;
  if (kLength + block.size() > queue_.free_bytes()) {
    ++counts_.cut;
    return false;
  }
  const bool is_first = queue_.empty();
  std::array<std::uint8_t, kLength> length;
  const auto size = static_cast<std::uint32_t>(block.size());
  std::memcpy(length.data(), &size, kLength);
  queue_.push(length);
  queue_.push(block);
  if (is_first) {
    begin_block(loop_.now_s());
    write();
  }
  return true;
}

// Takes the length of the first block off the queue; the block leaves after those before it, and
// not before it was handed in.
void LineSender::begin_block(double handed_in_s) {
  std::array<std::uint8_t, kLength> length;
  std::size_t filled = 0;
  for (const Bytes part : queue_.front(kLength)) {
    std::copy(part.begin(), part.end(), length.begin() + static_cast<std::ptrdiff_t>(filled));
    filled += part.size();
  }
  queue_.pop(kLength);
  std::memcpy(&rest_, length.data(), kLength);
  const double delay_s = schedule_.leave_s(handed_in_s, rest_) - loop_.now_s();
  if (delay_s > 0.0) departure_.start(delay_s, [this] { write(); });
}

void LineSender::write() {
  while (rest_ > 0 && !departure_.is_waiting()) {
    write_some();
    set_blocked(rest_ > 0);
    if (is_blocked_) return;
    ++counts_.sent;
    // Zero: the block was handed in before this one left.
    if (!queue_.empty()) begin_block(0.0);
  }
}

void LineSender::write_some() {
  const std::array<Bytes, 2> waiting = queue_.front(rest_);
  std::array<iovec, 2> parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = {const_cast<std::uint8_t*>(waiting[i].data()), waiting[i].size()};
  }
  const auto written = writev(descriptor_, parts.data(), parts.size());
  if (written <= 0) return;
  queue_.pop(static_cast<std::size_t>(written));
  counts_.sent_bytes += static_cast<std::uint64_t>(written);
  rest_ -= static_cast<std::uint32_t>(written);
}

void LineSender::set_blocked(bool is_blocked) {
  if (is_blocked == is_blocked_) return;
  is_blocked_ = is_blocked;
  loop_.change(descriptor_, PollLoop::kReadable | (is_blocked ? PollLoop::kWritable : 0U));
  schedule_.hold(loop_.now_s());
}

}  // namespace trident::bridges
