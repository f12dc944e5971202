// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/signing.h"

#include <algorithm>
#include <exception>

namespace trident::bridges::mavlink {
namespace {

constexpr std::int64_t kUnix2015Ns = 1'420'070'400'000'000'000;
constexpr std::size_t kDigestBytes = 6;  // of the digest that a signature holds
constexpr std::size_t kTimeBytes = 6;
constexpr SigningTime kLatest = (SigningTime{1} << 48) - 1;
constexpr std::uint32_t kRadioStatus = 109;  // RADIO_STATUS: radios cannot sign

SigningTime read_time(Bytes bytes) {
  SigningTime time = 0;
  for (std::size_t i = 0; i < kTimeBytes; ++i) time |= SigningTime{bytes[i]} << (8 * i);
  return time;
}

/// Takes as long for any difference.
bool are_equal(Bytes a, Bytes b) {
  std::uint8_t difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= a[i] ^ b[i];
  return difference == 0;
}

}  // namespace

SigningTime signing_time(std::int64_t utc_ns) {
  return utc_ns < kUnix2015Ns ? 0 : static_cast<SigningTime>((utc_ns - kUnix2015Ns) / 10'000);
}

const char* text_of(SignatureVerdict verdict) {
  constexpr std::array<const char*, kSignatureVerdicts> kTexts{
      "accepted",        "unsigned", "MAVLink 1",          "wrong signature",
      "link not listed", "replayed", "older than a minute"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

Signing::Signing(const SigningKey& key, SigningStore* store, SigningTime now)
    : key_(key), store_(store) {
  if (store_ != nullptr) memory_ = store_->load();
  memory_.newest = std::max(memory_.newest, now);
  save_ahead();
}

Signing::~Signing() {
  try {
    if (store_ != nullptr) store_->save(memory_);
  } catch (const std::exception&) {  // What was saved ahead holds.
  }
}

/// Keeps the end of the minute that begins, so that no time of it is used again after a crash.
void Signing::save_ahead() {
  saved_ = memory_.newest;
  if (store_ == nullptr) return;
  SigningMemory ahead = memory_;
  ahead.newest += kSigningMinute;
  store_->save(ahead);
}

void Signing::advance(SigningTime now) {
  memory_.newest = std::min(std::max(memory_.newest, now), kLatest);
  if (memory_.newest - saved_ >= kSigningMinute) save_ahead();
}

std::array<std::uint8_t, 32> Signing::digest(Bytes packet, Bytes link_and_time) {
  sha256_.update(key_.data(), key_.size());
  sha256_.update(packet.data(), packet.size());
  sha256_.update(link_and_time.data(), link_and_time.size());
  return sha256_.digest_and_reset();
}

void Signing::sign(Bytes packet, std::uint8_t link, std::uint8_t* signature) {
  advance(memory_.newest + 1);
  signature[0] = link;
  for (std::size_t i = 0; i < kTimeBytes; ++i) {
    signature[1 + i] = static_cast<std::uint8_t>(memory_.newest >> (8 * i));
  }
  const auto whole = digest(packet, {signature, 1 + kTimeBytes});
  std::copy_n(whole.begin(), kDigestBytes, signature + 1 + kTimeBytes);
}

SignatureVerdict Signing::check(const Packet& packet) {
  const SignatureVerdict result = verdict(packet);
  ++counts_[static_cast<std::size_t>(result)];
  return result;
}

SignatureVerdict Signing::verdict(const Packet& packet) {
  if (packet.id == kRadioStatus && !packet.is_signed) return SignatureVerdict::kAccepted;
  if (packet.version != 2) return SignatureVerdict::kMavlink1;
  if (!packet.is_signed) return SignatureVerdict::kUnsigned;
  return verdict_of_signature(packet);
}

SignatureVerdict Signing::verdict_of_signature(const Packet& packet) {
  const std::size_t content = packet.raw.size() - kSignatureSize;
  const Bytes signature = packet.raw.subspan(content);
  const auto whole = digest(packet.raw.first(content), signature.first(1 + kTimeBytes));
  if (!are_equal(signature.subspan(1 + kTimeBytes), Bytes(whole).first(kDigestBytes))) {
    return SignatureVerdict::kWrong;
  }
  const std::uint8_t link = signature[0];
  if (!links_.empty() && std::find(links_.begin(), links_.end(), link) == links_.end()) {
    return SignatureVerdict::kWrongLink;
  }
  return verdict_of_time({packet.source, link}, read_time(signature.subspan(1)));
}

SignatureVerdict Signing::verdict_of_time(const SigningStream& stream, SigningTime time) {
  if (time + kSigningMinute < memory_.newest) return SignatureVerdict::kTooOld;
  SigningTime& last = memory_.streams[stream];
  if (time <= last) return SignatureVerdict::kReplayed;
  last = time;
  advance(time);
  return SignatureVerdict::kAccepted;
}

}  // namespace trident::bridges::mavlink
