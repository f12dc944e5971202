// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "trident_base/error.h"

namespace trident {
namespace {

void check(int status) {
  if (status != 1) throw Error("SHA-256: the OpenSSL digest failed");
}

EVP_MD_CTX* new_context() {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  if (context == nullptr) throw Error("SHA-256: no OpenSSL digest context");
  return context;
}

}  // namespace

struct Sha256::Context {
  Context() : evp(new_context(), &EVP_MD_CTX_free) {}
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> evp;
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  check(EVP_DigestInit_ex(context_->evp.get(), EVP_sha256(), nullptr));
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(const void* data, std::size_t size) {
  check(EVP_DigestUpdate(context_->evp.get(), data, size));
}

void Sha256::update_double(double value) {
  // Bits are hashed and not values, lowest byte first on every machine: 0 and -0 differ.
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof value);
  std::memcpy(&bits, &value, sizeof bits);
  std::array<unsigned char, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<unsigned char>(bits >> (8 * i));
  }
  update(bytes.data(), bytes.size());
}

void Sha256::update_string(std::string_view text) { update(text.data(), text.size()); }

std::string Sha256::hex_digest() const {
  // Finalising a copy leaves this digest open for more data.
  Context copy;
  check(EVP_MD_CTX_copy_ex(copy.evp.get(), context_->evp.get()));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  check(EVP_DigestFinal_ex(copy.evp.get(), digest.data(), &size));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 0xF];
  }
  return text;
}

std::array<std::uint8_t, 32> Sha256::digest_and_reset() {
  std::array<std::uint8_t, 32> digest;
  unsigned int size = 0;
  check(EVP_DigestFinal_ex(context_->evp.get(), digest.data(), &size));
  // A null type keeps the algorithm that the context has.
  check(EVP_DigestInit_ex(context_->evp.get(), nullptr, nullptr));
  return digest;
}

}  // namespace trident
