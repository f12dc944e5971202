// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace trident {

/// Incremental SHA-256 (FIPS 180-4). The bytes that a number contributes are the same on every
/// machine.
class Sha256 {
 public:
  Sha256();  ///< of no bytes yet
  ~Sha256();
  /// What was moved from can only be destroyed or assigned to.
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;  ///< see the constructor

  /// Appends `size` bytes; how they are cut into calls does not matter.
  void update(const void* data, std::size_t size);
  /// The eight bytes of the IEEE-754 binary64, least significant first. -0.0 and 0.0 differ.
  void update_double(double value);
  /// The bytes of the text, without a length or a terminator.
  void update_string(std::string_view text);

  /// 64 lower-case hexadecimal digits of everything so far; more may be added afterwards.
  std::string hex_digest() const;
  /// The 32 bytes of the digest of everything so far; what is added afterwards begins a new one.
  /// Allocates nothing.
  std::array<std::uint8_t, 32> digest_and_reset();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace trident
