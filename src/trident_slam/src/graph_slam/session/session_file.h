// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "binary_stream.h"

namespace trident::slam {

/// A file of a name, a version, the contents and their SHA-256. It is written to a file next to it,
/// which is then renamed, so that a session that was there is never half overwritten. Throws Error
/// naming the file and the reason.
void write_session_file(const std::string& path, const BinaryWriter& contents);

/// Throws Error when the file cannot be read, is not a session file, has another version, is cut
/// off or has changed since it was written.
BinaryReader read_session_file(const std::string& path);

}  // namespace trident::slam
