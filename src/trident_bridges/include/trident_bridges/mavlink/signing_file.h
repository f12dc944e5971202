// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_bridges/mavlink/signing.h"

namespace trident::bridges::mavlink {

/// Keeps the memory of signing in a small text file, which is replaced whole and synced to the
/// disk.
class SigningFile : public SigningStore {
 public:
  /// The file need not exist; its folder must.
  explicit SigningFile(std::string path) : path_(std::move(path)) {}
  /// Throws Error for a file that is malformed: without it replayed packets would be believed.
  SigningMemory load() override;
  /// Throws Error when the file cannot be written.
  void save(const SigningMemory& memory) override;

 private:
  std::string path_;
};

}  // namespace trident::bridges::mavlink
