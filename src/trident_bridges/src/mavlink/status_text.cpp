// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/status_text.h"

#include <algorithm>
#include <cstring>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr std::size_t kChunk = 50;       // [bytes] of text in a message
constexpr std::size_t kMaxChunks = 255;  // of a text
constexpr std::size_t kMaxParts = 64;    // texts that are not whole, at a time

std::string joined(const std::map<std::uint8_t, std::string>& chunks, std::uint8_t last) {
  std::string text;
  for (int i = 0; i <= last; ++i) {
    const auto it = chunks.find(static_cast<std::uint8_t>(i));
    text += it == chunks.end() ? "..." : it->second;
  }
  return text;
}

}  // namespace

std::vector<Message> StatusTextWriter::write(Severity severity, const std::string& text) {
  const std::size_t size = std::min(text.size(), kChunk * kMaxChunks);
  std::vector<Message> messages;
  const bool has_parts = size > kChunk;
  if (has_parts && ++id_ == 0) id_ = 1;
  // The last part has a zero in it, if need be by being empty.
  const std::size_t count = !has_parts ? 1 : std::min(size / kChunk + 1, kMaxChunks);
  for (std::size_t i = 0; i < count; ++i) {
    mavlink_statustext_t payload{};
    payload.severity = static_cast<std::uint8_t>(severity);
    payload.id = has_parts ? id_ : 0;
    payload.chunk_seq = static_cast<std::uint8_t>(i);
    const std::size_t begin = i * kChunk;
    std::memcpy(payload.text, text.data() + begin, std::min(kChunk, size - begin));
    messages.push_back(pack(payload, self_));
  }
  return messages;
}

/// A new one, in place of an old one if there are too many, for a text that was not heard of.
StatusTextReader::Part& StatusTextReader::part_of(const Key& key, SimTime now) {
  if (parts_.size() >= kMaxParts && parts_.count(key) == 0) parts_.erase(parts_.begin());
  const auto [it, is_new] = parts_.try_emplace(key);
  if (is_new) it->second.begun = now;
  return it->second;
}

std::optional<StatusText> StatusTextReader::handle(const Message& message, SimTime now) {
  if (!is<mavlink_statustext_t>(message)) return std::nullopt;
  const auto payload = unpack<mavlink_statustext_t>(message);
  const std::string chunk(payload.text, ::strnlen(payload.text, kChunk));
  const auto severity = static_cast<Severity>(payload.severity);
  if (payload.id == 0) return StatusText{message.source, severity, chunk};
  const Key key{message.source, payload.id};
  Part& part = part_of(key, now);
  part.severity = severity;
  part.chunks[payload.chunk_seq] = chunk;
  if (chunk.size() < kChunk) part.last = payload.chunk_seq;
  if (!part.last || part.chunks.size() <= *part.last) return std::nullopt;
  StatusText whole{message.source, severity, joined(part.chunks, *part.last)};
  parts_.erase(key);
  return whole;
}

std::vector<StatusText> StatusTextReader::update(SimTime now) {
  std::vector<StatusText> texts;
  for (auto it = parts_.begin(); it != parts_.end();) {
    const Part& part = it->second;
    if ((now - part.begun).seconds() < kPatience_s) {
      ++it;
      continue;
    }
    const std::uint8_t last = part.chunks.rbegin()->first;
    texts.push_back(
        {it->first.first, part.severity, joined(part.chunks, last) + (part.last ? "" : "...")});
    it = parts_.erase(it);
  }
  return texts;
}

}  // namespace trident::bridges::mavlink
