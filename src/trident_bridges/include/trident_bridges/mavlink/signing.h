// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "trident_base/sha256.h"
#include "trident_bridges/mavlink/packet.h"

namespace trident::bridges::mavlink {

/// Shared secret of all who sign.
using SigningKey = std::array<std::uint8_t, 32>;

/// Reads 64 hexadecimal digits. Throws Error when the file is missing, malformed, or may be read by
/// others than its owner (mode 600 and 400 are legal).
SigningKey read_signing_key(const std::string& path);

/// Of signatures: [10 us] since 2015-01-01 00:00 UTC, 48 bits.
using SigningTime = std::uint64_t;

inline constexpr SigningTime kSigningMinute = 6'000'000;  ///< [10 us]

/// `utc_ns`: nanoseconds since 1970. Times before 2015 give 0.
SigningTime signing_time(std::int64_t utc_ns);

/// Who signs on which link: each has times of its own, which must grow.
struct SigningStream {
  Address source;         ///< who signs
  std::uint8_t link = 0;  ///< by that source's numbering
  friend bool operator<(const SigningStream& a, const SigningStream& b) {
    return std::tie(a.source, a.link) < std::tie(b.source, b.link);
  }
};

/// What has to outlive a restart, or packets could be replayed.
struct SigningMemory {
  SigningTime newest = 0;                        ///< no later one was used or accepted
  std::map<SigningStream, SigningTime> streams;  ///< newest time of each
};

/// Where the memory is kept.
class SigningStore {
 public:
  virtual ~SigningStore() = default;
  virtual SigningMemory load() = 0;                    ///< an empty one when nothing is kept
  virtual void save(const SigningMemory& memory) = 0;  ///< returns when it is safe
};

/// What is wrong with a packet where signatures are asked for.
enum class SignatureVerdict : std::uint8_t {
  kAccepted,
  kUnsigned,   ///< MAVLink 2 without a signature, and not RADIO_STATUS
  kMavlink1,   ///< cannot be signed
  kWrong,      ///< the signature is of another key or another content
  kWrongLink,  ///< of a link that is not listed
  kReplayed,   ///< not newer than the last one of its stream
  kTooOld,     ///< by more than a minute
};
inline constexpr std::size_t kSignatureVerdicts = 7;  ///< how many there are

/// "unsigned", "replayed" ...
const char* text_of(SignatureVerdict verdict);

/// Signs and checks for all links of a process that share a key. Time comes from outside, and is
/// kept by a store at least each minute of it. See
/// https://mavlink.io/en/guide/message_signing.html.
class Signing {
 public:
  /// `store` is optional and must outlive this. Throws what the store throws.
  Signing(const SigningKey& key, SigningStore* store, SigningTime now);
  /// Keeps the times.
  ~Signing();
  Signing(const Signing&) = delete;
  Signing& operator=(const Signing&) = delete;

  /// Only signatures with these link numbers are accepted; none listed: with any.
  void accept_links(std::vector<std::uint8_t> links) { links_ = std::move(links); }
  /// The time is at least this. Throws what the store throws.
  void advance(SigningTime now);
  /// Whether a packet may be used. Remembers its time if so.
  SignatureVerdict check(const Packet& packet);
  /// Writes the 13 bytes of a signature behind a packet whose flags say that they follow.
  void sign(Bytes packet, std::uint8_t link, std::uint8_t* signature);

  /// How many packets had each verdict.
  const std::array<std::uint64_t, kSignatureVerdicts>& counts() const { return counts_; }

 private:
  SignatureVerdict verdict(const Packet& packet);
  SignatureVerdict verdict_of_signature(const Packet& packet);
  SignatureVerdict verdict_of_time(const SigningStream& stream, SigningTime time);
  std::array<std::uint8_t, 32> digest(Bytes packet, Bytes link_and_time);
  void save_ahead();

  SigningKey key_;
  SigningStore* store_;
  std::vector<std::uint8_t> links_;
  SigningMemory memory_;
  SigningTime saved_ = 0;
  Sha256 sha256_;
  std::array<std::uint64_t, kSignatureVerdicts> counts_{};
};

/// Signs the packets of one link.
class PacketSigner {
 public:
  /// `signing` must outlive this. `link`: one number for each link of a system.
  PacketSigner(Signing& signing, std::uint8_t link) : signing_(signing), link_(link) {}
  /// See Signing::sign.
  void sign(Bytes packet, std::uint8_t* signature) { signing_.sign(packet, link_, signature); }

 private:
  Signing& signing_;
  std::uint8_t link_;
};

}  // namespace trident::bridges::mavlink
